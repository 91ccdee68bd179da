#include "mesh/tetrahedra_search.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/vectors.hpp"
#include "core/whole_points.hpp"
#include "mesh/face_cut.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;
/// By places among the nodes of the surface, which ascend with their numbers.
using Place = std::uint8_t;
using Triangle = std::array<Place, 3>;
using Tetrahedron = std::array<Place, 4>;
using PlacePair = std::array<Place, 2>;
constexpr std::size_t most_nodes = 256;
using Places = std::bitset<most_nodes>;

/// A search asks for so many orientations and determinants at most: tenths of a second. Cells of octrees with up to 26
/// nodes mostly take a tenth of it and less (tests/mesh/solid_cut_test.cpp).
constexpr std::size_t budget = 500000;

/// An oriented triangle, from its lowest place on.
Triangle from_first(Triangle t) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
}

Triangle reversed(const Triangle& t) {
    return {t[0], t[2], t[1]};
}

/// Seen from outside, as triangles of the surface; opposite to each corner of a tetrahedron of positive orientation.
std::array<Triangle, 4> facets_of(const Tetrahedron& t) {
    const auto [x, a, b, c] = t;
    return {from_first({a, b, c}), from_first({x, c, b}), from_first({x, a, c}), from_first({x, b, a})};
}

Places set_of(std::span<const Place> some) {
    Places places;
    for (const Place p : some) places.set(p);
    return places;
}

/// Which nodes lie strictly on either side of a triangle's plane, that seen from outside.
struct Sides {
    Places inner, outer;
};

/// Orientations of all nodes, each asked once.
class Orientations {
public:
    explicit Orientations(std::vector<const double*> points) : points_(std::move(points)) {}

    std::size_t count() const { return points_.size(); }
    std::size_t work() const { return work_; }

    Sides sides(const Triangle& t) {
        Triangle ascending = t;
        std::ranges::sort(ascending);
        const bool even = (t[0] < t[1]) == ((t[1] < t[2]) == (t[0] < t[2]));
        const auto [at, is_new] =
            known_.try_emplace(static_cast<std::uint32_t>(ascending[0] << 16U | ascending[1] << 8U | ascending[2]));
        Sides& own = at->second;
        for (std::size_t p = 0; is_new && p < points_.size(); ++p) {
            ++work_;
            const Sign sign = orient3d(points_[p], points_[ascending[0]], points_[ascending[1]], points_[ascending[2]]);
            own.inner[p] = sign == Sign::positive;
            own.outer[p] = sign == Sign::negative;
        }
        return even ? own : Sides{own.outer, own.inner};
    }

    /// A plane along both edges has the one set on one closed side, not all in it, and the other on the other one.
    bool separates(const PlacePair& e, const PlacePair& f, std::span<const Place> one, std::span<const Place> other) {
        int first = 0, second = 0;
        const auto add = [&](std::span<const Place> all, int& common) {
            for (const Place node : all) {
                ++work_;
                const auto own = static_cast<int>(
                    det3d(points_[e[0]], points_[e[1]], points_[f[0]], points_[f[1]], points_[e[0]], points_[node]));
                if (own * common < 0) return false;
                common = own != 0 ? own : common;
            }
            return true;
        };
        return add(one, first) && first != 0 && add(other, second) && second != first;
    }

private:
    std::vector<const double*> points_;
    std::unordered_map<std::uint32_t, Sides> known_;
    std::size_t work_ = 0;
};

class TetrahedraSearch {
public:
    TetrahedraSearch(std::vector<const double*> points, std::vector<Triangle> surface)
        : nodes_(std::move(points)), surface_(std::move(surface)) {
        for (Triangle& t : surface_) t = from_first(t);
        std::ranges::sort(surface_);
        is_convex_ = std::ranges::all_of(surface_, [&](const Triangle& t) { return nodes_.sides(t).outer.none(); });
    }

    /// True if the surface is filled.
    bool run() { return fill(surface_); }

    const std::vector<Tetrahedron>& found() const { return chosen_; }

private:
    /// No other node lies in the closed tetrahedron, which has positive orientation.
    bool holds_no_node(const Tetrahedron& t) {
        Places beyond;
        for (const Triangle& facet : facets_of(t)) beyond |= nodes_.sides(facet).outer;
        return beyond.count() + 4 == nodes_.count();
    }

    static bool are_separated(const Sides& by, const Places& one, const Places& other) {
        return ((one & by.inner).none() && (other & by.outer).none()) ||
               ((one & by.outer).none() && (other & by.inner).none());
    }

    /// The interior of the tetrahedron and the relative interior of the other set, a tetrahedron or a triangle, are
    /// disjoint: a plane through a facet of one of them, or along an edge of each, separates them.
    bool is_apart(const Tetrahedron& t, std::span<const Place> other) {
        const Places own = set_of(t), its = set_of(other);
        for (const Triangle& facet : facets_of(t)) {
            if ((its & nodes_.sides(facet).inner).none()) return true;
        }
        if (other.size() == 4) {
            for (const Triangle& facet : facets_of({other[0], other[1], other[2], other[3]})) {
                if ((own & nodes_.sides(facet).inner).none()) return true;
            }
        } else {
            const Sides by = nodes_.sides({other[0], other[1], other[2]});
            if ((own & by.inner).none() || (own & by.outer).none()) return true;
        }
        const std::vector<PlacePair> edges = edges_of(t), its_edges = edges_of(other);
        return std::ranges::any_of(edges, [&](const PlacePair& e) {
            return std::ranges::any_of(its_edges, [&](const PlacePair& f) { return edges_separate(e, f, t, other); });
        });
    }

    static std::vector<PlacePair> edges_of(std::span<const Place> corners) {
        std::vector<PlacePair> edges;
        for (std::size_t i = 1; i < corners.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) edges.push_back({corners[i], corners[j]});
        }
        return edges;
    }

    bool edges_separate(const PlacePair& e, const PlacePair& f, const Tetrahedron& t, std::span<const Place> other) {
        const std::size_t common = (set_of(e) & set_of(f)).count();
        if (common == 0) return nodes_.separates(e, f, t, other);
        if (common == 2) return false;
        const Place last = f[0] == e[0] || f[0] == e[1] ? f[1] : f[0];
        const Sides by = nodes_.sides({e[0], e[1], last});
        const Places own = set_of(t);
        return (own & (by.inner | by.outer)).any() && are_separated(by, own, set_of(other));
    }

    /// Nodes with which the triangle of a front makes a tetrahedron, whatever else was chosen.
    const std::vector<Place>& candidates(const Triangle& t) {
        const auto [at, is_new] = candidates_.try_emplace(t);
        if (!is_new) return at->second;
        const Places inner = nodes_.sides(t).inner;
        for (std::size_t p = 0; p < nodes_.count(); ++p) {
            const Tetrahedron own{static_cast<Place>(p), t[0], t[1], t[2]};
            if (!inner[p] || !holds_no_node(own)) continue;
            const bool meets_surface =
                !is_convex_ && !std::ranges::all_of(surface_, [&](const Triangle& s) { return is_apart(own, s); });
            if (!meets_surface) at->second.push_back(own[0]);
        }
        return at->second;
    }

    /// Apexes for a triangle of the front that the chosen tetrahedra leave free, best first.
    std::vector<Place> choices(const Triangle& t, const std::vector<Triangle>& front) {
        struct Choice {
            int closed;
            Place apex;
        };
        std::vector<Choice> all;
        for (const Place apex : candidates(t)) {
            const Tetrahedron own{apex, t[0], t[1], t[2]};
            int closed = 0;
            bool is_free = true;
            for (const Triangle& facet : facets_of(own)) {
                if (std::ranges::binary_search(front, facet))
                    ++closed;
                else
                    is_free = is_free && !std::ranges::binary_search(front, reversed(facet));
            }
            if (is_free && std::ranges::all_of(chosen_, [&](const Tetrahedron& c) { return is_apart(own, c); }))
                all.push_back({closed, apex});
        }
        std::ranges::stable_sort(all, std::greater(), &Choice::closed);
        std::vector<Place> apexes;
        for (const Choice& choice : all) apexes.push_back(choice.apex);
        return apexes;
    }

    /// `front` ascends.
    bool fill(const std::vector<Triangle>& front) {
        if (front.empty()) return true;
        const Triangle* narrowest = nullptr;
        std::size_t fewest = 0;
        for (const Triangle& t : front) {
            const std::size_t own = candidates(t).size();
            if (own == 0 || nodes_.work() > budget) return false;
            if (narrowest == nullptr || own < fewest) narrowest = &t, fewest = own;
        }
        const Triangle base = *narrowest;
        for (const Place apex : choices(base, front)) {
            const Tetrahedron own{apex, base[0], base[1], base[2]};
            std::vector<Triangle> closed, next;
            for (const Triangle& facet : facets_of(own)) {
                if (std::ranges::binary_search(front, facet))
                    closed.push_back(facet);
                else
                    next.push_back(reversed(facet));
            }
            std::ranges::sort(closed);
            std::ranges::set_difference(front, closed, std::back_inserter(next));
            std::ranges::sort(next);
            chosen_.push_back(own);
            if (fill(next)) return true;
            chosen_.pop_back();
            if (nodes_.work() > budget) return false;
        }
        return false;
    }

    Orientations nodes_;
    std::vector<Triangle> surface_;
    bool is_convex_ = false;
    std::map<Triangle, std::vector<Place>> candidates_;
    std::vector<Tetrahedron> chosen_;
};

/// The sign of the volume that the triangles enclose: the sum over cones from the first point.
int sign_of_volume(const std::vector<const double*>& points, const std::vector<Triangle>& triangles) {
    core::WholePoints whole{};
    for (const double* const p : points) whole.add(p);
    core::WholeNumber sum = 0;
    const core::WholeVector origin = whole.at(points.front());
    for (const auto& [a, b, c] : triangles) {
        const auto at = [&](Place p) { return base::minus(whole.at(points[p]), origin); };
        sum += base::dot(at(a), base::cross(at(b), at(c)));
    }
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

}  // namespace

std::vector<std::array<Index, 4>> find_tetrahedra(const NumberedNodes& nodes, std::span<const Index> own,
                                                  std::span<const NodeTriangle> surface) {
    // Larger ones are above the budget.
    if (own.size() > most_nodes) return {};
    std::vector<const double*> points;
    for (const Index node : own) points.push_back(nodes.at(node));
    std::vector<Triangle> triangles;
    for (const NodeTriangle& t : surface) {
        Triangle& places = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at =
                std::ranges::lower_bound(own, nodes.number(t[k]), {}, [&](Index node) { return nodes.number(node); });
            places[k] = static_cast<Place>(at - own.begin());
        }
    }
    const int sign = sign_of_volume(points, triangles);
    if (sign == 0) return {};
    // det(a, b, c) > 0 of what is seen from outside: orient3d(inner, a, b, c) > 0.
    if (sign < 0) {
        for (Triangle& t : triangles) std::swap(t[1], t[2]);
    }
    TetrahedraSearch search(std::move(points), std::move(triangles));
    std::vector<std::array<Index, 4>> found;
    if (!search.run()) return found;
    for (Tetrahedron t : search.found()) {
        if (sign < 0) std::swap(t[2], t[3]);
        found.push_back({own[t[0]], own[t[1]], own[t[2]], own[t[3]]});
    }
    return found;
}

}  // namespace barycert::mesh
