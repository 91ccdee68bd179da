// VTK's legacy files: numbers in big-endian order, or as text.
#include <algorithm>
#include <bit>
#include <new>
#include <string>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/io/vti/appended.hpp"
#include "barycert/io/vtk/mesh_arrays.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert {
namespace {

/// All but printable ASCII as %20 and the like.
std::string legacy_name(std::string_view name) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > ' ' && byte < 0x7F && c != '%' && c != '"') {
            text += c;
        } else {
            text += '%';
            text += digits[byte / 16];
            text += digits[byte % 16];
        }
    }
    return text;
}

/// VTK's readers take words of up to 255 bytes.
std::string fault_of_legacy_name(const std::string& name) {
    std::size_t length = 0;
    for (const char c : name) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        length += plain ? 1 : 3;
    }
    if (length > 200) return "the name of field " + io::in_quotes(name) + " is too long for the format";
    if (name == "METADATA" || name == "NULL_ARRAY") {
        return "the name of field " + io::in_quotes(name) + " means something else in the format";
    }
    return {};
}

std::string fault_of_legacy(const Mesh& mesh) {
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& field : *fields) {
            if (std::string fault = fault_of_legacy_name(field.name); !fault.empty()) return fault;
        }
    }
    for (const Column& labels : mesh.cell_labels) {
        if (std::string fault = fault_of_legacy_name(labels.name); !fault.empty()) return fault;
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
    void write(const io::OutArray& array, std::size_t per_line) {
        const auto out = [&](std::string_view bytes) { file_.write(bytes); };
        if (text_) {
            io::write_as_text(array, per_line, out);
        } else {
            const std::uint64_t size = io::number_size(array.array.type);
            io::write_parts(
                array, std::size_t{1} << 15,
                [size](std::size_t, std::size_t, std::string& bytes) { reverse_numbers(bytes, size); }, out);
            file_.write("\n");
        }
    }
    /// FIELD FieldData: any number of arrays of any type.
    void write_arrays(const char* section, std::size_t rows, const std::vector<io::OutArray>& arrays,
                      const std::vector<Column>& labels) {
        if (arrays.empty() && labels.empty()) return;
        const std::size_t texts = static_cast<std::size_t>(std::count_if(
            labels.begin(), labels.end(), [](const Column& c) { return c.type() == Column::Type::text; }));
        file_.write(std::string(section) + " " + std::to_string(rows) + "\nFIELD FieldData " +
                    std::to_string(arrays.size() + texts) + "\n");
        for (const io::OutArray& a : arrays) {
            const bool integer = a.array.type == io::VtiType::int64;
            file_.write(legacy_name(a.array.name) + " " + std::to_string(a.array.components) + " " +
                        std::to_string(rows) + (integer ? " vtktypeint64\n" : " double\n"));
            write(a, a.array.components > 1 ? static_cast<std::size_t>(a.array.components) : 12);
        }
        for (const Column& column : labels) {
            if (column.type() == Column::Type::text) write_texts(column, rows);
        }
    }
    Status commit() { return file_.commit(); }

private:
    /// In a binary file the length of each text stands before it, in 1, 2, 4 or 8 bytes, which its two highest bits
    /// tell: 3, 2, 1 or 0.
    void write_texts(const Column& column, std::size_t rows) {
        file_.write(legacy_name(column.name) + " 1 " + std::to_string(rows) + " string\n");
        for (const std::string& text : std::get<std::vector<std::string>>(column.values)) {
            if (text_) {
                file_.write(legacy_text(text) + "\n");
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
    /// A line: blanks may stand in it.
    static std::string legacy_text(std::string_view text) {
        std::string line;
        for (const char c : text) {
            if (c == ' ') {
                line += c;
            } else {
                line += legacy_name({&c, 1});
            }
        }
        return line;
    }

    base::OutputFile file_;
    bool text_;
};

/// Version 4.2: the number of its nodes before the nodes of each cell.
void write_cells(const Mesh& mesh, LegacyFile& file) {
    const std::size_t cells = mesh.cell_count(), nodes = io::nodes_a_cell(mesh), corners = mesh.corners();
    file.write("CELLS " + std::to_string(cells) + " " + std::to_string(cells * (nodes + 1)) + "\n");
    const auto number = [&mesh, nodes, corners](std::size_t i) {
        const std::size_t cell = i / (nodes + 1), k = i % (nodes + 1);
        if (k == 0) return static_cast<std::int32_t>(nodes);
        return k <= corners ? mesh.cells[cell * corners + k - 1]
                            : mesh.mid_nodes[cell * (nodes - corners) + k - 1 - corners];
    };
    file.write(io::array_made<std::int32_t>({"cells", 1, io::VtiType::int32}, cells * (nodes + 1), number), nodes + 1);
}

/// Version 5.1: where the nodes of each cell begin and the last ones end, then all nodes.
void write_wide_cells(const Mesh& mesh, LegacyFile& file) {
    const std::size_t cells = mesh.cell_count(), nodes = io::nodes_a_cell(mesh);
    file.write("CELLS " + std::to_string(cells + 1) + " " + std::to_string(cells * nodes) + "\nOFFSETS vtktypeint64\n");
    file.write(io::array_made<std::int64_t>({"offsets", 1, io::VtiType::int64}, cells + 1,
                                            [nodes](std::size_t i) { return nodes * i; }),
               12);
    file.write("CONNECTIVITY vtktypeint64\n");
    io::OutArray connectivity = io::connectivity_of(mesh);
    const std::size_t count = connectivity.count;
    file.write(io::array_made<std::int64_t>({"connectivity", 1, io::VtiType::int64}, count,
                                            [&connectivity](std::size_t i) {
                                                std::int32_t node = 0;
                                                connectivity.copy(i, i + 1, reinterpret_cast<char*>(&node));
                                                return node;
                                            }),
               nodes);
}

Status write_legacy(const Mesh& mesh, const std::string& path, VtkData data) {
    std::string fault = io::fault_of_mesh(mesh, io::Names::any);
    if (fault.empty()) fault = fault_of_legacy(mesh);
    if (!fault.empty()) return io::cannot_write("the mesh", fault, path);
    const std::size_t points = mesh.point_count(), cells = mesh.cell_count();
    // Version 4.2 counts all numbers of the cells, the lengths among them, with 32 bits.
    const bool wide = cells * (io::nodes_a_cell(mesh) + 1) > io::max_entities;
    LegacyFile file(path, data == VtkData::ascii);
    file.write(std::string("# vtk DataFile Version ") + (wide ? "5.1" : "4.2") + "\nmesh\n" +
               (data == VtkData::ascii ? "ASCII" : "BINARY") + "\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
               std::to_string(points) + " double\n");
    file.write(io::array_of_points(mesh.points, mesh.dimension), 3);
    wide ? write_wide_cells(mesh, file) : write_cells(mesh, file);
    file.write("CELL_TYPES " + std::to_string(cells) + "\n");
    const std::uint8_t type = io::cell_type_of(mesh);
    file.write(
        io::array_made<std::int32_t>({"types", 1, io::VtiType::int32}, cells, [type](std::size_t) { return type; }),
        12);
    std::vector<std::string> room;
    std::vector<io::OutArray> of_cells = io::cell_arrays_of(mesh, room);
    std::erase_if(of_cells, [](const io::OutArray& a) { return a.array.type == io::VtiType::text; });
    file.write_arrays("CELL_DATA", cells, of_cells, mesh.cell_labels);
    file.write_arrays("POINT_DATA", points, io::point_arrays_of(mesh), {});
    return file.commit();
}

}  // namespace

Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data) {
    const ExactEnvironment environment;
    if (path.ends_with(".vtu")) return write_vtu(mesh, path, data);
    if (!path.ends_with(".vtk")) {
        return Error{.what = "unknown file suffix",
                     .file = path,
                     .line = 0,
                     .expected = ".vtu or .vtk",
                     .found = {},
                     .remedy = "use one of these suffixes"};
    }
    if (data != VtkData::raw && data != VtkData::ascii) {
        return Error{.what = "legacy files of VTK (.vtk) know no compression",
                     .file = path,
                     .line = 0,
                     .expected = "raw or ascii",
                     .found = std::string(name(data)),
                     .remedy = "write a .vtu file"};
    }
    try {
        return write_legacy(mesh, path, data);
    } catch (const std::bad_alloc&) {
        return Error{.what = "too little memory to write the mesh", .file = path, .remedy = "free some memory"};
    }
}

}  // namespace barycert
