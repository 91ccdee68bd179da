#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert {
namespace {

/// Fields of a row, separated by spaces, in a buffer on the way to a file.
class RowWriter {
public:
    explicit RowWriter(std::string target) : file_(std::move(target)) {}

    template <class Number>
    void number(Number value) {
        if (size_ + longest > buffer_.size()) flush();
        if (!at_line_start_) buffer_[size_++] = ' ';
        at_line_start_ = false;
        char* const start = buffer_.data() + size_;
        size_ += static_cast<std::size_t>(std::to_chars(start, buffer_.data() + buffer_.size(), value).ptr - start);
    }

    void end_row() {
        if (size_ == buffer_.size()) flush();
        buffer_[size_++] = '\n';
        at_line_start_ = true;
    }

    void comment(std::string_view text) {
        flush();
        while (!text.empty()) {  // a line break in the comment must not begin a row
            const std::size_t stop = std::min(text.find_first_of("\r\n"), text.size());
            file_.write("# ");
            file_.write(text.substr(0, stop));
            file_.write("\n");
            text.remove_prefix(std::min(stop + 1, text.size()));
        }
    }

    Status close() {
        flush();
        return file_.close();
    }
    Status commit() { return file_.commit(); }

private:
    void flush() {
        file_.write({buffer_.data(), size_});
        size_ = 0;
    }

    static constexpr std::size_t longest = 32;  // a space and a number: at most 24 characters of a double
    base::OutputFile file_;
    std::array<char, 4096> buffer_{};
    std::size_t size_ = 0;
    bool at_line_start_ = true;
};

std::size_t component_count(const std::vector<Field>& fields) {
    std::size_t count = 0;
    for (const Field& field : fields) count += static_cast<std::size_t>(field.components);
    return count;
}

void write_fields(RowWriter& out, const std::vector<Field>& fields, std::size_t row) {
    for (const Field& field : fields) {
        const auto components = static_cast<std::size_t>(field.components);
        for (std::size_t c = 0; c < components; ++c) out.number(field.data[row * components + c]);
    }
}

void write_nodes(RowWriter& out, const Mesh& mesh) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    const bool markers = !mesh.point_markers.empty();
    out.number(mesh.point_count());
    out.number(dimension);
    out.number(component_count(mesh.point_fields));
    out.number(markers ? 1 : 0);
    out.end_row();
    for (std::size_t row = 0; row < mesh.point_count(); ++row) {
        out.number(row + static_cast<std::size_t>(mesh.index_base));
        for (std::size_t axis = 0; axis < dimension; ++axis) out.number(mesh.points[row * dimension + axis]);
        write_fields(out, mesh.point_fields, row);
        if (markers) out.number(mesh.point_markers[row]);
        out.end_row();
    }
}

void write_cells(RowWriter& out, const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size();
    const std::span<const std::size_t> sequence = mesh::edge_sequence(mesh.mid_edge_order, mesh.dimension);
    out.number(mesh.cell_count());
    out.number(corners + mids);
    out.number(component_count(mesh.cell_fields));
    out.end_row();
    for (std::size_t row = 0; row < mesh.cell_count(); ++row) {
        out.number(row + static_cast<std::size_t>(mesh.index_base));
        for (std::size_t i = 0; i < corners; ++i)
            out.number(mesh.cells[row * corners + i] + std::int64_t{mesh.index_base});
        for (std::size_t k = 0; k < mids; ++k) {
            out.number(mesh.mid_nodes[row * mids + sequence[k]] + std::int64_t{mesh.index_base});
        }
        write_fields(out, mesh.cell_fields, row);
        out.end_row();
    }
}

void write_faces(RowWriter& out, const Mesh& mesh) {
    const bool markers = !mesh.face_markers.empty();
    out.number(mesh.face_count());
    out.number(markers ? 1 : 0);
    out.end_row();
    for (std::size_t row = 0; row < mesh.face_count(); ++row) {
        out.number(row + static_cast<std::size_t>(mesh.index_base));
        for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) out.number(mesh.faces[i] + std::int64_t{mesh.index_base});
        for (std::size_t i = 3 * row; i < 3 * row + 3 && !mesh.face_mid_nodes.empty(); ++i) {
            out.number(mesh.face_mid_nodes[i] + std::int64_t{mesh.index_base});
        }
        if (markers) out.number(mesh.face_markers[row]);
        out.end_row();
    }
}

void write_neighbours(RowWriter& out, const Mesh& mesh) {
    const std::size_t sides = mesh.corners();
    out.number(mesh.cell_count());
    out.number(sides);
    out.end_row();
    for (std::size_t row = 0; row < mesh.cell_count(); ++row) {
        out.number(row + static_cast<std::size_t>(mesh.index_base));
        for (std::size_t i = row * sides; i < (row + 1) * sides; ++i) {
            const std::int64_t cell = mesh.neighbours[i];
            out.number(cell == -1 ? cell : cell + mesh.index_base);
        }
        out.end_row();
    }
}

}  // namespace

Status write_tetgen(const Mesh& mesh, const std::string& stem, const WriteOptions& options) {
    const ExactEnvironment environment;
    if (const char* const fault = mesh::inconsistency(mesh); fault != nullptr) {
        const bool values_alone = mesh::inconsistency(mesh, mesh::FieldValues::any) == nullptr;
        return Error{
            .what = std::string("cannot write the mesh: ") + fault,
            .file = stem,
            .line = 0,
            .expected = {},
            .found = {},
            .remedy = values_alone ? "choose .vtu, .vtk or .msh, which hold it" : "correct the mesh in memory"};
    }
    struct Part {
        const char* suffix;
        bool present;
        void (*write)(RowWriter&, const Mesh&);
    };
    const std::array<Part, 4> parts{{{".node", true, write_nodes},
                                     {".ele", true, write_cells},
                                     {".face", !mesh.faces.empty(), write_faces},
                                     {".neigh", !mesh.neighbours.empty(), write_neighbours}}};
    std::vector<std::unique_ptr<RowWriter>> files;
    for (const Part& part : parts) {
        const std::string target = stem + part.suffix;
        struct stat old {};
        if (!part.present && ::stat(target.c_str(), &old) == 0) {
            return Error{.what = "a file of another mesh exists",
                         .file = target,
                         .line = 0,
                         .expected = "no such file: the mesh to be written has no data for it",
                         .found = {},
                         .remedy = "remove it, or choose another name"};
        }
        if (!part.present) continue;
        files.push_back(std::make_unique<RowWriter>(target));
        part.write(*files.back(), mesh);
        if (!options.comment.empty()) files.back()->comment(options.comment);
        if (Status status = files.back()->close(); !status) return status;
    }
    for (const auto& file : files) {
        if (Status status = file->commit(); !status) return status;
    }
    return Done{};
}

}  // namespace barycert
