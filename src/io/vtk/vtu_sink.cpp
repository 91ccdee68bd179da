// Rows as points of an unstructured grid.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/vtk_cell.hpp"
#include "files/spool.hpp"
#include "io/table_format.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"
#include "io/vtk/out_grid.hpp"
#include "io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

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
