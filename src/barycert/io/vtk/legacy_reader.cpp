#include <algorithm>
#include <array>
#include <utility>

#include "barycert/io/vtk/legacy_text.hpp"
#include "barycert/io/vtk/parallel.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_grids.hpp"
#include "barycert/io/vtk/xml_reader.hpp"

namespace barycert::io {
namespace {

struct Cells {
    std::vector<std::int32_t> connectivity;
    std::vector<std::int64_t> ends;
};

class LegacyReader {
public:
    LegacyReader(LegacyText text, Part part) : text_(text), part_(part) {}

    Result<RawGrid> read() {
        if (Status s = text_.read_head(); !s) return s.error();
        if (Status s = read_data_set(); !s) return s.error();
        while (!done_) {
            const std::string keyword = text_.keyword();
            if (keyword.empty()) break;
            if (Status s = read_section(keyword); !s) return s.error();
        }
        if (part_ != Part::all) {
            if (!has_points_) return text_.error("the file has no points", "POINTS", "none");
            return std::move(grid_);
        }
        if (Status s = gather_cells(); !s) return s.error();
        return std::move(grid_);
    }

private:
    Status read_data_set() {
        std::string keyword = text_.keyword();
        if (keyword == "DATASET") keyword = text_.keyword();
        if (keyword == "POLYDATA") {
            polydata_ = true;
        } else if (keyword != "UNSTRUCTURED_GRID" && (part_ == Part::all || keyword != "STRUCTURED_GRID")) {
            return text_.error("the kind of the data set", "UNSTRUCTURED_GRID or POLYDATA", in_quotes(keyword),
                               to_simplices(text_.path()));
        }
        return Done{};
    }

    Status read_section(const std::string& keyword) {
        if (keyword == "POINTS") return read_points();
        if (keyword == "CELLS" && !polydata_) return read_cells(sections_[polygons]);
        if (keyword == "CELL_TYPES" && !polydata_) return read_types();
        if (keyword == "DIMENSIONS") return text_.skip_line();
        if (keyword == "METADATA") return text_.skip_metadata();
        if (keyword == "FIELD") return read_field_arrays(nullptr, 0);
        if (polydata_) {
            constexpr std::array<const char*, section_count> names{"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};
            for (std::size_t i = 0; i < section_count; ++i) {
                if (keyword == names[i]) return read_cells(sections_[i]);
            }
        }
        if (keyword == "POINT_DATA" || keyword == "CELL_DATA") return read_attributes(keyword);
        return text_.error("a keyword of the format", "POINTS, CELLS, POINT_DATA and the like", in_quotes(keyword),
                           "the data before it may be cut off, or more than was announced");
    }

    Status read_points() {
        const Result<std::size_t> count = text_.count("the number of points");
        if (!count) return count.error();
        const Result<NumberType> type = text_.number_type("the points");
        if (!type) return type.error();
        if (has_points_) return text_.error("a second section POINTS", "one", "two");
        has_points_ = true;
        grid_.narrow_points = *type == NumberType::float32;
        done_ = part_ == Part::points;
        point_count_ = *count;
        return text_.numbers("the coordinates", *type, std::uint64_t{3} * *count, grid_.points);
    }

    Status read_cells(Cells& cells) {
        if (!cells.ends.empty()) return text_.error("a second section of the same cells", "one", "two");
        const Result<std::size_t> count = text_.count("the number of cells");
        if (!count) return count.error();
        const Result<std::size_t> size = text_.count("the size of the cells");
        if (!size) return size.error();
        return text_.major_version() >= 5 ? read_offsets(cells, *count, *size) : read_rows(cells, *count, *size);
    }

    /// Since version 5: where each cell begins and the last one ends, then the nodes.
    Status read_offsets(Cells& cells, std::size_t offsets, std::size_t nodes) {
        if (offsets == 0 && nodes == 0) return Done{};
        if (Status s = text_.expect("OFFSETS"); !s) return s;
        const Result<NumberType> offset_type = text_.number_type("the offsets of cells");
        if (!offset_type) return offset_type.error();
        if (Status s = text_.numbers("the offsets of cells", *offset_type, offsets, cells.ends); !s) return s;
        if (Status s = text_.expect("CONNECTIVITY"); !s) return s;
        const Result<NumberType> type = text_.number_type("the connectivity");
        if (!type) return type.error();
        if (Status s = text_.numbers("the connectivity", *type, nodes, cells.connectivity); !s) return s;
        const bool grows = std::is_sorted(cells.ends.begin(), cells.ends.end());
        if (!grows || cells.ends.empty() || cells.ends.front() != 0 ||
            cells.ends.back() != static_cast<std::int64_t>(nodes)) {
            return text_.error("the offsets of cells",
                               "0 first, none below the one before it, " + std::to_string(nodes) + " last", "others");
        }
        cells.ends.erase(cells.ends.begin());
        return Done{};
    }

    /// Rows that all have as many nodes as the first one; false if they do not.
    static bool take_equal_rows(const std::vector<std::int32_t>& rows, std::size_t count, Cells& cells) {
        if (count == 0 || rows.empty() || rows.front() < 1) return false;
        const auto nodes = static_cast<std::size_t>(rows.front());
        if (rows.size() / count != nodes + 1 || rows.size() % count != 0) return false;
        for (std::size_t at = 0; at < rows.size(); at += nodes + 1) {
            if (rows[at] != rows.front()) return false;
        }
        make_room(cells.connectivity, count * nodes);
        cells.connectivity.resize(count * nodes);
        make_room(cells.ends, count);
        cells.ends.resize(count);
        in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
            for (std::size_t cell = first; cell < last; ++cell) {
                std::copy_n(rows.data() + cell * (nodes + 1) + 1, nodes, cells.connectivity.data() + cell * nodes);
                cells.ends[cell] = static_cast<std::int64_t>((cell + 1) * nodes);
            }
        });
        return true;
    }

    /// Before version 5: the number of its nodes, then the nodes, cell after cell.
    Status read_rows(Cells& cells, std::size_t count, std::size_t size) {
        std::vector<std::int32_t> rows;
        if (Status s = text_.numbers("the cells", NumberType::int32, size, rows); !s) return s;
        if (take_equal_rows(rows, count, cells)) return Done{};
        std::size_t at = 0;
        cells.connectivity.reserve(rows.size());
        for (std::size_t cell = 0; cell < count; ++cell) {
            const std::int32_t nodes = at < rows.size() ? rows[at] : -1;
            if (nodes < 0 || static_cast<std::size_t>(nodes) > rows.size() - at - 1) {
                return text_.error("the nodes of cell " + std::to_string(cell) + " (from 0)",
                                   "as many as fit in the " + std::to_string(size) + " numbers of the section",
                                   at < rows.size() ? std::to_string(nodes) : "none");
            }
            for (std::int32_t i = 1; i <= nodes; ++i)
                cells.connectivity.push_back(rows[at + static_cast<std::size_t>(i)]);
            at += 1 + static_cast<std::size_t>(nodes);
            cells.ends.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
        }
        if (at == rows.size()) return Done{};
        return text_.error("the size of the cells", std::to_string(at) + " numbers, as the cells have",
                           std::to_string(rows.size()));
    }

    Status read_types() {
        if (!grid_.types.empty()) return text_.error("a second section CELL_TYPES", "one", "two");
        const Result<std::size_t> count = text_.count("the number of cell types");
        if (!count) return count.error();
        return text_.numbers("the cell types", NumberType::int32, *count, grid_.types);
    }

    std::size_t cell_count() const {
        std::size_t count = 0;
        for (const Cells& cells : sections_) count += cells.ends.size();
        return count;
    }

    Status gather_cells() {
        if (!polydata_ && grid_.types.size() != cell_count()) {
            return text_.error("the cell types", std::to_string(cell_count()) + ", one a cell",
                               std::to_string(grid_.types.size()));
        }
        for (std::size_t i = 0; i < section_count; ++i) {
            const auto before = static_cast<std::int64_t>(grid_.connectivity.size());
            const bool first = grid_.ends.empty();
            Cells& cells = sections_[i];
            std::int64_t end = 0;
            for (const std::int64_t next : cells.ends) {
                if (polydata_) grid_.types.push_back(type_in(static_cast<Section>(i), next - end));
                end = next;
                if (!first) grid_.ends.push_back(before + end);
            }
            if (first) {
                grid_.ends = std::move(cells.ends);
                grid_.connectivity = std::move(cells.connectivity);
            } else {
                grid_.connectivity.insert(grid_.connectivity.end(), cells.connectivity.begin(),
                                          cells.connectivity.end());
            }
            cells = {};
        }
        return Done{};
    }

    /// All arrays behind POINT_DATA or CELL_DATA, up to the next of the two.
    Status read_attributes(const std::string& keyword) {
        const bool of_points = keyword == "POINT_DATA";
        const Result<std::size_t> rows = text_.count("the rows of " + keyword);
        if (!rows) return rows.error();
        const std::size_t expected = of_points ? point_count_ : cell_count();
        if (*rows != expected) {
            return text_.error("the rows of " + keyword,
                               std::to_string(expected) + (of_points ? ", one a point" : ", one a cell"),
                               std::to_string(*rows));
        }
        std::vector<RawArray>& arrays = of_points ? grid_.point_arrays : grid_.cell_arrays;
        while (true) {
            const LegacyText before = text_;
            const std::string kind = text_.keyword();
            if (kind.empty()) return Done{};
            if (kind == "POINT_DATA" || kind == "CELL_DATA") {
                text_ = before;
                return Done{};
            }
            if (Status s = read_attribute(kind, *rows, arrays); !s) return s;
        }
    }

    Status read_attribute(const std::string& kind, std::size_t rows, std::vector<RawArray>& arrays) {
        if (kind == "METADATA") return text_.skip_metadata();
        if (kind == "FIELD") return read_field_arrays(&arrays, rows);
        const std::string name = text_.name();
        if (kind == "LOOKUP_TABLE") {
            const Result<std::size_t> size = text_.count("the size of a lookup table");
            return size ? text_.skip_colors(std::uint64_t{4} * *size) : Status(size.error());
        }
        if (kind == "COLOR_SCALARS") {
            const Result<std::size_t> components = text_.count("the components of array " + in_quotes(name));
            return components ? read_colors(name, *components, rows, arrays) : Status(components.error());
        }
        std::size_t components = 0;
        if (kind == "TEXTURE_COORDINATES") {
            const Result<std::size_t> found = text_.count("the components of array " + in_quotes(name));
            if (!found) return found.error();
            components = *found;
        } else {
            constexpr std::array<std::pair<const char*, std::size_t>, 8> kinds{{{"SCALARS", 1},
                                                                                {"VECTORS", 3},
                                                                                {"NORMALS", 3},
                                                                                {"TENSORS", 9},
                                                                                {"TENSORS6", 6},
                                                                                {"GLOBAL_IDS", 1},
                                                                                {"PEDIGREE_IDS", 1},
                                                                                {"EDGE_FLAGS", 1}}};
            for (const auto& [known, count] : kinds) {
                if (kind == known) components = count;
            }
            if (components == 0) {
                return text_.error("a kind of array", "SCALARS, VECTORS, FIELD and the like", in_quotes(kind),
                                   "the data before it may be cut off, or more than was announced");
            }
        }
        const std::string type = text_.word();
        if (kind == "SCALARS") {
            // The number of components may be left out; the line of the lookup table may be, too.
            if (const std::optional<std::uint64_t> count = parse_count(text_.rest_of_line()); count.has_value()) {
                components = static_cast<std::size_t>(std::min(*count, max_entities + 1));
            }
            const LegacyText before = text_;
            if (text_.keyword() == "LOOKUP_TABLE") {
                text_.name();
            } else {
                text_ = before;
            }
        }
        return read_array(name, type, components, rows, arrays);
    }

    /// `arrays` of nullptr: field data, which belong to neither points nor cells.
    Status read_field_arrays(std::vector<RawArray>* arrays, std::size_t rows) {
        text_.name();
        const Result<std::size_t> count = text_.count("the number of arrays");
        if (!count) return count.error();
        std::vector<RawArray> unused;
        for (std::size_t i = 0; i < *count; ++i) {
            std::string name = text_.name();
            while (name == "METADATA") {
                if (Status s = text_.skip_metadata(); !s) return s;
                name = text_.name();
            }
            if (name == "NULL_ARRAY") continue;
            const Result<std::size_t> components = text_.count("the components of array " + in_quotes(name));
            if (!components) return components.error();
            const Result<std::size_t> tuples = text_.count("the rows of array " + in_quotes(name));
            if (!tuples) return tuples.error();
            if (arrays != nullptr && *tuples != rows) {
                return text_.error("the rows of array " + in_quotes(name), std::to_string(rows),
                                   std::to_string(*tuples));
            }
            const std::string type = text_.word();
            if (Status s = read_array(name, type, *components, *tuples, arrays != nullptr ? *arrays : unused); !s) {
                return s;
            }
            if (!unused.empty() && !is_time(name)) grid_.loose_arrays.push_back(name);
            unused.clear();
        }
        return Done{};
    }

    /// Of cells; of points, where no mesh has to carry them.
    bool may_label(const std::vector<RawArray>& arrays) const {
        return &arrays == &grid_.cell_arrays || (&arrays == &grid_.point_arrays && part_ == Part::point_arrays);
    }

    Status read_array(const std::string& name, const std::string& type, std::size_t components, std::size_t rows,
                      std::vector<RawArray>& arrays) {
        const std::string what = "array " + in_quotes(name);
        if (components == 0 && rows != 0 && &arrays != &grid_.point_arrays && &arrays != &grid_.cell_arrays)
            components = 1;
        if (components == 0 || components > max_entities) {
            return text_.error("the components of " + what, "1 or more", std::to_string(components));
        }
        if (Status s = must_be_new(name, arrays); !s) return s;
        RawArray array;
        array.field = {name, static_cast<int>(components), {}};
        const std::uint64_t numbers = static_cast<std::uint64_t>(components) * rows;
        if (LegacyText::is_text(type)) {
            const bool label = may_label(arrays);
            std::vector<std::string> texts;
            if (Status s = text_.strings(what, type, numbers, label && components == 1 ? &texts : nullptr); !s)
                return s;
            array.has_labels = label && components == 1;
            array.labels = std::move(texts);
            if (!array.has_labels)
                array.fault = label ? "it holds texts of several components"
                                    : "it holds text, which points of a mesh cannot carry";
        } else {
            const std::optional<NumberType> known = LegacyText::number_type_named(type);
            if (known == NumberType::bit && components > 1 && text_.binary()) {
                // VTK writes, and reads back, as many bits as there are rows.
                std::vector<double> part;
                array.fault = "VTK writes only the first bits of such an array";
                if (Status s = text_.numbers(what, *known, rows, part); !s) return s;
                arrays.push_back(std::move(array));
                return Done{};
            }
            if (!known.has_value()) {
                return text_.error("the type of " + what, "double, float, int and the like", in_quotes(type));
            }
            if (Status s = read_numbers(what, *known, numbers, arrays, array); !s) return s;
        }
        arrays.push_back(std::move(array));
        return Done{};
    }

    Status read_numbers(const std::string& what, NumberType type, std::uint64_t numbers,
                        const std::vector<RawArray>& arrays, RawArray& array) {
        array.is_narrow = type == NumberType::float32;
        array.is_integer = type == NumberType::int64 || type == NumberType::uint64;
        const bool markers = &arrays == &grid_.point_arrays && array.field.name == marker_name &&
                             type == NumberType::int64 && array.field.components == 1;
        array.is_whole = type != NumberType::float32 && type != NumberType::float64;
        const bool label = may_label(arrays) && array.is_integer && array.field.components == 1;
        const LegacyText before = text_;
        NumberFault fault;
        if (!markers) {
            if (Status s = text_.numbers(what, type, numbers, array.field.data, &fault); !s) return s;
            if (!fault) return Done{};
            array.field.data = {};
            array.fault = inexact(fault);
            if (!label) return Done{};
            text_ = before;
        }
        std::vector<std::int64_t> labels;
        NumberFault wide;
        if (Status s = text_.numbers(what, type, numbers, labels, &wide); !s) return s;
        if (wide) return Done{};
        array.fault.clear();
        array.labels = std::move(labels);
        array.has_labels = true;
        return Done{};
    }

    Status read_colors(const std::string& name, std::size_t components, std::size_t rows,
                       std::vector<RawArray>& arrays) {
        if (components == 0 || components > max_entities) {
            return text_.error("the components of array " + in_quotes(name), "1 or more", std::to_string(components));
        }
        if (Status s = must_be_new(name, arrays); !s) return s;
        RawArray array;
        array.field = {name, static_cast<int>(components), {}};
        if (Status s = text_.colors("array " + in_quotes(name), static_cast<std::uint64_t>(components) * rows,
                                    array.field.data);
            !s) {
            return s;
        }
        arrays.push_back(std::move(array));
        return Done{};
    }

    Status must_be_new(const std::string& name, const std::vector<RawArray>& arrays) const {
        const bool known =
            std::any_of(arrays.begin(), arrays.end(), [&](const RawArray& a) { return a.field.name == name; });
        if (!known) return Done{};
        return text_.error("two arrays of one section", "different names", in_quotes(name) + " twice",
                           "give them different names");
    }

    LegacyText text_;
    Part part_;
    RawGrid grid_;
    std::array<Cells, section_count> sections_;
    std::size_t point_count_ = 0;
    bool polydata_ = false, has_points_ = false;
    bool done_ = false;
};

}  // namespace

Result<RawGrid> read_legacy(std::string_view bytes, const std::string& path, Part part) {
    return LegacyReader(LegacyText(bytes, path), part).read();
}

}  // namespace barycert::io
