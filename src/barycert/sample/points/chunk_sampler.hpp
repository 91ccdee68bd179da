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
    Mesh::Index* cells;
    Feature* features;
    double* values;     ///< SamplerData::width a row
    double* distances;  ///< nullptr unless the policy gives some
};

/// Under the policies nearest and extrapolate: sets one value a column and returns the distance to the mesh; nothing if
/// no point of the mesh is within the limit. Point fields get, correctly rounded or plain as asked for, the value at
/// the orthogonal projection to the nearest vertex, edge or face, or that of the function of the nearest cell; cell
/// fields that of the nearest cell. On cells of second order the weights of the projection are rounded first, so that
/// they remain those of a point of the cell, then the quadratic is evaluated there.
std::optional<double> value_outside(const SamplerData& data, const SampleOptions& options, const double* point,
                                    double* values, TierCounts& tiers);

/// What a row has besides the values of point fields. Sets the values of the cell fields of the cell, and what is
/// computed at the point, into their columns of a row whose values of point fields stand. `point`: where gradients on
/// cells of second order are evaluated; not read if there are none.
void set_rest_of_row(const SamplerData& data, Rounding rounding, Mesh::Index cell, const double* point, double* row);

/// Not shared between threads.
class ChunkSampler {
public:
    ChunkSampler(const SamplerData& data, const SampleOptions& options, const BlockRows& rows)
        : data_(data), options_(options), rows_(rows) {}

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
    double* row(const locate::PointRecord& point) { return rows_.values + data_.width * point.number; }

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
