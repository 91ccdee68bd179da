// Do boundary facets conflict? With CGAL's exact kernel as the judge.
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "audit/exact/cgal_variant.hpp"
#include "barycert/environment.hpp"
#include "core/base/random.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"

namespace barycert::testing {
namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Coordinates = std::array<std::array<double, 3>, 3>;

Point point(const std::array<double, 3>& p) {
    return {CGAL::Gmpq(p[0]), CGAL::Gmpq(p[1]), CGAL::Gmpq(p[2])};
}

/// The two have more in common than the vertices or the edge they share, which are first in both.
bool judged(const Coordinates& f, const Coordinates& g, std::size_t common) {
    const Triangle t(point(f[0]), point(f[1]), point(f[2])), u(point(g[0]), point(g[1]), point(g[2]));
    if (common == 0) return CGAL::do_intersect(t, u);
    const auto meet = CGAL::intersection(t, u);
    if (!meet) return true;  // they share a vertex: it cannot be
    if (const Point* p = barycert::exact::met_as<Point>(*meet)) return common != 1 || *p != point(f[0]);
    if (const Segment* s = barycert::exact::met_as<Segment>(*meet)) {
        const Segment edge(point(f[0]), point(f[1]));
        return common != 2 || (*s != edge && *s != edge.opposite());
    }
    return true;  // a triangle or polygon
}

index::PlacedFacet placed(const Coordinates& f, std::array<Mesh::Index, 3> nodes) {
    index::PlacedFacet placed{nodes, {}};
    for (std::size_t i = 0; i < 3; ++i) placed.at[i] = f[i].data();
    return placed;
}

TEST(FacetContact, AsCgalsExactKernelHasIt) {
    std::array<std::array<int, 2>, 3> seen{};  // by common nodes: not, in conflict
    for (std::uint64_t seed = 0; seed < 30000; ++seed) {
        base::Random random = base::Random::stream(11, seed, 0);
        const auto common = static_cast<std::size_t>(random.integer(0, 2));
        // Few lattice points, or those of one slanted plane: most ways to touch occur. Now and then far apart in scale.
        const bool plane = random.coin();
        const double scale = seed % 5 == 0 ? 0x1p-1000 : seed % 5 == 1 ? 0x1p900 : 1;
        const auto place = [&] {
            const double x = random.integer(-2, 2), y = random.integer(-2, 2),
                         z = plane ? x + 2 * y : random.integer(-2, 2);
            return std::array<double, 3>{x * scale, y * scale, z * scale};
        };
        Coordinates f{place(), place(), place()}, g{place(), place(), place()};
        for (std::size_t i = 0; i < common; ++i) g[i] = f[i];
        std::array<Mesh::Index, 3> fn{0, 1, 2}, gn{3, 4, 5};
        for (std::size_t i = 0; i < common; ++i) gn[i] = fn[i];
        index::PlacedFacet a = placed(f, fn), b = placed(g, gn);
        if (!index::proper(3, a) || !index::proper(3, b)) continue;
        const bool expected = judged(f, g, common);
        ++seen[common][expected ? 1 : 0];
        for (int turn = 0; turn < 3; ++turn) {  // in any order of nodes and facets
            EXPECT_EQ(index::facets_conflict(3, a, b), expected) << seed;
            EXPECT_EQ(index::facets_conflict(3, b, a), expected) << seed;
            std::rotate(a.nodes.begin(), a.nodes.begin() + 1, a.nodes.end());
            std::rotate(a.at.begin(), a.at.begin() + 1, a.at.end());
            std::swap(b.nodes[0], b.nodes[2]);
            std::swap(b.at[0], b.at[2]);
        }
    }
    for (const auto& counts : seen) {
        EXPECT_GT(counts[0], 500);
        EXPECT_GT(counts[1], 500);
    }
}

/// The lanes take out only pairs without a conflict, and most of these; the same on every target.
TEST(FacetContact, LanesTakeOutPairsWithoutConflict) {
    const std::string usual = simd_target();
    std::array<std::size_t, 2> taken{}, left{};           // by whether the pair conflicts
    std::array<std::size_t, 2> in_general{}, in_plane{};  // of those without a conflict: left, taken
    for (std::uint64_t seed = 0; seed < 1200; ++seed) {
        base::Random random = base::Random::stream(12, seed, 0);
        // Few nodes, some of them at one place: facets have 0 to 3 nodes in common. On a lattice, in general position,
        // or exactly in a plane, askew to the axes or along two of them, whose determinants are exact or rounded; of
        // any scale, also mixed.
        const int kind = random.integer(0, 4);
        const double scale =
            std::array{0x1p-1000, 0x1p900, 0x1p-350, 0x1p-530, 0x1p-530, 1.0}[std::min<std::size_t>(seed % 12, 5)];
        std::array<index::NodeRecord, 14> nodes{};
        for (index::NodeRecord& node : nodes) {
            auto& at = node.at;
            const double own = kind == 3 && random.coin() ? 0x1p-20 : 1;
            for (double& x : at) {
                x = kind == 1 ? random.uniform(-2, 2) : random.integer(-2, 2);
                if (kind == 3) x = std::floor(random.uniform(-0x1p49, 0x1p49)) * 0x1p-48 * own;
            }
            const std::size_t k = seed % 3;  // z, or another axis, of the plane
            if (kind >= 2) at[k] = kind == 4 ? 1 : at[(k + 1) % 3] + 2 * at[(k + 2) % 3];
        }
        for (index::NodeRecord& node : nodes) {
            for (double& x : node.at) x *= scale;
        }
        std::vector<index::PlacedFacet> facets;
        for (int i = 0; i < 16; ++i) {
            index::PlacedFacet facet;
            for (std::size_t k = 0; k < 3; ++k) {
                facet.nodes[k] = random.integer(0, 13);
                facet.at[k] = nodes[static_cast<std::size_t>(facet.nodes[k])].at.data();
            }
            if (index::proper(3, facet)) facets.push_back(facet);
        }
        std::vector<index::FacetPair> all;
        for (std::uint32_t i = 0; i < facets.size(); ++i) {
            for (std::uint32_t j = 0; j < i; ++j) all.push_back({j, i});
        }
        const auto key = [](const index::FacetPair& pair) { return std::pair(pair.first, pair.second); };
        std::vector<std::pair<std::uint32_t, std::uint32_t>> first;
        for (const std::string& target : simd_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            std::vector<index::FacetPair> pairs = all;
            std::vector<std::pair<std::uint32_t, std::uint32_t>> kept;
            for (const index::FacetPair& pair : index::without_separated(facets, pairs)) kept.push_back(key(pair));
            if (target == simd_targets().front()) first = kept;
            EXPECT_EQ(kept, first) << target << ' ' << seed;
        }
        ASSERT_TRUE(use_simd_target(usual));
        for (const index::FacetPair& pair : all) {
            index::PlacedFacet f = facets[pair.first], g = facets[pair.second];
            std::ranges::sort(f.nodes), std::ranges::sort(g.nodes);
            const bool conflict =
                f.nodes == g.nodes || index::facets_conflict(3, facets[pair.first], facets[pair.second]);
            const bool is_left = std::ranges::count(first, key(pair)) != 0;
            ++(is_left ? left : taken)[conflict ? 1 : 0];
            if (kind == 1 && scale == 1 && !conflict) ++in_general[is_left ? 0 : 1];
            if (kind == 4 && scale == 1 && !conflict) ++in_plane[is_left ? 0 : 1];
        }
    }
    EXPECT_EQ(taken[1], 0U);
    EXPECT_GT(left[1], 1000U);
    EXPECT_GT(in_general[1], 2 * in_general[0]);
    EXPECT_GT(in_plane[1], 100 * in_plane[0]);
}

/// A corner of g nearly on a side of f, in one plane: the lanes do not take a sliver of overlap for none.
TEST(FacetContact, LanesLeaveSlivers) {
    constexpr std::uint32_t count = 40'000;
    std::vector<index::NodeRecord> nodes(6 * count);
    std::vector<index::PlacedFacet> facets(2 * count);
    std::vector<index::FacetPair> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
        base::Random random = base::Random::stream(13, i, 0);
        index::NodeRecord* const node = &nodes[6 * std::size_t{i}];
        const double t = random.uniform(0, 1);
        for (std::size_t n = 0; n < 6; ++n) {
            for (std::size_t k = 0; k < 2; ++k) {  // full doubles: differences are rounded, too
                const double a = node[0].at[k], b = node[1].at[k];
                node[n].at[k] = n == 3 ? a + t * (b - a) : random.uniform(-2, 2);
            }
            node[n].at[2] = 1;
        }
        for (std::size_t n = 0; n < 6; ++n) {
            facets[2 * i + n / 3].nodes[n % 3] = static_cast<Mesh::Index>(n);
            facets[2 * i + n / 3].at[n % 3] = node[n].at.data();
        }
        pairs.push_back({2 * i, 2 * i + 1});
    }
    std::vector<bool> left(count, false);
    for (const index::FacetPair& pair : index::without_separated(facets, pairs)) left[pair.first / 2] = true;
    std::size_t conflicts = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!index::facets_conflict(3, facets[2 * i], facets[2 * i + 1])) continue;
        ++conflicts;
        EXPECT_TRUE(left[i]) << i;
    }
    EXPECT_GT(conflicts, count / 4);
    EXPECT_LT(std::ranges::count(left, true), count);
}

}  // namespace
}  // namespace barycert::testing
