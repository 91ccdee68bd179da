// 2.x   count, rows: tag x y z            ($ParametricNodes: ... dimension entity [u [v]])
// 4.0   blocks count, blocks: entity dimension parametric count, rows: tag x y z [u [v [w]]]
// 4.1   blocks count lowest highest, blocks: dimension entity parametric count, rows: tag, rows: x y z [u [v [w]]]
//
// Parameters u, v, w of a node on its curve, surface or volume are passed over.
#include <string>

#include "barycert/base/large_pages.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {
namespace {

/// Where the rows are. `id` of a run: how many numbers that are passed over follow the coordinates.
struct NodeRows {
    std::vector<Run> tags;    ///< 4.1
    std::vector<Run> points;  ///< with the tags in other versions
    std::size_t count = 0;
};

void add_rows(Walk& walk, int version, std::int64_t count, std::size_t passed, NodeRows& rows) {
    const auto add = [&](std::vector<Run>& to, std::size_t numbers, std::size_t bytes, const char* name) {
        to.push_back({walk.at(), static_cast<std::size_t>(count), rows.count, numbers, bytes, passed});
        walk.skip_rows(count, numbers, bytes, name);
    };
    const std::size_t numbers = 3 + passed, bytes = 8 * numbers, tag = version == 41 ? 0 : 1;
    if (version == 41) add(rows.tags, 1, 8, "tags of nodes");
    add(rows.points, numbers + tag, bytes + 4 * tag, "nodes");
    rows.count += static_cast<std::size_t>(count);
}

/// Rows differ in length: dimension and entity follow the coordinates, and then as many parameters as the dimension
/// says, but none where it is 3.
void find_parametric_rows(const MshFile& file, Walk& walk, std::int64_t count, NodeRows& rows) {
    Walk(walk).skip_rows(count, 6, 1, "nodes");
    const auto dimension_in = [](TextRow row) {
        double ignored = 0;
        std::int64_t dimension = 0;
        for (int i = 0; i < 4; ++i) row.value(ignored, "");
        row.integer(dimension, "");
        return dimension;
    };
    while (rows.count < static_cast<std::size_t>(count)) {
        const std::int64_t dimension = dimension_in(TextRow(walk.at(), walk.end()));
        const std::size_t passed = 2 + (dimension == 1 || dimension == 2 ? static_cast<std::size_t>(dimension) : 0);
        const std::size_t alike =
            rows_alike(file, walk.at(), walk.end(), 4 + passed, static_cast<std::size_t>(count) - rows.count,
                       [&](const TextRow& row) { return dimension_in(row) == dimension; });
        add_rows(walk, 22, static_cast<std::int64_t>(std::max<std::size_t>(alike, 1)), passed, rows);
    }
}

NodeRows find_rows(const MshFile& file, Walk& walk, bool parametric) {
    NodeRows rows;
    if (file.version() != 22) {
        const auto add = [&](const BlockHeader& b) {
            if (b.dimension < 0 || b.dimension > 3)
                walk.refuse("bad dimension of an entity", "0 to 3", std::to_string(b.dimension));
            if (b.kind != 0 && b.kind != 1) walk.refuse("bad mark of parameters", "0 or 1", std::to_string(b.kind));
            add_rows(walk, file.version(), b.count, b.kind == 1 ? static_cast<std::size_t>(b.dimension) : 0, rows);
        };
        walk_blocks(walk, file.version(), "nodes", "0 or 1, whether nodes have parameters", rows.count, add);
        return rows;
    }
    const std::int64_t count = walk.count_line("the number of nodes");
    if (count > INT32_MAX) walk.refuse("too many nodes", "at most 2147483647", "more");
    if (parametric) {
        find_parametric_rows(file, walk, count, rows);
    } else {
        add_rows(walk, 22, count, 0, rows);
        walk.need_end();
    }
    return rows;
}

template <class Row>
bool take_tag(Row& row, std::int64_t& tag) {
    return row.tag(tag, "the tag of a node") &&
           (tag >= 0 || row.refuse({"bad tag of a node", "a number that is not negative", tag}));
}

}  // namespace

MshNodes read_msh_nodes(const MshFile& file) {
    const MshSection* section = file.find("Nodes");
    const bool parametric = section == nullptr && file.version() == 22;
    if (parametric) section = file.find("ParametricNodes");
    if (section == nullptr)
        refuse_file(file.path(), "the file contains no nodes", "a section $Nodes", "none",
                    "name a file with a mesh; this one may contain views or a geometry only");
    if (parametric && file.binary())
        file.refuse(section->name.data(), "binary $ParametricNodes", "$Nodes", "nodes with parameters",
                    "convert it with " + gmsh_command(file.path()));
    Walk walk(file, *section);
    const NodeRows rows = find_rows(file, walk, parametric);

    MshNodes nodes;
    std::vector<std::int64_t> tags;
    base::resize_large(nodes.points, 3 * rows.count);
    base::resize_large(tags, rows.count);
    double* const points = nodes.points.data();
    std::int64_t* const tag_of = tags.data();
    const std::string name(section->name);
    parse_runs(file, name.c_str(), rows.tags,
               [tag_of](auto& row, const Run&, std::size_t i) { return take_tag(row, tag_of[i]); });
    const bool tagged = file.version() != 41;
    parse_runs(file, name.c_str(), rows.points, [=](auto& row, const Run& run, std::size_t i) {
        if (tagged && !take_tag(row, tag_of[i])) return false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!row.real(points[3 * i + axis], "a finite coordinate")) return false;
        }
        std::int64_t integer = 0;
        if (parametric && !(row.integer(integer, "a dimension") && row.integer(integer, "the tag of an entity")))
            return false;
        double ignored = 0;
        for (std::size_t passed = parametric ? 2 : 0; passed < run.id; ++passed) {
            if (!row.value(ignored, "a parameter of a node")) return false;
        }
        return true;
    });
    nodes.index = TagIndex(tags);
    if (const auto twice = nodes.index.first_twice; twice)
        file.refuse(section->name.data(), "two nodes with the tag " + std::to_string(tags[*twice]), "each tag once",
                    "it again at node " + std::to_string(*twice) + " from 0",
                    "number the nodes anew: Gmsh itself cannot read such a file");
    return nodes;
}

}  // namespace barycert::io
