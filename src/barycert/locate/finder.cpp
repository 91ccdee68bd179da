#include "barycert/locate/finder.hpp"

#include <algorithm>
#include <limits>

namespace barycert::locate {
namespace {

/// A walk in floating point can go round in circles, in cells that are almost flat or not Delaunay.
constexpr int max_rounds = 128;

/// A chunk whose walks start within so many cells a point reads all of these: memory comes in order then.
constexpr std::size_t many_cells = 1;

constexpr std::size_t features = 8;  // more than there are

}  // namespace

void Finder::find(const PointRecord* points, std::size_t count, Place* owner, Feature* feature,
                  LocationCounts& counts) {
    asked_count_ = 0;
    if (data_.method == Method::walk) {
        walk(points, count, owner, feature, counts.tests);
    } else {
        std::iota(asked_.begin(), asked_.begin() + static_cast<std::ptrdiff_t>(count), 0);
        asked_count_ = count;
        std::fill(owner, owner + count, -1);
        std::fill(feature, feature + count, Feature::outside);
    }
    if (asked_count_ != 0) ask_candidates(points, owner, feature, counts.tests);
    std::array<std::uint64_t, features> found{};
    for (std::size_t i = 0; i < count; ++i) ++found[static_cast<std::size_t>(feature[i])];
    for (std::size_t f = 0; f < features; ++f) counts.add(static_cast<Feature>(f), found[f]);
}

void Finder::settle(const PointRecord& point, Place stuck, Place& owner, Feature& feature) {
    TierCounts ignored;
    owner = -1;
    feature = Feature::outside;
    asked_count_ = 0;
    resolve(point, {0, stuck}, &owner, &feature, ignored);
    if (asked_count_ != 0) ask_candidates(&point, &owner, &feature, ignored);
}

void Finder::expect(const SortedPoints& sorted, std::size_t first, std::size_t count) {
    const CellIndex& index = data_.index;
    expected_.count = count;
    ahead_.count = ahead_.done = 0;
    sorted.ask_for(first, count, ahead_);
    if (data_.method != Method::walk) return;
    Place least = std::numeric_limits<Place>::max(), most = -1;
    for (std::size_t i = 0; i < count; ++i) {
        const Place cell = index.start(sorted.bin(first + i));
        expected_.walks[i] = {static_cast<std::uint32_t>(i), cell};
        least = std::min(least, cell);
        most = std::max(most, cell);
    }
    least = std::max(least, fetched_cells_);
    expected_fetch_ = static_cast<std::int64_t>(most) - least > static_cast<std::int64_t>(many_cells * count);
    if (expected_fetch_) {
        for (std::size_t i = 0; i < count; ++i)
            ahead_.add(&index.cells[static_cast<std::size_t>(expected_.walks[i].cell)]);
        return;
    }
    if (least > most) return;
    const auto last_node = [&](Place cell) {
        const auto& node = index.cells[static_cast<std::size_t>(cell)].node;
        return *std::max_element(node.begin(), node.end());
    };
    const Place nodes = std::max(fetched_nodes_, last_node(least)), nodes_end = last_node(most);
    ahead_.add(index.cells.data() + least, index.cells.data() + most + 1);
    ahead_.add(index.original.data() + least, index.original.data() + most + 1);
    if (nodes < nodes_end) ahead_.add(nodes_ + nodes, nodes_ + nodes_end + 1);
    fetched_cells_ = most + 1;
    fetched_nodes_ = std::max(nodes, nodes_end);
}

void Finder::begin() {
    ahead_.ask(ahead_.count);
    std::copy_n(expected_.walks.begin(), expected_.count, walking_.walks.begin());
    walking_.count = expected_.count;
    fetch_ = expected_fetch_;
}

void Finder::walk(const PointRecord* points, std::size_t count, Place* owner, Feature* feature, TierCounts& tests) {
    std::fill(owner, owner + count, -1);
    std::fill(feature, feature + count, Feature::outside);
    arrived_.count = stuck_.count = 0;
    for (int round = 0; walking_.count > 0 && round < max_rounds; ++round)
        walking_.count = step_walks(data_.index, nodes_, points, walking_.walks.data(), walking_.count,
                                    fetch_, ahead_, arrived_, stuck_);
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
