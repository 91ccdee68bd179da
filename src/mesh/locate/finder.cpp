#include "mesh/locate/finder.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "core/base/random.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/sorted_points.hpp"

namespace barycert::locate {

void Finder::find(const PointRecord* points, std::size_t count, Place* owner, Feature* feature,
                  LocationCounts& counts) {
    std::fill(owner, owner + count, -1);
    std::fill(feature, feature + count, Feature::outside);
    asked_count_ = arrived_.count = 0;
    if (proof_ != nullptr) {
        walk(points, owner, feature, counts);
    } else {
        std::iota(asked_.begin(), asked_.begin() + static_cast<std::ptrdiff_t>(count), 0);
        asked_count_ = count;
    }
    if (asked_count_ != 0) ask_candidates(points, owner, feature, counts.tests);
    counts.ways.walk += count - asked_count_;
    counts.ways.candidates += asked_count_;
    const auto interior = static_cast<std::size_t>(std::count(feature, feature + count, Feature::interior));
    counts.add(Feature::interior, interior);
    for (std::size_t i = 0; interior != count && i < count; ++i) {
        if (feature[i] != Feature::interior) counts.add(feature[i]);
    }
}

void Finder::settle(const PointRecord& point, Place stuck, Place& owner, Feature& feature) {
    TierCounts ignored;
    owner = -1;
    feature = Feature::outside;
    asked_count_ = 0;
    resolve(point, {0, stuck}, &owner, &feature, ignored);
    if (asked_count_ != 0) ask_candidates(&point, &owner, &feature, ignored);
}

void Upcoming::find(std::size_t number) {
    const std::size_t end = std::min(count, done + number), d = index->dimension();
    const SortedPoints::Entry* const entries = sorted->entries() + first;
    const double* const points = sorted->point(0);
    constexpr std::size_t ahead = 16;
    for (std::size_t i = done; i < end; ++i) {
        if (i + ahead < count) __builtin_prefetch(&index->start[entries[i + ahead].bin]);
        const SortedPoints::Entry entry = entries[i];
        const double* const at = points + d * entry.number;
        __builtin_prefetch(at, 0, 2);
        __builtin_prefetch(at + d - 1, 0, 2);
        const Place cell = index->start[entry.bin];
        __builtin_prefetch(index->cells.data() + cell, 0, 2);
        walks[i] = {static_cast<std::uint32_t>(i), cell};
    }
    done = end;
}

void Finder::expect(const SortedPoints& sorted, std::size_t first, std::size_t count) {
    upcoming_.index = &data_.index;
    upcoming_.sorted = &sorted;
    upcoming_.first = first;
    upcoming_.count = count;
    upcoming_.done = 0;
}

void Finder::begin() {
    upcoming_.find(upcoming_.count);
    std::copy_n(upcoming_.walks.begin(), upcoming_.count, walking_.walks.begin());
    walking_.count = upcoming_.count;
}

void Finder::walk(const PointRecord* points, Place* owner, Feature* feature, LocationCounts& counts) {
    // A walk in floating point can go round in circles, in cells that are almost flat or not Delaunay.
    constexpr int max_rounds = 128;
    TierCounts& tests = counts.tests;
    stuck_.count = 0;
    for (int round = 0; walking_.count > 0 && round < max_rounds; ++round)
        walking_.count = step_walks(data_.index, nodes_, points, walking_.walks.data(), walking_.count, fetch_,
                                    upcoming_, arrived_, stuck_);
    for (std::size_t i = 0; i < arrived_.count; ++i) {
        const Walk& end = arrived_.walks[i];
        owner[end.point] = end.cell;
        feature[end.point] = Feature::interior;
        __builtin_prefetch(&data_.index.original[end.cell]);
    }
    tests.add(Tier::filter, arrived_.count);
    if (!proof_->contested.empty()) ask_contested(points, owner, feature, counts);
    for (std::size_t i = 0; i < stuck_.count; ++i)
        resolve(points[stuck_.walks[i].point], stuck_.walks[i], owner, feature, tests);
    for (std::size_t i = 0; i < walking_.count; ++i) {
        const PointRecord& point = points[walking_.walks[i].point];
        resolve(point, {walking_.walks[i].point, out_of_circle(point, walking_.walks[i].cell, tests)}, owner, feature,
                tests);
    }
}

/// Beyond any facet with the point on its other side: which one is as good as by chance, so that no circle lasts.
Place Finder::out_of_circle(const PointRecord& point, Place cell, TierCounts& tests) const {
    constexpr int max_steps = 4096;
    base::Random random(static_cast<std::uint64_t>(cell));
    for (int step = 0; step < max_steps; ++step) {
        const WeightSigns signs = cell_signs(data_.index, cell, point.at.data(), tests);
        if (signs.contains()) return cell;
        std::array<Place, 4> beyond{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < data_.index.corners(); ++i) {
            if (signs.sign(static_cast<int>(i)) == Sign::negative) beyond[count++] = data_.index.cells[cell].next[i];
        }
        const Place next = count == 0 ? -1 : beyond[random.below(count)];
        if (next < 0) return ~cell;
        cell = next;
    }
    return ~cell;
}

void Finder::ask_contested(const PointRecord* points, Place* owner, Feature* feature, LocationCounts& counts) {
    std::array<std::uint32_t, chunk_size> contested;
    std::size_t count = 0;
    for (std::size_t i = 0; i < arrived_.count; ++i) {
        contested[count] = arrived_.walks[i].point;
        count += proof_->is_contested(arrived_.walks[i].cell) ? 1 : 0;
    }
    if (count == 0) return;
    data_.parts.contested_cells().find_owners(points, contested.data(), count, owner, feature, counts.tests);
    counts.ways.contested += count;
    counts.ways.walk -= count;  // find() adds all that walked
}

void Finder::resolve(const PointRecord& point, Walk stuck, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    // At the end of the domain the point may still be in another part of it, in a contested cell in others as well.
    WeightSigns signs = WeightSigns::degenerate_simplex();
    if (stuck.cell >= 0 && !proof_->is_contested(stuck.cell))
        signs = cell_signs(index, stuck.cell, point.at.data(), tests);
    if (!signs.contains()) {
        asked_[asked_count_++] = stuck.point;
        return;
    }
    Place& first = owner[stuck.point] = stuck.cell;
    if (signs.region() != Region::interior) {
        first = data_.parts.node_cells().lowest_around(index, stuck.cell, signs);
        // Where whole cells do not meet face to face, a feature of one need not be one of the other.
        if (index.inside != nullptr) signs = cell_signs(index, first, point.at.data(), tests);
    }
    feature[stuck.point] = feature_of(index, first, signs);
}

void Finder::ask_candidates(const PointRecord* points, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    for_candidates(points, asked_.data(), asked_count_, tests, [&](const Candidate& c, WeightSigns signs) {
        if (!signs.contains()) return;
        Place& best = owner[c.point];
        if (best >= 0 && index.original[best] < index.original[c.cell]) return;
        best = c.cell;
        feature[c.point] = feature_of(index, c.cell, signs);
    });
}

}  // namespace barycert::locate
