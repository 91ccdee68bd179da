// 2.x   count, rows: tag x y z            ($ParametricNodes: ... dimension entity [u [v]])
// 4.0   blocks count, blocks: entity dimension parametric count, rows: tag x y z [u [v [w]]]
// 4.1   blocks count lowest highest, blocks: dimension entity parametric count, rows: tag, rows: x y z [u [v [w]]]
//
// Parameters u, v, w of a node on its curve, surface or volume are passed over.
#include "barycert/io/gmsh/msh_nodes.hpp"

#include <string>

#include "barycert/base/large_pages.hpp"
#include "barycert/io/gmsh/rows.hpp"
#include "barycert/io/gmsh/walk.hpp"
#include "barycert/io/other_formats.hpp"

namespace barycert::io {
namespace {

/// Where the rows are. `id` of a run: how many parameters a node has.
struct NodeRows {
    std::vector<Run> tags;    ///< 4.1
    std::vector<Run> points;  ///< with the tags in other versions
    std::size_t count = 0;
};

constexpr std::size_t max_nodes = INT32_MAX;

bool add_block(Walk& walk, int version, std::int64_t count, std::size_t parameters, NodeRows& rows) {
    if (static_cast<std::uint64_t>(count) > max_nodes - rows.count)
        return walk.refuse("too many nodes", "at most 2147483647", "more");
    const std::size_t point_bytes = (3 + parameters) * 8, first = rows.count;
    rows.count += static_cast<std::size_t>(count);
    if (version == 41) {
        rows.tags.push_back({walk.place(), static_cast<std::size_t>(count), first, 8, 0});
        if (!walk.skip_rows(count, 1, 8, "tags of nodes")) return false;
        rows.points.push_back({walk.place(), static_cast<std::size_t>(count), first, point_bytes, parameters});
        return walk.skip_rows(count, 3 + parameters, point_bytes, "nodes");
    }
    rows.points.push_back({walk.place(), static_cast<std::size_t>(count), first, 4 + point_bytes, parameters});
    return walk.skip_rows(count, 4 + parameters, 4 + point_bytes, "nodes");
}

bool find_node_blocks(Walk& walk, int version, NodeRows& rows) {
    std::int64_t blocks = 0, total = 0, ignored = 0;
    if (!walk.size(blocks, "the number of blocks") || !walk.size(total, "the number of nodes")) return false;
    if (version == 41 && !(walk.size(ignored, "the lowest tag") && walk.size(ignored, "the highest tag"))) return false;
    if (!walk.end_header()) return false;
    for (std::int64_t i = 0; i < blocks; ++i) {
        std::int64_t dimension = 0, parametric = 0, count = 0;
        const bool entity_first = version == 40;
        if (entity_first && !walk.integer(ignored, "the tag of an entity")) return false;
        if (!walk.integer(dimension, "the dimension of an entity")) return false;
        if (!entity_first && !walk.integer(ignored, "the tag of an entity")) return false;
        if (!walk.integer(parametric, "0 or 1, whether nodes have parameters") ||
            !walk.size(count, "the number of nodes in a block") || !walk.end_header()) {
            return false;
        }
        if (dimension < 0 || dimension > 3)
            return walk.refuse("bad dimension of an entity", "0 to 3", std::to_string(dimension));
        if (parametric != 0 && parametric != 1)
            return walk.refuse("bad mark of parameters", "0 or 1", std::to_string(parametric));
        if (!add_block(walk, version, count, parametric == 1 ? static_cast<std::size_t>(dimension) : 0, rows))
            return false;
    }
    if (static_cast<std::uint64_t>(total) != rows.count) {
        return walk.refuse("the blocks do not add up", std::to_string(total) + " nodes", std::to_string(rows.count),
                           "mend the numbers of nodes");
    }
    return walk.at_end();
}

bool find_rows(Walk& walk, int version, NodeRows& rows) {
    if (version != 22) return find_node_blocks(walk, version, rows);
    std::int64_t count = 0;
    if (!walk.count_line(count, "the number of nodes")) return false;
    return add_block(walk, version, count, 0, rows) && walk.at_end();
}

template <class Row>
bool take_tag(Row& row, std::int64_t& tag) {
    if (!row.tag(tag, "the tag of a node")) return false;
    if (tag >= 0) return true;
    return row.refuse(
        {.what = "bad tag of a node", .expected = "a number that is not negative", .has_number = true, .number = tag});
}

template <class Row>
bool take_point(Row& row, double* point, std::size_t parameters) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!row.real(point[axis], "a finite coordinate")) return false;
    }
    double ignored = 0;
    for (std::size_t k = 0; k < parameters; ++k) {
        if (!row.value(ignored, "a parameter of a node")) return false;
    }
    return true;
}

/// What follows the coordinates in $ParametricNodes.
template <class Row>
bool pass_parameters(Row& row) {
    std::int64_t dimension = 0, entity = 0;
    if (!row.integer(dimension, "a dimension") || !row.integer(entity, "the tag of an entity")) return false;
    double ignored = 0;
    for (std::int64_t k = 0; k < dimension && dimension < 3; ++k) {
        if (!row.value(ignored, "a parameter of a node")) return false;
    }
    return true;
}

}  // namespace

Result<MshNodes> read_msh_nodes(const MshFile& file) {
    const MshSection* section = file.find("Nodes");
    const bool parametric = section == nullptr && file.version() == 22;
    if (parametric) section = file.find("ParametricNodes");
    if (section == nullptr) {
        return Error{.what = "the file contains no nodes",
                     .file = file.path(),
                     .expected = "a section $Nodes",
                     .found = "none",
                     .remedy = "name a file with a mesh; this one may contain views or a geometry only"};
    }
    Walk walk(file, *section);
    NodeRows rows;
    const std::string name(section->name);
    if (parametric) {
        if (file.layout() == MshLayout::binary) {
            return file.error_at(section->name.data(), "binary $ParametricNodes", "$Nodes", "nodes with parameters",
                                 "convert it with " + gmsh_command(file.path()));
        }
        // Rows differ in length: they are found as lines, or read as they come.
        std::int64_t count = 0;
        if (!walk.count_line(count, "the number of nodes")) return walk.error();
        rows.count = static_cast<std::size_t>(count);
        rows.points.push_back({walk.place(), rows.count, 0, 1, 0});
        if (!walk.skip_rows(count, 6, 1, "nodes")) return walk.error();
    } else if (!find_rows(walk, file.version(), rows)) {
        return walk.error();
    }

    MshNodes nodes;
    std::vector<std::int64_t> tags;
    base::resize_large(nodes.points, 3 * rows.count);
    base::resize_large(tags, rows.count);
    double* const points = nodes.points.data();
    std::int64_t* const tag_of = tags.data();
    Status status = parse_runs(file, name.c_str(), rows.tags, [tag_of](auto& row, const Run&, std::size_t i) {
        return take_tag(row, tag_of[i]) && row.end();
    });
    if (!status) return status.error();
    const bool tagged = file.version() != 41;
    status = parse_runs(file, name.c_str(), rows.points,
                        [tag_of, points, tagged, parametric](auto& row, const Run& run, std::size_t i) {
                            if (tagged && !take_tag(row, tag_of[i])) return false;
                            if (!take_point(row, points + 3 * i, run.id)) return false;
                            return (!parametric || pass_parameters(row)) && row.end();
                        });
    if (!status) return status.error();

    std::optional<std::size_t> twice;
    nodes.index = TagIndex(tags, twice);
    if (twice) {
        return file.error_at(section->name.data(), "two nodes with the tag " + std::to_string(tags[*twice]),
                             "each tag once", "it again at node " + std::to_string(*twice) + " from 0",
                             "number the nodes anew: Gmsh itself cannot read such a file");
    }
    return nodes;
}

}  // namespace barycert::io
