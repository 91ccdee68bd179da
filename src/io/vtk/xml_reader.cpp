#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/vtk_cell.hpp"
#include "io/number_word.hpp"
#include "io/other_formats.hpp"
#include "io/paths.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"
#include "io/words.hpp"

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
            x = real_of_word(word, true).value_or(HUGE_VAL);
            good = good && std::isfinite(x);
        } else {
            x = whole_number<T>(word).value_or(most + 1);
            good = good && -most <= x && x <= most;
        }
    }
    if (!good || !next_word(text).empty()) return std::nullopt;
    return numbers;
}

class XmlReader : XmlTree {
public:
    XmlReader(XmlTree tree, Wanted part) : XmlTree(std::move(tree)), part_(part) { take_layout(); }

    RawGrid read() {
        const std::string type(root().attribute_or("type", ""));
        const XmlElement* const data = root().name == "VTKFile" ? child(&root(), type) : nullptr;
        is_polygons_ = type == "PolyData";
        const bool structured = has_word("ImageData RectilinearGrid StructuredGrid", type);
        if (data == nullptr || !(is_polygons_ || structured || type == "UnstructuredGrid")) refuse_kind(data, type);
        RawGrid grid;
        std::size_t pieces = 0;
        for (const std::size_t i : data->children) {
            const XmlElement& element = elements[i];
            if (element.name == "FieldData")
                std::ranges::copy_if(names_of(element), std::back_inserter(grid.loose_arrays), std::not_fn(is_time));
            if (element.name != "Piece") continue;
            // Grids have one piece, or the points on the borders of pieces would be there twice.
            if (structured && ++pieces > 1)
                refuse_at("file.unsupported", element, "a grid in several pieces", "one piece", "more",
                          "write it again in one piece, as ParaView's Merge Blocks or VTK's writer do");
            RawGrid piece;
            structured ? read_structured(*data, element, type, piece)
                       : read_points(element, count_of(element, "NumberOfPoints", grid.point_count()), piece);
            if (const XmlElement* const of_points = child(&element, "PointData"); of_points != nullptr) {
                piece.global_ids = of_points->attribute_or("GlobalIds", "");
                if (part_ == Wanted::points) {
                    piece.unread_arrays = names_of(*of_points);
                } else {
                    read_arrays(*of_points, piece.point_count(), piece.has_steps, piece.point_arrays);
                }
            }
            if (part_ == Wanted::all && !structured) read_cells(element, grid.types.size(), piece);
            const XmlElement* const of_cells = child(&element, "CellData");
            if (part_ == Wanted::all && of_cells != nullptr)
                read_arrays(*of_cells, piece.cell_count(), piece.has_steps, piece.cell_arrays);
            append_piece(grid, std::move(piece), path);
        }
        return grid;
    }

private:
    [[noreturn]] void refuse_kind(const XmlElement* data, const std::string& type) const {
        const std::string found = root().name != "VTKFile" ? "an element " + in_quotes(root().name)
                                  : data == nullptr        ? "no element of its type " + in_quotes(type)
                                                           : "type " + in_quotes(type);
        refuse_at("file.unsupported", root(), "the kind of the file",
                  "a VTKFile of type UnstructuredGrid, PolyData, ImageData, RectilinearGrid or StructuredGrid", found,
                  has_word("PImageData PRectilinearGrid PStructuredGrid", type)
                      ? "the grid is in pieces: make one of them with " + one_grid_command(path)
                      : "");
    }

    std::size_t count_of(const XmlElement& piece, std::string_view key, std::size_t before) const {
        const std::optional<std::string_view> text = piece.attribute(key);
        const std::optional<std::uint64_t> count = parse_count(text.value_or(""));
        if (!count || *count > max_entities - before)
            refuse_at("file.count", piece, "the attribute " + std::string(key),
                      "a count, at most " + std::to_string(max_entities) + " in all pieces",
                      text ? in_quotes(*text) : "none");
        return static_cast<std::size_t>(*count);
    }

    void read_points(const XmlElement& piece, std::size_t count, RawGrid& grid) const {
        if (count == 0) return;
        const XmlElement* const array = child(child(&piece, "Points"), "DataArray");
        if (array == nullptr) refuse_at("mesh.empty", piece, "the points of a piece", "an array in Points", "none");
        const std::string_view components = array->attribute_or("NumberOfComponents", "1");
        if (parse_count(components) != 3)
            refuse_at("file.count", *array, "the components of the points", "3", in_quotes(components));
        grid.narrow_points = array->number_type() == NumberType::float32;
        take_numbers(*array, "the coordinates", std::uint64_t{3} * count, grid.points);
    }

    /// The only piece of a structured grid. Error: an extent that is none, or not that of the whole; too many points.
    void read_structured(const XmlElement& data, const XmlElement& piece, const std::string& type,
                         RawGrid& grid) const {
        const std::string_view whole_text = data.attribute_or("WholeExtent", ""),
                               text = piece.attribute_or("Extent", "");
        const auto whole = parse_all<std::int64_t, 6>(whole_text), extent = parse_all<std::int64_t, 6>(text);
        if (!extent || whole != extent)
            refuse_at("file.count", piece, "the extent of the piece", "that of the whole, six integers",
                      in_quotes(text) + " of " + in_quotes(whole_text));
        StructuredGrid structured;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t count = (*extent)[2 * axis + 1] - (*extent)[2 * axis] + 1;
            structured.counts[axis] = count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        if (const std::string fault = structured.fault(part_, type != "StructuredGrid"); !fault.empty())
            refuse_at("file.count", piece, "the points of the grid", fault, "the extent " + in_quotes(text));
        if (type == "StructuredGrid") {
            read_points(piece, structured.point_count(), grid);
        } else if (structured.point_count() != 0) {
            structured.axes = type == "ImageData" ? image_axes(data, *extent)
                                                  : rectilinear_axes(piece, structured.counts, grid.narrow_points);
        }
        structured.append_to(grid, part_);
    }

    using Axes = std::array<std::vector<double>, 3>;

    /// origin + spacing * index, rounded twice, as VTK has them. Error: image data that are turned (a Direction).
    Axes image_axes(const XmlElement& data, const std::array<std::int64_t, 6>& extent) const {
        constexpr std::string_view plain = "1 0 0 0 1 0 0 0 1";
        const std::string_view origin_text = data.attribute_or("Origin", "0 0 0"),
                               spacing_text = data.attribute_or("Spacing", "1 1 1"),
                               direction = data.attribute_or("Direction", plain);
        const auto origin = parse_all<double, 3>(origin_text), spacing = parse_all<double, 3>(spacing_text);
        if (!origin || !spacing)
            refuse_at("mesh.coordinate", data, "the origin and spacing of the grid", "three finite numbers each",
                      in_quotes(origin_text) + " and " + in_quotes(spacing_text));
        if (parse_all<double, 9>(direction) != parse_all<double, 9>(plain))
            refuse_at("file.unsupported", data, "the direction of the grid", std::string(plain), in_quotes(direction),
                      "write its points as a structured or unstructured grid");
        Axes axes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::int64_t i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
                axes[axis].push_back((*origin)[axis] + (*spacing)[axis] * static_cast<double>(i));
        }
        return axes;
    }

    Axes rectilinear_axes(const XmlElement& piece, const std::array<std::size_t, 3>& counts, bool& narrow) const {
        Axes axes;
        std::size_t found = 0;
        const XmlElement* const coordinates = child(&piece, "Coordinates");
        for (const std::size_t i : coordinates != nullptr ? coordinates->children : std::vector<std::size_t>()) {
            const XmlElement& array = elements[i];
            if (array.name != "DataArray" || found == 3) continue;
            take_numbers(array, "the coordinates along an axis", counts[found], axes[found]);
            narrow = narrow || array.number_type() == NumberType::float32;
            ++found;
        }
        if (found != 3)
            refuse_at("file.count", piece, "the points of a piece", "three arrays in Coordinates",
                      std::to_string(found));
        return axes;
    }

    std::vector<std::string> names_of(const XmlElement& data) const {
        std::vector<std::string> names;
        for (const std::size_t i : data.children) {
            const std::string_view name = elements[i].attribute_or("Name", "");
            if (!name.empty()) names.emplace_back(name);
        }
        return names;
    }

    /// Behind so many cells of other pieces.
    void read_cells(const XmlElement& piece, std::size_t before, RawGrid& grid) const {
        if (is_polygons_) {
            constexpr std::array<const char*, section_count> sections{"Verts", "Lines", "Polys", "Strips"};
            for (std::size_t i = 0; i < section_count; ++i) {
                const std::string key = std::string("NumberOf") + sections[i];
                if (!piece.attribute(key)) continue;
                const std::size_t count = count_of(piece, key, before + grid.types.size());
                read_section(piece, sections[i], count, static_cast<Section>(i), grid);
            }
        } else {
            read_section(piece, "Cells", count_of(piece, "NumberOfCells", before), std::nullopt, grid);
        }
    }

    /// Reads the cells of an element, behind those that there are. Cells have types unless they are in a section of
    /// polygon data.
    void read_section(const XmlElement& piece, const char* name, std::size_t count, std::optional<Section> section,
                      RawGrid& grid) const {
        if (count == 0) return;
        const XmlElement* const element = child(&piece, name);
        const XmlElement* const connectivity = child(element, "connectivity", "Name");
        const XmlElement* const offsets = child(element, "offsets", "Name");
        const XmlElement* const types = child(element, "types", "Name");
        if (connectivity == nullptr || offsets == nullptr || (types == nullptr && !section))
            refuse_at("file.syntax", piece, "the cells of a piece",
                      section ? "arrays connectivity and offsets" : "arrays connectivity, offsets and types",
                      section ? "not both" : "not all three");
        if (!section) take_numbers(*types, "the types of cells", count, grid.types);
        RawCells cells;
        take_numbers(*offsets, "the offsets of cells", count, cells.ends);
        std::int64_t end = 0;
        for (const std::int64_t own : cells.ends) {
            if (own < end)
                refuse_at("file.count", *offsets, "the offsets of cells", "none below the one before it",
                          std::to_string(own) + " after " + std::to_string(end));
            end = own;
        }
        take_numbers(*connectivity, "the connectivity", static_cast<std::uint64_t>(end), cells.connectivity);
        const std::size_t wrong = first_wrong_node(cells.connectivity, grid.point_count());
        if (wrong != cells.connectivity.size())
            refuse_at("mesh.node-index", *connectivity, "a node of a cell",
                      "a point below " + std::to_string(grid.point_count()), std::to_string(cells.connectivity[wrong]));
        if (!section && std::ranges::count(grid.types, vtk_polyhedron) != 0) read_faces(piece, *element, grid);
        grid.append(std::move(cells), section);
    }

    [[noreturn]] void refuse_faces(const XmlElement& element, std::size_t cell, std::size_t points) const {
        refuse_at("mesh.faces", element, "the faces of cell " + std::to_string(cell) + " (from 0) of the piece",
                  "nodes of faces below " + std::to_string(points), "others");
    }

    /// Up to version 2.2 of the format each polyhedron has a stream of faces (see RawFaces).
    void read_faces(const XmlElement& piece, const XmlElement& element, RawGrid& grid) const {
        if (child(&element, "polyhedron_to_faces", "Name") != nullptr) return read_numbered_faces(piece, element, grid);
        const std::vector<std::int64_t> ends = take_integers(piece, element, "faceoffsets", grid.types.size());
        const std::int64_t size = std::max(std::int64_t{0}, *std::ranges::max_element(ends));
        const std::vector<std::int64_t> stream = take_integers(piece, element, "faces", static_cast<std::size_t>(size));
        std::int64_t begin = 0;
        for (std::size_t cell = 0; cell < ends.size(); ++cell) {
            if (grid.types[cell] != vtk_polyhedron) {
                grid.faces.face_ends.push_back(static_cast<std::int64_t>(grid.faces.ring_ends.size()));
                continue;
            }
            if (ends[cell] < begin ||
                !grid.faces.append({stream.data() + begin, stream.data() + ends[cell]}, grid.point_count()))
                refuse_faces(element, cell, grid.point_count());
            begin = ends[cell];
        }
    }

    std::vector<std::int64_t> take_integers(const XmlElement& piece, const XmlElement& element, const char* name,
                                            std::size_t count) const {
        std::vector<std::int64_t> numbers;
        const XmlElement* const array = child(&element, name, "Name");
        if (array == nullptr)
            refuse_at("mesh.faces", piece, "the faces of polyhedra", std::string("an array ") + name, "none");
        take_numbers(*array, name, count, numbers);
        return numbers;
    }

    /// Since then faces are numbered, and the two cells at a face name it.
    void read_numbered_faces(const XmlElement& piece, const XmlElement& element, RawGrid& grid) const {
        const auto refuse = [&](const char* expected) {
            refuse_at("mesh.faces", element, "the faces of polyhedra", expected, "others");
        };
        const auto size_of = [&](const std::vector<std::int64_t>& ends) {
            if (!std::ranges::is_sorted(ends) || (!ends.empty() && ends.front() < 0))
                refuse("offsets that are not negative, none below the one before it");
            return static_cast<std::size_t>(ends.empty() ? 0 : ends.back());
        };
        const std::size_t points = grid.point_count(), cells = grid.types.size();
        const std::vector<std::int64_t> cell_ends = take_integers(piece, element, "polyhedron_offsets", cells);
        const std::vector<std::int64_t> of_cells =
            take_integers(piece, element, "polyhedron_to_faces", size_of(cell_ends));
        std::int64_t faces = 0;
        for (const std::int64_t face : of_cells) {
            if (face < 0 || face >= static_cast<std::int64_t>(max_entities)) refuse("numbers of faces");
            faces = std::max(faces, face + 1);
        }
        const std::vector<std::int64_t> face_ends =
            take_integers(piece, element, "face_offsets", static_cast<std::size_t>(faces));
        const std::vector<std::int64_t> nodes = take_integers(piece, element, "face_connectivity", size_of(face_ends));
        // Else few numbers could make many.
        std::vector<std::uint8_t> cells_at(face_ends.size(), 0);
        std::size_t next = 0;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            for (; next < static_cast<std::size_t>(cell_ends[cell]); ++next) {
                const auto face = static_cast<std::size_t>(of_cells[next]);
                if (grid.types[cell] != vtk_polyhedron || ++cells_at[face] > 2) refuse("each of two polyhedra at most");
                for (auto i = face == 0 ? 0 : face_ends[face - 1]; i < face_ends[face]; ++i) {
                    const std::int64_t node = nodes[static_cast<std::size_t>(i)];
                    if (node < 0 || static_cast<std::size_t>(node) >= points) refuse_faces(element, cell, points);
                    grid.faces.rings.push_back(static_cast<std::int32_t>(node));
                }
                grid.faces.ring_ends.push_back(static_cast<std::int64_t>(grid.faces.rings.size()));
            }
            grid.faces.face_ends.push_back(static_cast<std::int64_t>(grid.faces.ring_ends.size()));
        }
    }

    void read_arrays(const XmlElement& data, std::size_t count, bool& has_steps, std::vector<RawArray>& arrays) const {
        if (count == 0) return;
        std::set<std::string> seen;
        for (const std::size_t i : data.children) {
            const XmlElement& array = elements[i];
            if (array.name != "DataArray" && array.name != "Array") continue;
            // Arrays of several time steps stand side by side; the first step is read.
            if (!has_word(array.attribute_or("TimeStep", "0"), "0")) {
                has_steps = true;
                continue;
            }
            RawArray& to = arrays.emplace_back();
            to.name = array.attribute_or("Name", "");
            if (!seen.insert(to.name).second)
                refuse_at("file.duplicate", array, "two arrays in one " + data.name, "different names",
                          in_quotes(to.name) + " twice", "give them different names");
            read_array(array, data.name == "PointData", count, to);
        }
    }

    void read_array(const XmlElement& array, bool of_points, std::size_t count, RawArray& to) const {
        const std::string what = "array " + in_quotes(to.name);
        const std::string_view text = array.attribute_or("NumberOfComponents", "1");
        const std::uint64_t components = parse_count(text).value_or(0);
        if (components == 0 || components > max_entities)
            refuse_at("file.count", array, "the components of " + what, "a count of 1 or more", in_quotes(text));
        to.components = static_cast<int>(components);
        const std::optional<NumberType> type = array.number_type();
        const bool may_label = !of_points || part_ == Wanted::point_arrays;
        if (to.name.empty()) {
            to.fault = "it has no name";
        } else if (type) {
            to.type = *type;
            read_numbers(to, of_points, may_label, [&](NumbersTo values, NumberFault& inexact) {
                take_numbers(array, what, components * count, values, &inexact);
            });
        } else if (array.attribute("type") == "String") {
            if (takes_texts(to, may_label)) to.values = take_texts(array, what, count);
        } else if (array.name == "DataArray") {
            refuse_at("file.unsupported", array, "the attribute type of " + what,
                      "Int8 to UInt64, Float32, Float64, Bit or String", in_quotes(array.attribute_or("type", "")));
        } else {
            to.fault = "it holds no numbers";
        }
    }

    Wanted part_;
    bool is_polygons_ = false;
};

}  // namespace

RawGrid read_xml(XmlTree tree, Wanted part) {
    return XmlReader(std::move(tree), part).read();
}

}  // namespace barycert::io
