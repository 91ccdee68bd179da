#include "barycert/io/vtk/xml_reader.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "barycert/io/other_formats.hpp"
#include "barycert/io/vtk/xml_arrays.hpp"
#include "barycert/io/vtk/xml_grids.hpp"

namespace barycert::io {

std::uint8_t type_in(Section section, std::int64_t nodes) {
    constexpr std::uint8_t vertex = 1, poly_vertex = 2, line = 3, poly_line = 4, triangle = 5, strip = 6, polygon = 7,
                           quad = 9;
    switch (section) {
        case vertices:
            return nodes == 1 ? vertex : poly_vertex;
        case lines:
            return nodes == 2 ? line : poly_line;
        case polygons:
            return nodes == 3 ? triangle : nodes == 4 ? quad : polygon;
        default:
            return strip;
    }
}

namespace {

/// Reads the pieces of a file one after the other.
class XmlReader {
public:
    XmlReader(std::string_view bytes, const XmlTree& tree, const XmlLayout& layout, const std::string& path, Part part)
        : tree_(tree), arrays_(bytes, tree, layout, path), path_(path), part_(part) {}

    Result<RawGrid> read() {
        const std::string type(tree_.root().attribute("type").value_or(""));
        const bool mesh = type == "UnstructuredGrid" || type == "PolyData";
        const XmlElement* const data = tree_.root().name == "VTKFile" ? tree_.child(tree_.root(), type) : nullptr;
        if (data == nullptr || !(mesh || (part_ != Part::all && is_structured(type)))) return wrong_kind(data, type);
        if (!mesh) return read_structured(*data, type);
        is_polygons_ = type == "PolyData";
        RawGrid grid;
        for (const std::size_t i : data->children) {
            const XmlElement& element = tree_.elements[i];
            if (element.name == "FieldData") note_loose(element, grid);
            if (element.name != "Piece") continue;
            RawGrid piece;
            if (Status s = read_piece(element, grid, piece); !s) return s.error();
            if (Status s = append_piece(grid, std::move(piece), path_); !s) return s.error();
        }
        return grid;
    }

private:
    Error wrong_kind(const XmlElement* data, const std::string& type) const {
        std::string found = "type " + in_quotes(type);
        if (tree_.root().name != "VTKFile") {
            found = "an element " + in_quotes(tree_.root().name);
        } else if (data == nullptr) {
            found = "no element of its type " + in_quotes(type);
        }
        return arrays_.error(tree_.root(), "the kind of the file",
                             part_ == Part::all ? "a VTKFile of type UnstructuredGrid or PolyData"
                                                : "a VTKFile of type UnstructuredGrid, PolyData, ImageData, "
                                                  "RectilinearGrid or StructuredGrid",
                             found, is_structured(type) ? to_simplices(path_) : "");
    }

    Result<std::size_t> count_of(const XmlElement& piece, std::string_view key, std::size_t before) const {
        const std::optional<std::string_view> text = piece.attribute(key);
        const std::optional<std::uint64_t> count =
            text.has_value() ? parse_count(*text) : std::optional<std::uint64_t>();
        if (!count.has_value() || *count > max_entities - before) {
            return arrays_.error(piece, "the attribute " + std::string(key),
                                 "a count, at most " + std::to_string(max_entities) + " in all pieces",
                                 text.has_value() ? in_quotes(*text) : "none");
        }
        return static_cast<std::size_t>(*count);
    }

    Status read_piece(const XmlElement& piece, const RawGrid& before, RawGrid& grid) {
        const Result<std::size_t> points = count_of(piece, "NumberOfPoints", before.point_count());
        if (!points) return points.error();
        if (Status s = read_points(piece, *points, grid); !s) return s;
        if (part_ == Part::points) {
            list_arrays(piece, grid);
            return Done{};
        }
        if (Status s = read_arrays(piece, "PointData", *points, grid.has_steps, grid.point_arrays); !s) return s;
        if (const XmlElement* const data = tree_.child(piece, "PointData"); data != nullptr)
            grid.global_ids = data->attribute("GlobalIds").value_or("");
        if (part_ != Part::all) return Done{};
        if (is_polygons_) {
            if (Status s = read_polygons(piece, before.types.size(), grid); !s) return s;
        } else {
            const Result<std::size_t> cells = count_of(piece, "NumberOfCells", before.types.size());
            if (!cells) return cells.error();
            if (Status s = read_cells(piece, "Cells", *cells, grid); !s) return s;
        }
        grid.checked_nodes = true;
        return read_arrays(piece, "CellData", grid.types.size(), grid.has_steps, grid.cell_arrays);
    }

    /// The names of point arrays that are not read.
    void list_arrays(const XmlElement& piece, RawGrid& grid) const {
        const XmlElement* const data = tree_.child(piece, "PointData");
        if (data == nullptr) return;
        for (const std::size_t i : data->children) {
            const std::string name(tree_.elements[i].attribute("Name").value_or(""));
            if (!name.empty()) grid.unread_arrays.push_back(name);
        }
    }

    Status read_points(const XmlElement& piece, std::size_t count, RawGrid& grid) {
        if (count == 0) return Done{};
        const XmlElement* const points = tree_.child(piece, "Points");
        const XmlElement* const array = points != nullptr ? tree_.child(*points, "DataArray") : nullptr;
        if (array == nullptr) return arrays_.error(piece, "the points of a piece", "an array in Points", "none");
        if (parse_count(array->attribute("NumberOfComponents").value_or("1")) != 3) {
            return arrays_.error(*array, "the components of the points", "3",
                                 in_quotes(array->attribute("NumberOfComponents").value_or("")));
        }
        grid.narrow_points = XmlArrays::type_of(*array) == NumberType::float32;
        return arrays_.read(*array, "the coordinates", std::uint64_t{3} * count, grid.points);
    }

    const XmlElement* array_named(const XmlElement* in, std::string_view name) const {
        if (in == nullptr) return nullptr;
        for (const std::size_t i : in->children) {
            if (tree_.elements[i].attribute("Name") == name) return &tree_.elements[i];
        }
        return nullptr;
    }

    /// The cells of a section, behind those that there are. Types are read where the section has them.
    Status read_cells(const XmlElement& piece, const char* section, std::size_t count, RawGrid& grid) {
        if (count == 0) return Done{};
        const XmlElement* const cells = tree_.child(piece, section);
        const XmlElement* const connectivity = array_named(cells, "connectivity");
        const XmlElement* const offsets = array_named(cells, "offsets");
        const XmlElement* const types = array_named(cells, "types");
        if (connectivity == nullptr || offsets == nullptr || (types == nullptr && !is_polygons_)) {
            return arrays_.error(
                piece, "the cells of a piece",
                is_polygons_ ? "arrays connectivity and offsets" : "arrays connectivity, offsets and types",
                is_polygons_ ? "not both" : "not all three");
        }
        if (!is_polygons_) {
            if (Status s = arrays_.read(*types, "the types of cells", count, grid.types); !s) return s;
        }
        const std::size_t cells_before = grid.ends.size(), nodes_before = grid.connectivity.size();
        if (Status s = arrays_.read(*offsets, "the offsets of cells", count, grid.ends); !s) return s;
        std::int64_t end = 0;
        for (std::size_t i = cells_before; i < grid.ends.size(); ++i) {
            if (grid.ends[i] < end) {
                return arrays_.error(*offsets, "the offsets of cells", "none below the one before it",
                                     std::to_string(grid.ends[i]) + " after " + std::to_string(end));
            }
            end = grid.ends[i];
            grid.ends[i] += static_cast<std::int64_t>(nodes_before);
        }
        if (Status s =
                arrays_.read(*connectivity, "the connectivity", static_cast<std::uint64_t>(end), grid.connectivity);
            !s) {
            return s;
        }
        const std::size_t wrong = first_wrong_node(grid.connectivity, nodes_before, grid.point_count());
        if (wrong == grid.connectivity.size()) return Done{};
        return arrays_.error(*connectivity, "a node of a cell", "a point below " + std::to_string(grid.point_count()),
                             std::to_string(grid.connectivity[wrong]));
    }

    Status read_polygons(const XmlElement& piece, std::size_t before, RawGrid& grid) {
        constexpr std::array<std::pair<const char*, const char*>, section_count> sections{
            {{"Verts", "NumberOfVerts"},
             {"Lines", "NumberOfLines"},
             {"Polys", "NumberOfPolys"},
             {"Strips", "NumberOfStrips"}}};
        for (std::size_t i = 0; i < section_count; ++i) {
            const auto& [name, key] = sections[i];
            if (!piece.attribute(key).has_value()) continue;
            const Result<std::size_t> count = count_of(piece, key, before + grid.types.size());
            if (!count) return count.error();
            std::size_t cell = grid.ends.size();
            auto end = static_cast<std::int64_t>(grid.connectivity.size());
            if (Status s = read_cells(piece, name, *count, grid); !s) return s;
            for (; cell < grid.ends.size(); ++cell) {
                grid.types.push_back(type_in(static_cast<Section>(i), grid.ends[cell] - end));
                end = grid.ends[cell];
            }
        }
        return Done{};
    }

    void note_loose(const XmlElement& data, RawGrid& grid) const {
        for (const std::size_t i : data.children) {
            const std::string name(tree_.elements[i].attribute("Name").value_or(""));
            if (!name.empty() && !is_time(name)) grid.loose_arrays.push_back(name);
        }
    }

    Status read_arrays(const XmlElement& piece, const char* section, std::size_t count, bool& has_steps,
                       std::vector<RawArray>& arrays) {
        const XmlElement* const data = tree_.child(piece, section);
        if (count == 0 || data == nullptr) return Done{};
        std::set<std::string> seen;
        for (const std::size_t i : data->children) {
            const XmlElement& array = tree_.elements[i];
            if (array.name != "DataArray" && array.name != "Array") continue;
            // Arrays of several time steps stand side by side; the first step is read.
            const std::optional<std::string_view> step = array.attribute("TimeStep");
            if (step.has_value() && !has_word(*step, "0")) {
                has_steps = true;
                continue;
            }
            RawArray read;
            read.field.name = array.attribute("Name").value_or("");
            if (!seen.insert(read.field.name).second) {
                return arrays_.error(array, "two arrays in one " + std::string(section), "different names",
                                     in_quotes(read.field.name) + " twice", "give them different names");
            }
            const bool of_cells = std::string_view(section) == "CellData";
            if (Status s = read_array(array, of_cells, count, read); !s) return s;
            arrays.push_back(std::move(read));
        }
        return Done{};
    }

    Status read_array(const XmlElement& array, bool of_cells, std::size_t count, RawArray& to) {
        const std::string what = "array " + in_quotes(to.field.name);
        const std::string_view text = array.attribute("NumberOfComponents").value_or("1");
        const std::uint64_t components = parse_count(text).value_or(0);
        if (components == 0 || components > max_entities) {
            return arrays_.error(array, "the components of " + what, "a count of 1 or more", in_quotes(text));
        }
        to.field.components = static_cast<int>(components);
        const std::uint64_t numbers = components * count;
        const std::optional<NumberType> type = XmlArrays::type_of(array);
        if (to.field.name.empty()) {
            to.fault = "it has no name";
            return Done{};
        }
        const bool may_label = of_cells || part_ == Part::point_arrays;
        if (!type.has_value()) return read_text_array(array, what, may_label, count, to);
        to.is_narrow = *type == NumberType::float32;
        to.is_integer = *type == NumberType::int64 || *type == NumberType::uint64;
        to.is_whole = *type != NumberType::float32 && *type != NumberType::float64;
        const bool markers = !of_cells && to.field.name == marker_name && *type == NumberType::int64 && components == 1;
        NumberFault fault;
        if (!markers) {
            if (Status s = arrays_.read(array, what, numbers, to.field.data, &fault); !s) return s;
            if (!fault) return Done{};
        }
        to.field.data = {};
        NumberFault wide;
        std::vector<std::int64_t> labels;
        if (markers || (may_label && components == 1 && to.is_integer)) {
            if (Status s = arrays_.read(array, what, numbers, labels, &wide); !s) return s;
        }
        if (wide || labels.empty()) {
            to.fault = inexact(fault);
        } else {
            to.labels = std::move(labels);
            to.has_labels = true;
        }
        return Done{};
    }

    Status read_text_array(const XmlElement& array, const std::string& what, bool may_label, std::size_t count,
                           RawArray& to) {
        if (array.attribute("type") != "String") {
            to.fault = "it holds no numbers";
        } else if (!may_label) {
            to.fault = "it holds text, which points of a mesh cannot carry";
        } else if (to.field.components != 1) {
            to.fault = "it holds texts of several components";
        } else {
            std::vector<std::string> texts;
            if (Status s = arrays_.read_texts(array, what, count, texts); !s) return s;
            to.labels = std::move(texts);
            to.has_labels = true;
        }
        return Done{};
    }

    static bool has_word(std::string_view text, std::string_view wanted) {
        for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
            if (word == wanted) return true;
        }
        return false;
    }

    /// Grids have one piece, or the points on the borders of pieces would be there twice.
    Result<RawGrid> read_structured(const XmlElement& data, const std::string& type) {
        RawGrid grid;
        const XmlElement* piece = nullptr;
        for (const std::size_t i : data.children) {
            if (tree_.elements[i].name == "FieldData") note_loose(tree_.elements[i], grid);
            if (tree_.elements[i].name != "Piece") continue;
            if (piece != nullptr) {
                return arrays_.error(tree_.elements[i], "a grid in several pieces", "one piece", "more",
                                     "write it again in one piece, as ParaView's Merge Blocks or VTK's writer do");
            }
            piece = &tree_.elements[i];
        }
        if (piece == nullptr) return grid;
        if (Status s = read_grid_points(tree_, arrays_, data, *piece, type, grid); !s) return s.error();
        if (part_ == Part::points) {
            list_arrays(*piece, grid);
            return grid;
        }
        if (Status s = read_arrays(*piece, "PointData", grid.point_count(), grid.has_steps, grid.point_arrays); !s)
            return s.error();
        return grid;
    }

    const XmlTree& tree_;
    XmlArrays arrays_;
    const std::string& path_;
    Part part_;
    bool is_polygons_ = false;
};

}  // namespace

Result<RawGrid> read_xml(std::string_view bytes, const XmlTree& tree, const std::string& path, Part part) {
    const Result<XmlLayout> layout = layout_of(tree, bytes, path);
    if (!layout) return layout.error();
    return XmlReader(bytes, tree, *layout, path, part).read();
}

}  // namespace barycert::io
