/// What a .msh file of any version holds, in one form: nodes, elements in blocks, cells, groups, views.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/gmsh/rows.hpp"
#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

enum class ElementFamily : std::uint8_t { point, line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };

struct ElementType {
    int number;  ///< Gmsh's
    ElementFamily family;
    int order;
    std::size_t nodes;

    int dimension() const;
    /// "tetrahedra of order 3"; with a count of one, "tetrahedron of order 3".
    std::string counted(std::size_t count) const;
};

/// nullptr if the type is not known.
const ElementType* element_type(std::int64_t number);

/// All types that are known, by number.
std::span<const ElementType> element_types();

inline constexpr std::int64_t max_element_type = 140;

/// How many elements there are of each type.
using TypeCounts = std::array<std::size_t, max_element_type + 1>;

/// "8 points, 120 lines": of types whose dimension is at least `low` and at most `high`.
std::string counted_types(const TypeCounts& counts, int low, int high);

class TagIndex {
public:
    /// Tags in any order, with gaps of any size. `first_twice` gets the position of the first one that stood before, if
    /// there is one; then the index is of no use. Precondition: fewer than 2^31.
    TagIndex(std::span<const std::int64_t> tags, std::optional<std::size_t>& first_twice) {
        first_twice.reset();
        if (tags.empty()) return;
        const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
        low_ = *low;
        span_ = offset_of(*high) + 1;
        std::size_t same = 0;
        while (same != tags.size() && offset_of(tags[same]) == same) ++same;
        if (same == tags.size()) return;
        if (span_ <= 8 * tags.size() + 1024) {
            table_.assign(span_, -1);
            for (std::size_t i = 0; i < tags.size() && !first_twice; ++i) {
                Mesh::Index& entry = table_[offset_of(tags[i])];
                if (entry != -1) first_twice = i;
                entry = static_cast<Mesh::Index>(i);
            }
            return;
        }
        in_order_.reserve(tags.size());
        for (std::size_t i = 0; i < tags.size(); ++i) in_order_.emplace_back(tags[i], static_cast<Mesh::Index>(i));
        std::sort(in_order_.begin(), in_order_.end());
        for (std::size_t i = 1; i < in_order_.size(); ++i) {
            const auto position = static_cast<std::size_t>(in_order_[i].second);
            if (in_order_[i].first == in_order_[i - 1].first)
                first_twice = std::min(first_twice.value_or(position), position);
        }
    }
    TagIndex() = default;

    /// The position of a tag, or -1.
    Mesh::Index find(std::int64_t tag) const {
        const std::uint64_t offset = offset_of(tag);
        if (offset >= span_) return -1;
        if (!table_.empty()) return table_[offset];
        return in_order_.empty() ? static_cast<Mesh::Index>(offset) : search(tag);
    }

private:
    std::uint64_t offset_of(std::int64_t tag) const {
        return static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(low_);
    }
    Mesh::Index search(std::int64_t tag) const {
        const auto found = std::lower_bound(in_order_.begin(), in_order_.end(), std::pair(tag, Mesh::Index{0}));
        return found != in_order_.end() && found->first == tag ? found->second : -1;
    }

    std::int64_t low_ = 0;
    std::uint64_t span_ = 0;                                      ///< highest - lowest + 1
    std::vector<Mesh::Index> table_;                              ///< where it is not much larger than the tags
    std::vector<std::pair<std::int64_t, Mesh::Index>> in_order_;  ///< by tag, where it would be; neither: in sequence
};

struct MshNodes {
    std::vector<double> points;  ///< x, y, z a node, finite
    TagIndex index;
};

/// Error: what the grammar does not have, a tag twice, a coordinate that is not finite.
Result<MshNodes> read_msh_nodes(const MshFile& file);

/// Elements of one type, one after the other.
struct ElementBlock {
    const ElementType* type = nullptr;
    std::int64_t entity = 0;  ///< 4.x
    std::size_t tags = 0;     ///< of an element; 2.x
    std::size_t first = 0;    ///< its first element among all of the file
    Run run;                  ///< `first` and `id` are not set
};

struct MshElements {
    std::vector<ElementBlock> blocks;
    TypeCounts counts{};
    std::size_t count = 0;
};

/// Looks at headers, in text of 2.x at the types of the elements. Error: what the grammar does not have, unknown types.
Result<MshElements> find_msh_elements(const MshFile& file);

/// The header of a block of 4.x.
struct BlockHeader {
    std::int64_t dimension = 0, entity = 0;
    std::int64_t kind = 0;  ///< of nodes: whether they have parameters; of elements: their type
    std::int64_t count = 0;
};

/// Calls add(header) for each block of $Nodes or $Elements, which moves over its rows. `what`: "nodes"; `kind`: what
/// BlockHeader::kind is; `found`: how many rows there are so far.
template <class Add>
bool walk_blocks(Walk& walk, int version, const std::string& what, const char* kind, const std::size_t& found,
                 const Add& add) {
    constexpr std::uint64_t most = INT32_MAX;
    const std::string all = "the number of " + what, one = all + " in a block";
    constexpr const char *dimension = "the dimension of an entity", *entity = "the tag of an entity";
    std::int64_t blocks = 0, total = 0, ignored = 0;
    if (!walk.size(blocks, "the number of blocks") || !walk.size(total, all.c_str())) return false;
    if (version == 41 && !(walk.size(ignored, "the lowest tag") && walk.size(ignored, "the highest tag"))) return false;
    for (std::int64_t i = 0; i < blocks; ++i) {
        BlockHeader b;
        const bool head = version == 40 ? walk.integer(b.entity, entity) && walk.integer(b.dimension, dimension)
                                        : walk.integer(b.dimension, dimension) && walk.integer(b.entity, entity);
        if (!head || !walk.integer(b.kind, kind) || !walk.size(b.count, one.c_str())) return false;
        if (static_cast<std::uint64_t>(b.count) > most - found)
            return walk.refuse("too many " + what, "at most 2147483647", "more");
        if (!add(b)) return false;
    }
    if (static_cast<std::uint64_t>(total) == found) return walk.at_end();
    return walk.refuse("the blocks do not add up", std::to_string(total) + " " + what, std::to_string(found),
                       "mend the numbers of " + what);
}

struct MshCells {
    int dimension = 3;
    std::vector<Mesh::Index> corners, mid_nodes;  ///< in Gmsh's order
    std::vector<std::int64_t> tags;               ///< of elements
    std::vector<Mesh::Index> numbers;             ///< among all elements; empty if all are cells
    std::vector<double> physical, geometrical;    ///< tags of groups and of entities; in 2.x only
    TypeCounts left_out{};                        ///< of a lower dimension
    bool apart = false;                           ///< one of these has a node that no cell has
    bool partitioned = false;                     ///< there are further tags; 2.x only
    std::size_t unused_nodes = 0;
    std::size_t repeated = 0;  ///< elements of further groups; 2.x only
};

/// Tetrahedra, or triangles where there is nothing of dimension 3. Error: other cells of that dimension, cells of both
/// orders, an element that names a node that there is not.
Result<MshCells> read_msh_cells(const MshFile& file, const MshElements& elements, const TagIndex& nodes,
                                std::size_t node_count);

/// An entity or a physical group: its dimension and its tag.
using GmshKey = std::pair<std::int64_t, std::int64_t>;

struct MshEntity {
    std::vector<std::int64_t> physical;  ///< tags of groups, as in the file: negative where turned around
    std::int64_t whole = 0;              ///< the entity that it is a part of, or itself
};

/// $PhysicalNames, $Entities and $PartitionedEntities: what entities belong to.
struct MshGroups {
    std::map<GmshKey, std::string> names;   ///< of physical groups
    std::map<GmshKey, MshEntity> entities;  ///< 4.x; those that are in a group or a part of another
    bool partitioned = false;               ///< there are parts of entities
};

Result<MshGroups> read_msh_groups(const MshFile& file);

/// Tells which elements are not among the cells, and which nodes are of no cell.
void note_cells(const MshCells& cells, const MshGroups& groups, const std::string& path, Notes& notes);

/// Appends the fields "gmsh:physical" and "gmsh:geometrical", and the labels "gmsh:tag" and "gmsh:physical_name". A
/// cell field of one of these names that is there already stays: the writer makes such where groups cannot say the
/// same.
void label_cells(const MshFile& file, const MshElements& elements, MshCells cells, const MshGroups& groups, Mesh& mesh);

/// The header of a section $NodeData, $ElementData or $ElementNodeData: a field, or a step in time of it.
struct MshView : GmshStep {
    enum class Of : std::uint8_t { nodes, elements, element_nodes };
    Of of = Of::nodes;
    const MshSection* section = nullptr;
    bool interpolated = false;  ///< names an interpolation scheme
    Run rows = {};              ///< of element_nodes: not set
};

/// All such sections, in the order of the file. Error: what the grammar does not have.
Result<std::vector<MshView>> find_msh_views(const MshFile& file);

/// What views are about.
struct ViewTargets {
    const TagIndex& index;
    std::size_t count;  ///< of nodes or cells
    const char* one;    ///< "node"
    const char* many;   ///< "nodes"
};

/// Appends one field for each name among the views `of` nodes or elements, and tells in `notes` what is missing.
/// `step`: of each field; not set: its first.
Status read_msh_fields(const MshFile& file, const std::vector<MshView>& views, MshView::Of of,
                       const ViewTargets& targets, std::optional<std::int64_t> step, std::vector<Field>& fields,
                       Notes& notes);

struct CellGroups {
    std::vector<std::int64_t> tags;                    ///< of elements
    std::vector<std::int32_t> physical;                ///< a cell; empty: none
    std::vector<std::int32_t> entity;                  ///< a cell; empty: 1
    std::map<std::int32_t, std::int32_t> physical_of;  ///< of each entity, 0 for none; `by_entity` alone
    std::map<std::int32_t, std::string> names;         ///< of physical groups
    std::vector<const Field*> data;                    ///< the cell fields that are written as such

    std::int32_t entity_of(std::size_t cell) const { return entity.empty() ? 1 : entity[cell]; }
    std::int32_t group_of(std::size_t cell) const { return physical.empty() ? 0 : physical[cell]; }
};

/// `by_entity`: an entity can be in one group only (4.1). Error: one group with two names.
Result<CellGroups> group_cells(const Mesh& mesh, bool by_entity, const std::string& path);

}  // namespace barycert::io
