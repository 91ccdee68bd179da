#include <cmath>
#include <deque>
#include <functional>

#include "barycert/base/spool.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/out_file.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

/// Rows in a .vtu file: each point a cell of type VTK_VERTEX (z = 0 in dimension 2), the rest as point arrays: `cell`
/// (Int64), `feature` (UInt8: 0 interior, 1 face, 2 edge, 3 vertex, 4 outside, 5 degenerate), `vtkValidPointMask`
/// (Int8: 1 inside, 0 outside, as VTK's own probes name it), `distance` (Float64), the fields (Float64, any value) and
/// what is carried through (Int64, Float64 or String).
class VtuSink final : public TableSink {
public:
    VtuSink(const std::string& path, const TableFormat& format) : path_(path), format_(format) {
        for (const TableField& field : format.fields) {
            fields_.push_back(&add(field.name, field.components, NumberType::float64));
            numbers_.push_back({field.name, field.components, {}});
        }
        constexpr std::array types{NumberType::int64, NumberType::float64, NumberType::text};  // by Column::Type
        for (const ColumnFormat& column : format.carried)
            carried_.push_back(&add(column.name, 1, types[static_cast<std::size_t>(column.type)]));
    }

    Status write(const TableView& rows) override {
        Status good = check_rows(rows, format_, path_);
        const auto append = [&](base::Spool& spool, auto values) {
            if (good) good = spool.append(std::span<const typename decltype(values)::value_type>(values));
        };
        const std::size_t count = rows.cells.size(), dimension = static_cast<std::size_t>(format_.dimension);
        for (std::size_t i = 0; i < rows.points.size() && good; ++i) {
            // A point of a row outside may be anywhere.
            if (!std::isfinite(rows.points[i]) && rows.cells[i / dimension] >= 0)
                good = cannot_write("the points", "a coordinate is not finite", path_);
        }
        append(points_, rows.points);
        append(cells_, std::vector<std::int64_t>(rows.cells.begin(), rows.cells.end()));
        append(features_, rows.features);
        if (distances_ != nullptr) append(*distances_, rows.distances);
        std::vector<std::int8_t> inside(count);
        for (std::size_t i = 0; i < count; ++i) inside[i] = rows.cells[i] >= 0 ? 1 : 0;
        append(inside_, inside);
        for (Field& field : numbers_) field.data.clear();
        if (good) append_rows(rows, numbers_);
        for (std::size_t f = 0; f < fields_.size(); ++f) append(*fields_[f], std::span<const double>(numbers_[f].data));
        for (std::size_t k = 0; k < carried_.size() && good; ++k)
            std::visit([&](const auto& values) { good = append_column(*carried_[k], values); }, rows.carried[k].values);
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
    base::Spool& add(const std::string& name, int components, NumberType type) {
        return arrays_.emplace_back(ArrayFormat{name, components, type}, base::Spool(path_)).second;
    }

    template <class T>
    Status append_column(base::Spool& spool, const std::vector<T>& values) const {
        if constexpr (std::is_same_v<T, std::string>) {
            for (const std::string& text : values) {
                if (text.find('\0') != std::string::npos)
                    return file_error(path_, "a text with a zero byte, which ends a text in VTK's files", {},
                                      text.substr(0, 40), "carry another column through, or write a .csv file");
                if (Status s = spool.append(std::span<const char>(text.c_str(), text.size() + 1)); !s) return s;
            }
            return Done{};
        } else {
            return spool.append(std::span<const T>(values));
        }
    }

    std::string path_;
    TableFormat format_;
    base::Spool points_{path_};
    std::deque<std::pair<ArrayFormat, base::Spool>> arrays_;  ///< in the order of the file; the members below are of it
    base::Spool& cells_ = add("cell", 1, NumberType::int64);
    base::Spool& features_ = add("feature", 1, NumberType::uint8);
    base::Spool& inside_ = add("vtkValidPointMask", 1, NumberType::int8);
    base::Spool* distances_ = format_.distances ? &add("distance", 1, NumberType::float64) : nullptr;
    std::vector<base::Spool*> fields_, carried_;
    std::vector<Field> numbers_;  ///< of the last rows, each field for itself
    std::size_t count_ = 0;
};

}  // namespace

Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format) {
    return std::unique_ptr<TableSink>(std::make_unique<VtuSink>(path, format));
}

}  // namespace barycert::io
