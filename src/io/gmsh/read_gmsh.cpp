// Groups of cells, what a file has beside the mesh, and the mesh as a whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/gmsh/msh_file.hpp"
#include "io/gmsh/msh_parts.hpp"
#include "io/in_space.hpp"
#include "io/mesh_notes.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert {
namespace io {
namespace {

// $PhysicalNames, always text: count, lines: dimension tag "name"
//
// $Entities: four counts (points, curves, surfaces, volumes), then a row for each:
//     tag, x y z of a point or (all others, and in 4.0 points too) two corners of a box, groups count, group...;
//     but for points also: boundaries count, boundary...
// $PartitionedEntities, 4.1: partitions count, ghosts count, rows: ghost partition; four counts; rows as above, with
//     parent-dimension parent-tag, partitions count, partition... after the tag.

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

void read_names(const MshFile& file, const MshSection& section, MshGroups& groups) {
    constexpr const char* name_line = "a line: dimension tag \"name\"";
    Walk walk(file, section, true, "bad line in");
    const auto refuse_at = [&](const char* at) {
        walk.move_to(at);
        walk.refuse_word(name_line, word_at(at, walk.end()));
    };
    const std::int64_t count = walk.integer(name_line);
    if (count < 0) refuse_at(section.body.data());
    walk.line();
    for (std::int64_t i = 0; i < count; ++i) {
        const char* const start = walk.at();
        const std::int64_t dimension = walk.integer(name_line), tag = walk.integer(name_line);
        const std::string_view rest = walk.line();
        const std::size_t first = rest.find('"'), last = rest.rfind('"');
        if (first == std::string_view::npos || first == last) refuse_at(start);
        groups.names[{dimension, tag}] = std::string(rest.substr(first + 1, last - first - 1));
    }
}

std::vector<std::int64_t> take_integers(Walk& walk, const char* count_name, const char* name) {
    std::vector<std::int64_t> values;
    for (std::int64_t left = walk.size(count_name); left > 0; --left) values.push_back(walk.integer(name));
    return values;
}

/// One row. `parts`: of $PartitionedEntities.
void take_entity(Walk& walk, std::int64_t dimension, int reals, bool parts, MshGroups& groups) {
    const std::int64_t tag = walk.integer("the tag of an entity");
    MshEntity entity{{}, tag};
    if (parts) {
        const std::int64_t whole_dimension = walk.integer("the dimension of an entity");
        const std::int64_t whole = walk.integer("the tag of an entity");
        take_integers(walk, "the number of partitions", "a partition");
        if (whole_dimension == dimension) entity.whole = whole;
    }
    for (int i = 0; i < reals; ++i) walk.real("a coordinate");
    entity.physical = take_integers(walk, "the number of physical groups", "the tag of a physical group");
    if (dimension > 0) take_integers(walk, "the number of boundaries", "the tag of an entity");
    if (!entity.physical.empty() || entity.whole != tag) groups.entities[{dimension, tag}] = std::move(entity);
}

void take_entities(const MshFile& file, const MshSection& section, bool parts, MshGroups& groups) {
    Walk walk(file, section);
    if (parts) {
        walk.size("the number of partitions");
        for (std::int64_t ghosts = walk.size("the number of ghost entities"); ghosts-- > 0;) {
            walk.integer("the tag of an entity");
            walk.integer("a partition");
        }
        groups.partitioned = true;
    }
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts) count = walk.size("the number of entities");
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
        const int reals = dimension == 0 && file.version() == 41 ? 3 : 6;
        for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i)
            take_entity(walk, dimension, reals, parts, groups);
    }
    walk.need_end();
}

/// Drops tags of groups that are all 0, for none, and those of entities that are all 0 or all 1.
void drop_what_says_nothing(MshCells& cells) {
    if (std::ranges::all_of(cells.physical, [](double tag) { return tag == 0; })) cells.physical.clear();
    const std::vector<double>& tags = cells.geometrical;
    const auto says_nothing = [&](double tag) { return tag == tags.front() && (tag == 0 || tag == 1); };
    if (std::ranges::all_of(tags, says_nothing)) cells.geometrical.clear();
}

/// 4.x: groups of cells by way of their entities. Nothing is filled in that would say nothing.
void fill_from_entities(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells) {
    std::vector<std::size_t> counts;  // of cells with each tag
    std::set<std::int64_t> in_several;
    for (const ElementBlock& block : elements.blocks) {
        if (cells.left_out.contains(block.type) || block.run.count == 0) continue;
        const auto found = groups.entities.find({cells.mesh.dimension, block.entity});
        const MshEntity alone{{}, block.entity};
        const MshEntity& entity = found == groups.entities.end() ? alone : found->second;
        counts.push_back(block.run.count);
        cells.physical.push_back(entity.physical.empty() ? 0 : static_cast<double>(entity.physical.front()));
        cells.geometrical.push_back(static_cast<double>(entity.whole));
        if (entity.physical.size() > 1) in_several.insert(block.entity);
    }
    drop_what_says_nothing(cells);
    for (std::vector<double>* const tags : {&cells.physical, &cells.geometrical}) {
        if (tags->empty()) continue;
        std::vector<double> of_cells;
        of_cells.reserve(cells.tags.size());
        for (std::size_t i = 0; i < counts.size(); ++i) of_cells.insert(of_cells.end(), counts[i], (*tags)[i]);
        *tags = std::move(of_cells);
    }
    if (in_several.empty()) return;
    cells.mesh.notes.push_back({Note::Kind::left_out,
                                "further physical groups of " + std::to_string(in_several.size()) +
                                    " entities, the first being " + std::to_string(*in_several.begin()) +
                                    ": gmsh:physical has the first group of each cell",
                                file.path(), true});
}

std::vector<std::string> group_names(const MshCells& cells, const MshGroups& groups) {
    std::vector<std::string> names;
    names.reserve(cells.physical.size());
    for (std::size_t i = 0; i < cells.physical.size(); ++i) {
        if (i != 0 && cells.physical[i] == cells.physical[i - 1]) {
            names.push_back(names.back());
            continue;
        }
        // A group that is turned around has its tag with a minus.
        const auto tag = static_cast<std::int64_t>(std::fabs(cells.physical[i]));
        const auto found = groups.names.find({cells.mesh.dimension, tag});
        names.push_back(found == groups.names.end() ? "" : found->second);
    }
    return names;
}

MshGroups read_msh_groups(const MshFile& file) {
    MshGroups groups;
    if (const MshSection* const names = file.find("PhysicalNames"); names != nullptr) read_names(file, *names, groups);
    if (const MshSection* const entities = file.find("Entities"); entities != nullptr && file.version() != 22)
        take_entities(file, *entities, false, groups);
    if (const MshSection* const parts = file.find("PartitionedEntities"); parts != nullptr && file.version() == 41)
        take_entities(file, *parts, true, groups);
    return groups;
}

/// Appends the fields "gmsh:physical" and "gmsh:geometrical", and the labels "gmsh:tag" and "gmsh:physical_name". Cell
/// fields of such names stay: the writer makes them where groups cannot say the same.
void label_cells(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells) {
    Mesh& mesh = cells.mesh;
    file.version() == 22 ? drop_what_says_nothing(cells) : fill_from_entities(file, elements, groups, cells);
    bool in_sequence = true;
    for (std::size_t i = 0; i < cells.tags.size() && in_sequence; ++i)
        in_sequence = cells.tags[i] == std::int64_t{mesh.cell_number(static_cast<Mesh::Index>(i))} + 1;
    if (!cells.physical.empty()) {
        std::vector<std::string> names = group_names(cells, groups);
        if (std::any_of(names.begin(), names.end(), [](const std::string& name) { return !name.empty(); }))
            mesh.cell_labels.push_back({"gmsh:physical_name", std::move(names)});
    }
    if (!in_sequence) mesh.cell_labels.push_back({"gmsh:tag", std::move(cells.tags)});
    const auto add_field = [&](const char* name, std::vector<double>& tags) {
        const bool there = std::ranges::find(mesh.cell_fields, name, &Field::name) != mesh.cell_fields.end();
        if (!tags.empty() && !there) mesh.cell_fields.push_back({name, 1, std::move(tags)});
    };
    add_field("gmsh:physical", cells.physical);
    add_field("gmsh:geometrical", cells.geometrical);
}

void note_sections(const MshFile& file, const std::vector<MshView>& views, Notes& notes) {
    std::set<std::string_view> others;
    for (const MshSection& section : file.sections()) others.insert(section.name);
    for (const std::string_view name : once_sections) others.erase(name);
    for (const std::string_view name : {"NodeData", "ElementData", "ElementNodeData", "Comments"}) others.erase(name);
    const auto shown = [](std::string_view name) { return base::printable(name.substr(0, 40)); };
    if (!others.empty())
        notes.push_back({Note::Kind::left_out, "section $" + base::joined(others, ", $", shown), file.path()});
    std::set<std::string> names;
    for (const MshView& view : views) {
        if (view.of != MshView::Of::element_nodes || !names.insert(view.field).second) continue;
        notes.push_back({Note::Kind::left_out,
                         base::quoted(view.field) + " ($ElementNodeData): it has a value for each node of each element",
                         file.path(), true});
    }
}

Mesh read_whole(const MshFile& file, const GmshReadOptions& options, InSpace* space) {
    MshNodes nodes = read_msh_nodes(file);
    const MshElements elements = find_msh_elements(file);
    MshCells cells = read_msh_cells(file, elements, nodes);
    const MshGroups groups = read_msh_groups(file);
    const std::vector<MshView> views = find_msh_views(file);

    Mesh& mesh = cells.mesh;
    mesh.points = std::move(nodes.points);
    if (!mesh.mid_nodes.empty()) {
        // Both orders are the same in a triangle.
        mesh.mid_edge_order = mesh.dimension == 3 ? MidEdgeOrder::gmsh : MidEdgeOrder::vtk;
        mesh::normalise_mid_nodes(mesh);
    }
    mesh.index_base = 1;
    if (mesh.dimension == 2)
        mesh.points = to_points(std::move(mesh.points), 2, file.path(),
                                mesh.mid_nodes.empty() && mesh.shapes.types.empty() ? file.path() : "", "node", space);
    note_cells(cells, groups.partitioned, file.path());
    read_msh_fields(file, views, MshView::Of::nodes, {nodes.index, mesh.point_count(), "node"}, options.step,
                    mesh.point_fields, mesh.notes);
    if (std::any_of(views.begin(), views.end(), [](const MshView& v) { return v.of == MshView::Of::elements; })) {
        const TagIndex index(cells.tags);
        if (const auto twice = index.first_twice; twice)
            file.refuse("mesh.numbering", file.find("Elements")->name.data(),
                        "two cells with the tag " + std::to_string(cells.tags[*twice]),
                        "each tag once, for $ElementData refers to them",
                        "it again at cell " + std::to_string(*twice) + " from 0", "give each element a tag of its own");
        read_msh_fields(file, views, MshView::Of::elements, {index, mesh.whole_count(), "cell"}, options.step,
                        mesh.cell_fields, mesh.notes);
    }
    label_cells(file, elements, groups, cells);
    note_sections(file, views, mesh.notes);
    cut_into_simplices(mesh, file.path());
    return std::move(mesh);
}

}  // namespace

Result<Mesh> read_gmsh_in_space(const std::string& path, const GmshReadOptions& options, InSpace* space) {
    return read_guarded(path, [&] { return read_whole(MshFile(path, options.threads), options, space); });
}

}  // namespace io

Result<Mesh> read_gmsh(const std::string& path, const GmshReadOptions& options) {
    return io::read_gmsh_in_space(path, options, nullptr);
}

Result<std::vector<GmshStep>> gmsh_steps(const std::string& path) {
    return io::read_guarded(path, [&] {
        const io::MshFile file(path, 0);
        std::vector<io::MshView> views = io::find_msh_views(file);
        std::erase_if(views, [](const io::MshView& v) { return v.of == io::MshView::Of::element_nodes; });
        return std::vector<GmshStep>(views.begin(), views.end());
    });
}

Result<std::vector<double>> read_gmsh_points(const std::string& path, int dimension, int threads) {
    if (dimension != 2 && dimension != 3)
        return file_error("point.dimension", path, "the dimension of points", "2 or 3", std::to_string(dimension));
    return io::read_guarded(path, [&] {
        return io::to_points(io::read_msh_nodes(io::MshFile(path, threads)).points, dimension, path, {}, "node");
    });
}

}  // namespace barycert
