// VTK's legacy files.
#include <array>

#include "barycert/io/vtk/legacy_text.hpp"

namespace barycert::io {
namespace {

class LegacyReader {
public:
    LegacyReader(std::string_view bytes, const std::string& path, Part part) : text_(bytes, path), part_(part) {}

    RawGrid read() {
        text_.read_head();
        read_data_set();
        while (!done_) {
            const std::string keyword = text_.keyword();
            if (keyword.empty()) break;
            read_section(keyword);
        }
        if (!has_points_ && (part_ != Part::all || cell_count() != 0))
            text_.fail("the file has no points", "POINTS", "none");
        if (part_ == Part::all) gather_cells();
        return std::move(grid_);
    }

private:
    void read_data_set() {
        text_.take("DATASET");
        const std::string keyword = text_.keyword();
        polydata_ = keyword == "POLYDATA";
        if (polydata_ || keyword == "UNSTRUCTURED_GRID") return;
        if (part_ == Part::all)
            text_.fail("the kind of the data set", "UNSTRUCTURED_GRID or POLYDATA", in_quotes(keyword),
                       keyword == "FIELD" ? "" : to_simplices(text_.path()));
        if (keyword != "STRUCTURED_GRID")
            text_.fail("the kind of the data set", "UNSTRUCTURED_GRID, POLYDATA or STRUCTURED_GRID", in_quotes(keyword),
                       "save the points as .vti or .vtr, in ParaView");
    }

    void read_section(const std::string& keyword) {
        if (keyword == "POINTS") return read_points();
        if (keyword == "CELLS" && !polydata_) return read_cells(sections_[polygons]);
        if (keyword == "CELL_TYPES" && !polydata_) return read_types();
        if (keyword == "DIMENSIONS") return static_cast<void>(text_.rest_of_line());
        if (keyword == "METADATA") return text_.skip_metadata();
        if (keyword == "FIELD") return read_field_arrays(nullptr, 0);
        constexpr std::array<const char*, section_count> names{"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};
        for (std::size_t i = 0; i < section_count; ++i) {
            if (polydata_ && keyword == names[i]) return read_cells(sections_[i]);
        }
        if (keyword == "POINT_DATA") return read_attributes(keyword, point_count_, ", one a point", grid_.point_arrays);
        if (keyword == "CELL_DATA") return read_attributes(keyword, cell_count(), ", one a cell", grid_.cell_arrays);
        text_.fail("a keyword of the format", "POINTS, CELLS, POINT_DATA and the like", in_quotes(keyword), too_many);
    }

    void read_points() {
        point_count_ = text_.count("the number of points");
        const NumberType type = text_.number_type("the points");
        if (has_points_) text_.fail("a second section POINTS", "one", "two");
        has_points_ = true;
        grid_.narrow_points = type == NumberType::float32;
        done_ = part_ == Part::points;
        text_.numbers("the coordinates", type, std::uint64_t{3} * point_count_, grid_.points);
    }

    void read_cells(RawCells& cells) {
        if (!cells.ends.empty()) text_.fail("a second section of the same cells", "one", "two");
        const std::size_t count = text_.count("the number of cells"), size = text_.count("the size of the cells");
        text_.major_version() >= 5 ? read_offsets(cells, count, size) : read_rows(cells, count, size);
    }

    /// Since version 5: where each cell begins and the last one ends, then the nodes.
    void read_offsets(RawCells& cells, std::size_t offsets, std::size_t nodes) {
        if (offsets == 0 && nodes == 0) return;
        text_.expect("OFFSETS");
        text_.numbers("the offsets of cells", text_.number_type("the offsets of cells"), offsets, cells.ends);
        text_.expect("CONNECTIVITY");
        text_.numbers("the connectivity", text_.number_type("the connectivity"), nodes, cells.connectivity);
        const bool grows = std::is_sorted(cells.ends.begin(), cells.ends.end());
        if (!grows || cells.ends.empty() || cells.ends.front() != 0 ||
            cells.ends.back() != static_cast<std::int64_t>(nodes))
            text_.fail("the offsets of cells",
                       "0 first, none below the one before it, " + std::to_string(nodes) + " last", "others");
        cells.ends.erase(cells.ends.begin());
    }

    /// Before version 5: the number of its nodes, then the nodes, cell after cell.
    void read_rows(RawCells& cells, std::size_t count, std::size_t size) {
        std::vector<std::int32_t> rows;
        text_.numbers("the cells", NumberType::int32, size, rows);
        // No more cells than numbers, or it ends with an error.
        base::resize_large(cells.ends, std::min(count, rows.size()));
        std::size_t at = 0;
        for (std::size_t cell = 0; cell < count; ++cell) {
            const std::int32_t nodes = at < rows.size() ? rows[at] : -1;
            if (nodes < 0 || static_cast<std::size_t>(nodes) > rows.size() - at - 1)
                text_.fail("the nodes of cell " + std::to_string(cell) + " (from 0)",
                           "as many as fit in the " + std::to_string(size) + " numbers of the section",
                           at < rows.size() ? std::to_string(nodes) : "none");
            at += 1 + static_cast<std::size_t>(nodes);
            cells.ends[cell] = static_cast<std::int64_t>(at - cell - 1);
        }
        if (at != rows.size())
            text_.fail("the size of the cells", std::to_string(at) + " numbers, as the cells have",
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
        if (!grid_.types.empty()) text_.fail("a second section CELL_TYPES", "one", "two");
        const std::size_t count = text_.count("the number of cell types");
        text_.numbers("the cell types", NumberType::int32, count, grid_.types);
    }

    std::size_t cell_count() const {
        std::size_t count = 0;
        for (const RawCells& cells : sections_) count += cells.ends.size();
        return count;
    }

    void gather_cells() {
        if (!polydata_ && grid_.types.size() != cell_count())
            text_.fail("the cell types", std::to_string(cell_count()) + ", one a cell",
                       std::to_string(grid_.types.size()));
        for (std::size_t i = 0; i < section_count; ++i)
            grid_.append(std::move(sections_[i]), polydata_ ? std::optional(static_cast<Section>(i)) : std::nullopt);
        const RawCells& cells = grid_.cells;
        const std::size_t wrong = first_wrong_node(cells.connectivity, grid_.point_count());
        if (wrong == cells.connectivity.size()) return;
        const auto cell = std::ranges::upper_bound(cells.ends, static_cast<std::int64_t>(wrong)) - cells.ends.begin();
        refuse_file(text_.path(), "a node of cell " + std::to_string(cell) + " (from 0)",
                    "a point below " + std::to_string(grid_.point_count()), std::to_string(cells.connectivity[wrong]));
    }

    /// All arrays behind POINT_DATA or CELL_DATA, up to the next of the two. `expected`: so many points or cells.
    void read_attributes(const std::string& keyword, std::size_t expected, const char* each,
                         std::vector<RawArray>& arrays) {
        const std::size_t rows = text_.count("the rows of " + keyword);
        if (rows != expected)
            text_.fail("the rows of " + keyword, std::to_string(expected) + each, std::to_string(rows));
        while (true) {
            const std::string_view before = text_.rest();
            const std::string kind = text_.keyword();
            if (kind.empty() || kind == "POINT_DATA" || kind == "CELL_DATA") return text_.go_back(before);
            read_attribute(kind, rows, arrays);
        }
    }

    void read_attribute(const std::string& kind, std::size_t rows, std::vector<RawArray>& arrays) {
        if (kind == "METADATA") return text_.skip_metadata();
        if (kind == "FIELD") return read_field_arrays(&arrays, rows);
        const std::string name = text_.name();
        if (kind == "LOOKUP_TABLE") {
            const std::size_t size = text_.count("the size of a lookup table");
            std::vector<double> unused;
            return text_.colors("a lookup table", std::uint64_t{4} * size, unused);
        }
        /// By their components, 0 where the file tells how many they are.
        constexpr std::array<std::pair<const char*, std::size_t>, 5> kinds{
            {{"SCALARS GLOBAL_IDS PEDIGREE_IDS EDGE_FLAGS", 1},
             {"VECTORS NORMALS", 3},
             {"TENSORS6", 6},
             {"TENSORS", 9},
             {"TEXTURE_COORDINATES COLOR_SCALARS", 0}}};
        const auto* const known =
            std::find_if(kinds.begin(), kinds.end(), [&](const auto& one) { return has_word(one.first, kind); });
        if (known == kinds.end())
            text_.fail("a kind of array", "SCALARS, VECTORS, FIELD and the like", in_quotes(kind), too_many);
        std::size_t components = known->second;
        if (components == 0) components = text_.count("the components of array " + in_quotes(name));
        if (kind == "COLOR_SCALARS") return read_array(name, std::nullopt, components, rows, arrays);
        const std::string type = text_.word();
        if (kind == "SCALARS") {
            // The number of components may be left out; the line of the lookup table may be, too.
            if (const std::optional<std::uint64_t> count = parse_count(text_.rest_of_line()); count.has_value())
                components = static_cast<std::size_t>(std::min(*count, max_entities + 1));
            if (text_.take("LOOKUP_TABLE")) text_.name();
        }
        read_array(name, type, components, rows, arrays);
    }

    /// `arrays` of nullptr: field data, which belong to neither points nor cells.
    void read_field_arrays(std::vector<RawArray>* arrays, std::size_t rows) {
        text_.name();
        const std::size_t count = text_.count("the number of arrays");
        for (std::size_t i = 0; i < count; ++i) {
            std::string name = text_.name();
            while (name == "METADATA") {
                text_.skip_metadata();
                name = text_.name();
            }
            if (name == "NULL_ARRAY") continue;
            const std::size_t components = text_.count("the components of array " + in_quotes(name));
            const std::size_t tuples = text_.count("the rows of array " + in_quotes(name));
            if (arrays != nullptr && tuples != rows)
                text_.fail("the rows of array " + in_quotes(name), std::to_string(rows), std::to_string(tuples));
            const std::string type = text_.word();
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
            text_.fail("the components of " + what, "1 or more", std::to_string(components));
        if (std::ranges::count(arrays, name, &RawArray::name) != 0)
            text_.fail("two arrays of one section", "different names", in_quotes(name) + " twice",
                       "give them different names");
        RawArray& array = arrays.emplace_back(RawArray{.name = name, .components = static_cast<int>(components)});
        const std::uint64_t numbers = static_cast<std::uint64_t>(components) * rows;
        const bool may_label = of_cells || (of_points && part_ == Part::point_arrays);
        if (!type) return text_.colors(what, numbers, array.numbers());
        const std::optional<NumberType> known = type_of_name(capitals(*type));
        if (!known) text_.fail("the type of " + what, "double, float, int and the like", in_quotes(*type));
        if (known == NumberType::text) {
            std::vector<std::string> texts;
            const bool wanted = takes_texts(array, may_label);
            text_.strings(what, capitals(*type) == "VARIANT", numbers, wanted ? &texts : nullptr);
            if (wanted) array.values = std::move(texts);
        } else if (known == NumberType::bit && components > 1 && text_.binary()) {
            // VTK writes, and reads back, as many bits as there are rows.
            std::vector<double> part;
            array.fault = "VTK writes only the first bits of such an array";
            text_.numbers(what, *known, rows, part);
        } else {
            array.type = *known;
            const std::string_view begin = text_.rest();
            read_numbers(array, of_points, may_label, [&](NumbersTo values, NumberFault& inexact) {
                text_.go_back(begin);
                text_.numbers(what, *known, numbers, values, &inexact);
            });
        }
    }

    static constexpr const char* too_many = "the data before it may be cut off, or more than was announced";

    LegacyText text_;
    Part part_;
    RawGrid grid_;
    std::array<RawCells, section_count> sections_;
    std::size_t point_count_ = 0;
    bool polydata_ = false, has_points_ = false;
    bool done_ = false;
};

}  // namespace

void check_legacy_head(std::string_view bytes, const std::string& path) {
    LegacyText(bytes, path).read_head();
}

RawGrid read_legacy(std::string_view bytes, const std::string& path, Part part) {
    return LegacyReader(bytes, path, part).read();
}

}  // namespace barycert::io
