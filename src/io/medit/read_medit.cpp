// Meshes and fields of Medit's files.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "core/base/finite.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/text.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/medit/medit.hpp"
#include "io/medit/medit_file.hpp"
#include "io/mesh_notes.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert::io::medit {
namespace {

/// Numbers a value of a field has: 1 is a scalar, 2 a vector, 3 a symmetric matrix, 4 any matrix.
std::size_t components_of(std::int64_t type, std::size_t dimension) {
    return type == 1 ? 1 : type == 2 ? dimension : type == 3 ? dimension * (dimension + 1) / 2 : dimension * dimension;
}

void add_fields_of(const MeditFile& file, const MeditSection& section, std::vector<Field>& fields) {
    const auto dimension = static_cast<std::size_t>(file.dimension());
    std::size_t width = 0;
    for (const std::int64_t type : section.types) width += components_of(type, dimension);
    const MeditRows rows = file.rows(section, width, 0);
    for (std::size_t i = 0, begin = 0; i < section.types.size(); ++i) {
        const std::size_t components = components_of(section.types[i], dimension);
        Field field{"solution" + std::to_string(i), static_cast<int>(components), {}};
        field.data.resize(section.count * components);
        for (std::size_t row = 0; row < section.count; ++row)
            std::copy_n(&rows.reals[row * width + begin], components, &field.data[row * components]);
        fields.push_back(std::move(field));
        begin += components;
    }
}

/// Appends those of nodes and of cells of the mesh's dimension to its fields; others are noted.
void add_medit_fields(const MeditFile& file, Mesh& mesh) {
    for (const MeditSection& section : file.sections()) {
        if (section.keyword.kind != MeditKind::solution) continue;
        const int of = section.keyword.dimension;
        const std::size_t rows = of == 0 ? mesh.point_count() : mesh.whole_count();
        const bool some = of != 0 && !mesh.shapes.types.empty() && section.count != rows;
        if (some || (of != 0 && of != mesh.dimension)) {
            const char* const why = some ? ": not of all cells of the mesh" : ": they are no cells of the mesh";
            mesh.notes.push_back({Note::Kind::left_out, section.name + why, file.path(), some});
        } else if (rows != 0 && section.count != rows) {  // of a file that holds both
            refuse_file("field.size", file.path(), "the rows of solution0", std::to_string(rows),
                        std::to_string(section.count), "one for each node or cell");
        } else {
            add_fields_of(file, section, of == 0 ? mesh.point_fields : mesh.cell_fields);
        }
    }
}

/// Notes the sections that nobody reads, under the name of all they are: "sections".
void note_medit_sections(const MeditFile& file, Notes& notes) {
    std::vector<std::string> names;
    for (const MeditSection& section : file.sections()) {
        if (section.keyword.kind == MeditKind::other && std::ranges::count(names, section.name) == 0)
            names.push_back(section.name);
    }
    if (!names.empty()) notes.push_back({Note::Kind::left_out, "sections " + list_of(names), file.path()});
}

bool is_simplex(const MeditKeyword& cell, int order) {
    return cell.nodes == (cell.dimension == 3 ? (order == 1 ? 4U : 10U) : (order == 1 ? 3U : 6U));
}

class MeditReader {
public:
    MeditReader(const MeditFile& file, const ReadOptions& options, InSpace* space)
        : file_(file), options_(options), space_(space) {}

    Mesh read() {
        choose();
        read_nodes();
        read_cells();
        settle_order();
        read_the_lower();
        add_medit_fields(file_, mesh_);
        note_medit_sections(file_, mesh_.notes);
        note_solution_beside();
        cut_into_simplices(mesh_, file_.path());
        mesh_.index_base = 1;
        return std::move(mesh_);
    }

private:
    void note(Note::Kind kind, std::string text, bool important = false) {
        mesh_.notes.push_back({kind, std::move(text), file_.path(), important});
    }

    void choose() {
        std::vector<const MeditSection*> found;
        for (const MeditSection& section : file_.sections()) {
            if (section.keyword.kind == MeditKind::vertices) nodes_ = &section;
            if (section.keyword.kind != MeditKind::cells || section.count == 0) continue;
            const int dimension = section.keyword.dimension;
            if (!found.empty() && dimension > found.front()->keyword.dimension) {
                lower_.insert(lower_.end(), found.begin(), found.end());
                found.clear();
            }
            (found.empty() || dimension == found.front()->keyword.dimension ? found : lower_).push_back(&section);
        }
        if (nodes_ == nullptr || found.empty() || found.front()->keyword.dimension < 2)
            refuse_file("mesh.empty", file_.path(), "the file contains no mesh",
                        "Vertices, and Tetrahedra, Hexahedra, Triangles or the like",
                        file_.sections().empty() ? "nothing" : file_.sections().front().name,
                        "name a file with a mesh; the fields of a .sol file go with --field NAME=FILE");
        cells_ = found.front();
        mesh_.dimension = cells_->keyword.dimension;
        const MeditKeyword& keyword = cells_->keyword;
        if (found.size() > 1 || !(is_simplex(keyword, 1) || is_simplex(keyword, 2))) shapes_ = std::move(found);
        if (mesh_.dimension > file_.dimension())
            refuse_file("mesh.dimension", file_.path(), "cells in space, and nodes in the plane", "Dimension 3",
                        "Dimension 2", "mend the dimension");
    }

    void read_nodes() {
        const auto dimension = static_cast<std::size_t>(file_.dimension());
        MeditRows rows = file_.rows(*nodes_, dimension, 1);
        if (const std::size_t i = base::first_not_finite(rows.reals); i != rows.reals.size())
            file_.refuse_in("mesh.coordinate", *nodes_, rows, i / dimension, i % dimension, "a finite coordinate",
                            base::shortest(rows.reals[i]), "correct the point");
        mesh_.point_markers = references(std::move(rows.integers));
        mesh_.points = std::move(rows.reals);
        if (mesh_.dimension < file_.dimension())
            mesh_.points =
                to_points(std::move(mesh_.points), 2, file_.path(),
                          shapes_.empty() && is_simplex(cells_->keyword, 1) ? file_.path() : "", "point", space_);
        if (file_.narrow()) note(Note::Kind::converted, "float32 to double: the coordinates");
    }

    /// Where all are 0 there are none.
    static std::vector<std::int64_t> references(std::vector<std::int64_t> numbers) {
        if (std::all_of(numbers.begin(), numbers.end(), [](std::int64_t n) { return n == 0; })) numbers = {};
        return numbers;
    }

    struct Cells {
        std::vector<Mesh::Index> corners, mids;
        std::vector<std::int64_t> references;
    };
    Cells take(const MeditSection& section, std::size_t corners) const {
        const std::size_t nodes = section.keyword.nodes, width = nodes + 1, count = section.count;
        const MeditRows rows = file_.rows(section, 0, width);
        Cells cells;
        base::resize_large(cells.corners, count * corners);
        base::resize_large(cells.mids, count * (nodes - corners));
        cells.references.resize(count);
        const std::uint64_t points = mesh_.point_count();
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t* const row = &rows.integers[i * width];
            for (std::size_t k = 0; k < nodes; ++k) {
                const std::int64_t node = row[k] - 1;
                if (row[k] < 1 || static_cast<std::uint64_t>(node) >= points)
                    file_.refuse_in("mesh.node-index", section, rows, i, k,
                                    "a node from 1 to " + std::to_string(points), std::to_string(row[k]),
                                    row[k] == 0 ? "nodes count from 1: add 1 to all" : "check the numbers");
                (k < corners ? cells.corners[i * corners + k] : cells.mids[i * (nodes - corners) + k - corners]) =
                    static_cast<Mesh::Index>(node);
            }
            cells.references[i] = row[nodes];
        }
        return cells;
    }

    /// Several sections, or one whose cells are no mesh's own: by their corners.
    Cells take_shapes() {
        Cells all;
        std::size_t by_corners = 0;
        for (const MeditSection* const section : shapes_) {
            const std::uint8_t type = section->keyword.type;
            const std::size_t corners = mesh::cell_type(type).corners;
            const Cells own = take(*section, corners);
            if (section->keyword.nodes != corners) by_corners += section->count;
            for (std::size_t i = 0; i < section->count; ++i)
                mesh::add_shape(mesh_, type, std::span(own.corners).subspan(i * corners, corners));
            all.references.insert(all.references.end(), own.references.begin(), own.references.end());
        }
        note_by_corners(by_corners, file_.path(), mesh_);
        return all;
    }

    void read_cells() {
        Cells cells = shapes_.empty() ? take(*cells_, mesh_.corners()) : take_shapes();
        mesh_.cells = std::move(cells.corners);
        mesh_.mid_nodes = std::move(cells.mids);
        const std::vector<std::int64_t> all = references(std::move(cells.references));
        const bool doubles = std::ranges::all_of(all, [](std::int64_t n) { return std::abs(n) <= 1LL << 53; });
        if (all.empty()) return;
        doubles ? mesh_.cell_fields.push_back({"medit:ref", 1, {all.begin(), all.end()}})
                : mesh_.cell_labels.push_back({"medit:ref", all});
    }

    void settle_order() {
        if (mesh_.mid_nodes.empty()) return;
        const std::optional<mesh::MidEdgeVote> vote = mesh::detect_mid_edge_order(mesh_);
        if (!vote)
            refuse_file("mesh.node-order", file_.path(), "the order of the mid-edge nodes is unknown",
                        "each near the middle of its edge, in the order 12 23 13 14 24 34, or that of TetGen or Gmsh",
                        "another order in most cells", "write the mesh again with cells of order 1");
        // Where no cell tells it, as libMeshb documents it.
        mesh_.mid_edge_order = vote->guessed ? MidEdgeOrder::vtk : vote->order;
        if (vote->guessed)
            note(Note::Kind::guessed, "mid-edge nodes in the order of Medit, as no cell tells another", true);
        mesh::normalise_mid_nodes(mesh_);
    }

    /// Cells of a lower dimension: triangles beside tetrahedra are faces. The others are told as by Gmsh's reader.
    void read_the_lower() {
        std::vector<std::uint8_t> used(mesh_.point_count(), 0);
        for (const auto* nodes : {&mesh_.cells, &mesh_.mid_nodes, &mesh_.shapes.nodes}) {
            for (const Mesh::Index node : *nodes) used[static_cast<std::size_t>(node)] = 1;
        }
        bool apart = false;
        std::vector<const MeditSection*> left_out;
        for (const MeditSection* section : lower_) {
            const int order = mesh_.mid_nodes.empty() ? 1 : 2;
            const bool faces = section->keyword.dimension == 2 && is_simplex(section->keyword, order);
            Cells cells = take(*section, faces ? 3 : section->keyword.nodes);
            const bool here = std::any_of(cells.corners.begin(), cells.corners.end(),
                                          [&](Mesh::Index node) { return used[static_cast<std::size_t>(node)] == 0; });
            apart = apart || here;
            if (!faces || here) left_out.push_back(section);
            if (!faces || here || !options_.faces) continue;
            mesh_.faces = std::move(cells.corners);
            mesh_.face_mid_nodes = std::move(cells.mids);
            mesh_.face_markers = references(std::move(cells.references));
        }
        const auto text = [](const MeditSection* s) { return std::to_string(s->count) + " " + s->name; };
        if (!left_out.empty())
            note(Note::Kind::left_out,
                 "elements of a lower dimension: " + base::joined(left_out, ", ", text) +
                     (apart ? "; some have nodes that no cell has" : ""),
                 apart);
    }

    /// Fields in a file of their own are read where they are named.
    void note_solution_beside() {
        std::ranges::for_each(std::array{".sol", ".solb"}, [&](const char* suffix) {
            const std::string path = std::filesystem::path(without_gz(file_.path())).replace_extension(suffix).string();
            if (exists(path))
                note(Note::Kind::left_out, "the fields of " + path + ", unless it is named: --field NAME=" + path);
        });
    }

    const MeditFile& file_;
    const ReadOptions& options_;
    InSpace* space_;
    const MeditSection *nodes_ = nullptr, *cells_ = nullptr;
    std::vector<const MeditSection*> shapes_;  ///< those with the cells, unless these are simplices of one type
    std::vector<const MeditSection*> lower_;
    Mesh mesh_;
};

}  // namespace
}  // namespace barycert::io::medit

namespace barycert::io {

using namespace medit;

bool is_medit(std::string_view head) {
    if (same_word(first_word(head, '#').substr(0, 11), "MeshVersion")) return true;
    if (head.size() < 12) return false;
    const bool swapped = head[0] == 0;
    return take_integer(head, 4, swapped) == 1 && static_cast<std::uint64_t>(take_integer(head, 4, swapped) - 1) < 4 &&
           take_integer(head, 4, swapped) == code_of_dimension;
}

Result<Mesh> read_medit(const std::string& path, const ReadOptions& options, InSpace* space) {
    return read_guarded(path, [&] { return MeditReader(MeditFile(path), options, space).read(); });
}

Result<Mesh> read_medit_fields(const std::string& path, int dimension) {
    return read_guarded(path, [&] {
        const MeditFile file(path);
        Mesh mesh;
        mesh.dimension = dimension;
        add_medit_fields(file, mesh);
        note_medit_sections(file, mesh.notes);
        return mesh;
    });
}

}  // namespace barycert::io
