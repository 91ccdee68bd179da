#include <algorithm>
#include <array>
#include <utility>

#include "barycert/io/other_formats.hpp"
#include "barycert/io/vtk/legacy_arrays.hpp"
#include "barycert/io/vtk/legacy_text.hpp"
#include "barycert/io/vtk/parallel.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
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
    LegacyReader(const LegacyReader&) = delete;  // its arrays_ refers to it
    LegacyReader& operator=(const LegacyReader&) = delete;

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
            if (part_ == Part::all)
                return text_.error("the kind of the data set", "UNSTRUCTURED_GRID or POLYDATA", in_quotes(keyword),
                                   keyword == "FIELD" ? "" : to_simplices(text_.path()));
            return text_.error("the kind of the data set", "UNSTRUCTURED_GRID, POLYDATA or STRUCTURED_GRID",
                               in_quotes(keyword), "save the points as .vti or .vtr, in ParaView");
        }
        return Done{};
    }

    Status read_section(const std::string& keyword) {
        if (keyword == "POINTS") return read_points();
        if (keyword == "CELLS" && !polydata_) return read_cells(sections_[polygons]);
        if (keyword == "CELL_TYPES" && !polydata_) return read_types();
        if (keyword == "DIMENSIONS") return text_.skip_line();
        if (keyword == "METADATA") return text_.skip_metadata();
        if (keyword == "FIELD") return arrays_.read_field_data();
        if (polydata_) {
            constexpr std::array<const char*, section_count> names{"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};
            for (std::size_t i = 0; i < section_count; ++i) {
                if (keyword == names[i]) return read_cells(sections_[i]);
            }
        }
        if (keyword == "POINT_DATA") return arrays_.read_attributes(keyword, point_count_);
        if (keyword == "CELL_DATA") return arrays_.read_attributes(keyword, cell_count());
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

    LegacyText text_;
    Part part_;
    RawGrid grid_;
    LegacyArrays arrays_{text_, part_, grid_};
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
