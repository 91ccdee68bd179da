#include "mesh/locate/mapped/nearest_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "core/isoparametric/near_patch.hpp"
#include "core/isoparametric/patch.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/mapped/boundary.hpp"
#include "mesh/locate/mapped/cell_sides.hpp"
#include "mesh/locate/mapped/square_parts.hpp"
#include "mesh/locate/near_bounds.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/locate/nearest.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;
using iso::Params, iso::PatchKind;

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// A point that may be the nearest, with bounds of the square of its distance, less that of the place o.
struct NearCandidate {
    std::unique_ptr<PointOnSide> on = {};
    Mesh::Index cell = -1;
    Real low = 0, high = 0;  ///< where `bounded`, low bounds the squares of all points of a part
    bool bounded = false;
    bool straight = false;  ///< that of cells without maps
};

class SideSearch {
public:
    SideSearch(const LocatorData& data, const double* point)
        : data_(data), boundary_(data.mapped->boundary()), point_(point) {
        std::copy_n(point, data.index.dimension(), p_.begin());
    }

    NearestInMaps run(double limit) {
        choose_place();
        add_straight();
        if (!boundary_.groups().empty()) visit(0);
        NearestInMaps found = nearest();
        if (found.nearest.distance <= limit) return found;
        return {.nearest = {.distance = std::numeric_limits<double>::infinity()}, .off = 0, .on = nullptr};
    }

private:
    /// Parts of edges and facets that are looked at, at most: some hundred are where there is one nearest point.
    static constexpr std::size_t most_parts = 20000;

    Point3 in_space(const double* at) const {
        Point3 x{};
        std::copy_n(at, data_.index.dimension(), x.begin());
        return x;
    }
    NearPlace place(const Point3& at) const { return {p_, at, {}}; }
    Real key(const index::Box& box) const { return farther(place(box.nearest(p_)), o_).low(); }

    /// o: a vertex that is near.
    void choose_place() {
        o_ = place(p_);
        const auto& groups = boundary_.groups();
        if (groups.empty()) return;
        std::size_t at = 0;
        while (groups[at].count == 0) {
            const std::size_t right = groups[at].first;
            at = key(groups[at + 1].box) <= key(groups[right].box) ? at + 1 : right;
        }
        const auto corners = vertices_of_side(boundary_.side(boundary_.facet(groups[at].first)));
        NearPlace best = place(in_space(corners.front().patch.nodes[0].at));
        for (const Side& corner : corners) {
            const NearPlace own = place(in_space(corner.patch.nodes[0].at));
            if (farther(own, best).high() < 0) best = own;
        }
        o_ = best;
    }

    /// The nearest point of cells without maps.
    void add_straight() {
        straight_ = find_nearest(data_, point_, std::numeric_limits<double>::infinity());
        if (straight_.cell < 0) return;
        const NearFeature feature = near_feature(straight_.nodes, data_.mesh->points, data_.index.dimension());
        if (feature.count == 0) return;
        if (boundary_.groups().empty()) o_ = place(feature.at[0]);
        const NearBest best(p_, feature);
        const Estimate more = farther(best.place, o_);
        NearCandidate found{.cell = straight_.cell, .straight = true};
        const auto count = static_cast<std::size_t>(feature.count);
        found.on = std::make_unique<PointOnSide>(straight_side({feature.nodes.data(), count}, *data_.mesh), point_);
        const std::array<double, 3> weights = weights_of(p_, feature);
        const Params<double> about{count > 1 ? weights[1] : 0, count > 2 ? weights[2] : 0};
        found.on->at.take(about);
        if (count > 1) {
            if (const auto critical = found.on->at.critical(about)) found.on->at.take(*critical);
        }
        found.low = more.low() - best.slack;
        found.high = more.high() + best.slack;
        keep(std::move(found));
    }

    void keep(NearCandidate candidate) {
        upper_ = candidate.high < upper_ ? candidate.high : upper_;
        if (!(candidate.low > upper_)) candidates_.push_back(std::move(candidate));
    }

    void visit(std::size_t number) {
        const MapBoundary::Group& group = boundary_.groups()[number];
        if (key(group.box) > upper_) return;
        if (group.count == 0) {
            const std::size_t left = number + 1, right = group.first;
            const bool first = key(boundary_.groups()[left].box) <= key(boundary_.groups()[right].box);
            visit(first ? left : right);
            return visit(first ? right : left);
        }
        for (std::size_t i = group.first; i < group.first + std::size_t{group.count}; ++i) {
            const Side facet = boundary_.side(boundary_.facet(i));
            for (const Side& vertex : vertices_of_side(facet)) add_vertex(vertex);
            for (const Side& edge : edges_of_side(facet)) explore(edge);
            explore(facet);
        }
    }

    bool is_new(const Side& side) {
        if (std::ranges::any_of(seen_, [&](const Side& other) { return other.same(side); })) return false;
        seen_.push_back(side);
        return true;
    }

    void add_vertex(const Side& vertex) {
        if (!is_new(vertex)) return;
        const Estimate more = farther(place(in_space(vertex.patch.nodes[0].at)), o_);
        if (more.low() > upper_) return;
        keep({.on = std::make_unique<PointOnSide>(vertex, point_), .low = more.low(), .high = more.high()});
    }

    /// Searches an edge or a facet.
    void explore(const Side& side) {
        const SquareOfDistance square(side.patch, p_, o_.corner);
        const Real error = square.error();
        std::vector<SquarePart> parts{SquarePart(square, side.patch.kind)};
        if (parts.back().least() - error > upper_ || !is_new(side)) return;
        const iso::NearPatch near(side.patch, point_);
        std::vector<iso::Critical> known;
        while (!parts.empty()) {
            const SquarePart part = parts.back();
            parts.pop_back();
            const Real low = part.least() - error;
            if (low > upper_) continue;
            Real value = 0;
            const Params<double> corner = part.lowest_corner(value);
            upper_ = std::min(upper_, value + error);
            const auto holds = [&](const iso::Critical& c) { return part.within(c.about, c.unique); };
            if (part.slopes(error) || std::ranges::any_of(known, holds)) continue;
            if (const auto found = near.critical(part.middle())) {
                if (!is_known(*found, known)) {
                    known.push_back(*found);
                    add_critical(side, *found, square);
                }
                if (holds(*found)) continue;
            }
            if (++parts_ > most_parts || part.most() - part.least() <= 2 * error || part.width() < 0x1p-40) {
                NearCandidate rest{.low = low, .high = value + error, .bounded = true};
                rest.on = std::make_unique<PointOnSide>(side, point_);
                rest.on->at.take(corner);
                keep(std::move(rest));
                continue;
            }
            for (const SquarePart& half : part.halves()) parts.push_back(half);
            if (parts.back().least() > parts[parts.size() - 2].least())
                std::swap(parts.back(), parts[parts.size() - 2]);
        }
    }

    static bool is_known(const iso::Critical& found, const std::vector<iso::Critical>& known) {
        return std::ranges::any_of(known, [&](const iso::Critical& c) {
            return std::abs(c.about[0] - found.about[0]) < c.unique && std::abs(c.about[1] - found.about[1]) < c.unique;
        });
    }

    void add_critical(const Side& side, const iso::Critical& critical, const SquareOfDistance& square) {
        const Real value = square.at(critical.about), error = square.error();
        if (value - error > upper_) return;
        NearCandidate found{.low = value - error, .high = value + error};
        found.on = std::make_unique<PointOnSide>(side, point_);
        found.on->at.take(critical);
        if (found.on->at.inside()) keep(std::move(found));
    }

    void find_cell(NearCandidate& of) const {
        if (of.cell < 0) of.cell = data_.mapped->first_cell(boundary_.lowest_with(of.on->side));
    }

    /// Whether x is to be taken before y; both are as near.
    bool precedes(NearCandidate& x, NearCandidate& y) const {
        find_cell(x);
        find_cell(y);
        if (x.cell != y.cell) return x.cell < y.cell;
        const iso::Patch &a = x.on->side.patch, &b = y.on->side.patch;
        if (a.variables() != b.variables()) return a.variables() < b.variables();
        if (const auto p = x.on->side.corners(), q = y.on->side.corners(); p != q) return p < q;
        return x.on->at.about() < y.on->at.about();
    }

    NearestInMaps nearest() {
        std::erase_if(candidates_, [&](const NearCandidate& c) { return c.low > upper_; });
        if (candidates_.empty()) return {.nearest = straight_, .off = 0, .on = nullptr};
        const bool bounded = std::ranges::any_of(candidates_, &NearCandidate::bounded);
        NearCandidate* best = &candidates_.front();
        for (NearCandidate& other : candidates_) {
            if (&other == best) continue;
            const int order = bounded ? (other.high < best->high   ? -1
                                         : other.high > best->high ? 1
                                                                   : 0)
                                      : other.on->at.compare(best->on->at);
            if (order < 0 || (order == 0 && precedes(other, *best))) best = &other;
        }
        if (best->straight && !bounded) return {.nearest = straight_, .off = 0, .on = nullptr};
        find_cell(*best);
        const iso::RoundedDistance distance = best->on->at.distance();
        NearestInMaps found{.nearest = {.cell = best->cell, .distance = distance.value}, .off = distance.off};
        const std::array<Mesh::Index, 4> corners = best->on->side.corners();
        std::copy_n(corners.begin(), 3, found.nearest.nodes.begin());
        if (bounded) {
            Real least = infinite, own = 0;
            for (const NearCandidate& c : candidates_) least = std::min(least, c.low);
            for (const Real away : o_.away) own += away * away;
            const Real lowest = std::sqrt(std::max(Real{0}, least + own * (1 - 0x1p-50L))) * (1 - 0x1p-50L);
            found.off += std::max(0.0, static_cast<double>((distance.value - lowest) * (1 + 0x1p-50L)));
        }
        if (best->straight) return {.nearest = straight_, .off = found.off, .on = nullptr};
        found.on = std::move(best->on);
        return found;
    }

    const LocatorData& data_;
    const MapBoundary& boundary_;
    const double* point_;
    Point3 p_{};
    NearPlace o_{};
    Real upper_ = infinite;  ///< no nearest point has a larger square
    Nearest straight_;
    std::vector<NearCandidate> candidates_;
    std::vector<Side> seen_;
    std::size_t parts_ = 0;
};

}  // namespace

NearestInMaps nearest_in_maps(const LocatorData& data, const double* point, double limit) {
    if (!(limit >= 0) || data.index.cell_count() == 0)
        return {.nearest = {.distance = std::numeric_limits<double>::infinity()}, .off = 0, .on = nullptr};
    return SideSearch(data, point).run(limit);
}

}  // namespace barycert::locate
