/// Rows for a chunk of points whose owners are known.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/sample/points/sampler_data.hpp"

namespace barycert::locate {
struct NearestInMaps;
}

namespace barycert::sample {

inline bool gives_distances(const OutsidePolicy& policy) {
    return policy.kind == Outside::nearest || policy.kind == Outside::extrapolate;
}

/// Returns the error that a point is outside, under the policy `error`.
inline Error outside_error(const std::string& point) {
    return {.code = "point.outside",
            .what = point + " is outside the mesh",
            .remedy = "choose what points outside get: nan, fill, nearest or extrapolate"};
}

/// Where the rows of a block go; row r of the block is for the point of number r.
struct BlockRows {
    Mesh::Index* cells;
    Feature* features;
    double* values;     ///< SamplerData::width a row
    double* distances;  ///< nullptr unless the policy gives some
};

/// Makes room for so many rows of `width` numbers, the same from call to call.
inline BlockRows make_room(FoundRows& rows, std::size_t count, std::size_t width, const OutsidePolicy& policy) {
    if (rows.cells.size() < count) {
        rows.cells = locate::Buffer<Mesh::Index>(count);
        rows.features = locate::Buffer<Feature>(count);
        rows.values = locate::Buffer<double>(width * count);
    }
    rows.distances.assign(gives_distances(policy) ? count : 0, 0);
    return {rows.cells.data(), rows.features.data(), rows.values.data(),
            rows.distances.empty() ? nullptr : rows.distances.data()};
}

/// Where quantities are computed that differ from point to point in a cell.
struct PlaceInCell {
    Mesh::Index cell;
    const double* point;  ///< not read where there are no such quantities
    /// Of a point outside, its nearest point in a mapped cell; nullptr: else.
    const locate::PointOnSide* on = nullptr;
};

/// Sets the columns of a row besides the values of point fields, which stand: the values of the cell fields of the
/// cell, and what is computed at the point. Counts gradients that are not proved.
void set_rest_of_row(const SamplerData& data, const SampleOptions& options, const PlaceInCell& place, double* row,
                     SampleCounts& counts);

/// Not shared between threads.
class ChunkSampler {
public:
    /// `in_parts`: owners are those in parts of cells, or as if all were straight.
    ChunkSampler(const SamplerData& data, const SampleOptions& options, const BlockRows& rows, bool in_parts = true);

    /// Requires: points with an owner are finite; owners are places of cells, or -1 outside. Where cells have maps,
    /// rows are complete after flush().
    void operator()(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                    const Feature* feature) {
        if (!lanes_) return straight(points, count, owner, feature);
        for (std::size_t i = 0; i < count; ++i) {
            data_.located().fetch_maps(owner + i, count - i, data_.node_values().first);
            push(points[i], owner[i], feature[i]);
        }
    }

    /// The same for one point after the other, some of them at a time: the last ones at flush().
    void push(const locate::PointRecord& point, locate::Place owner, Feature feature);
    void flush();

    /// Sets the values of `count` points outside of one number, under a policy that does not look at the point.
    void leave_out(std::uint64_t count, std::uint32_t number);

    const SampleCounts& counts() const { return counts_; }
    /// The lowest number of a point outside, if the policy is `error` and there is one.
    std::optional<std::uint32_t> refused() const { return refused_; }

private:
    void push_straight(const locate::PointRecord& point, locate::Place owner, Feature feature) {
        pending_.points[pending_.count] = point;
        pending_.owners[pending_.count] = owner;
        pending_.features[pending_.count] = feature;
        if (++pending_.count == locate::chunk_size) flush_straight();
    }
    void flush_straight() {
        straight(pending_.points.data(), std::exchange(pending_.count, 0), pending_.owners.data(),
                 pending_.features.data());
    }
    void straight(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                  const Feature* feature);
    /// A point whose owner is known, by the map of the cell if it has one.
    void settled(const locate::PointRecord& point, const Location& at, bool on_lanes = true);
    /// The points of not_here_: not while lanes call back.
    void settle_rest();
    void set_row(const locate::PointRecord& point, const Location& at, const double* values, std::size_t stride);
    struct UseLane {
        ChunkSampler* sampler;
        void operator()(const locate::MappedCells::Batch& batch, std::size_t lane, bool inside, bool proved) const;
    };
    /// Sets the values of a point outside, and its distance if the policy gives some; or returns the nearest cell,
    /// whose function is to be evaluated there.
    locate::Place outside(const locate::PointRecord& point);
    /// The same for a point whose nearest point is that of a cell with a map.
    void outside_maps(const locate::PointRecord& point, const locate::NearestInMaps& nearest);
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

    bool in_parts_;
    std::optional<locate::MappedLanes<UseLane>> lanes_;               ///< where cells have maps
    std::vector<std::pair<locate::PointRecord, Location>> not_here_;  ///< not proved to be in the cell of the part
    locate::MappedCells::Scratch scratch_;
};

}  // namespace barycert::sample
