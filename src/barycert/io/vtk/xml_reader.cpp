#include <algorithm>
#include <optional>
#include <set>

#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_arrays.hpp"
#include "barycert/io/vtk/xml_tree.hpp"

namespace barycert::io {
namespace {

constexpr const char* missing = "it is missing in a piece of the file";

/// Collects the pieces of a file one after the other.
class XmlReader {
public:
    XmlReader(std::string_view bytes, const XmlTree& tree, const XmlLayout& layout, const std::string& path, Part part)
        : tree_(tree), arrays_(bytes, tree, layout, path), part_(part) {}

    Result<RawGrid> read() {
        const XmlElement* const data = data_set();
        if (data == nullptr) {
            return arrays_.error(tree_.root(), "the kind of the file",
                                 part_ == Part::all ? "a VTKFile of type UnstructuredGrid"
                                                    : "a VTKFile of type UnstructuredGrid or PolyData",
                                 found_kind(),
                                 "convert it to an unstructured grid in one .vtu file, with ParaView or VTK");
        }
        for (const std::size_t i : data->children) {
            if (tree_.elements[i].name != "Piece") continue;
            if (Status s = read_piece(tree_.elements[i]); !s) return s.error();
        }
        settle_markers();
        return std::move(grid_);
    }

private:
    /// The array of markers is no field, unless its type differs between pieces.
    void settle_markers() {
        if (grid_.point_markers.empty()) return;
        const auto array = std::find_if(grid_.point_arrays.begin(), grid_.point_arrays.end(),
                                        [](const RawArray& a) { return a.field.name == marker_name; });
        if (grid_.point_markers.size() == grid_.points.size() / 3) {
            grid_.point_arrays.erase(array);
        } else {
            array->fault = array->fault.empty() ? "its type differs between pieces" : array->fault;
            grid_.point_markers.clear();
        }
    }

    const XmlElement* data_set() const {
        const std::string_view type = tree_.root().attribute("type").value_or("");
        const bool known = type == "UnstructuredGrid" || (type == "PolyData" && part_ == Part::points);
        return tree_.root().name == "VTKFile" && known ? tree_.child(tree_.root(), type) : nullptr;
    }

    std::string found_kind() const {
        if (tree_.root().name != "VTKFile") return "an element " + in_quotes(tree_.root().name);
        const std::string type(tree_.root().attribute("type").value_or(""));
        if (tree_.child(tree_.root(), type) == nullptr) return "no element of its type " + in_quotes(type);
        return in_quotes(type);
    }

    Result<std::size_t> count_of(const XmlElement& piece, const char* key, std::size_t before) const {
        const std::optional<std::string_view> text = piece.attribute(key);
        const std::optional<std::uint64_t> count = parse_count(text.value_or(""));
        if (!count.has_value() || *count > max_entities - before) {
            return arrays_.error(piece, "the attribute " + std::string(key),
                                 "a count, at most " + std::to_string(max_entities) + " in all pieces",
                                 text.has_value() ? in_quotes(*text) : "none");
        }
        return static_cast<std::size_t>(*count);
    }

    Status read_piece(const XmlElement& piece) {
        const std::size_t points_before = grid_.points.size() / 3, cells_before = grid_.types.size();
        const Result<std::size_t> points = count_of(piece, "NumberOfPoints", points_before);
        if (!points) return points.error();
        if (Status s = read_points(piece, *points); !s || part_ == Part::points) return s;
        const Result<std::size_t> cells = count_of(piece, "NumberOfCells", cells_before);
        if (!cells) return cells.error();
        if (Status s = read_cells(piece, *cells, points_before); !s) return s;
        if (Status s = read_fields(piece, "PointData", *points, points_before == 0, grid_.point_arrays); !s) return s;
        return read_fields(piece, "CellData", *cells, cells_before == 0, grid_.cell_arrays);
    }

    Status read_points(const XmlElement& piece, std::size_t count) {
        if (count == 0) return Done{};
        const XmlElement* const points = tree_.child(piece, "Points");
        const XmlElement* const array = points != nullptr ? tree_.child(*points, "DataArray") : nullptr;
        if (array == nullptr) return arrays_.error(piece, "the points of a piece", "an array in Points", "none");
        if (parse_count(array->attribute("NumberOfComponents").value_or("1")) != 3) {
            return arrays_.error(*array, "the components of the points", "3",
                                 in_quotes(array->attribute("NumberOfComponents").value_or("")));
        }
        return arrays_.read(*array, "the coordinates", std::uint64_t{3} * count, grid_.points);
    }

    Status read_cells(const XmlElement& piece, std::size_t count, std::size_t points_before) {
        if (count == 0) return Done{};
        const XmlElement* const cells = tree_.child(piece, "Cells");
        const auto array_named = [&](std::string_view name) -> const XmlElement* {
            if (cells == nullptr) return nullptr;
            for (const std::size_t i : cells->children) {
                if (tree_.elements[i].attribute("Name") == name) return &tree_.elements[i];
            }
            return nullptr;
        };
        const XmlElement* const connectivity = array_named("connectivity");
        const XmlElement* const offsets = array_named("offsets");
        const XmlElement* const types = array_named("types");
        if (connectivity == nullptr || offsets == nullptr || types == nullptr) {
            return arrays_.error(piece, "the cells of a piece", "arrays connectivity, offsets and types",
                                 "not all three");
        }
        if (Status s = arrays_.read(*types, "the types of cells", count, grid_.types); !s) return s;
        const std::size_t cells_before = grid_.ends.size(), nodes_before = grid_.connectivity.size();
        if (Status s = arrays_.read(*offsets, "the offsets of cells", count, grid_.ends); !s) return s;
        std::int64_t end = 0;
        for (std::size_t i = cells_before; i < grid_.ends.size(); ++i) {
            if (grid_.ends[i] < end) {
                return arrays_.error(*offsets, "the offsets of cells", "none below the one before it",
                                     std::to_string(grid_.ends[i]) + " after " + std::to_string(end));
            }
            end = grid_.ends[i];
            grid_.ends[i] += static_cast<std::int64_t>(nodes_before);
        }
        if (Status s =
                arrays_.read(*connectivity, "the connectivity", static_cast<std::uint64_t>(end), grid_.connectivity);
            !s) {
            return s;
        }
        return to_all_points(*connectivity, nodes_before, points_before);
    }

    /// A piece counts its own points from 0.
    Status to_all_points(const XmlElement& array, std::size_t nodes_before, std::size_t points_before) {
        const std::size_t own = grid_.points.size() / 3 - points_before;
        for (std::size_t i = nodes_before; i < grid_.connectivity.size(); ++i) {
            std::int32_t& node = grid_.connectivity[i];
            if (node < 0 || static_cast<std::size_t>(node) >= own) {
                return arrays_.error(array, "a node of a cell", "a point below " + std::to_string(own),
                                     std::to_string(node));
            }
            node += static_cast<std::int32_t>(points_before);
        }
        return Done{};
    }

    /// Arrays of the same name in all pieces make one field.
    Status read_fields(const XmlElement& piece, const char* section, std::size_t count, bool first,
                       std::vector<RawArray>& fields) {
        if (count == 0) return Done{};
        std::set<std::string> seen;
        if (const XmlElement* const data = tree_.child(piece, section); data != nullptr) {
            for (const std::size_t i : data->children) {
                const XmlElement& array = tree_.elements[i];
                // Arrays of several time steps stand side by side; the first step is read.
                const std::optional<std::string_view> step = array.attribute("TimeStep");
                if (step.has_value() && !has_word(*step, "0")) continue;
                const std::string name(array.attribute("Name").value_or(""));
                if (!seen.insert(name).second) {
                    return arrays_.error(array, "two arrays in one " + std::string(section), "different names",
                                         in_quotes(name) + " twice", "give them different names");
                }
                if (Status s = read_array(array, name, section, count, first, fields); !s) return s;
            }
        }
        for (RawArray& field : fields) {
            if (!seen.contains(field.field.name)) field.fault = missing;
        }
        return Done{};
    }

    Status read_array(const XmlElement& array, const std::string& name, std::string_view section, std::size_t count,
                      bool first, std::vector<RawArray>& fields) {
        const std::string what = "array " + in_quotes(name);
        const std::string_view text = array.attribute("NumberOfComponents").value_or("1");
        const std::uint64_t components = parse_count(text).value_or(0);
        if (components == 0 || components > max_entities) {
            return arrays_.error(array, "the components of " + what, "a count of 1 or more", in_quotes(text));
        }
        auto known =
            std::find_if(fields.begin(), fields.end(), [&](const RawArray& f) { return f.field.name == name; });
        if (known == fields.end()) {
            RawArray& added = fields.emplace_back();
            added.field = {name, static_cast<int>(components), {}};
            if (!first) added.fault = missing;
            known = fields.end() - 1;
        }
        if (known->field.components != static_cast<int>(components)) {
            return arrays_.error(array, "the components of " + what,
                                 std::to_string(known->field.components) + " as in the pieces before",
                                 std::to_string(components));
        }
        return read_field(array, what, count, section == "PointData", *known);
    }

    Status read_field(const XmlElement& array, const std::string& what, std::size_t count, bool of_points,
                      RawArray& to) {
        const std::optional<NumberType> type = XmlArrays::type_of(array);
        const std::uint64_t numbers = static_cast<std::uint64_t>(to.field.components) * count;
        if (!type.has_value()) {
            to.fault = "it holds no numbers";
        } else if (to.field.name.empty()) {
            to.fault = "it has no name";
        } else if (of_points && to.field.name == marker_name && *type == NumberType::int64 && numbers == count) {
            return arrays_.read(array, what, numbers, grid_.point_markers);
        } else {
            NumberFault fault;
            if (Status s = arrays_.read(array, what, numbers, to.field.data, &fault); !s) return s;
            if (fault) to.fault = inexact(fault);
        }
        return Done{};
    }

    static bool has_word(std::string_view text, std::string_view wanted) {
        for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
            if (word == wanted) return true;
        }
        return false;
    }

    const XmlTree& tree_;
    XmlArrays arrays_;
    Part part_;
    RawGrid grid_;
};

}  // namespace

Result<RawGrid> read_xml(std::string_view bytes, const std::string& path, Part part) {
    const Result<XmlTree> tree = parse_xml(bytes, path);
    if (!tree) return tree.error();
    const Result<XmlLayout> layout = layout_of(*tree, bytes, path);
    if (!layout) return layout.error();
    return XmlReader(bytes, *tree, *layout, path, part).read();
}

}  // namespace barycert::io
