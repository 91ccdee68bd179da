/// Rows for a chunk of points whose owners are known.
#pragma once

#include "barycert/locate/finder.hpp"
#include "barycert/sample/points/sampler_data.hpp"

namespace barycert::sample {

inline bool gives_distances(const OutsidePolicy& policy) {
    return policy.kind == Outside::nearest || policy.kind == Outside::extrapolate;
}

/// That a point is outside, under the policy `error`.
inline Error outside_error(const std::string& point) {
    return {.what = point + " is outside the mesh",
            .remedy = "choose what points outside get: nan, fill, nearest or extrapolate"};
}

/// Where the rows of a block go; row r of the block is for the point of number r.
struct BlockRows {
    Mesh::Index* cells;
    Feature* features;
    double* values;     ///< SamplerData::width a row
    double* distances;  ///< nullptr unless the policy gives some
};

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

    /// The same for one point after the other, some of them at a time: the last ones at flush().
    void push(const locate::PointRecord& point, locate::Place owner, Feature feature) {
        pending_.points[pending_.count] = point;
        pending_.owners[pending_.count] = owner;
        pending_.features[pending_.count] = feature;
        if (++pending_.count == locate::chunk_size) flush();
    }
    void flush() {
        (*this)(pending_.points.data(), pending_.count, pending_.owners.data(), pending_.features.data());
        pending_.count = 0;
    }

    /// Sets the values of `count` points outside of one number, under a policy that does not look at the point.
    void leave_out(std::uint64_t count, std::uint32_t number);

    const SampleCounts& counts() const { return counts_; }
    /// The lowest number of a point outside, if the policy is `error` and there is one.
    std::optional<std::uint32_t> refused() const { return refused_; }

private:
    /// Sets the values of a point outside, and its distance if the policy gives some; or returns the nearest cell,
    /// whose function is to be evaluated there.
    locate::Place outside(const locate::PointRecord& point);
    void interpolate_linear(const locate::PointRecord* points, std::size_t count);
    void interpolate_exactly(const locate::PointRecord& point, locate::Place cell);
    void mend_plain(const locate::PointRecord& point, locate::Place cell);
    void interpolate_second_order(const locate::PointRecord* points, std::size_t count);
    double* row(const locate::PointRecord& point) { return rows_.values + data_.width * point.number; }

    struct {
        std::array<locate::PointRecord, locate::chunk_size> points;
        std::array<locate::Place, locate::chunk_size> owners;
        std::array<Feature, locate::chunk_size> features;
        std::size_t count = 0;
    } pending_;  ///< first: its points are aligned
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
