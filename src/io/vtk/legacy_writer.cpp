// Grids as VTK's legacy files.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "files/output_file.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"
#include "io/vtk/out_grid.hpp"
#include "io/vtk/raw_grid.hpp"

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

class LegacyWriter {
public:
    LegacyWriter(const std::string& path, bool text) : file_(path), text_(text) {}

    Status write(OutGrid grid, const CellNodes& node) {
        const std::size_t points = grid.points.count / 3, cells = grid.cells;
        // Version 4.2 counts all numbers of the cells, the lengths among them, with 32 bits.
        const bool wide = grid.shapes == nullptr && cells * (node.nodes + 1) > max_entities;
        file_.write(std::string("# vtk DataFile Version ") + (wide ? "5.1" : "4.2") + "\nmesh\n" +
                    (text_ ? "ASCII" : "BINARY") + "\nDATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(points) +
                    " double\n");
        write_array(grid.points, 3);
        wide                     ? write_wide_cells(node, cells)
        : grid.shapes != nullptr ? write_shapes(*grid.shapes)
                                 : write_cells(node, cells);
        file_.write("CELL_TYPES " + std::to_string(cells) + "\n");
        write_array(array_made<std::int32_t>("types", cells, [&](std::size_t i) { return grid.type_of(i); }), 12);
        write_arrays("CELL_DATA", cells, grid.cell_arrays);
        write_arrays("POINT_DATA", points, grid.point_arrays);
        return file_.commit();
    }

private:
    void write_array(const OutArray& array, std::size_t per_line) {
        const auto out = [&](std::string_view bytes) { file_.write(bytes); };
        if (text_) return write_as_text(array, per_line, out);
        const auto size = static_cast<std::ptrdiff_t>(number_bytes(array.format.type));
        const auto reverse_numbers = [size](std::size_t, std::size_t, std::string& bytes) {
            if (std::endian::native == std::endian::big || size == 1) return;
            for (auto at = bytes.begin(); at != bytes.end(); at += size) std::reverse(at, at + size);
        };
        write_parts(array, std::size_t{1} << 15, reverse_numbers, out);
        file_.write("\n");
    }

    /// Version 4.2: the number of its nodes before the nodes of each cell.
    void write_cells(const CellNodes& node, std::size_t cells) {
        const std::size_t row = node.nodes + 1;
        file_.write("CELLS " + std::to_string(cells) + " " + std::to_string(cells * row) + "\n");
        const auto number = [node, row](std::size_t i) {
            return i % row == 0 ? static_cast<std::int32_t>(node.nodes) : node(i / row * node.nodes + i % row - 1);
        };
        write_array(array_made<std::int32_t>("cells", cells * row, number), row);
    }

    /// Version 4.2, too; polyhedra have the stream of their faces in place of nodes.
    void write_shapes(const Mesh::Shapes& shapes) {
        std::vector<std::int64_t> ends;
        const std::vector<std::int64_t> stream = face_streams(shapes, ends);
        std::vector<std::int32_t> numbers;
        std::ptrdiff_t in_stream = 0;
        for (std::size_t cell = 0; cell < shapes.count(); ++cell) {
            const auto add = [&](auto first, auto last) {
                numbers.push_back(static_cast<std::int32_t>(last - first));
                for (; first != last; ++first) numbers.push_back(static_cast<std::int32_t>(*first));
            };
            if (ends[cell] >= 0) {
                add(stream.begin() + std::exchange(in_stream, ends[cell]), stream.begin() + ends[cell]);
            } else {
                const std::span nodes = shapes.nodes_of(cell);
                add(nodes.begin(), nodes.end());
            }
        }
        file_.write("CELLS " + std::to_string(shapes.count()) + " " + std::to_string(numbers.size()) + "\n");
        write_array(array_in_memory<std::int32_t>("cells", numbers), 12);
    }

    /// Version 5.1: where the nodes of each cell begin and the last ones end, then all nodes.
    void write_wide_cells(const CellNodes& node, std::size_t cells) {
        const std::size_t nodes = node.nodes, numbers = cells * nodes;
        file_.write("CELLS " + std::to_string(cells + 1) + " " + std::to_string(numbers) + "\nOFFSETS vtktypeint64\n");
        const auto begin = [nodes](std::size_t i) { return nodes * i; };
        write_array(array_made<std::int64_t>("offsets", cells + 1, begin), 12);
        file_.write("CONNECTIVITY vtktypeint64\n");
        write_array(array_made<std::int64_t>("connectivity", numbers, node), nodes);
    }

    /// FIELD FieldData: any number of arrays of any type; texts last.
    void write_arrays(const char* section, std::size_t rows, std::vector<OutArray>& arrays) {
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
                       : write_array(a, components > 1 ? static_cast<std::size_t>(components) : 12);
        }
    }

    /// In a binary file each text follows its length, of 1, 2, 4 or 8 bytes, whose two highest bits are 3, 2, 1 or 0.
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

}  // namespace

Status write_legacy_grid(OutGrid grid, const CellNodes& node, const std::string& path, bool text) {
    return LegacyWriter(path, text).write(std::move(grid), node);
}

}  // namespace barycert::io
