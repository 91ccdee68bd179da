// Decides what the triangles of a surface count in winding numbers, shell by shell (W2 of surface_locator.hpp).
//
// Why a sum of crossings tells where a point lies. Let each triangle count a whole number of times, so that around each
// edge those that go along it one way count as much as those that go the other way. Then the sum of what a ray crosses
// is the same for all rays from a point, changes on triangles alone, and is 0 far away. So it is for a shell whose
// edges have as many triangles one way as the other, each counting 1. And so it is where each triangle counts by how
// its two sides lie to the unbounded part U of space around its shell: 1 if U is where its normal points and not behind
// it, -1 if U is behind it alone, else 0. That is the closed surface around U, turned: the sum is 1 in what the shell
// encloses, 0 in U. Modulo 2 the same holds where all edges have an even number of triangles.
//
// A triangle without an area crosses no ray, but its edges join others: it counts as long as they are three.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/surface_locator.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/integer.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/index/open_sheets.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/index/triangles.hpp"
#include "mesh/locate/surface/surface_data.hpp"

namespace barycert::locate {
namespace {

using base::DisjointSets;

bool is_loop(const Ridge& r) {
    return r.nodes >> 32 == (r.nodes & 0xFFFFFFFFU);
}

/// Two triangles of one edge have the third node in common as well.
bool have_same_nodes(const Triangles& all, std::span<const Ridge> edge) {
    std::vector<Mesh::Index> third;
    for (const Ridge& r : edge) third.push_back(all.facets[r.facet].nodes[r.other]);
    std::ranges::sort(third);
    return std::ranges::adjacent_find(third) != third.end();
}

/// Most surfaces: each edge has as many triangles one way as the other, and no triangle is there twice.
bool all_turned_alike(const Triangles& all, const std::vector<Ridge>& edges) {
    bool alike = true;
    index::for_each_ridge(edges, [&](std::span<const Ridge> edge) {
        if (!alike || is_loop(edge[0])) return;
        const auto up = std::ranges::count_if(edge, [&](const Ridge& r) { return all.ascends(r); });
        alike = 2 * static_cast<std::size_t>(up) == edge.size() && !have_same_nodes(all, edge);
    });
    return alike;
}

/// Triangles of the same three nodes as one.
struct Merged {
    std::uint32_t first = 0;   ///< the lowest place
    std::uint32_t copies = 0;  ///< how many there are
    std::int32_t net = 0;      ///< how many more go round by ascending nodes than the other way
};

class Shells {
public:
    explicit Shells(const Triangles& all) : all_(all) {
        merge();
        edges_ = index::ridges_of(3, facets_);
        number_edges();
    }

    SideCounts count() {
        const std::vector<std::uint32_t> as_given = shells_of([](std::size_t) { return true; });
        peel();
        counts_.of.assign(all_.size(), 0);
        counts_.rules.turned = Turned::alike;
        const std::vector<std::uint32_t> shell = shells_of([&](std::size_t m) { return alive_[m] != 0; });
        std::vector<std::vector<std::uint32_t>> members(facets_.size());
        for (std::size_t m = 0; m < facets_.size(); ++m) {
            if (alive_[m] != 0) members[shell[m]].push_back(static_cast<std::uint32_t>(m));
        }
        for (const auto& some : members) {
            if (!some.empty()) decide(some);
        }
        leave_out(as_given);
        const bool counted = std::ranges::any_of(counts_.of, [](std::int8_t times) { return times != 0; });
        if (!counted || counts_.rules.open >= 0) counts_.rules.turned = Turned::open;
        return std::move(counts_);
    }

private:
    void merge() {
        std::vector<std::uint32_t> order;
        for (std::size_t f = 0; f < all_.size(); ++f) {
            const auto& n = all_.facets[f].nodes;
            if (n[0] != n[1] && n[1] != n[2]) order.push_back(static_cast<std::uint32_t>(f));
        }
        std::ranges::sort(order, {}, [&](std::uint32_t f) { return std::pair(all_.facets[f].nodes, f); });
        for (const std::uint32_t f : order) {
            if (merged_.empty() || all_.facets[f].nodes != facets_.back().nodes) {
                merged_.push_back({.first = f});
                facets_.push_back(all_.facets[f]);
            }
            ++merged_.back().copies;
            merged_.back().net += all_.odd[f] != 0 ? -1 : 1;
            of_place_.emplace_back(f, static_cast<std::uint32_t>(merged_.size() - 1));
        }
    }

    /// Ridges of one edge have one number, from 0.
    void number_edges() {
        edge_of_.resize(3 * facets_.size());
        index::for_each_ridge(edges_, [&](std::span<const Ridge> edge) {
            for (const Ridge& r : edge) edge_of_[3 * std::size_t{r.facet} + r.other] = ends_.size();
            ends_.push_back(static_cast<std::size_t>(edge.data() - edges_.data()) + edge.size());
        });
    }
    std::span<const Ridge> edge(std::size_t e) const {
        const std::size_t first = e == 0 ? 0 : ends_[e - 1];
        return std::span(edges_).subspan(first, ends_[e] - first);
    }

    /// Takes away triangles with an edge that no other one has, until there is none: they have the same on both sides.
    void peel() {
        alive_.assign(facets_.size(), 1);
        std::vector<std::uint32_t> left(ends_.size());
        std::vector<std::size_t> single;
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            left[e] = static_cast<std::uint32_t>(edge(e).size());
            if (left[e] == 1) single.push_back(e);
        }
        while (!single.empty()) {
            const auto of = edge(single.back());
            single.pop_back();
            const auto last = std::ranges::find_if(of, [&](const Ridge& r) { return alive_[r.facet] != 0; });
            if (last == of.end()) continue;
            alive_[last->facet] = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t e = edge_of_[3 * std::size_t{last->facet} + k];
                if (--left[e] == 1) single.push_back(e);
            }
        }
    }

    /// For each triangle, the lowest that it is connected with over edges; only triangles that count take part.
    template <class Counts>
    std::vector<std::uint32_t> shells_of(Counts counts) const {
        DisjointSets sets(facets_.size());
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            const Ridge* before = nullptr;
            for (const Ridge& r : edge(e)) {
                if (!counts(r.facet)) continue;
                if (before != nullptr) sets.join(before->facet, r.facet);
                before = &r;
            }
        }
        std::vector<std::uint32_t> lowest(facets_.size());
        for (std::size_t m = 0; m < lowest.size(); ++m) lowest[m] = sets.find(m);
        return lowest;
    }

    void decide(const std::vector<std::uint32_t>& shell) {
        bool balanced = true, even = true, nothing = true;
        for (const std::uint32_t m : shell) {
            nothing = nothing && merged_[m].net == 0;
            for (std::size_t k = 0; k < 3; ++k) {
                std::int64_t up = 0;
                std::uint64_t count = 0;
                const std::span<const Ridge> of = edge(edge_of_[3 * std::size_t{m} + k]);
                if (of[0].facet < m && alive_[of[0].facet] != 0) continue;  // asked before
                for (const Ridge& r : of) {
                    if (alive_[r.facet] == 0) continue;
                    up += r.other == 1 ? -merged_[r.facet].net : merged_[r.facet].net;
                    count += merged_[r.facet].copies;
                }
                balanced = balanced && up == 0;
                even = even && count % 2 == 0;
            }
        }
        if (balanced && !nothing) return count_all(shell, 1);
        if (count_regions(shell)) return lower(Turned::regions);
        if (balanced) {
            idle_.insert(idle_.end(), shell.begin(), shell.end());
        } else if (even) {
            lower(Turned::even);
            count_all(shell, SideCounts::parity);
        } else {
            open(shell);
        }
    }

    void lower(Turned to) { counts_.rules.turned = std::min(counts_.rules.turned, to); }

    void count_all(const std::vector<std::uint32_t>& shell, std::int8_t times) {
        for (const std::uint32_t m : shell) {
            for (auto copy = std::ranges::lower_bound(of_place_, m, {}, &Copy::second);
                 copy != of_place_.end() && copy->second == m; ++copy)
                counts_.of[copy->first] = times;
            if (times == SideCounts::parity) counts_.rules.by_parity += merged_[m].copies;
        }
    }

    /// By the regions that the shell encloses; false if it meets itself, or encloses none.
    bool count_regions(const std::vector<std::uint32_t>& shell) {
        std::vector<std::uint32_t> proper;
        std::vector<double> points;
        for (const std::uint32_t m : shell) {
            if (all_.is_flat(merged_[m].first)) continue;
            proper.push_back(m);
            for (const double* const corner : all_.turned(merged_[m].first))
                points.insert(points.end(), corner, corner + 3);
        }
        if (proper.empty()) return false;
        std::vector<Mesh::Index> corners(3 * proper.size()), numbers(proper.size());
        std::iota(corners.begin(), corners.end(), 0);
        std::iota(numbers.begin(), numbers.end(), 0);
        const Triangles alone = index::place_triangles(points, corners, numbers);
        if (!index::conflicting_pairs(alone.index, alone.facets, 0).empty()) return false;
        const std::vector<std::uint8_t> unbounded = unbounded_sides(alone, points);
        std::vector<std::int8_t> times(proper.size());
        std::int64_t outward = 0;
        for (std::size_t f = 0; f < alone.size(); ++f) {
            const auto i = static_cast<std::size_t>(alone.number(f));
            const Merged& m = merged_[proper[i]];
            times[i] = static_cast<std::int8_t>(unbounded[2 * f] - unbounded[2 * f + 1]);
            outward += (all_.odd[m.first] != 0 ? -times[i] : times[i]) * m.net;
        }
        if (std::ranges::count(times, 0) == std::ssize(times)) return false;
        for (std::size_t i = 0; i < proper.size(); ++i)
            counts_.of[merged_[proper[i]].first] = outward < 0 ? static_cast<std::int8_t>(-times[i]) : times[i];
        for (const std::uint32_t m : shell) counts_.rules.by_regions += merged_[m].copies;
        return true;
    }

    /// 1 for each side that looks into the unbounded part of space around a shell. The sides that look into one part,
    /// with normals away from it, are a closed surface; its volume is negative around the unbounded part.
    static std::vector<std::uint8_t> unbounded_sides(const Triangles& alone, const std::vector<double>& points) {
        DisjointSets sides(2 * alone.size());
        index::RidgeTurn turn(3, alone.facets);
        index::for_each_ridge(index::ridges_of(3, alone.facets),
                              [&](std::span<const Ridge> edge) { index::join_sides(alone, turn.sorted(edge), sides); });
        const index::ExactVolumes volumes(3, points);
        std::vector<std::uint32_t> part(2 * alone.size());  // of space, from 0
        std::uint32_t parts = 0;
        for (std::size_t s = 0; s < part.size(); ++s) part[s] = sides.find(s) == s ? parts++ : part[sides.find(s)];
        std::vector<core::Integer> six(parts);
        for (std::size_t f = 0; f < alone.size(); ++f) {
            const core::Integer cone = volumes.cone(alone.turned(f).data());
            six[part[2 * f]] = six[part[2 * f]] - cone;
            six[part[2 * f + 1]] = six[part[2 * f + 1]] + cone;
        }
        std::vector<std::uint8_t> unbounded(2 * alone.size());
        for (std::size_t s = 0; s < unbounded.size(); ++s) unbounded[s] = six[part[s]].sign() < 0 ? 1 : 0;
        return unbounded;
    }

    void open(const std::vector<std::uint32_t>& shell) {
        for (const std::uint32_t m : shell) {
            const Mesh::Index number = all_.number(merged_[m].first);
            Mesh::Index& lowest = counts_.rules.open;
            lowest = lowest < 0 ? number : std::min(lowest, number);
        }
    }

    /// Shells of which nothing is left are open, unless all of it cancels; what else was taken away is idle.
    void leave_out(const std::vector<std::uint32_t>& as_given) {
        std::vector<std::uint8_t> some_left(facets_.size()), cancels(facets_.size(), 1);
        for (std::size_t m = 0; m < facets_.size(); ++m) {
            if (alive_[m] != 0) some_left[as_given[m]] = 1;
            if (merged_[m].net != 0) cancels[as_given[m]] = 0;
        }
        std::vector<std::uint32_t> all_open;
        for (std::size_t m = 0; m < facets_.size(); ++m) {
            if (alive_[m] != 0) continue;
            const bool idle = some_left[as_given[m]] != 0 || cancels[as_given[m]] != 0;
            (idle ? idle_ : all_open).push_back(static_cast<std::uint32_t>(m));
        }
        open(all_open);
        for (const std::uint32_t m : idle_) counts_.rules.idle += merged_[m].copies;
    }

    using Copy = std::pair<std::uint32_t, std::uint32_t>;  ///< a place, and its number in merged_

    const Triangles& all_;
    std::vector<Merged> merged_;
    std::vector<PlacedFacet> facets_;  ///< of merged_
    std::vector<Copy> of_place_;       ///< by merged_
    std::vector<Ridge> edges_;
    std::vector<std::size_t> edge_of_, ends_;  ///< of ridge 3 f + other: its edge; where the ridges of each edge end
    std::vector<std::uint8_t> alive_;
    std::vector<std::uint32_t> idle_;
    SideCounts counts_;
};

}  // namespace

SideCounts count_sides(const Triangles& triangles) {
    SideCounts counts;
    if (all_turned_alike(triangles, index::ridges_of(3, triangles.facets))) {
        const bool proper = triangles.flat.empty() || std::ranges::find(triangles.flat, 0) != triangles.flat.end();
        counts.rules.turned = proper ? Turned::alike : Turned::open;
        return counts;
    }
    return Shells(triangles).count();
}

}  // namespace barycert::locate
