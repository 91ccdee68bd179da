/// Rows of a block of points, from the order in which they are found into that of the caller.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "barycert/locate/sorted_points.hpp"
#include "barycert/sample/points/chunk_sampler.hpp"
#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

inline bool gives_distances(const OutsidePolicy& policy) {
    return policy.kind == Outside::nearest || policy.kind == Outside::extrapolate;
}

/// The rows of a block in the order in which they are found.
class SortedRows {
public:
    SortedRows(const SamplerData& data, const SampleOptions& options, std::size_t size)
        : data_(data), rows_(data.rows.take()), columns_(data.columns.size()) {
        const std::size_t numbers = (size + 1) * stride();  // one row more for all points left out
        if (rows_->numbers.size() < numbers) rows_->numbers = locate::Buffer<double>(numbers);
        if (gives_distances(options.outside)) rows_->distances.assign(size + 1, 0);
        sampler_.emplace(data, options,
                         BlockRows{nullptr, nullptr, values(0),
                                   gives_distances(options.outside) ? rows_->distances.data() : nullptr, stride()});
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
        sorted.for_each_in_callers_order([&](std::size_t place) { __builtin_prefetch(values(place) - 1); },
                                         [&](std::size_t i, std::size_t place) {
                                             const double* const from = values(place) + data_.hidden;
                                             const auto location = std::bit_cast<Location>(values(place)[-1]);
                                             out.cells[first + i] = location.cell;
                                             out.features[first + i] = location.feature;
                                             for (std::size_t c = 0; c < columns_; ++c)
                                                 out.values[columns_ * (first + i) + c] = from[c];
                                         });
        if (out.distances.empty()) return;
        sorted.for_each_in_callers_order(
            [](std::size_t) {},
            [&](std::size_t i, std::size_t place) {
                double* const to = &out.distances[first + i];
                *to = rows_->distances[place];
                if (place != last) return;
                // The row of all points left out serves for one after the other.
                sampler_->outside(sorted.point(i), static_cast<std::uint32_t>(last), values(last), to);
                std::copy_n(values(last) + data_.hidden, columns_, out.values.data() + columns_ * (first + i));
            });
    }

private:
    std::size_t stride() const { return data_.width + 1; }
    double* values(std::size_t row) const { return rows_->numbers.data() + stride() * row + 1; }

    void set_outside(std::size_t row, std::size_t count, const Table& out) {
        const Location outside;
        std::memcpy(values(row) - 1, &outside, sizeof outside);
        std::fill_n(values(row), data_.width, 0);
        if (out.distances.empty()) sampler_->outside(count, static_cast<std::uint32_t>(row), values(row));
    }

    const SamplerData& data_;
    std::unique_ptr<PackedRows> rows_;
    std::size_t columns_;
    std::optional<ChunkSampler> sampler_;
};

}  // namespace barycert::sample
