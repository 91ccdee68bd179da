// The nearest triangle: floating point leaves those that it cannot tell apart, and says what is certain of them; the
// rest is decided and rounded exactly.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"
#include "mesh/locate/near_bounds.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/locate/nearest.hpp"
#include "mesh/locate/surface/surface_data.hpp"

namespace barycert::locate {
namespace {

SurfaceNearest none() {
    return {Nearest{.distance = std::numeric_limits<double>::infinity()}};
}

void round_on(const Point3& p, const NearFeature& f, SurfaceNearest& to) {
    to.distance = distance_to(p, f);
    to.point = projection_on(p, f);
    for (double& x : to.point) x += 0.0;  // a zero has no sign
    to.weights = weights_of(p, f);
}

/// Points side by side in space, at most `most` of them.
class PointCluster {
public:
    static constexpr std::size_t most = 512;
    /// More candidates of one point are settled by themselves: far more would take the memory of all others.
    static constexpr std::size_t many = 64;

    PointCluster(const SurfaceData& data, double limit) : data_(data), groups_(data.near_groups()), limit_(limit) {
        // The limit is that of rounded distances.
        const double reach = std::ldexp(limit, groups_.exponent) * (1 + 0x1p-50) + 0x1p-500;
        square_ = reach * reach * (1 + 0x1p-50);
    }

    void add(const double* point, SurfaceNearest* to) {
        *to = none();
        NearPair pair{};
        if (!groups_.take(point, pair.point)) return far(point, *to);
        find_candidates(groups_, pair.point, square_, hint_, found_);
        const std::size_t count = found_.number.size();
        if (count > many) return exact(point, nearest_of_many(pair), *to);
        queries_.push_back({point, to, pairs_.size(), count});
        for (const std::uint32_t t : found_.number) {
            pairs_.push_back(with_corners(pair, t));
            places_.push_back(groups_.order[t]);
        }
    }
    bool full() const { return queries_.size() >= most; }

    void finish() {
        masks_.resize(pairs_.size());
        if (!pairs_.empty()) classify_nearest(pairs_.data(), pairs_.size(), masks_.data());
        for (const Query& query : queries_) {
            if (query.count == 0) continue;
            if (!settle(query)) exact(query.point, std::span(places_).subspan(query.first, query.count), *query.to);
        }
        for (std::size_t corners = 1; corners <= 3; ++corners) round(corners);
        queries_.clear();
        pairs_.clear();
        places_.clear();
    }

private:
    struct Query {
        const double* point;
        SurfaceNearest* to;
        std::size_t first, count;  ///< its pairs
    };
    struct Settled {
        Query query;
        std::size_t pair;
        std::array<std::uint8_t, 3> corners;  ///< of the feature, by ascending node
    };

    NearPair with_corners(NearPair pair, std::uint32_t t) const {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < 3; ++k) pair.at[c][k] = groups_.triangles[t / 8].at[c][k][t % 8];
        }
        return pair;
    }

    /// Returns the places of the candidates whose rounded distance is least, and of those where it is not certain:
    /// rounding keeps the order, so no other is nearest.
    std::vector<std::uint32_t> nearest_of_many(const NearPair& of) const {
        const std::size_t count = found_.number.size();
        std::vector<NearPair> pairs;
        for (const std::uint32_t t : found_.number) pairs.push_back(with_corners(of, t));
        std::vector<std::uint8_t> masks(count);
        classify_nearest(pairs.data(), count, masks.data());
        std::vector<double> distance(count, -1);
        double least = std::numeric_limits<double>::infinity();
        for (int corners = 1; corners <= 3; ++corners) {
            std::vector<NearPair> in_order;
            std::vector<std::size_t> which;
            for (std::size_t i = 0; i < count; ++i) {
                if (masks[i] == 0 || std::popcount(masks[i]) != corners) continue;
                which.push_back(i);
                in_order.push_back(pairs[i]);
                for (std::size_t c = 0, at = 0; c < 3; ++c) {
                    if ((masks[i] >> c & 1) != 0) std::copy_n(pairs[i].at[c], 3, in_order.back().at[at++]);
                }
            }
            if (which.empty()) continue;
            std::vector<NearRounded> rounded(which.size());
            round_nearest(in_order.data(), which.size(), corners, rounded.data());
            for (std::size_t i = 0; i < which.size(); ++i) {
                if (!rounded[i].certain) continue;
                distance[which[i]] = rounded[i].distance;
                least = std::min(least, rounded[i].distance);
            }
        }
        std::vector<std::uint32_t> places;
        for (std::size_t i = 0; i < count; ++i) {
            if (distance[i] < 0 || distance[i] == least) places.push_back(groups_.order[found_.number[i]]);
        }
        return places;
    }

    /// Which nodes: of each candidate, if they are certain.
    std::array<Mesh::Index, 3> nodes_of(std::size_t pair, std::array<std::uint8_t, 3>& order) const {
        std::array<Mesh::Index, 3> nodes{-1, -1, -1};
        const auto& corner = data_.triangles.index.cells[places_[pair]].node;
        std::size_t n = 0;
        for (std::uint8_t c = 0; c < 3; ++c) {
            if ((masks_[pair] >> c & 1) == 0) continue;
            const Mesh::Index node = data_.triangles.node(corner[c]);
            std::size_t at = n++;
            for (; at > 0 && nodes[at - 1] > node; --at) nodes[at] = nodes[at - 1], order[at] = order[at - 1];
            nodes[at] = node;
            order[at] = c;
        }
        return nodes;
    }

    /// All candidates have the same certain feature, or there is but one.
    bool settle(const Query& query) {
        std::array<std::uint8_t, 3> order{}, ignored{};
        if (masks_[query.first] == 0) return false;
        const std::array<Mesh::Index, 3> nodes = nodes_of(query.first, order);
        Mesh::Index lowest = data_.triangles.number(places_[query.first]);
        for (std::size_t i = query.first + 1; i < query.first + query.count; ++i) {
            if (masks_[i] == 0 || nodes_of(i, ignored) != nodes) return false;
            lowest = std::min(lowest, data_.triangles.number(places_[i]));
        }
        query.to->cell = lowest;
        query.to->nodes = nodes;
        take_own_nodes(*query.to, &order);
        settled_[static_cast<std::size_t>(std::popcount(masks_[query.first])) - 1].push_back(
            {query, query.first, order});
        return true;
    }

    /// Nodes at one place are one here, and so may be another triangle's: makes them those of the triangle, of several
    /// the lowest, ascending, and `order` with them.
    void take_own_nodes(SurfaceNearest& to, std::array<std::uint8_t, 3>* order = nullptr) const {
        if (!data_.triangles.joined) return;
        const Surface& s = *data_.surface;
        const auto at = [&](Mesh::Index n) { return &s.points[3 * static_cast<std::size_t>(n)]; };
        for (std::size_t i = 0; i < 3 && to.nodes[i] >= 0; ++i) {
            Mesh::Index lowest = -1;
            for (std::size_t c = 0; c < 3; ++c) {
                const Mesh::Index own = s.cells[3 * static_cast<std::size_t>(to.cell) + c];
                if (std::equal(at(own), at(own) + 3, at(to.nodes[i])) && (lowest < 0 || own < lowest)) lowest = own;
            }
            to.nodes[i] = lowest;
            for (std::size_t k = i; k > 0 && to.nodes[k] < to.nodes[k - 1]; --k) {
                std::swap(to.nodes[k], to.nodes[k - 1]);
                if (order != nullptr) std::swap((*order)[k], (*order)[k - 1]);
            }
        }
    }

    void round(std::size_t corners) {
        std::vector<Settled>& all = settled_[corners - 1];
        rounded_.resize(all.size());
        in_order_.resize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const NearPair& from = pairs_[all[i].pair];
            std::copy_n(from.point, 3, in_order_[i].point);
            for (std::size_t c = 0; c < 3; ++c)
                std::copy_n(from.at[c < corners ? all[i].corners[c] : all[i].corners[0]], 3, in_order_[i].at[c]);
        }
        if (!all.empty()) round_nearest(in_order_.data(), all.size(), static_cast<int>(corners), rounded_.data());
        for (std::size_t i = 0; i < all.size(); ++i) {
            SurfaceNearest& to = *all[i].query.to;
            const NearRounded& from = rounded_[i];
            bool exact_unit = from.certain && from.distance >= 0x1p-900;
            const auto out = [&](double x) {
                const double in_own_unit = x * groups_.from_unit;
                exact_unit = exact_unit && in_own_unit * groups_.to_unit == x;
                return in_own_unit;
            };
            to.distance = out(from.distance);
            for (std::size_t k = 0; k < 3; ++k) to.point[k] = out(from.at[k]) + 0.0;
            std::copy_n(from.weights, 3, to.weights.begin());
            if (!exact_unit) round_exactly(all[i].query.point, to);
            keep_within(to);
        }
        all.clear();
    }

    void keep_within(SurfaceNearest& to) const {
        if (!(to.distance <= limit_)) to = none();
    }

    /// Computes the answer for a point whose triangle and nodes are known.
    void round_exactly(const double* point, SurfaceNearest& to) const {
        const NearFeature f = near_feature(to.nodes, data_.surface->points, 3);
        round_on({point[0], point[1], point[2]}, f, to);
    }

    /// Decides between candidates that floating point cannot tell apart.
    void exact(const double* point, std::span<const std::uint32_t> places, SurfaceNearest& to) const {
        take(find_nearest_of(data_.triangles.index, places, point, limit_), point, to);
    }

    /// Answers for points that are far away, or not exact in the unit.
    void far(const double* point, SurfaceNearest& to) const {
        take(find_nearest(data_.triangles.index, data_.far_tree(), point, limit_), point, to);
    }

    void take(const Nearest& found, const double* point, SurfaceNearest& to) const {
        static_cast<Nearest&>(to) = found;
        if (to.cell < 0) return;
        take_own_nodes(to);
        round_exactly(point, to);
    }

    const SurfaceData& data_;
    const NearGroups& groups_;
    double limit_, square_ = 0;
    std::uint32_t hint_ = UINT32_MAX;
    NearCandidates found_;
    std::vector<Query> queries_;
    std::vector<NearPair> pairs_, in_order_;
    std::vector<std::uint32_t> places_;  ///< triangles of the pairs
    std::vector<std::uint8_t> masks_;
    std::array<std::vector<Settled>, 3> settled_;
    std::vector<NearRounded> rounded_;
};

}  // namespace

void SurfaceData::nearest(std::span<const double* const> points, double limit,
                          std::span<SurfaceNearest* const> to) const {
    if (empty() || !(limit >= 0)) {
        for (SurfaceNearest* const one : to) *one = none();
        return;
    }
    PointCluster block(*this, limit);
    for (std::size_t i = 0; i < points.size(); ++i) {
        block.add(points[i], to[i]);
        if (block.full()) block.finish();
    }
    block.finish();
}

void SurfaceData::nearest_on(Mesh::Index triangle, const double* p, SurfaceNearest& to) const {
    to = none();
    if (triangle < 0) return;
    NearCell cell{3, true};
    const Mesh::Index* const corners = &surface->cells[3 * static_cast<std::size_t>(triangle)];
    std::copy_n(corners, 3, cell.nodes.begin());
    std::sort(cell.nodes.begin(), cell.nodes.begin() + 3);
    for (std::size_t i = 0; i < 3; ++i)
        std::copy_n(&surface->points[3 * static_cast<std::size_t>(cell.nodes[i])], 3, cell.at[i].begin());
    const Point3 point{p[0], p[1], p[2]};
    NearFeature f;
    nearest_feature(cell, point, guess_nearest(cell, point).mask, f);
    to.cell = triangle;
    to.nodes = f.nodes;
    round_on(point, f, to);
}

}  // namespace barycert::locate
