#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "barycert/base/spool.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/point_rows.hpp"

namespace barycert::io {
namespace {

class VtuSink final : public TableSink {
public:
    VtuSink(const std::string& path, const TableFormat& format)
        : path_(path), format_(format), points_(path), cells_(path), features_(path), inside_(path), distances_(path) {
        for (const TableField& field : format.fields) {
            fields_.emplace_back(path);
            columns_ += static_cast<std::size_t>(field.components);
        }
        for (std::size_t i = 0; i < format.carried.size(); ++i) carried_.emplace_back(path);
    }

    Status write(const TableView& rows) override {
        Status good = check_rows(rows, format_, path_);
        const auto add = [&](base::Spool& spool, auto values) {
            if (good) good = spool.append(std::span<const typename decltype(values)::value_type>(values));
        };
        add(points_, rows.points);
        add(cells_, rows.cells);
        add(features_, rows.features);
        add(distances_, rows.distances);
        inside_rows_.assign(rows.cells.size(), 0);
        for (std::size_t i = 0; i < rows.cells.size(); ++i) inside_rows_[i] = rows.cells[i] >= 0 ? 1 : 0;
        add(inside_, std::span<const std::uint8_t>(inside_rows_));
        std::size_t first = 0;
        for (std::size_t f = 0; f < fields_.size() && good; ++f) {
            const auto n = static_cast<std::size_t>(format_.fields[f].components);
            numbers_.resize(n * rows.cells.size());
            for (std::size_t i = 0; i < rows.cells.size(); ++i) {
                for (std::size_t c = 0; c < n; ++c) numbers_[n * i + c] = rows.values[columns_ * i + first + c];
            }
            add(fields_[f], std::span<const double>(numbers_));
            first += n;
        }
        for (std::size_t k = 0; k < carried_.size() && good; ++k) {
            std::visit([&](const auto& values) { add_column(carried_[k], values, good); }, rows.carried[k].values);
        }
        return good;
    }

    Status commit() override {
        for (base::Spool* const spool : {&points_, &cells_, &features_, &inside_, &distances_}) {
            if (Status done = spool->finish(); !done) return done;
        }
        PointRows rows{.dimension = format_.dimension,
                       .points = points_.values<double>(),
                       .cells = cells_.values<Mesh::Index>(),
                       .features = features_.values<Feature>(),
                       .inside = inside_.values<std::uint8_t>(),
                       .fields = {},
                       .distances = distances_.values<double>(),
                       .carried = {}};
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            if (Status done = fields_[f].finish(); !done) return done;
            rows.fields.push_back({format_.fields[f].name, format_.fields[f].components, fields_[f].values<double>()});
        }
        for (std::size_t k = 0; k < carried_.size(); ++k) {
            if (Status done = carried_[k].finish(); !done) return done;
            ColumnRows column{format_.carried[k].name, {}};
            if (format_.carried[k].type == Column::Type::integer) {
                column.values = carried_[k].values<std::int64_t>();
            } else if (format_.carried[k].type == Column::Type::number) {
                column.values = carried_[k].values<double>();
            } else {
                column.values = carried_[k].values<char>();
            }
            rows.carried.push_back(std::move(column));
        }
        return write_vtk_points(path_, rows, format_.vtk_data);
    }

private:
    template <class T>
    void add_column(base::Spool& spool, const std::vector<T>& values, Status& good) const {
        if constexpr (std::is_same_v<T, std::string>) {
            for (const std::string& text : values) {
                if (good && text.find('\0') != std::string::npos) {
                    good = Error{.what = "a text with a zero byte, which ends a text in VTK's files",
                                 .file = path_,
                                 .expected = {},
                                 .found = text.substr(0, 40),
                                 .remedy = "carry another column through, or write a .csv file"};
                }
                if (good) good = spool.append(std::span<const char>(text.c_str(), text.size() + 1));
            }
        } else {
            good = spool.append(std::span<const T>(values));
        }
    }

    std::string path_;
    TableFormat format_;
    std::size_t columns_ = 0;
    base::Spool points_, cells_, features_, inside_, distances_;
    std::vector<base::Spool> fields_, carried_;
    std::vector<double> numbers_;
    std::vector<std::uint8_t> inside_rows_;
};

}  // namespace

Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format) {
    return std::unique_ptr<TableSink>(std::make_unique<VtuSink>(path, format));
}

}  // namespace barycert::io
