// Meshes as VTK's files, in XML and in the legacy format, and rows as points of an unstructured grid.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/vtk_cell.hpp"
#include "files/format.hpp"
#include "files/output_file.hpp"
#include "files/spool.hpp"
#include "io/formats.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/consistency.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/pulling.hpp"

namespace barycert::io {
namespace {

/// An unstructured grid of cells of one type, of so many nodes each, or of those shapes.
struct OutGrid {
    std::vector<OutArray> point_arrays, cell_arrays;
    OutArray points, connectivity;
    std::size_t cells = 0, nodes = 1;
    std::uint8_t type = 0;  ///< VTK's number
    const Mesh::Shapes* shapes = nullptr;

    std::size_t end(std::size_t cell) const {
        return shapes == nullptr ? nodes * (cell + 1) : static_cast<std::size_t>(shapes->ends[cell]);
    }
    std::uint8_t type_of(std::size_t cell) const { return shapes == nullptr ? type : shapes->types[cell]; }
};

/// As RawFaces has them. `ends`: where those of each polyhedron end, -1 of other cells.
std::vector<std::int64_t> face_streams(const Mesh::Shapes& shapes, std::vector<std::int64_t>& ends) {
    std::vector<std::int64_t> stream;
    std::int64_t face = 0, node = 0;
    for (std::size_t cell = 0; cell < shapes.count(); ++cell) {
        if (shapes.types[cell] == vtk_polyhedron) {
            stream.push_back(shapes.face_ends[cell] - face);
            for (; face < shapes.face_ends[cell]; ++face) {
                const std::int64_t end = shapes.ring_ends[static_cast<std::size_t>(face)];
                stream.push_back(end - node);
                for (; node < end; ++node) stream.push_back(shapes.rings[static_cast<std::size_t>(node)]);
            }
        }
        ends.push_back(shapes.types[cell] == vtk_polyhedron ? static_cast<std::int64_t>(stream.size()) : -1);
    }
    return stream;
}

Status write_grid(OutGrid grid, const std::string& path, VtkData data) {
    const auto end = [&](std::size_t i) { return grid.end(i); };
    const auto type = [&](std::size_t i) { return grid.type_of(i); };
    const bool wide = grid.connectivity.count > std::numeric_limits<std::int32_t>::max();
    std::vector<std::int64_t> stream, ends;
    std::vector<OutArray> cells{std::move(grid.connectivity),
                                wide ? array_made<std::int64_t>("offsets", grid.cells, end)
                                     : array_made<std::int32_t>("offsets", grid.cells, end),
                                array_made<std::uint8_t>("types", grid.cells, type)};
    if (grid.shapes != nullptr && !grid.shapes->face_ends.empty()) {
        stream = face_streams(*grid.shapes, ends);
        cells.push_back(array_in_memory<std::int64_t>("faces", stream));
        cells.push_back(array_in_memory<std::int64_t>("faceoffsets", ends));
    }
    return write_xml({.data_set = "UnstructuredGrid",
                      .piece = " NumberOfPoints=\"" + std::to_string(grid.points.count / 3) + "\" NumberOfCells=\"" +
                               std::to_string(grid.cells) + "\"",
                      .sections = {{"PointData", std::move(grid.point_arrays)},
                                   {"CellData", std::move(grid.cell_arrays)},
                                   {"Points", {std::move(grid.points)}},
                                   {"Cells", std::move(cells)}}},
                     path, data);
}

bool has_zero_byte(const std::string& text) {
    return text.find('\0') != std::string::npos;
}

/// Each text with a zero byte behind it.
std::string with_ends(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all.append(text).push_back('\0');
    return all;
}

/// Says, in one clause, what is wrong with the mesh, names of fields aside; empty if nothing is.
std::string fault_of_mesh(const Mesh& mesh) {
    if (const char* const found = mesh::inconsistency(mesh, mesh::FieldValues::any); found != nullptr) return found;
    for (const Column& labels : mesh.cell_labels) {
        if (labels.size() != mesh.cell_count()) return "the labels of cells do not match the cells";
        if (labels.type() != Column::Type::text) continue;
        if (std::ranges::any_of(std::get<std::vector<std::string>>(labels.values), has_zero_byte))
            return "the labels \"" + labels.name + "\" hold a zero byte, which ends a text there";
    }
    return {};
}

/// The nodes of all cells: corners, then mid-edge nodes, whose order in the mesh is VTK's.
struct CellNodes {
    const Mesh& mesh;
    std::size_t corners = mesh.corners();  ///< of a cell, and all of its nodes
    std::size_t nodes = corners + (mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size());

    Mesh::Index operator()(std::size_t i) const {
        const std::size_t cell = i / nodes, k = i % nodes;
        return k < corners ? mesh.cells[cell * corners + k] : mesh.mid_nodes[cell * (nodes - corners) + k - corners];
    }
    VtkCell type() const {
        if (mesh.dimension == 2) return nodes == corners ? vtk_triangle : vtk_quadratic_triangle;
        return nodes == corners ? vtk_tetra : vtk_quadratic_tetra;
    }
};

/// Arrays of cells: fields and labels. Texts go to `room`, which must outlive them.
std::vector<OutArray> cell_arrays_of(const Mesh& mesh, std::vector<std::string>& room) {
    std::vector<OutArray> arrays = arrays_of(mesh.cell_fields);
    room.resize(mesh.cell_labels.size());
    for (std::size_t i = 0; i < room.size(); ++i) {
        const Column& labels = mesh.cell_labels[i];
        const auto add = [&]<class T>(const std::vector<T>& all) {
            if constexpr (std::is_same_v<T, std::string>) {
                arrays.push_back(array_in_memory<char>(labels.name, room[i] = with_ends(all)));
            } else {
                arrays.push_back(array_in_memory<T>(labels.name, all));
            }
        };
        std::visit(add, labels.values);
    }
    return arrays;
}

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

/// A legacy file: numbers in big-endian order, or as text.
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

Status write_mesh(const Mesh& mesh, const std::string& path, VtkData data, Names names) {
    const ExactEnvironment environment;
    try {
        std::string fault = fault_of_mesh(mesh);
        if (!fault.empty()) return cannot_write("the mesh", fault, path);
        std::vector<std::string> room;
        const CellNodes node{mesh};
        const bool shaped = !mesh.shapes.types.empty();
        const std::size_t cells = mesh.whole_count();
        const Mesh rows = shaped ? mesh::rows_of_wholes(mesh) : Mesh();
        OutGrid grid{
            .point_arrays = arrays_of(mesh.point_fields),
            .cell_arrays = cell_arrays_of(shaped ? rows : mesh, room),
            .points = array_of_points(mesh.points, mesh.dimension),
            .connectivity = mesh.mid_nodes.empty()
                                ? array_in_memory<Mesh::Index>("connectivity", shaped ? mesh.shapes.nodes : mesh.cells)
                                : array_made<Mesh::Index>("connectivity", node.nodes * cells, node),
            .cells = cells,
            .nodes = node.nodes,
            .type = node.type(),
            .shapes = shaped ? &mesh.shapes : nullptr};
        if (!mesh.point_markers.empty())
            grid.point_arrays.push_back(array_in_memory<std::int64_t>(marker_name, mesh.point_markers));
        fault = fault_of_names(grid.point_arrays, names);
        if (fault.empty()) fault = fault_of_names(grid.cell_arrays, names);
        if (!fault.empty()) return cannot_write("the mesh", fault, path);
        return names == Names::xml ? write_grid(std::move(grid), path, data)
                                   : LegacyWriter(path, data == VtkData::ascii).write(std::move(grid), node);
    } catch (const std::bad_alloc&) {
        return file_error("memory.short", path, "too little memory to write the mesh", {}, {}, "free some memory");
    }
}

/// Rows in a .vtu file: each point a cell of type VTK_VERTEX (z = 0 in dimension 2), the rest as point arrays: `cell`
/// (Int64), `feature` (UInt8: 0 interior, 1 face, 2 edge, 3 vertex, 4 outside, 5 degenerate), `vtkValidPointMask`
/// (Int8: 1 inside, 0 outside, as VTK's own probes name it), `distance`, the fields (Float64), what is carried.
class VtuSink final : public TableSink {
public:
    VtuSink(const std::string& path, const TableFormat& format) : path_(path), format_(format) {
        const auto add = [&](const std::string& name, int components, NumberType type) {
            arrays_.emplace_back(ArrayFormat{name, components, type}, base::Spool(path));
        };
        add("cell", 1, NumberType::int64);
        add("feature", 1, NumberType::uint8);
        add("vtkValidPointMask", 1, NumberType::int8);
        if (format.distances) add("distance", 1, NumberType::float64);
        for (const TableField& field : format.fields) {
            add(field.name, field.components, NumberType::float64);
            numbers_.push_back({field.name, field.components, {}});
        }
        constexpr std::array types{NumberType::int64, NumberType::float64, NumberType::text};  // by Column::Type
        for (const ColumnFormat& column : format.carried)
            add(column.name, 1, types[static_cast<std::size_t>(column.type)]);
    }

    Status write(const TableView& rows) override {
        if (Status fits = check_rows(rows, format_, path_); !fits) return fits;
        const std::size_t count = rows.cells.size(), dimension = static_cast<std::size_t>(format_.dimension);
        for (std::size_t i = 0; i < rows.points.size(); ++i) {
            // A point of a row outside may be anywhere.
            if (!std::isfinite(rows.points[i]) && rows.cells[i / dimension] >= 0)
                return cannot_write("the points", "a coordinate is not finite", path_);
        }
        Status good = points_.append(rows.points);
        auto array = arrays_.begin();
        const auto append = [&](const auto& values) {
            base::Spool& spool = (array++)->second;
            if (good) good = spool.append(std::span(values));
        };
        append(std::vector<std::int64_t>(rows.cells.begin(), rows.cells.end()));
        append(rows.features);
        std::vector<std::int8_t> inside(count);
        for (std::size_t i = 0; i < count; ++i) inside[i] = rows.cells[i] >= 0 ? 1 : 0;
        append(inside);
        if (format_.distances) append(rows.distances);
        for (Field& field : numbers_) field.data.clear();
        append_rows(rows, numbers_);
        for (const Field& field : numbers_) append(field.data);
        const auto append_column = [&]<class T>(const std::vector<T>& values) {
            if constexpr (std::is_same_v<T, std::string>) {
                const auto bad = std::ranges::find_if(values, has_zero_byte);
                if (bad != values.end() && good)
                    good = file_error("field.type", path_, "a text with a zero byte, which ends a text in VTK's files",
                                      {}, bad->substr(0, 40), "carry another column through, or write a .csv file");
                append(with_ends(values));
            } else {
                append(values);
            }
        };
        for (const Column& column : rows.carried) std::visit(append_column, column.values);
        count_ += count;
        return good;
    }

    Status commit() override {
        std::vector<OutArray> found;
        std::string fault = count_ > max_entities ? "there are more than 2147483647 points" : "";
        for (auto& [format, spool] : arrays_) {
            if (Status done = spool.finish(); !done) return done;
            const std::span<const char> bytes = spool.values<char>();
            found.push_back({format, bytes.size() / number_bytes(format.type), bytes.data()});
            if (fault.empty() && format.components < 1) fault = "a field has no components";
        }
        if (fault.empty()) fault = fault_of_names(found, Names::xml);
        if (!fault.empty()) return cannot_write("the points", fault, path_);
        if (Status done = points_.finish(); !done) return done;
        if (count_ == 0) found.clear();
        // Each point a cell. Node numbers go up to 2^31 - 1.
        return write_grid({.point_arrays = std::move(found),
                           .cell_arrays = {},
                           .points = array_of_points(points_.values<double>(), format_.dimension),
                           .connectivity = array_made<std::int32_t>("connectivity", count_, std::identity()),
                           .cells = count_,
                           .type = vtk_vertex},
                          path_, format_.vtk_data);
    }

private:
    std::string path_;
    TableFormat format_;
    base::Spool points_{path_};
    std::vector<std::pair<ArrayFormat, base::Spool>> arrays_;  ///< in the order of the file
    std::vector<Field> numbers_;                               ///< of the last rows, each field for itself
    std::size_t count_ = 0;
};

}  // namespace

Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format) {
    return std::unique_ptr<TableSink>(std::make_unique<VtuSink>(path, format));
}

}  // namespace barycert::io

namespace barycert {

Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data) {
    return io::write_mesh(mesh, path, data, io::Names::xml);
}

Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data) {
    const base::FormatKind kind = base::kind_of(path);
    if (kind == base::FormatKind::vtu) return write_vtu(mesh, path, data);
    if (kind != base::FormatKind::vtk)
        return file_error("file.suffix", path, "unknown file suffix", ".vtu or .vtk", {}, "use one of these suffixes");
    if (data != VtkData::raw && data != VtkData::ascii)
        return file_error("option.unfit", path, "legacy files of VTK (.vtk) know no compression", "raw or ascii",
                          std::string(name(data)), "write a .vtu file");
    return io::write_mesh(mesh, path, data, io::Names::legacy);
}

}  // namespace barycert
