/// Rows of a block of points, from the order in which they are found into that of the caller.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "barycert/locate/sorted_points.hpp"
#include "barycert/sample/points/chunk_sampler.hpp"
#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

/// The rows of a block in the order in which they are found.
class SortedRows {
public:
    SortedRows(const SamplerData& data, const SampleOptions& options, std::size_t size)
        : data_(data), rows_(data.rows.take()), columns_(data.columns.size()) {
        const std::size_t rows = size + 1;  // one more for all points left out
        if (rows_->cells.size() < rows) {
            rows_->cells = locate::Buffer<Mesh::Index>(rows);
            rows_->features = locate::Buffer<Feature>(rows);
            rows_->values = locate::Buffer<double>(rows * data.width);
        }
        if (gives_distances(options.outside)) rows_->distances.assign(rows, 0);
        sampler_.emplace(data, options,
                         BlockRows{rows_->cells.data(), rows_->features.data(), values(0),
                                   gives_distances(options.outside) ? rows_->distances.data() : nullptr});
    }
    SortedRows(SortedRows&&) = default;
    ~SortedRows() {
        if (rows_) data_.rows.put(std::move(rows_));
    }

    void operator()(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                    const Feature* feature) {
        (*sampler_)(points, count, owner, feature);
    }
    const ChunkSampler& sampler() const { return *sampler_; }

    void write(const locate::SortedPoints& sorted, std::size_t first, Table& out) {
        const std::size_t last = sorted.size(), left_out = sorted.left_out();
        if (left_out != 0) set_outside(last, left_out, out);
        const auto ahead = [&](std::size_t place) {
            __builtin_prefetch(&rows_->cells[place]);
            __builtin_prefetch(&rows_->features[place]);
            __builtin_prefetch(values(place));
        };
        sorted.for_each_in_callers_order(ahead, [&](std::size_t i, std::size_t place) {
            const double* const from = values(place) + data_.hidden;
            out.cells[first + i] = rows_->cells[place];
            out.features[first + i] = rows_->features[place];
            for (std::size_t c = 0; c < columns_; ++c) out.values[columns_ * (first + i) + c] = from[c];
        });
        if (out.distances.empty()) return;
        sorted.for_each_in_callers_order(
            [](std::size_t) {},
            [&](std::size_t i, std::size_t place) {
                if (place == last) {  // the row of all points left out serves for one after the other
                    locate::PointRecord point{};
                    point.number = static_cast<std::uint32_t>(last);
                    std::copy_n(sorted.point(i), data_.index().dimension(), point.at.begin());
                    constexpr locate::Place no_owner = -1;
                    constexpr Feature outside = Feature::outside;
                    (*sampler_)(&point, 1, &no_owner, &outside);
                    std::copy_n(values(last) + data_.hidden, columns_, out.values.data() + columns_ * (first + i));
                }
                out.distances[first + i] = rows_->distances[place];
            });
    }

private:
    double* values(std::size_t row) const { return rows_->values.data() + data_.width * row; }

    void set_outside(std::size_t row, std::size_t count, const Table& out) {
        rows_->cells[row] = -1;
        rows_->features[row] = Feature::outside;
        std::fill_n(values(row), data_.width, 0);
        if (out.distances.empty()) sampler_->leave_out(count, static_cast<std::uint32_t>(row));
    }

    const SamplerData& data_;
    std::unique_ptr<FoundRows> rows_;
    std::size_t columns_;
    std::optional<ChunkSampler> sampler_;
};

}  // namespace barycert::sample
