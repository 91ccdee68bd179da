#include "barycert/locate/finder.hpp"

#include <algorithm>

namespace barycert::locate {
namespace {

/// A walk in floating point can go round in circles, in cells that are almost flat or not Delaunay.
constexpr int max_rounds = 128;

}  // namespace

void Finder::find(const PointRecord* points, std::size_t count, Place* owner, Feature* feature,
                  LocationCounts& counts) {
    asked_count_ = 0;
    if (data_.method == Method::walk) {
        start(points, count);
        walk(points, count, owner, feature, counts.tests);
    } else {
        std::iota(asked_.begin(), asked_.begin() + static_cast<std::ptrdiff_t>(count), 0);
        asked_count_ = count;
        std::fill(owner, owner + count, -1);
        std::fill(feature, feature + count, Feature::outside);
    }
    if (asked_count_ != 0) ask_candidates(points, owner, feature, counts.tests);
    for (std::size_t i = 0; i < count; ++i) counts.add(feature[i]);
}

void Finder::settle(const PointRecord& point, Place stuck, Place& owner, Feature& feature) {
    TierCounts ignored;
    owner = -1;
    feature = Feature::outside;
    asked_count_ = 0;
    resolve(point, {0, stuck}, &owner, &feature, ignored);
    if (asked_count_ != 0) ask_candidates(&point, &owner, &feature, ignored);
}

void Finder::start(const PointRecord* points, std::size_t count) {
    const CellIndex& index = data_.index;
    for (std::size_t i = 0; i < count; ++i) {
        const Place cell = index.start(points[i].bin);
        __builtin_prefetch(&index.cells[static_cast<std::size_t>(cell)]);
        walking_.walks[i] = {static_cast<std::uint32_t>(i), cell};
    }
    walking_.count = count;
}

void Finder::walk(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, TierCounts& tests) {
    std::fill(owner, owner + count, -1);
    std::fill(feature, feature + count, Feature::outside);
    arrived_.count = stuck_.count = 0;
    for (int round = 0; walking_.count > 0 && round < max_rounds; ++round)
        walking_.count = step_walks(data_.index, nodes_, points, walking_.walks.data(), walking_.count, true, arrived_, stuck_);
    for (std::size_t i = 0; i < arrived_.count; ++i) {
        const Walk& end = arrived_.walks[i];
        owner[end.point] = end.cell;
        feature[end.point] = Feature::interior;
    }
    tests.add(Tier::filter, arrived_.count);
    for (const WalkList* const doubtful : {&stuck_, &walking_}) {
        for (std::size_t i = 0; i < doubtful->count; ++i)
            resolve(points[doubtful->walks[i].point], doubtful->walks[i], owner, feature, tests);
    }
}

void Finder::resolve(const PointRecord& point, Walk stuck, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    // At the end of the domain the point may still be in another part of it.
    WeightSigns signs;
    if (stuck.cell >= 0) signs = cell_signs(index, stuck.cell, point.at.data(), tests);
    if (stuck.cell < 0 || !signs.contains()) {
        asked_[asked_count_++] = stuck.point;
        return;
    }
    feature[stuck.point] = signs.feature(index.simplex);
    owner[stuck.point] = stuck.cell;
    if (signs.region() == Region::interior) return;
    data_.node_cells().for_each_around(index, stuck.cell, signs, [&](Place first) {
        owner[stuck.point] = first;
        return false;
    });
}

void Finder::ask_candidates(const PointRecord* points, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    const auto original = [&](Place place) { return index.original[static_cast<std::size_t>(place)]; };
    for_candidates(points, asked_.data(), asked_count_, tests, [&](const Candidate& c, WeightSigns signs) {
        if (!signs.contains()) return;
        Place& best = owner[c.point];
        if (best >= 0 && original(best) < original(c.cell)) return;
        best = c.cell;
        feature[c.point] = signs.feature(index.simplex);
    });
}

}  // namespace barycert::locate
