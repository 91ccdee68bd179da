// PLY files. G. Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/surface/surface_writers.hpp"

namespace barycert::io {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written as numbers stand in memory");

/// Names of properties: a program may take any other character for an end.
class Names {
public:
    explicit Names(std::vector<std::string> taken) : taken_(std::move(taken)) {}

    std::string safe(std::string_view wanted) {
        std::string name(wanted);
        for (char& c : name) {
            const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
            if (!letter && !(c >= '0' && c <= '9')) c = '_';
        }
        if (name.empty()) name = "_";
        while (std::find(taken_.begin(), taken_.end(), name) != taken_.end()) name += '_';
        taken_.push_back(name);
        return name;
    }

private:
    std::vector<std::string> taken_;
};

/// The properties of all fields, one a component.
std::string properties_of(const std::vector<Field>& fields, Names names, std::vector<std::string>& renamed) {
    std::string text;
    for (const Field& f : fields) {
        for (int c = 0; c < f.components; ++c) {
            const std::string wanted = f.components == 1 ? f.name : f.name + '_' + std::to_string(c);
            const std::string name = names.safe(wanted);
            text.append("property double ").append(name).append("\n");
            if (name != wanted) renamed.emplace_back(wanted).append(" as ").append(name);
        }
    }
    return text;
}

template <class T>
void append(std::string& bytes, const T* numbers, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(T));
}

void append_rows(std::string& bytes, const std::vector<Field>& fields, std::size_t row) {
    for (const Field& f : fields) {
        const auto components = static_cast<std::size_t>(f.components);
        append(bytes, f.data.data() + components * row, components);
    }
}

/// Calls add(bytes, row) for each row and writes the bytes, some at a time.
template <class Add>
void write_rows(base::OutputFile& file, std::size_t count, Add add) {
    constexpr std::size_t enough = std::size_t{1} << 18;
    std::string bytes;
    for (std::size_t row = 0; row < count; ++row) {
        add(bytes, row);
        if (bytes.size() < enough && row + 1 < count) continue;
        file.write(bytes);
        bytes.clear();
    }
}

}  // namespace

Result<SurfaceFile> write_ply(const Surface& s, const std::string& path) {
    SurfaceFile result;
    const bool lines = s.dimension == 2;
    const std::size_t corners = s.corners();
    std::string head = "ply\nformat binary_little_endian 1.0\ncomment written by barycert\nelement vertex " +
                       std::to_string(s.point_count()) + "\nproperty double x\nproperty double y\nproperty double z\n";
    head += properties_of(s.point_fields, Names({"x", "y", "z"}), result.renamed);
    head += std::string("element ") + (lines ? "edge " : "face ") + std::to_string(s.cell_count()) + '\n';
    head += lines ? "property int vertex1\nproperty int vertex2\n" : "property list uchar int vertex_indices\n";
    head += properties_of(s.cell_fields, Names({"vertex1", "vertex2", "vertex_indices"}), result.renamed);
    base::OutputFile file(path);
    file.write(head + "end_header\n");
    write_rows(file, s.point_count(), [&](std::string& bytes, std::size_t v) {
        constexpr double zero = 0;
        append(bytes, s.points.data() + corners * v, corners);
        if (lines) append(bytes, &zero, 1);
        append_rows(bytes, s.point_fields, v);
    });
    write_rows(file, s.cell_count(), [&](std::string& bytes, std::size_t c) {
        if (!lines) bytes += '\3';
        append(bytes, s.cells.data() + corners * c, corners);
        append_rows(bytes, s.cell_fields, c);
    });
    if (Status written = file.commit(); !written) return written.error();
    return result;
}

}  // namespace barycert::io
