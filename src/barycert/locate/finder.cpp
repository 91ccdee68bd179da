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
        for (std::size_t i = 0; i < count; ++i) {
            asked_[asked_count_] = static_cast<std::uint32_t>(i);
            asked_count_ += data_.index.box_holds(points[i].at.data()) ? 1 : 0;
            owner[i] = -1;
            feature[i] = Feature::outside;
        }
    }
    if (asked_count_ != 0) ask_candidates(points, owner, feature, counts.tests);
    for (std::size_t i = 0; i < count; ++i) counts.add(feature[i]);
}

void Finder::find_from(Place start, const PointRecord& point, Place& owner, Feature& feature) {
    LocationCounts ignored;
    if (data_.method != Method::walk || !data_.index.box_holds(point.at.data()))
        return find(&point, 1, &owner, &feature, ignored);
    asked_count_ = 0;
    walks_[0] = {0, start};
    walking_ = 1;
    walk(&point, 1, &owner, &feature, ignored.tests);
    if (asked_count_ != 0) ask_candidates(&point, &owner, &feature, ignored.tests);
}

void Finder::start(const PointRecord* points, std::size_t count) {
    const CellIndex& index = data_.index;
    walking_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Place cell = index.start(points[i].bin);
        __builtin_prefetch(&index.cells[static_cast<std::size_t>(cell)]);
        walks_[walking_] = {static_cast<std::uint32_t>(i), cell};
        walking_ += index.box_holds(points[i].at.data()) ? 1 : 0;
    }
}

void Finder::walk(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    std::fill(owner, owner + count, -1);
    std::size_t stuck = 0;
    for (int round = 0; walking_ > 0 && round < max_rounds; ++round)
        walking_ = step_walks(index, points, walks_.data(), walking_, owner, stuck_.data(), stuck);
    std::uint64_t arrived = 0;
    for (std::size_t i = 0; i < count; ++i) {
        feature[i] = owner[i] >= 0 ? Feature::interior : Feature::outside;
        arrived += owner[i] >= 0 ? 1 : 0;
    }
    tests.add(Tier::filter, arrived);
    if (!data_.proof.contested.empty()) {
        std::array<std::uint32_t, chunk_size> contested;
        std::size_t contested_count = 0;
        for (std::size_t i = 0; i < count; ++i) {
            contested[contested_count] = static_cast<std::uint32_t>(i);
            contested_count += owner[i] >= 0 && data_.proof.is_contested(owner[i]) ? 1 : 0;
        }
        if (contested_count != 0)
            data_.contested_cells().find_owners(points, contested.data(), contested_count, owner, feature, tests);
    }
    for (std::size_t i = 0; i < stuck; ++i) resolve(points[stuck_[i].point], stuck_[i], owner, feature, tests);
    for (std::size_t i = 0; i < walking_; ++i) resolve(points[walks_[i].point], walks_[i], owner, feature, tests);
}

void Finder::resolve(const PointRecord& point, Walk stuck, Place* owner, Feature* feature, TierCounts& tests) {
    const CellIndex& index = data_.index;
    // At the end of the domain the point may still be in another part of it, in a contested cell in others as well.
    WeightSigns signs = WeightSigns::degenerate_simplex();
    if (stuck.cell >= 0 && !data_.proof.is_contested(stuck.cell))
        signs = cell_signs(index, stuck.cell, point.at.data(), tests);
    if (!signs.contains()) {
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
