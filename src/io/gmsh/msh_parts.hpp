/// Contents of a .msh file of any version, in one form: nodes, elements in blocks, cells, groups, views.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/vtk_cell.hpp"
#include "io/gmsh/msh_file.hpp"
#include "mesh/cell_types.hpp"

namespace barycert::io {

struct ElementType {
    int number;      ///< Gmsh's
    VtkCell linear;  ///< the cell of its corners, which come first
    int order;
    std::size_t nodes;

    int dimension() const { return linear == vtk_line ? 1 : mesh::cell_type(linear).dimension(); }
    bool is_simplex() const { return linear == vtk_triangle || linear == vtk_tetra; }
};

const ElementType* element_type(std::int64_t number);

/// Triangles and tetrahedra of order 1 and 2.
const ElementType& simplex_element(int dimension, int order);

/// How many elements there are of each type, if there are any; in the order of their numbers.
using TypeCounts = std::map<const ElementType*, std::size_t>;

class TagIndex {
public:
    TagIndex() = default;
    /// Tags in any order, with gaps of any size. Requires: fewer than 2^31.
    explicit TagIndex(std::span<const std::int64_t> tags) {
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

    /// The position of the first tag that stood before, if there is one; then the index is of no use.
    std::optional<std::size_t> first_twice;

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
MshNodes read_msh_nodes(const MshFile& file);

struct ElementBlock {
    const ElementType* type = nullptr;
    std::int64_t entity = 0;  ///< 4.x
    std::size_t tags = 0;     ///< of an element; 2.x
    Run run;                  ///< `first` among all of the file; `id`: the number of the block
};

struct MshElements {
    std::vector<ElementBlock> blocks;
    TypeCounts counts;
    std::size_t count = 0;
};

/// Looks at headers, in text of 2.x at the types of the elements. Error: what the grammar does not have, unknown types.
MshElements find_msh_elements(const MshFile& file);

struct MshCells {
    Mesh mesh;                                  ///< its cells or shapes, with mid-edge nodes in Gmsh's order
    std::vector<std::int64_t> tags;             ///< of elements
    std::vector<double> physical, geometrical;  ///< tags of groups and of entities; in 2.x only
    TypeCounts left_out;                        ///< of a lower dimension
    bool apart = false;                         ///< one of these has a node that no cell has
    bool partitioned = false;                   ///< there are further tags; 2.x only
    std::size_t unused_nodes = 0;
    std::size_t by_corners = 0;  ///< cells of a higher order
    std::size_t repeated = 0;    ///< elements of further groups; 2.x only
};

/// Returns the cells of the highest dimension: shapes, not cut yet, unless all are simplices of one type. Error: an
/// unknown node.
MshCells read_msh_cells(const MshFile& file, const MshElements& elements, const MshNodes& nodes);

/// Tells which elements are not among the cells, and which nodes are of no cell. `partitioned`: entities are.
void note_cells(MshCells& cells, bool partitioned, const std::string& path);

/// The header of a section $NodeData, $ElementData or $ElementNodeData: a field, or a step in time of it.
struct MshView : GmshStep {
    enum class Of : std::uint8_t { nodes, elements, element_nodes };
    Of of = Of::nodes;
    const MshSection* section = nullptr;
    bool interpolated = false;  ///< names an interpolation scheme
    Run rows = {};              ///< of element_nodes: not set
};

/// All such sections, in the order of the file. Error: what the grammar does not have.
std::vector<MshView> find_msh_views(const MshFile& file);

struct ViewTargets {
    const TagIndex& index;
    std::size_t count;  ///< of nodes or cells
    std::string one;    ///< "node"
};

/// Appends a field for each name among these views, and notes what is missing. `step`: of each; not set: its first.
void read_msh_fields(const MshFile& file, const std::vector<MshView>& views, MshView::Of of, const ViewTargets& targets,
                     std::optional<std::int64_t> step, std::vector<Field>& fields, Notes& notes);

}  // namespace barycert::io
