#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "io/paths.hpp"
#include "io/row_output.hpp"
#include "mesh/consistency.hpp"
#include "mesh/mid_edges.hpp"

namespace barycert {
namespace {

using io::RowOutput;

void write_comment(RowOutput& out, std::string_view text) {
    while (!text.empty()) {  // a line break in the comment must not begin a row
        const std::size_t stop = std::min(text.find_first_of("\r\n"), text.size());
        out.text("# " + std::string(text.substr(0, stop)) + "\n");
        text.remove_prefix(std::min(stop + 1, text.size()));
    }
}

std::size_t component_count(const std::vector<Field>& fields) {
    std::size_t count = 0;
    for (const Field& field : fields) count += static_cast<std::size_t>(field.components);
    return count;
}

/// The numbers of a header, of which the first is how many rows there are; and these, each behind its own number.
template <class WriteRow>
void write_table(RowOutput& out, const Mesh& mesh, std::initializer_list<std::size_t> header, const WriteRow& row) {
    for (const std::size_t number : header) out.number(number);
    out.end_row();
    for (std::size_t i = 0; i < *header.begin(); ++i) {
        out.number(i + static_cast<std::size_t>(mesh.index_base));
        row(i);
        out.end_row();
    }
}

/// `width` of the nodes or cells, if there are any; -1 stays.
void write_indices(RowOutput& out, const Mesh& mesh, const std::vector<Mesh::Index>& all, std::size_t width,
                   std::size_t row) {
    for (std::size_t i = width * row; i < width * (row + 1) && !all.empty(); ++i)
        out.number(all[i] == -1 ? std::int64_t{-1} : std::int64_t{all[i]} + mesh.index_base);
}

void write_nodes(RowOutput& out, const Mesh& mesh) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    const std::size_t markers = mesh.point_markers.empty() ? 0 : 1;
    write_table(out, mesh, {mesh.point_count(), dimension, component_count(mesh.point_fields), markers},
                [&](std::size_t row) {
                    out.numbers(std::span(mesh.points).subspan(row * dimension, dimension));
                    out.row_of(mesh.point_fields, row);
                    if (markers != 0) out.number(mesh.point_markers[row]);
                });
}

void write_cells(RowOutput& out, const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size();
    const std::span<const std::size_t> sequence = mesh::edge_sequence(mesh.mid_edge_order, mesh.dimension);
    write_table(out, mesh, {mesh.cell_count(), corners + mids, component_count(mesh.cell_fields)},
                [&](std::size_t row) {
                    write_indices(out, mesh, mesh.cells, corners, row);
                    for (std::size_t k = 0; k < mids; ++k)
                        out.number(mesh.mid_nodes[row * mids + sequence[k]] + std::int64_t{mesh.index_base});
                    out.row_of(mesh.cell_fields, row);
                });
}

void write_faces(RowOutput& out, const Mesh& mesh) {
    const std::size_t markers = mesh.face_markers.empty() ? 0 : 1;
    write_table(out, mesh, {mesh.face_count(), markers}, [&](std::size_t row) {
        write_indices(out, mesh, mesh.faces, 3, row);
        write_indices(out, mesh, mesh.face_mid_nodes, 3, row);
        if (markers != 0) out.number(mesh.face_markers[row]);
    });
}

void write_neighbours(RowOutput& out, const Mesh& mesh) {
    write_table(out, mesh, {mesh.cell_count(), mesh.corners()},
                [&](std::size_t row) { write_indices(out, mesh, mesh.neighbours, mesh.corners(), row); });
}

}  // namespace

Status write_tetgen(const Mesh& mesh, const std::string& stem, const WriteOptions& options) {
    const ExactEnvironment environment;
    if (const char* const fault = mesh::inconsistency(mesh); fault != nullptr) {
        const bool values_alone = mesh::inconsistency(mesh, mesh::FieldValues::any) == nullptr;
        return file_error("mesh.inconsistent", stem, std::string("cannot write the mesh: ") + fault, {}, {},
                          values_alone ? "choose .vtu, .vtk or .msh, which hold it" : "correct the mesh in memory");
    }
    struct FileOfStem {
        const char* suffix;
        bool present;
        void (*write)(RowOutput&, const Mesh&);
    };
    const std::array<FileOfStem, 4> parts{{{".node", true, write_nodes},
                                           {".ele", true, write_cells},
                                           {".face", !mesh.faces.empty(), write_faces},
                                           {".neigh", !mesh.neighbours.empty(), write_neighbours}}};
    std::vector<std::unique_ptr<RowOutput>> files;
    for (const FileOfStem& part : parts) {
        const std::string target = stem + part.suffix;
        if (!part.present && io::exists(target))
            return file_error("file.overwrite", target, "a file of another mesh exists",
                              "no such file: the mesh to be written has no data for it", {},
                              "remove it, or choose another name");
        if (!part.present) continue;
        files.push_back(std::make_unique<RowOutput>(target));
        part.write(*files.back(), mesh);
        write_comment(*files.back(), options.comment);
        if (Status status = files.back()->close(); !status) return status;
    }
    for (const auto& file : files) {
        if (Status status = file->commit(); !status) return status;
    }
    return Done{};
}

}  // namespace barycert
