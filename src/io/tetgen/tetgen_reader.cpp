// The grammar accepted. Each file is a header line and then rows, one a line. '#' starts a comment that goes to the end
// of the line; blank and comment lines may stand anywhere. Fields and separators: scanner.hpp.
//
//   .node   nodes [dimension = 3 [attributes = 0 [markers = 0]]]       id x y [z] attribute... [marker]
//   .ele    cells [corners = dimension + 1 [attributes = 0]]           id corner... attribute...
//   .face   faces [markers = 0]                                        id corner... [marker] [cell cell]
//   .neigh  cells [dimension + 1]                                      id neighbour...
//
// dimension: 2 (Triangle) or 3. Corners: 4 or 10 a tetrahedron, 3 or 6 a triangle or face. Attributes are numbers,
// markers integers. Whether faces have mid-edge nodes, and the two cells that TetGen's -nn adds, is told by the columns
// of their first row. The first id of .node, 0 or 1, is the base of all ids and indices of all files; ids run on
// without gaps. A row has as many columns as the header tells, and the file as many rows.
//
// Where TetGen would accept and misread, this reader refuses: see row_errors.cpp.
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "files/suffix.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/tetgen/node_table.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/tetgen/text_table.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace io {
namespace {

constexpr std::array<std::string_view, 4> suffixes{".node", ".ele", ".face", ".neigh"};
constexpr std::array node_header{"nodes", "dimensions", "attributes", "markers"};

std::string header_text(std::initializer_list<std::size_t> numbers) {
    return '"' + base::joined(numbers, " ", [](std::size_t number) { return std::to_string(number); }) + '"';
}

[[noreturn]] void refuse_meaning(ErrorCode code, const TextTable& table, const std::string& what, std::string expected,
                                 std::size_t found, std::string remedy) {
    refuse_header(code, table, what + " in the header", std::move(expected), std::to_string(found), std::move(remedy));
}

/// Sets the columns and the base of a .node file by its header and first row, and makes room for their values.
void settle_node_columns(TextTable& table, std::size_t dimension, std::vector<double>& points,
                         std::vector<Field>& fields, std::vector<std::int64_t>& markers_of_nodes) {
    const std::size_t attributes = table.header_field(2, 0), markers = table.header_field(3, 0);
    if (markers > 1)
        refuse_meaning("file.count", table, "bad number of markers", "0 or 1", markers,
                       "declare further columns as attributes");
    table.columns = {{.name = "id"},
                     {.kind = ColumnKind::real, .count = dimension, .name = "coordinate", .reals = &points},
                     {.kind = ColumnKind::real, .count = attributes, .name = "attribute", .fields = &fields},
                     {.kind = ColumnKind::integer, .count = markers, .name = "marker", .integers = &markers_of_nodes}};
    const std::vector<std::string_view> first = table.first_row();
    std::int64_t id = 0;
    table.base = !first.empty() && scan_integer(first.front().data(), id) != nullptr && id == 1 ? 1 : 0;
    make_room(table);
}

/// One read, step by step. Each preparation reads a header, takes the memory and says where the columns go.
class TetgenReader {
public:
    TetgenReader(std::string stem, const ReadOptions& options) : stem_(std::move(stem)), options_(options) {}

    Mesh read() {
        prepare_nodes();
        prepare_cells();
        if (options_.faces && has(".face")) prepare_faces();
        if (options_.neighbours && has(".neigh")) prepare_neighbours();
        std::vector<TextTable*> tables{&nodes_, &cells_};
        if (faces_) tables.push_back(&*faces_);
        if (neighbours_) tables.push_back(&*neighbours_);
        parse_tables(tables, options_.threads);
        settle_mid_edge_order();
        return std::move(mesh_);
    }

private:
    bool has(const char* suffix) const { return exists(plain_or_packed(stem_ + suffix)); }

    /// Beside the nodes, which have told the base.
    TextTable open(const char* suffix, std::span<const char* const> header_names) const {
        TextTable table = open_table(stem_ + suffix, header_names, options_.threads);
        table.base = mesh_.index_base;
        table.base_is_given = true;
        return table;
    }

    void prepare_nodes() {
        TextTable& table = nodes_ = open_table(stem_ + ".node", node_header, options_.threads);

        const std::size_t dimension = table.header_field(1, 3);
        if (dimension != 2 && dimension != 3)
            refuse_meaning("mesh.dimension", table, "bad dimension", "2 or 3", dimension,
                           "the header is: nodes, dimension, attributes, markers");
        const std::size_t attributes = table.header_field(2, 0), markers = table.header_field(3, 0);
        const std::string more = header_text({table.rows, dimension, attributes + 1, markers});
        table.surplus_remedy = markers == 0 ? "if the last column is a marker, make the header " +
                                                  header_text({table.rows, dimension, attributes, 1}) +
                                                  "; if it is an attribute, " + more
                                            : "if there is one attribute more, make the header " + more;
        mesh_.dimension = static_cast<int>(dimension);
        settle_node_columns(table, dimension, mesh_.points, mesh_.point_fields, mesh_.point_markers);
        mesh_.index_base = table.base;
    }

    void prepare_cells() {
        constexpr std::array names{"cells", "corners", "attributes"};
        if (!has(".ele"))
            refuse_file("file.missing", stem_ + ".ele", "there are nodes but no cells",
                        "an .ele file beside " + nodes_.file, "no such file",
                        "mesh the nodes first, or put the .ele file there");
        TextTable& table = cells_ = open(".ele", names);

        const bool flat = mesh_.dimension == 2;
        const std::size_t corners = table.header_field(1, mesh_.corners()), attributes = table.header_field(2, 0);
        if (flat ? corners != 3 && corners != 6 : corners != 4 && corners != 10)
            refuse_meaning(
                "mesh.node-count", table, "bad number of corners",
                flat ? "3 or 6, for the .node file has 2 dimensions" : "4 or 10, for the .node file has 3 dimensions",
                corners, "check that the files belong together and hold triangles (2D) or tetrahedra (3D)");
        table.columns = {
            {.name = "id"},
            {ColumnKind::index, corners, "corner", nodes_.limit(), "nodes", &mesh_.cells, &mesh_.mid_nodes,
             mesh_.corners()},
            {.kind = ColumnKind::real, .count = attributes, .name = "attribute", .fields = &mesh_.cell_fields}};
        table.surplus_remedy =
            "if there is one attribute more, make the header " + header_text({table.rows, corners, attributes + 1});
        make_room(table);
    }

    void prepare_faces() {
        constexpr std::array names{"faces", "markers"};
        TextTable& table = faces_.emplace(open(".face", names));
        if (mesh_.dimension == 2)
            refuse_header("mesh.dimension", table, "a mesh of triangles has no faces", "", "",
                          "remove the .face file or do not ask for faces");
        const std::size_t markers = table.header_field(1, 0);
        if (markers > 1) refuse_meaning("file.count", table, "bad number of markers", "0 or 1", markers, {});
        const std::size_t found = table.first_row().size();
        const std::size_t linear = 4 + markers;  // id, corners, marker
        const bool mids = found == linear + 3 || found == linear + 5;
        const bool adjacent = found == linear + 2 || found == linear + 5;  // checked, and told again by the neighbours
        table.columns = {
            {.name = "id"},
            {ColumnKind::index, mids ? 6U : 3U, "corner", nodes_.limit(), "nodes", &mesh_.faces, &mesh_.face_mid_nodes,
             3},
            {.kind = ColumnKind::integer, .count = markers, .name = "marker", .integers = &mesh_.face_markers},
            {ColumnKind::neighbour, adjacent ? 2U : 0U, "cell", cells_.limit(), "cells"}};
        table.surplus_remedy = markers == 0
                                   ? "if the last column is a marker, make the header " + header_text({table.rows, 1})
                                   : "let all rows have as many columns as the first";
        make_room(table);
    }

    void prepare_neighbours() {
        constexpr std::array names{"cells", "neighbours"};
        TextTable& table = neighbours_.emplace(open(".neigh", names));
        const std::size_t sides = mesh_.corners();
        const char* const remedy = "check that the files belong together, or remove the .neigh file";
        if (table.rows != cells_.rows)
            refuse_header("file.count", table, "the number of cells differs from that of the .ele file",
                          std::to_string(cells_.rows), std::to_string(table.rows), remedy);
        if (const std::size_t declared = table.header_field(1, sides); declared != sides)
            refuse_meaning("file.count", table, "bad number of neighbours", std::to_string(sides), declared, remedy);
        table.columns = {{.name = "id"},
                         {ColumnKind::neighbour, sides, "neighbour", cells_.limit(), "cells", &mesh_.neighbours}};
        table.surplus_remedy = "let each row have an id and " + std::to_string(sides) + " neighbours";
        make_room(table);
    }

    void settle_mid_edge_order() {
        if (mesh_.mid_nodes.empty()) return;
        const std::optional<mesh::MidEdgeVote> vote = mesh::detect_mid_edge_order(mesh_);
        if (!vote)
            refuse_header("mesh.node-order", cells_, "the order of the mid-edge nodes is unknown",
                          "each near the middle of its edge, in the order of TetGen, Triangle, VTK or Gmsh",
                          "another order in most cells",
                          "check that the files belong together, or write the mesh again as " +
                              std::to_string(mesh_.corners()) + "-node cells");
        mesh_.mid_edge_order = vote->order;
        if (vote->guessed)
            mesh_.notes.push_back({Note::Kind::guessed,
                                   std::string("mid-edge nodes in the order of ") +
                                       (mesh_.dimension == 2 ? "Triangle" : "TetGen") + ", as no cell tells another",
                                   stem_ + ".ele", true});
        mesh::normalise_mid_nodes(mesh_);
    }

    std::string stem_;
    ReadOptions options_;
    Mesh mesh_;
    TextTable nodes_, cells_;
    std::optional<TextTable> faces_, neighbours_;  // where there is such a file
};

}  // namespace

NodeTable read_node_table(const std::string& path, int dimension, const PointOptions& options) {
    const int threads = base::arena_threads();
    TextTable table = open_table(path, node_header, threads);
    const std::size_t found = table.header_field(1, 3);
    // Points in space may lie in the plane of a mesh.
    if ((std::cmp_less(found, dimension) && options.columns.empty()) || found < 2 || found > 3) {
        const std::string d = std::to_string(dimension);
        refuse_header("point.dimension", table, "bad dimension in the header",
                      d + ", for the mesh is " + d + "-dimensional", std::to_string(found),
                      "give points of the dimension of the mesh");
    }
    table.any_real = options.nonfinite_points == NonfinitePoints::nan;
    table.surplus_remedy = "mend the header: nodes, dimension, attributes, markers";
    table.finite_remedy = std::string("remove the point, give it coordinates") + or_nan_for_it;
    table.finite_subject = nonfinite_points;
    PointTable points;
    points.dimension = static_cast<int>(found);
    points.of_nodes = true;
    std::vector<std::int64_t> markers;
    settle_node_columns(table, found, points.points, points.fields, markers);
    parse_tables(std::array{&table}, threads);
    if (table.columns[3].count != 0) points.labels.push_back({"marker", std::move(markers)});
    return {std::move(points), table.file};
}

}  // namespace io

std::string tetgen_stem(const std::string& path) {
    const std::string_view plain = base::without_gz(path);
    for (const std::string_view suffix : io::suffixes) {
        if (plain.ends_with(suffix)) return path.substr(0, plain.size() - suffix.size());
    }
    return path;
}

std::vector<std::string> tetgen_files(const std::string& path) {
    std::vector<std::string> files;
    files.reserve(io::suffixes.size());
    for (const std::string_view suffix : io::suffixes)
        files.push_back(io::plain_or_packed(tetgen_stem(path) + std::string(suffix)));
    return files;
}

Result<Mesh> read_tetgen(const std::string& path, const ReadOptions& options) {
    return io::read_guarded(path, [&] { return io::TetgenReader(tetgen_stem(path), options).read(); });
}

}  // namespace barycert
