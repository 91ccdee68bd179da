// Pairs around crowded nodes: none that meets is left out, and few others are named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "barycert/predicates.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/overlap.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/sanitized.hpp"

namespace barycert::testing {
namespace {

using index::Candidates;
using index::Item;

Item item_of(const Mesh& mesh, std::size_t first, int count) {
    Item item{.count = count};
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        item.nodes[i] = mesh.cells[first + i];
        item.at[i] = &mesh.points[static_cast<std::size_t>(mesh.cells[first + i] * mesh.dimension)];
    }
    return item;
}

/// Simplices of `corners` nodes of which most have node 0, half of these node 1 as well; on a small lattice, where much
/// is coplanar, or anywhere.
Mesh star(int d, int corners, bool lattice, double scale, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    for (int i = 0; i < 120 * d; ++i)
        mesh.points.push_back(scale * (lattice ? random.integer(-3, 3) : random.uniform(-1, 1)));
    for (int c = 0; c < 250; ++c) {
        std::vector<Mesh::Index> nodes;
        if (c % 8 != 7) nodes.push_back(0);
        if (c % 2 == 0) nodes.push_back(1);
        while (nodes.size() < static_cast<std::size_t>(corners)) {
            const auto node = static_cast<Mesh::Index>(2 + random.below(118));
            if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
        }
        mesh.cells.insert(mesh.cells.end(), nodes.begin(), nodes.end());
    }
    return mesh;
}

template <class Meet>
std::size_t expect_complete(int d, const std::vector<Item>& items, Meet meet) {
    const Candidates candidates(d, items, 32);
    std::size_t meeting = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        std::set<std::size_t> named;
        candidates.for_each(items[i], [&](std::uint32_t j) {
            EXPECT_TRUE(named.insert(j).second) << "named twice";
            return true;
        });
        for (std::size_t j = 0; j < items.size(); ++j) {
            if (j == i || std::set(items[i].nodes.begin(), items[i].nodes.end()) ==
                              std::set(items[j].nodes.begin(), items[j].nodes.end()))
                continue;
            if (!meet(i, j)) continue;
            ++meeting;
            EXPECT_EQ(named.count(j), 1U) << i << " and " << j << " meet";
        }
    }
    return meeting;
}

TEST(Candidates, LeaveOutNoneThatMeets) {
    for (const int d : {2, 3}) {
        for (const bool lattice : {false, true}) {
            for (const double scale : {1.0, 1e-300, 1e300, 0x1p-1070}) {
                if (!lattice && scale < 0x1p-1000) continue;
                base::Random random = base::Random::stream(35, static_cast<std::uint64_t>(d), lattice ? 1 : 0);
                const Mesh facets = star(d, d, lattice, scale, random), cells = star(d, d + 1, lattice, scale, random);
                std::vector<Item> items;
                std::vector<index::PlacedFacet> placed;
                for (std::size_t f = 0; f < facets.cells.size(); f += static_cast<std::size_t>(d)) {
                    const Item item = item_of(facets, f, d);
                    index::PlacedFacet p;
                    std::copy_n(item.nodes.begin(), 3, p.nodes.begin());
                    std::copy_n(item.at.begin(), 3, p.at.begin());
                    if (!index::proper(d, p)) continue;
                    items.push_back(item);
                    placed.push_back(p);
                }
                EXPECT_GT(expect_complete(d, items,
                                          [&](std::size_t i, std::size_t j) {
                                              return index::facets_conflict(d, placed[i], placed[j]);
                                          }),
                          100U);
                items.clear();
                for (std::size_t c = 0; c < cells.cells.size(); c += cells.corners()) {
                    const Item item = item_of(cells, c, d + 1);
                    const bool flat = d == 2 ? orient2d(item.at[0], item.at[1], item.at[2]) == Sign::zero
                                             : orient3d(item.at[0], item.at[1], item.at[2], item.at[3]) == Sign::zero;
                    if (!flat) items.push_back(item);
                }
                EXPECT_GT(expect_complete(d, items,
                                          [&](std::size_t i, std::size_t j) {
                                              return index::interiors_meet(d, items[i].at, items[j].at);
                                          }),
                          100U);
            }
        }
    }
}

/// Blades around node 0, in 3D rising from it: each by itself but for that node.
Mesh pinwheel(int d, int blades) {
    Mesh mesh;
    mesh.dimension = d;
    mesh.points.assign(static_cast<std::size_t>(d), 0.0);
    const auto at = [&](double turn, double height) {
        const double angle = 2 * 3.14159265358979 * turn / blades;
        std::vector<double> p{std::cos(angle), std::sin(angle)};
        if (d == 3) p.push_back(height);
        return add_node(mesh, p);
    };
    for (int i = 0; i < blades; ++i) {
        const Mesh::Index a = at(i, 0.5), b = at(i + 0.5, 0.5), c = d == 3 ? at(i + 0.25, 0.75) : -1;
        mesh.cells.insert(mesh.cells.end(), {0, a, b});
        if (d == 3) mesh.cells.push_back(c);
    }
    return mesh;
}

// Every pair of blades has boxes that meet.
TEST(Candidates, AreFewInAPinwheel) {
    for (const int d : {2, 3}) {
        std::array<double, 2> named{};
        for (const int blades : {1000, 4000}) {
            const Mesh mesh = pinwheel(d, blades);
            std::vector<Item> items;
            for (std::size_t c = 0; c < mesh.cells.size(); c += mesh.corners())
                items.push_back(item_of(mesh, c, d + 1));
            const Candidates candidates(d, items);
            std::size_t count = 0;
            for (const Item& item : items) candidates.for_each(item, [&](std::uint32_t) { return ++count > 0; });
            named[blades == 1000 ? 0 : 1] = static_cast<double>(count) / blades;
        }
        // In 3D a blade covers a slanted stretch of directions, whose box holds some of its neighbours.
        if (d == 2) {
            EXPECT_LT(named[1], 10);
            EXPECT_LT(named[1], 1.5 * named[0]) << "it grows with the square of the blades";
        } else {
            EXPECT_LT(named[1], 4000 / 40);
        }
    }
}

TEST(Candidates, APinwheelIsCertifiedInTime) {
    const CheckReport r = quick(pinwheel(2, 30000));
    EXPECT_TRUE(r.certified());
    EXPECT_LT(r.seconds, 10 * testing::slowdown) << "0.2 s on one core of 2.5 GHz; two minutes if every pair is asked";
}

}  // namespace
}  // namespace barycert::testing
