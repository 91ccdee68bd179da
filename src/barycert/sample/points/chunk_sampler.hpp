/// Rows for a chunk of points whose owners are known.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "barycert/locate/finder.hpp"
#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

/// Where the rows of a block go; row r of the block is for the point of number r.
struct BlockRows {
    Mesh::Index* cells;  ///< nullptr: each row of values has a Location before it instead
    Feature* features;
    double* values;          ///< SamplerData::width a row
    double* distances;       ///< nullptr unless the policy gives some
    std::size_t stride = 0;  ///< from row to row of values; 0: rows of nothing else
};
static_assert(sizeof(Location) == sizeof(double));

/// Not shared between threads.
class ChunkSampler {
public:
    ChunkSampler(const SamplerData& data, const SampleOptions& options, const BlockRows& rows)
        : data_(data), options_(options), rows_(rows) {
        if (rows_.stride == 0) rows_.stride = data.width;
    }

    /// Precondition: points with an owner are finite; owners are places of cells, or -1 outside.
    void operator()(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                    const Feature* feature);

    /// Sets the values of a point outside, and its distance if the policy gives some.
    void outside(const double* point, std::uint32_t number, double* values, double* distance);
    /// The same for `count` points of one number and the same values, under a policy that does not look at the point.
    void outside(std::uint64_t count, std::uint32_t number, double* values);

    const SampleCounts& counts() const { return counts_; }
    /// The lowest number of a point outside, if the policy is `error` and there is one.
    std::optional<std::uint32_t> refused() const { return refused_; }

private:
    void interpolate_linear(const locate::PointRecord* points, std::size_t count);
    void interpolate_exactly(const locate::PointRecord& point, locate::Place cell);
    void mend_plain(const locate::PointRecord& point, locate::Place cell);
    void interpolate_second_order(const locate::PointRecord* points, std::size_t count);
    double* row(const locate::PointRecord& point) { return rows_.values + rows_.stride * point.number; }

    const SamplerData& data_;
    const SampleOptions& options_;
    BlockRows rows_;
    SampleCounts counts_;
    std::optional<std::uint32_t> refused_;
    std::array<locate::Walk, locate::chunk_size> inside_;
    std::array<std::uint32_t, locate::chunk_size> undecided_;
    std::vector<Mesh::Index> cells_;
    std::vector<double> points_, values_;
};

}  // namespace barycert::sample
