// The grammar accepted. Each file is a header line and then rows, one a line. '#' starts a comment that goes to the end
// of the line; blank and comment lines may stand anywhere. Fields and separators: see scanner.hpp. A byte-order mark at
// the beginning is passed over.
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
#include "barycert/io/tetgen/tetgen_reader.hpp"

#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert {
namespace io {

Result<Mesh> TetgenReader::read() {
    Status status = prepare_nodes();
    if (status) status = prepare_cells();
    if (status && options_.faces && exists(".face")) status = prepare_faces();
    if (status && options_.neighbours && exists(".neigh")) status = prepare_neighbours();
    if (!status) return status.error();

    std::vector<TextTable*> tables{&nodes_, &cells_};
    if (faces_) tables.push_back(faces_.get());
    if (neighbours_) tables.push_back(neighbours_.get());
    status = parse_tables(tables, options_.threads);
    if (status) status = settle_mid_edge_order();
    if (!status) return status.error();
    return std::move(mesh_);
}

bool TetgenReader::exists(const char* suffix) const {
    std::error_code ignored;
    return std::filesystem::exists(plain_or_packed(stem_ + suffix), ignored);
}

Status TetgenReader::settle_mid_edge_order() {
    if (mesh_.mid_nodes.empty()) return Done{};
    const std::optional<mesh::MidEdgeVote> vote = mesh::detect_mid_edge_order(mesh_);
    if (!vote) {
        return header_error(cells_, "the order of the mid-edge nodes is unknown",
                            "each near the middle of its edge, in the order of TetGen, Triangle, VTK or Gmsh",
                            "another order in most cells",
                            "check that the files belong together, or write the mesh again as " +
                                std::to_string(mesh_.corners()) + "-node cells");
    }
    mesh_.mid_edge_order = vote->order;
    if (vote->guessed)
        mesh_.notes.push_back({Note::Kind::guessed,
                               std::string("mid-edge nodes in the order of ") +
                                   (mesh_.dimension == 2 ? "Triangle" : "TetGen") + ", as no cell tells another",
                               stem_ + ".ele", true});
    mesh::normalise_mid_nodes(mesh_);
    return Done{};
}

std::string header_text(std::initializer_list<std::int64_t> numbers) {
    std::string text = "\"";
    for (const std::int64_t number : numbers) {
        if (text.size() > 1) text += ' ';
        text += std::to_string(number);
    }
    text += '"';
    return text;
}

}  // namespace io

namespace {

constexpr std::array<std::string_view, 4> suffixes{".node", ".ele", ".face", ".neigh"};

}  // namespace

std::string tetgen_stem(const std::string& path) {
    const std::string_view plain = io::without_gz(path);
    for (const std::string_view suffix : suffixes) {
        if (plain.ends_with(suffix)) return path.substr(0, plain.size() - suffix.size());
    }
    return path;
}

std::vector<std::string> tetgen_files(const std::string& path) {
    std::vector<std::string> files;
    files.reserve(std::size(suffixes));
    for (const std::string_view suffix : suffixes)
        files.push_back(io::plain_or_packed(tetgen_stem(path) + std::string(suffix)));
    return files;
}

Result<Mesh> read_tetgen(const std::string& path, const ReadOptions& options) {
    const ExactEnvironment environment;
    return io::TetgenReader(tetgen_stem(path), options).read();
}

}  // namespace barycert
