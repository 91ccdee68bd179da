// VTK's legacy files: numbers in big-endian order, or as text.
#include <algorithm>
#include <bit>

#include "barycert/base/output_file.hpp"
#include "barycert/io/vtk/out_file.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

/// All but printable ASCII as %20 and the like. `but`: a character that stands for itself.
std::string legacy_name(std::string_view name, char but = '!') {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == but || (byte > ' ' && byte < 0x7F && c != '%' && c != '"')) {
            text += c;
        } else {
            text += {'%', digits[byte / 16], digits[byte % 16]};
        }
    }
    return text;
}

std::string fault_of_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const Field& field : mesh.point_fields) names.push_back(field.name);
    for (const Field& field : mesh.cell_fields) names.push_back(field.name);
    for (const Column& labels : mesh.cell_labels) names.push_back(labels.name);
    for (const std::string& name : names) {
        std::size_t length = 0;
        for (const char c : name) {
            const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
            length += plain ? 1 : 3;
        }
        // VTK's readers take words of up to 255 bytes.
        if (length > 200) return "the name of field " + in_quotes(name) + " is too long for the format";
        if (name == "METADATA" || name == "NULL_ARRAY")
            return "the name of field " + in_quotes(name) + " means something else in the format";
    }
    return {};
}

/// The bytes of each number the other way round.
void reverse_numbers(std::string& bytes, std::uint64_t size) {
    if (std::endian::native == std::endian::big || size == 1) return;
    for (auto at = bytes.begin(); at != bytes.end(); at += static_cast<std::ptrdiff_t>(size))
        std::reverse(at, at + static_cast<std::ptrdiff_t>(size));
}

class LegacyFile {
public:
    LegacyFile(const std::string& path, bool text) : file_(path), text_(text) {}

    void write(std::string_view bytes) { file_.write(bytes); }
    void write(const OutArray& array, std::size_t per_line) {
        const auto out = [&](std::string_view bytes) { file_.write(bytes); };
        if (text_) {
            write_as_text(array, per_line, out);
        } else {
            const std::uint64_t size = number_bytes(array.format.type);
            write_parts(
                array, std::size_t{1} << 15,
                [size](std::size_t, std::size_t, std::string& bytes) { reverse_numbers(bytes, size); }, out);
            file_.write("\n");
        }
    }
    /// FIELD FieldData: any number of arrays of any type; texts last.
    void write_arrays(const char* section, std::size_t rows, std::vector<OutArray> arrays) {
        if (arrays.empty()) return;
        const auto is_text = [](const OutArray& a) { return a.format.type == NumberType::text; };
        std::stable_partition(arrays.begin(), arrays.end(), std::not_fn(is_text));
        file_.write(std::string(section) + " " + std::to_string(rows) + "\nFIELD FieldData " +
                    std::to_string(arrays.size()) + "\n");
        for (const OutArray& a : arrays) {
            const auto& [name, components, type] = a.format;
            file_.write(legacy_name(name) + " " + std::to_string(components) + " " + std::to_string(rows) +
                        (is_text(a)                  ? " string\n"
                         : type == NumberType::int64 ? " vtktypeint64\n"
                                                     : " double\n"));
            is_text(a) ? write_texts({a.bytes, a.count})
                       : write(a, components > 1 ? static_cast<std::size_t>(components) : 12);
        }
    }
    Status commit() { return file_.commit(); }

private:
    /// In a binary file the length of each text stands before it, in 1, 2, 4 or 8 bytes, which its two highest bits
    /// tell: 3, 2, 1 or 0.
    void write_texts(std::string_view all) {
        for (std::size_t end = all.find('\0'); end != std::string_view::npos; end = all.find('\0')) {
            const std::string_view text = all.substr(0, end);
            all.remove_prefix(end + 1);
            if (text_) {
                file_.write(legacy_name(text, ' ') + "\n");  // blanks may stand in a line
                continue;
            }
            const std::uint64_t length = text.size();
            const unsigned width = length < (1U << 6U) ? 1 : length < (1U << 14U) ? 2 : length < (1U << 30U) ? 4 : 8;
            const std::uint64_t mark = width == 1 ? 3 : width == 2 ? 2 : width == 4 ? 1 : 0;
            const std::uint64_t word = length | mark << (8 * width - 2);
            for (unsigned i = width; i-- > 0;) {
                const char byte = static_cast<char>(word >> (8 * i));
                file_.write({&byte, 1});
            }
            file_.write(text);
        }
        file_.write("\n");
    }

    base::OutputFile file_;
    bool text_;
};

/// Version 4.2: the number of its nodes before the nodes of each cell.
void write_cells(const Mesh& mesh, LegacyFile& file) {
    const std::size_t cells = mesh.cell_count(), nodes = nodes_a_cell(mesh);
    file.write("CELLS " + std::to_string(cells) + " " + std::to_string(cells * (nodes + 1)) + "\n");
    const auto number = [&mesh, nodes](std::size_t i) {
        const std::size_t cell = i / (nodes + 1), k = i % (nodes + 1);
        return k == 0 ? static_cast<std::int32_t>(nodes) : node_of(mesh, nodes, cell, k - 1);
    };
    file.write(array_made<std::int32_t>({"cells", 1, NumberType::int32}, cells * (nodes + 1), number), nodes + 1);
}

/// Version 5.1: where the nodes of each cell begin and the last ones end, then all nodes.
void write_wide_cells(const Mesh& mesh, LegacyFile& file) {
    const std::size_t cells = mesh.cell_count(), nodes = nodes_a_cell(mesh);
    file.write("CELLS " + std::to_string(cells + 1) + " " + std::to_string(cells * nodes) + "\nOFFSETS vtktypeint64\n");
    file.write(array_made<std::int64_t>({"offsets", 1, NumberType::int64}, cells + 1,
                                        [nodes](std::size_t i) { return nodes * i; }),
               12);
    file.write("CONNECTIVITY vtktypeint64\n");
    const auto node = [&mesh, nodes](std::size_t i) { return node_of(mesh, nodes, i / nodes, i % nodes); };
    file.write(array_made<std::int64_t>({"connectivity", 1, NumberType::int64}, cells * nodes, node), nodes);
}

}  // namespace

Status write_legacy(const Mesh& mesh, const std::string& path, VtkData data) {
    if (const std::string fault = fault_of_names(mesh); !fault.empty()) return cannot_write("the mesh", fault, path);
    const std::size_t points = mesh.point_count(), cells = mesh.cell_count();
    // Version 4.2 counts all numbers of the cells, the lengths among them, with 32 bits.
    const bool wide = cells * (nodes_a_cell(mesh) + 1) > max_entities;
    LegacyFile file(path, data == VtkData::ascii);
    file.write(std::string("# vtk DataFile Version ") + (wide ? "5.1" : "4.2") + "\nmesh\n" +
               (data == VtkData::ascii ? "ASCII" : "BINARY") + "\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
               std::to_string(points) + " double\n");
    file.write(array_of_points(mesh.points, mesh.dimension), 3);
    wide ? write_wide_cells(mesh, file) : write_cells(mesh, file);
    file.write("CELL_TYPES " + std::to_string(cells) + "\n");
    const std::uint8_t type = cell_type_of(mesh);
    file.write(array_made<std::int32_t>({"types", 1, NumberType::int32}, cells, [type](std::size_t) { return type; }),
               12);
    std::vector<std::string> room;
    file.write_arrays("CELL_DATA", cells, cell_arrays_of(mesh, room));
    file.write_arrays("POINT_DATA", points, point_arrays_of(mesh));
    return file.commit();
}

}  // namespace barycert::io
