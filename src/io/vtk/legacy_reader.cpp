// VTK's legacy files: sections made of their words and numbers.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/vtk_cell.hpp"
#include "io/errors.hpp"
#include "io/number_word.hpp"
#include "io/parallel.hpp"
#include "io/vtk/legacy_text.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

class LegacyReader : LegacyText {
public:
    LegacyReader(std::string_view bytes, const std::string& path, Wanted part) : LegacyText(bytes, path), part_(part) {}

    RawGrid read() {
        read_head();
        read_data_set();
        for (std::string keyword = take_keyword(); !keyword.empty(); keyword = take_keyword()) read_section(keyword);
        if (!structured_ && !has_points_ && (part_ != Wanted::all || cell_count() != 0))
            fail("mesh.empty", "the file has no points", "POINTS", "none");
        if (structured_) make_structured();
        if (part_ == Wanted::all && !structured_) gather_cells();
        return std::move(grid_);
    }

private:
    void read_data_set() {
        take("DATASET");
        const std::string keyword = take_keyword();
        polydata_ = keyword == "POLYDATA";
        structured_ = keyword.starts_with("STRUCTURED_") || keyword == "RECTILINEAR_GRID";
        if (!polydata_ && !structured_ && keyword != "UNSTRUCTURED_GRID")
            fail("file.unsupported", "the kind of the data set",
                 "UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_POINTS, RECTILINEAR_GRID or STRUCTURED_GRID",
                 in_quotes(keyword));
        rectilinear_ = keyword == "RECTILINEAR_GRID";
        along_axes_ = rectilinear_ || keyword == "STRUCTURED_POINTS";
        has_points_ = along_axes_;
    }

    /// Reads a line that places the points of a structured grid; false if the keyword is none of those.
    bool read_structure(const std::string& keyword) {
        StructuredGrid& grid = grid_of_axes_;
        if (keyword == "DIMENSIONS") {
            if (has_dimensions_) fail("file.duplicate", "a second line DIMENSIONS", "one", "two");
            has_dimensions_ = true;
            for (std::size_t& count : grid.counts) count = take_count("the points along an axis");
            if (const std::string fault = grid.fault(part_, along_axes_); !fault.empty())
                fail("mesh.too-large", "the points of the grid", fault, "more");
            point_count_ = grid.point_count();
            return true;
        }
        if (keyword == "ORIGIN" || keyword == "SPACING" || keyword == "ASPECT_RATIO") {
            for (double& x : keyword == "ORIGIN" ? origin_ : spacing_) {
                const std::string word = take_word();
                x = real_of_word(word, true).value_or(HUGE_VAL);
                if (!std::isfinite(x))
                    fail("mesh.coordinate", "the origin or spacing of the grid", "a finite number", shown(word));
            }
            return true;
        }
        const std::size_t axis = std::string_view("XYZ").find(keyword[0]);
        if (!rectilinear_ || axis == std::string_view::npos || keyword.substr(1) != "_COORDINATES") return false;
        if (!grid.axes[axis].empty()) fail("file.duplicate", "a second section " + keyword, "one", "two");
        const std::size_t count = take_count("the points along an axis");
        if (count != grid.counts[axis])
            fail("file.count", "the points along an axis", std::to_string(grid.counts[axis]) + ", as DIMENSIONS says",
                 std::to_string(count));
        const NumberType type = take_type("the coordinates along an axis");
        grid_.narrow_points = grid_.narrow_points || type == NumberType::float32;
        take_numbers("the coordinates along an axis", type, count, grid.axes[axis]);
        return true;
    }

    /// Points and cells, as soon as they are known.
    void make_structured() {
        if (is_made_) return;
        is_made_ = true;
        StructuredGrid& grid = grid_of_axes_;
        if (!has_dimensions_) fail("file.syntax", "the points of the grid", "DIMENSIONS before data", "none");
        if (!has_points_ || (!along_axes_ && grid_.points.size() != 3 * point_count_))
            fail("file.syntax", "the points of the grid", "POINTS before data", "none");
        for (std::size_t axis = 0; along_axes_ && axis < 3; ++axis) {
            std::vector<double>& own = grid.axes[axis];
            if (rectilinear_ && own.size() != grid.counts[axis])
                fail("file.syntax", "the points of the grid", std::string(1, "XYZ"[axis]) + "_COORDINATES before data",
                     "none");
            // Rounded twice, as VTK has them.
            for (std::size_t i = 0; !rectilinear_ && point_count_ != 0 && i < grid.counts[axis]; ++i)
                own.push_back(origin_[axis] + spacing_[axis] * static_cast<double>(i));
        }
        grid.append_to(grid_, part_);
    }

    void read_section(const std::string& keyword) {
        if (keyword == "POINTS") return read_points();
        const bool has_cells = !polydata_ && !structured_;
        if (keyword == "CELLS" && has_cells) return read_cells(sections_[polygons]);
        if (keyword == "CELL_TYPES" && has_cells) return read_types();
        if (structured_ && read_structure(keyword)) return;
        if (keyword == "METADATA") return skip_metadata();
        if (keyword == "FIELD") return read_field_arrays(nullptr, 0);
        constexpr std::array<std::string_view, section_count> names{"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};
        const auto section = static_cast<std::size_t>(std::ranges::find(names, keyword) - names.begin());
        if (polydata_ && section != section_count) return read_cells(sections_[section]);
        if (structured_ && (keyword == "POINT_DATA" || keyword == "CELL_DATA")) make_structured();
        if (keyword == "POINT_DATA") return read_attributes(keyword, point_count_, ", one a point", grid_.point_arrays);
        if (keyword == "CELL_DATA") return read_attributes(keyword, cell_count(), ", one a cell", grid_.cell_arrays);
        fail("file.syntax", "a keyword of the format", "POINTS, CELLS, POINT_DATA and the like", in_quotes(keyword),
             too_many);
    }

    void read_points() {
        if (along_axes_)
            fail("file.syntax", "the points of the grid", "DIMENSIONS and what lies along the axes", "POINTS");
        if (structured_ && !has_dimensions_)
            fail("file.syntax", "the points of the grid", "DIMENSIONS before POINTS", "none");
        const std::size_t count = take_count("the number of points");
        if (structured_ && count != point_count_)
            fail("file.count", "the number of points", std::to_string(point_count_) + ", as DIMENSIONS says",
                 std::to_string(count));
        point_count_ = count;
        const NumberType type = take_type("the points");
        if (has_points_) fail("file.duplicate", "a second section POINTS", "one", "two");
        has_points_ = true;
        grid_.narrow_points = type == NumberType::float32;
        take_numbers("the coordinates", type, std::uint64_t{3} * point_count_, grid_.points);
        if (part_ == Wanted::points) rest_.remove_prefix(rest_.size());  // nothing else is wanted
    }

    void read_cells(RawCells& cells) {
        if (!cells.ends.empty()) fail("file.duplicate", "a second section of the same cells", "one", "two");
        const std::size_t count = take_count("the number of cells"), size = take_count("the size of the cells");
        major_version_ >= 5 ? read_offsets(cells, count, size) : read_rows(cells, count, size);
    }

    /// Since version 5: where each cell begins and the last one ends, then the nodes.
    void read_offsets(RawCells& cells, std::size_t offsets, std::size_t nodes) {
        if (offsets == 0 && nodes == 0) return;
        expect("OFFSETS");
        take_numbers("the offsets of cells", take_type("the offsets of cells"), offsets, cells.ends);
        expect("CONNECTIVITY");
        take_numbers("the connectivity", take_type("the connectivity"), nodes, cells.connectivity);
        const bool grows = std::is_sorted(cells.ends.begin(), cells.ends.end());
        if (!grows || cells.ends.empty() || cells.ends.front() != 0 ||
            cells.ends.back() != static_cast<std::int64_t>(nodes))
            fail("file.count", "the offsets of cells",
                 "0 first, none below the one before it, " + std::to_string(nodes) + " last", "others");
        cells.ends.erase(cells.ends.begin());
    }

    /// Before version 5: the number of its nodes, then the nodes, cell after cell.
    void read_rows(RawCells& cells, std::size_t count, std::size_t size) {
        std::vector<std::int32_t> rows;
        take_numbers("the cells", NumberType::int32, size, rows);
        // No more cells than numbers, or it ends with an error.
        base::resize_large(cells.ends, std::min(count, rows.size()));
        std::size_t at = 0;
        for (std::size_t cell = 0; cell < count; ++cell) {
            const std::int32_t nodes = at < rows.size() ? rows[at] : -1;
            if (nodes < 0 || static_cast<std::size_t>(nodes) > rows.size() - at - 1)
                fail("mesh.node-count", "the nodes of cell " + std::to_string(cell) + " (from 0)",
                     "as many as fit in the " + std::to_string(size) + " numbers of the section",
                     at < rows.size() ? std::to_string(nodes) : "none");
            at += 1 + static_cast<std::size_t>(nodes);
            cells.ends[cell] = static_cast<std::int64_t>(at - cell - 1);
        }
        if (at != rows.size())
            fail("file.count", "the size of the cells", std::to_string(at) + " numbers, as the cells have",
                 std::to_string(rows.size()));
        base::resize_large(cells.connectivity, rows.size() - count);
        in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
            for (std::size_t cell = first; cell < last; ++cell) {
                const std::int64_t begin = cell == 0 ? 0 : cells.ends[cell - 1];
                const std::int32_t* const row = rows.data() + cell + 1;
                std::copy(row + begin, row + cells.ends[cell], cells.connectivity.data() + begin);
            }
        });
    }

    void read_types() {
        if (!grid_.types.empty()) fail("file.duplicate", "a second section CELL_TYPES", "one", "two");
        const std::size_t count = take_count("the number of cell types");
        take_numbers("the cell types", NumberType::int32, count, grid_.types);
    }

    std::size_t cell_count() const {
        std::size_t count = structured_ ? grid_of_axes_.cell_count() : 0;
        for (const RawCells& cells : sections_) count += cells.ends.size();
        return count;
    }

    void gather_cells() {
        if (!polydata_ && grid_.types.size() != cell_count())
            fail("file.count", "the cell types", std::to_string(cell_count()) + ", one a cell",
                 std::to_string(grid_.types.size()));
        for (std::size_t i = 0; i < section_count; ++i)
            grid_.append(std::move(sections_[i]), polydata_ ? std::optional(static_cast<Section>(i)) : std::nullopt);
        RawCells& cells = grid_.cells;
        if (std::ranges::count(grid_.types, vtk_polyhedron) != 0) take_faces(cells);
        const std::size_t wrong = first_wrong_node(cells.connectivity, grid_.point_count());
        if (wrong == cells.connectivity.size()) return;
        const auto cell = std::ranges::upper_bound(cells.ends, static_cast<std::int64_t>(wrong)) - cells.ends.begin();
        refuse_file("mesh.node-index", file_.path, "a node of cell " + std::to_string(cell) + " (from 0)",
                    "a point below " + std::to_string(grid_.point_count()), std::to_string(cells.connectivity[wrong]));
    }

    /// Polyhedra have a stream of faces (see RawFaces) in place of nodes.
    void take_faces(RawCells& cells) {
        RawCells plain;
        for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
            const std::span own = cells.nodes(cell);
            const std::size_t before = grid_.faces.rings.size();
            if (grid_.types[cell] != vtk_polyhedron) {
                plain.connectivity.insert(plain.connectivity.end(), own.begin(), own.end());
                grid_.faces.face_ends.push_back(static_cast<std::int64_t>(grid_.faces.ring_ends.size()));
            } else if (grid_.faces.append(std::vector<std::int64_t>(own.begin(), own.end()), grid_.point_count())) {
                std::vector<std::int32_t> nodes(grid_.faces.rings.begin() + static_cast<std::ptrdiff_t>(before),
                                                grid_.faces.rings.end());
                std::ranges::sort(nodes);
                plain.connectivity.insert(plain.connectivity.end(), nodes.begin(),
                                          std::unique(nodes.begin(), nodes.end()));
            } else {
                refuse_file("mesh.faces", file_.path, "the faces of cell " + std::to_string(cell) + " (from 0)",
                            "nodes of faces below " + std::to_string(grid_.point_count()), "others");
            }
            plain.ends.push_back(static_cast<std::int64_t>(plain.connectivity.size()));
        }
        cells = std::move(plain);
    }

    /// All arrays behind POINT_DATA or CELL_DATA, up to the next of the two. `expected`: so many points or cells.
    void read_attributes(const std::string& keyword, std::size_t expected, const char* each,
                         std::vector<RawArray>& arrays) {
        const std::size_t rows = take_count("the rows of " + keyword);
        if (rows != expected)
            fail("file.count", "the rows of " + keyword, std::to_string(expected) + each, std::to_string(rows));
        while (true) {
            const std::string_view before = rest_;
            const std::string kind = take_keyword();
            if (kind.empty() || kind == "POINT_DATA" || kind == "CELL_DATA") return static_cast<void>(rest_ = before);
            read_attribute(kind, rows, arrays);
        }
    }

    void read_attribute(const std::string& kind, std::size_t rows, std::vector<RawArray>& arrays) {
        if (kind == "METADATA") return skip_metadata();
        if (kind == "FIELD") return read_field_arrays(&arrays, rows);
        const std::string name = take_name();
        if (kind == "LOOKUP_TABLE") {
            const std::size_t size = take_count("the size of a lookup table");
            std::vector<double> unused;
            return take_colors("a lookup table", std::uint64_t{4} * size, unused);
        }
        /// By their components, 0 where the file tells how many they are.
        constexpr std::array<std::pair<const char*, std::size_t>, 5> kinds{
            {{"SCALARS GLOBAL_IDS PEDIGREE_IDS EDGE_FLAGS", 1},
             {"VECTORS NORMALS", 3},
             {"TENSORS6", 6},
             {"TENSORS", 9},
             {"TEXTURE_COORDINATES COLOR_SCALARS", 0}}};
        const auto* const known = std::ranges::find_if(kinds, [&](auto& one) { return has_word(one.first, kind); });
        if (known == kinds.end())
            fail("file.syntax", "a kind of array", "SCALARS, VECTORS, FIELD and the like", in_quotes(kind), too_many);
        std::size_t components = known->second;
        if (components == 0) components = take_count("the components of array " + in_quotes(name));
        if (kind == "COLOR_SCALARS") return read_array(name, std::nullopt, components, rows, arrays);
        const std::string type = take_word();
        if (kind == "SCALARS") {
            // The number of components may be left out; the line of the lookup table may be, too.
            const std::string_view more = rest_of_line();
            const std::optional<std::uint64_t> count = parse_count(more);
            if (!count && more.find_first_not_of(" \t") != std::string_view::npos)
                fail("file.syntax", "the components of array " + in_quotes(name), "a count, or the end of the line",
                     shown(more));
            if (count) components = static_cast<std::size_t>(std::min(*count, max_entities + 1));
            if (take("LOOKUP_TABLE")) take_name();
        }
        read_array(name, type, components, rows, arrays);
    }

    /// `arrays` of nullptr: field data, which belong to neither points nor cells.
    void read_field_arrays(std::vector<RawArray>* arrays, std::size_t rows) {
        take_name();
        const std::size_t count = take_count("the number of arrays");
        for (std::size_t i = 0; i < count; ++i) {
            std::string name = take_name();
            for (; name == "METADATA"; name = take_name()) skip_metadata();
            if (name == "NULL_ARRAY") continue;
            const std::size_t components = take_count("the components of array " + in_quotes(name));
            const std::size_t tuples = take_count("the rows of array " + in_quotes(name));
            if (arrays != nullptr && tuples != rows)
                fail("file.count", "the rows of array " + in_quotes(name), std::to_string(rows),
                     std::to_string(tuples));
            const std::string type = take_word();
            std::vector<RawArray> loose;
            read_array(name, type, components, tuples, arrays != nullptr ? *arrays : loose);
            if (!loose.empty() && !is_time(name)) grid_.loose_arrays.push_back(name);
        }
    }

    /// `type`: none of colours.
    void read_array(const std::string& name, const std::optional<std::string>& type, std::size_t components,
                    std::size_t rows, std::vector<RawArray>& arrays) {
        const std::string what = "array " + in_quotes(name);
        const bool of_points = &arrays == &grid_.point_arrays, of_cells = &arrays == &grid_.cell_arrays;
        if (components == 0 && rows != 0 && !of_points && !of_cells) components = 1;
        if (components == 0 || components > max_entities)
            fail("file.count", "the components of " + what, "1 or more", std::to_string(components));
        if (std::ranges::count(arrays, name, &RawArray::name) != 0)
            fail("file.duplicate", "two arrays of one section", "different names", in_quotes(name) + " twice",
                 "give them different names");
        RawArray& array = arrays.emplace_back(RawArray{.name = name, .components = static_cast<int>(components)});
        const std::uint64_t numbers = static_cast<std::uint64_t>(components) * rows;
        const bool may_label = of_cells || (of_points && part_ == Wanted::point_arrays);
        if (!type) return take_colors(what, numbers, array.numbers());
        const std::optional<NumberType> known = type_of_name(capitals(*type));
        if (!known) fail("file.syntax", "the type of " + what, "double, float, int and the like", in_quotes(*type));
        if (known == NumberType::text) {
            std::vector<std::string> texts;
            const bool wanted = takes_texts(array, may_label);
            take_strings(what, capitals(*type) == "VARIANT", numbers, wanted ? &texts : nullptr);
            if (wanted) array.values = std::move(texts);
        } else if (known == NumberType::bit && components > 1 && binary()) {
            // VTK writes, and reads back, as many bits as there are rows.
            std::vector<double> part;
            array.fault = "VTK writes only the first bits of such an array";
            take_numbers(what, *known, rows, part);
        } else {
            array.type = *known;
            const std::string_view begin = rest_;
            read_numbers(array, of_points, may_label, [&](NumbersTo values, NumberFault& inexact) {
                rest_ = begin;
                take_numbers(what, *known, numbers, values, &inexact);
            });
        }
    }

    static constexpr const char* too_many = "the data before it may be cut off, or more than was announced";

    Wanted part_;
    RawGrid grid_;
    std::array<RawCells, section_count> sections_;
    std::size_t point_count_ = 0;
    bool polydata_ = false, structured_ = false, rectilinear_ = false, has_points_ = false;
    bool along_axes_ = false;  ///< structured points, or rectilinear
    bool has_dimensions_ = false, is_made_ = false;
    StructuredGrid grid_of_axes_;
    std::array<double, 3> origin_{}, spacing_{1, 1, 1};
};

}  // namespace

void check_legacy_head(std::string_view bytes, const std::string& path) {
    LegacyText(bytes, path).read_head();
}

RawGrid read_legacy(std::string_view bytes, const std::string& path, Wanted part) {
    return LegacyReader(bytes, path, part).read();
}

}  // namespace barycert::io
