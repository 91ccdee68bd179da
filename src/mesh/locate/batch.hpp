/// Many points, in blocks and chunks, on several threads.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/finder.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/sorted_points.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

/// How many points are not finite.
inline std::size_t count_not_finite(std::span<const double> points, std::size_t d) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); i += d) count += base::all_finite({&points[i], d}) ? 0 : 1;
    return count;
}

/// The first row without a cell; points that are not finite are told by another policy than those outside.
inline std::optional<std::size_t> first_outside(std::span<const Mesh::Index> cells, std::span<const double> points,
                                                std::size_t d) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] < 0 && base::all_finite({&points[d * i], d})) return i;
    }
    return std::nullopt;
}

/// Returns the error that `what` needs listed cells (Mesh::axes).
inline Error not_listed(const std::string& what) {
    return {.code = "mesh.unlisted",
            .what = what + " of a grid whose cells are not listed",
            .remedy = "read it with ReadOptions::list_grids"};
}

/// There are d coordinates a point.
inline Status check_size(std::span<const double> points, std::size_t d) {
    if (points.size() % d == 0) return Done{};
    return Error{.code = "argument.size",
                 .what = "size of the points",
                 .expected = std::to_string(d) + " coordinates a point",
                 .found = std::to_string(points.size()) + " numbers"};
}

/// Cells given by the caller are -1 or of a mesh with `count` of them.
inline Status check_cells(std::span<const Mesh::Index> cells, std::size_t count) {
    const auto wrong = std::find_if(cells.begin(), cells.end(), [&](Mesh::Index cell) {
        return cell < -1 || (cell >= 0 && static_cast<std::size_t>(cell) >= count);
    });
    if (wrong == cells.end()) return Done{};
    return Error{.code = "argument.value",
                 .what = "index of a cell",
                 .expected = "-1 or below " + std::to_string(count),
                 .found = std::to_string(*wrong)};
}

/// An Error naming the first point with a coordinate that is not finite, if there is one. `first`: its number counts
/// from there.
inline Status check_finite(std::span<const double> points, std::size_t d, std::size_t first = 0) {
    if (base::all_finite(points)) return Done{};
    const std::size_t bad = base::first_not_finite(points);
    return base::not_finite("coordinate " + std::to_string(bad % d) + " of point " + std::to_string(first + bad / d),
                            points[bad]);
}

/// How many points are sorted together: the more there are, the nearer they lie to each other. A block takes some 40
/// bytes a point, so half as many as there are cells take a tenth of what the index does.
inline std::size_t block_of(std::size_t count, std::size_t cells) {
    constexpr std::size_t min = std::size_t{1} << 13, enough = std::size_t{1} << 20, most = std::size_t{1} << 24;
    const std::size_t max = std::clamp(cells / 2, enough, most);
    const auto threads = static_cast<std::size_t>(base::arena_threads());
    return std::clamp((count + threads - 1) / threads, min, max);
}

/// For blocks of the points, on all threads of the calling arena: worker = make(number of the first point of the
/// block, their count); worker(records, count, owners, features) for each chunk of the sorted block, points that are
/// known to be outside left out; in the end done(number of the first point, sorted block, worker). `nodes`: those of
/// the index, or a copy that will be read after it. Returns false if a coordinate is not finite; such points are
/// outside.
template <class Make, class Done>
bool for_chunks(const LocatorData& data, const NodeRecord* nodes, std::span<const double> points,
                LocationCounts& counts, Make make, Done done) {
    const std::size_t d = data.index.dimension(), count = points.size() / d;
    data.policy.prepare(count);
    const std::size_t block = block_of(count, data.index.cell_count()), blocks = (count + block - 1) / block;
    std::vector<LocationCounts> parts(blocks);
    std::atomic<bool> finite = true;
    base::parallel_for(blocks, [&](std::size_t b) {
        const std::size_t first = b * block, size = std::min(block, count - first);
        std::unique_ptr<SortedPoints> sorted = data.sorted.take();
        if (!sorted->sort(data.index, data.parts.occupancy(), points.subspan(d * first, d * size))) finite = false;
        Finder finder(data, nodes, size);
        auto worker = make(first, size);
        std::array<PointRecord, chunk_size> records;
        std::array<Place, chunk_size> owner;
        std::array<Feature, chunk_size> feature;
        const auto expect = [&](std::size_t at) {
            finder.expect(*sorted, at, std::min(chunk_size, sorted->size() - at));
        };
        expect(0);
        for (std::size_t at = 0; at < sorted->size(); at += chunk_size) {
            const std::size_t n = std::min(chunk_size, sorted->size() - at);
            finder.begin();
            sorted->copy(at, n, records.data());
            expect(at + n);
            finder.find(records.data(), n, owner.data(), feature.data(), parts[b]);
            worker(records.data(), n, owner.data(), feature.data());
        }
        parts[b].add(Feature::outside, sorted->left_out());
        parts[b].ways.no_cell_near += sorted->left_out();
        done(first, *sorted, worker);
        data.sorted.put(std::move(sorted));
    });
    for (const LocationCounts& part : parts) counts.add(part);
    return finite;
}

/// Owners and features of points, by those in parts of cells: to[number of a record].
class MappedOwners {
public:
    MappedOwners(const LocatorData& data, Location* to)
        : data_(data), to_(to), lanes_(*data.mapped, {}, {.first = data.index.nodes.data()}, Use{this}) {}

    void push(const PointRecord& point, const Location& in_parts, const Place* owner, std::size_t count) {
        data_.fetch_maps(owner, count, data_.index.nodes.data());
        if (count == 0 || !lanes_.push(in_parts, point, *owner, false)) settle(point, in_parts);
    }
    void flush() { lanes_.flush(); }

private:
    struct Use {
        MappedOwners* owners;
        void operator()(const MappedCells::Batch& batch, std::size_t lane, bool inside, bool) const {
            if (!inside) return owners->settle(batch.record(lane), batch.at[lane]);
            owners->to_[batch.numbers[lane]] = {batch.first[lane], Feature::interior};
        }
    };
    void settle(const PointRecord& point, const Location& in_parts) {
        to_[point.number] = data_.settle(point.at.data(), in_parts);
    }

    const LocatorData& data_;
    Location* to_;
    MappedLanes<Use> lanes_;
};

/// Features are those of `features`, not of parts of cells.
inline void count_anew(std::span<const Feature> features, LocationCounts& counts) {
    LocationCounts found;
    for (const Feature feature : features) found.add(feature);
    found.tests = counts.tests;
    found.ways = counts.ways;
    counts = found;
}

}  // namespace barycert::locate
