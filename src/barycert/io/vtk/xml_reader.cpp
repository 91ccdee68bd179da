#include "barycert/io/vtk/xml.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {

namespace {

/// So many finite numbers, or integers as large as counts may be, and no more.
template <class T, std::size_t count>
std::optional<std::array<T, count>> parse_all(std::string_view text) {
    constexpr auto most = static_cast<std::int64_t>(max_entities);
    std::array<T, count> numbers{};
    bool good = true;
    for (T& x : numbers) {
        const std::string_view word = next_word(text);
        if constexpr (std::is_same_v<T, double>) {
            x = base::parse_double(word).value_or(HUGE_VAL);
            good = good && std::isfinite(x);
        } else {
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
            good = good && error == std::errc{} && end == word.data() + word.size() && -most <= x && x <= most;
        }
    }
    if (!good || !next_word(text).empty()) return std::nullopt;
    return numbers;
}

bool is_structured(std::string_view type) {
    return type == "ImageData" || type == "RectilinearGrid" || type == "StructuredGrid";
}

/// Reads the pieces of a file one after the other.
class XmlReader {
public:
    XmlReader(const XmlArrays& arrays, Part part) : tree_(arrays.tree()), arrays_(arrays), part_(part) {}

    Result<RawGrid> read() {
        const std::string type(tree_.root().attribute("type").value_or(""));
        const XmlElement* const data = tree_.root().name == "VTKFile" ? tree_.child(&tree_.root(), type) : nullptr;
        is_polygons_ = type == "PolyData";
        const bool structured = part_ != Part::all && is_structured(type);
        if (data == nullptr || !(is_polygons_ || structured || type == "UnstructuredGrid"))
            return wrong_kind(data, type);
        RawGrid grid;
        std::size_t pieces = 0;
        for (const std::size_t i : data->children) {
            const XmlElement& element = tree_.elements[i];
            if (element.name == "FieldData") {
                for (std::string& name : names_of(element))
                    if (!is_time(name)) grid.loose_arrays.push_back(std::move(name));
            }
            if (element.name != "Piece") continue;
            // Grids have one piece, or the points on the borders of pieces would be there twice.
            if (structured && ++pieces > 1)
                return tree_.error(element, "a grid in several pieces", "one piece", "more",
                                   "write it again in one piece, as ParaView's Merge Blocks or VTK's writer do");
            RawGrid piece;
            Status read = Done{};
            if (structured) {
                read = read_grid_points(*data, element, type, piece);
            } else {
                const Result<std::size_t> points = count_of(element, "NumberOfPoints", grid.point_count());
                read = points ? read_points(element, *points, piece) : points.error();
            }
            if (read) read = read_point_arrays(element, piece);
            if (read && part_ == Part::all) read = read_cells(element, grid.types.size(), piece);
            if (read) read = append_piece(grid, std::move(piece), tree_.path);
            if (!read) return read.error();
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
        return tree_.error(tree_.root(), "the kind of the file",
                           part_ == Part::all ? "a VTKFile of type UnstructuredGrid or PolyData"
                                              : "a VTKFile of type UnstructuredGrid, PolyData, ImageData, "
                                                "RectilinearGrid or StructuredGrid",
                           found, is_structured(type) ? to_simplices(tree_.path) : "");
    }

    Result<std::size_t> count_of(const XmlElement& piece, std::string_view key, std::size_t before) const {
        const std::optional<std::string_view> text = piece.attribute(key);
        const std::optional<std::uint64_t> count = parse_count(text.value_or(""));
        if (!count.has_value() || *count > max_entities - before)
            return tree_.error(piece, "the attribute " + std::string(key),
                               "a count, at most " + std::to_string(max_entities) + " in all pieces",
                               text.has_value() ? in_quotes(*text) : "none");
        return static_cast<std::size_t>(*count);
    }

    /// Those of the array in the section Points.
    Status read_points(const XmlElement& piece, std::size_t count, RawGrid& grid) const {
        if (count == 0) return Done{};
        const XmlElement* const array = tree_.child(tree_.child(&piece, "Points"), "DataArray");
        if (array == nullptr) return tree_.error(piece, "the points of a piece", "an array in Points", "none");
        const std::string_view components = array->attribute("NumberOfComponents").value_or("1");
        if (parse_count(components) != 3)
            return tree_.error(*array, "the components of the points", "3", in_quotes(components));
        grid.narrow_points = XmlArrays::type_of(*array) == NumberType::float32;
        return arrays_.read(*array, "the coordinates", std::uint64_t{3} * count, grid.points);
    }

    /// The points of the only piece of a structured grid, x running fastest. Error: an extent that is none, or not that
    /// of the whole; more points than a mesh can have, or than the file has numbers for.
    Status read_grid_points(const XmlElement& data, const XmlElement& piece, const std::string& type,
                            RawGrid& grid) const {
        const std::string_view whole_text = data.attribute("WholeExtent").value_or(""),
                               text = piece.attribute("Extent").value_or("");
        const auto whole = parse_all<std::int64_t, 6>(whole_text), extent = parse_all<std::int64_t, 6>(text);
        if (!extent || whole != extent)
            return tree_.error(piece, "the extent of the piece", "that of the whole, six integers",
                               in_quotes(text) + " of " + in_quotes(whole_text));
        std::array<std::size_t, 3> counts{};
        std::uint64_t points = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t count = (*extent)[2 * axis + 1] - (*extent)[2 * axis] + 1;
            counts[axis] = count > 0 ? static_cast<std::size_t>(count) : 0;
            if (__builtin_mul_overflow(points, counts[axis], &points)) points = max_entities + 1;
            points = std::min(points, max_entities + 1);
        }
        if (points > max_entities)
            return tree_.error(piece, "the points of the grid", "at most " + std::to_string(max_entities),
                               "the extent " + in_quotes(text));
        if (points == 0) return Done{};
        if (type == "StructuredGrid") return read_points(piece, points, grid);
        // Few bytes describe any number of points: no more than memory holds.
        const std::uint64_t memory =
            static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
        if (points > memory / 2 / (3 * sizeof(double)))
            return tree_.error(piece, "the points of the grid", "as many as fit in half of the memory of this machine",
                               std::to_string(points), "use a smaller grid");
        std::array<std::vector<double>, 3> axes;
        if (Status s = type == "ImageData" ? image_axes(data, *extent, counts, axes)
                                           : rectilinear_axes(piece, counts, axes, grid.narrow_points);
            !s) {
            return s;
        }
        grid.points.resize(3 * points);
        in_parallel(counts[2], [&](std::size_t k) {
            double* to = grid.points.data() + 3 * k * counts[0] * counts[1];
            for (const double y : axes[1]) {
                for (const double x : axes[0]) {
                    for (const double own : {x, y, axes[2][k]}) *to++ = own;
                }
            }
        });
        return Done{};
    }

    /// origin + spacing * index, rounded twice, as VTK has them. Error: image data that are turned (a Direction).
    Status image_axes(const XmlElement& data, const std::array<std::int64_t, 6>& extent,
                      const std::array<std::size_t, 3>& counts, std::array<std::vector<double>, 3>& axes) const {
        const std::string_view origin_text = data.attribute("Origin").value_or("0 0 0"),
                               spacing_text = data.attribute("Spacing").value_or("1 1 1"), plain = "1 0 0 0 1 0 0 0 1",
                               direction = data.attribute("Direction").value_or(plain);
        const auto origin = parse_all<double, 3>(origin_text), spacing = parse_all<double, 3>(spacing_text);
        if (!origin || !spacing)
            return tree_.error(data, "the origin and spacing of the grid", "three finite numbers each",
                               in_quotes(origin_text) + " and " + in_quotes(spacing_text));
        if (parse_all<double, 9>(direction) != parse_all<double, 9>(plain))
            return tree_.error(data, "the direction of the grid", std::string(plain), in_quotes(direction),
                               "write its points as a structured or unstructured grid");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < counts[axis]; ++i) {
                const auto index = static_cast<double>(extent[2 * axis] + static_cast<std::int64_t>(i));
                axes[axis].push_back((*origin)[axis] + (*spacing)[axis] * index);
            }
        }
        return Done{};
    }

    Status rectilinear_axes(const XmlElement& piece, const std::array<std::size_t, 3>& counts,
                            std::array<std::vector<double>, 3>& axes, bool& narrow) const {
        std::size_t found = 0;
        if (const XmlElement* const coordinates = tree_.child(&piece, "Coordinates"); coordinates != nullptr) {
            for (const std::size_t i : coordinates->children) {
                const XmlElement& array = tree_.elements[i];
                if (array.name != "DataArray" || found == 3) continue;
                if (Status s = arrays_.read(array, "the coordinates along an axis", counts[found], axes[found]); !s)
                    return s;
                narrow = narrow || XmlArrays::type_of(array) == NumberType::float32;
                ++found;
            }
        }
        if (found == 3) return Done{};
        return tree_.error(piece, "the points of a piece", "three arrays in Coordinates", std::to_string(found));
    }

    /// Behind so many cells of other pieces.
    Status read_cells(const XmlElement& piece, std::size_t before, RawGrid& grid) const {
        Status read = Done{};
        if (is_polygons_) {
            read = read_polygons(piece, before, grid);
        } else {
            const Result<std::size_t> cells = count_of(piece, "NumberOfCells", before);
            read = cells ? read_section(piece, "Cells", *cells, grid) : cells.error();
        }
        if (!read) return read;
        grid.checked_nodes = true;
        const XmlElement* const data = tree_.child(&piece, "CellData");
        return data == nullptr ? Done{} : read_arrays(*data, grid.types.size(), grid.has_steps, grid.cell_arrays);
    }

    /// The arrays, or their names where they are not wanted.
    Status read_point_arrays(const XmlElement& piece, RawGrid& grid) const {
        const XmlElement* const data = tree_.child(&piece, "PointData");
        if (data == nullptr) return Done{};
        grid.global_ids = data->attribute("GlobalIds").value_or("");
        if (part_ != Part::points) return read_arrays(*data, grid.point_count(), grid.has_steps, grid.point_arrays);
        grid.unread_arrays = names_of(*data);
        return Done{};
    }

    std::vector<std::string> names_of(const XmlElement& data) const {
        std::vector<std::string> names;
        for (const std::size_t i : data.children) {
            const std::string_view name = tree_.elements[i].attribute("Name").value_or("");
            if (!name.empty()) names.emplace_back(name);
        }
        return names;
    }

    /// The cells of a section, behind those that there are. Types are read where the section has them.
    Status read_section(const XmlElement& piece, const char* section, std::size_t count, RawGrid& grid) const {
        if (count == 0) return Done{};
        const XmlElement* const cells = tree_.child(&piece, section);
        const XmlElement* const connectivity = tree_.child(cells, "connectivity", "Name");
        const XmlElement* const offsets = tree_.child(cells, "offsets", "Name");
        const XmlElement* const types = tree_.child(cells, "types", "Name");
        if (connectivity == nullptr || offsets == nullptr || (types == nullptr && !is_polygons_))
            return tree_.error(
                piece, "the cells of a piece",
                is_polygons_ ? "arrays connectivity and offsets" : "arrays connectivity, offsets and types",
                is_polygons_ ? "not both" : "not all three");
        if (!is_polygons_) {
            if (Status s = arrays_.read(*types, "the types of cells", count, grid.types); !s) return s;
        }
        const std::size_t cells_before = grid.ends.size(), nodes_before = grid.connectivity.size();
        if (Status s = arrays_.read(*offsets, "the offsets of cells", count, grid.ends); !s) return s;
        std::int64_t end = 0;
        for (std::size_t i = cells_before; i < grid.ends.size(); ++i) {
            if (grid.ends[i] < end)
                return tree_.error(*offsets, "the offsets of cells", "none below the one before it",
                                   std::to_string(grid.ends[i]) + " after " + std::to_string(end));
            end = grid.ends[i];
            grid.ends[i] += static_cast<std::int64_t>(nodes_before);
        }
        const auto nodes = static_cast<std::uint64_t>(end);
        if (Status s = arrays_.read(*connectivity, "the connectivity", nodes, grid.connectivity); !s) return s;
        const std::size_t wrong = first_wrong_node(grid.connectivity, nodes_before, grid.point_count());
        if (wrong == grid.connectivity.size()) return Done{};
        return tree_.error(*connectivity, "a node of a cell", "a point below " + std::to_string(grid.point_count()),
                           std::to_string(grid.connectivity[wrong]));
    }

    Status read_polygons(const XmlElement& piece, std::size_t before, RawGrid& grid) const {
        constexpr std::array<const char*, section_count> sections{"Verts", "Lines", "Polys", "Strips"};
        for (std::size_t i = 0; i < section_count; ++i) {
            const std::string key = std::string("NumberOf") + sections[i];
            if (!piece.attribute(key).has_value()) continue;
            const Result<std::size_t> count = count_of(piece, key, before + grid.types.size());
            if (!count) return count.error();
            std::size_t cell = grid.ends.size();
            auto end = static_cast<std::int64_t>(grid.connectivity.size());
            if (Status s = read_section(piece, sections[i], *count, grid); !s) return s;
            for (; cell < grid.ends.size(); ++cell) {
                grid.types.push_back(type_in(static_cast<Section>(i), grid.ends[cell] - end));
                end = grid.ends[cell];
            }
        }
        return Done{};
    }

    /// Those of PointData or CellData.
    Status read_arrays(const XmlElement& data, std::size_t count, bool& has_steps,
                       std::vector<RawArray>& arrays) const {
        if (count == 0) return Done{};
        std::set<std::string> seen;
        for (const std::size_t i : data.children) {
            const XmlElement& array = tree_.elements[i];
            if (array.name != "DataArray" && array.name != "Array") continue;
            // Arrays of several time steps stand side by side; the first step is read.
            if (!has_word(array.attribute("TimeStep").value_or("0"), "0")) {
                has_steps = true;
                continue;
            }
            RawArray read;
            read.name = array.attribute("Name").value_or("");
            if (!seen.insert(read.name).second)
                return tree_.error(array, "two arrays in one " + data.name, "different names",
                                   in_quotes(read.name) + " twice", "give them different names");
            if (Status s = read_array(array, data.name == "PointData", count, read); !s) return s;
            arrays.push_back(std::move(read));
        }
        return Done{};
    }

    Status read_array(const XmlElement& array, bool of_points, std::size_t count, RawArray& to) const {
        const std::string what = "array " + in_quotes(to.name);
        const std::string_view text = array.attribute("NumberOfComponents").value_or("1");
        const std::uint64_t components = parse_count(text).value_or(0);
        if (components == 0 || components > max_entities)
            return tree_.error(array, "the components of " + what, "a count of 1 or more", in_quotes(text));
        to.components = static_cast<int>(components);
        const std::optional<NumberType> type = XmlArrays::type_of(array);
        const bool may_label = !of_points || part_ == Part::point_arrays;
        if (to.name.empty()) {
            to.fault = "it has no name";
        } else if (type) {
            to.type = *type;
            return read_numbers(to, of_points, may_label, [&](NumbersTo values, NumberFault& inexact) {
                return arrays_.read(array, what, components * count, values, &inexact);
            });
        } else if (array.attribute("type") != "String") {
            to.fault = "it holds no numbers";
        } else if (takes_texts(to, may_label)) {
            return arrays_.read_texts(array, what, count, to.values.emplace<std::vector<std::string>>());
        }
        return Done{};
    }

    const XmlTree& tree_;
    const XmlArrays& arrays_;
    Part part_;
    bool is_polygons_ = false;
};

}  // namespace

Result<RawGrid> read_xml(const XmlTree& tree, Part part) {
    const Result<XmlArrays> arrays = XmlArrays::of(tree);
    if (!arrays) return arrays.error();
    return XmlReader(*arrays, part).read();
}

}  // namespace barycert::io
