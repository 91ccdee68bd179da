// The check of surfaces and PLCs, against exact rational geometry of all pairs, and surfaces of voxels whose regions
// are known.
#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cmath>
#include <limits>
#include <set>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "tests/mesh/check/surfaces.hpp"

namespace barycert::testing {
namespace {

using Pairs = std::set<std::array<Mesh::Index, 2>>;

const CheckOptions all_places{.examples = 1000000, .contacts = 0};

Pairs pairs_of(const CheckReport& r, DefectKind kind) {
    Pairs pairs;
    if (const Defect* const d = r.find(kind); d != nullptr) {
        for (const DefectPlace& p : d->places)
            pairs.insert({std::min(p.cells[0], p.cells[1]), std::max(p.cells[0], p.cells[1])});
    }
    return pairs;
}

std::uint64_t count(const CheckReport& r, DefectKind kind) {
    const Defect* const d = r.find(kind);
    return d == nullptr ? 0 : d->count;
}

/// Nodes at one place are one.
std::vector<Rational3> common_nodes(const RationalTriangle& a, const RationalTriangle& b) {
    std::vector<Rational3> all;
    for (const Rational3& p : a) {
        if (std::ranges::find(b, p) != b.end()) all.push_back(p);
    }
    return all;
}

/// Their common part is more than the hull of their common nodes.
bool meet_beyond(const RationalTriangle& a, const RationalTriangle& b) {
    const std::vector<Rational3> nodes = common_nodes(a, b);
    return !std::ranges::all_of(common_points(a, b), [&](const Rational3& p) {
        if (std::ranges::find(nodes, p) != nodes.end()) return true;
        if (nodes.size() != 2) return nodes.size() == 3;
        const Rational3 e = nodes[1] - nodes[0], w = p - nodes[0], off = outer(e, w);
        const mpq_class t = inner(w, e);
        return off[0] == 0 && off[1] == 0 && off[2] == 0 && t >= 0 && t <= inner(e, e);
    });
}

void compare_with_all_pairs(const Surface& s, const std::string& what) {
    const CheckReport r = check_surface(s, all_places);
    Pairs expected, twice;
    std::uint64_t flat = 0;
    std::vector<RationalTriangle> triangles;
    for (std::size_t t = 0; t < s.cell_count(); ++t) {
        triangles.push_back(triangle_of(s, t));
        const auto n = std::set(s.cells.begin() + static_cast<std::ptrdiff_t>(3 * t),
                                s.cells.begin() + static_cast<std::ptrdiff_t>(3 * t + 3));
        flat += n.size() == 3 && is_flat(triangles.back()) ? 1 : 0;
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            if (is_flat(triangles[i]) || is_flat(triangles[j])) continue;
            const std::array<Mesh::Index, 2> pair{static_cast<Mesh::Index>(i), static_cast<Mesh::Index>(j)};
            if (common_nodes(triangles[i], triangles[j]).size() == 3) {
                twice.insert(pair);
            } else if (meet_beyond(triangles[i], triangles[j])) {
                expected.insert(pair);
            }
        }
    }
    EXPECT_EQ(pairs_of(r, DefectKind::self_intersection), expected) << what;
    EXPECT_EQ(pairs_of(r, DefectKind::duplicate_triangle), twice) << what;
    EXPECT_EQ(count(r, DefectKind::degenerate_triangle), flat) << what;
    const bool yes = check_surface(s, {.verdict_only = true}).certified();
    EXPECT_EQ(yes, r.certified()) << what;
}

TEST(SurfaceCheck, AllPairsOfLatticeSoups) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Surface s = random_soup(seed % 3 == 0 ? 2 : 4, 5 + seed % 20, 14, seed);
        compare_with_all_pairs(s, "seed " + std::to_string(seed));
        if (seed % 10 != 0) continue;
        compare_with_all_pairs(mapped(s, 0x1p500), "times 2^500");
        compare_with_all_pairs(mapped(s, 0x1p-500), "times 2^-500");
        compare_with_all_pairs(mapped(s, 1, 1e6), "moved");
    }
}

TEST(SurfaceCheck, PairsNearlyTouching) {
    // Random triangles whose nodes are moved by some ulps: shared, nearly shared and coplanar ones.
    std::mt19937_64 random(7);
    for (int round = 0; round < 30; ++round) {
        Surface s = random_soup(3, 8, 12, static_cast<std::uint64_t>(round));
        for (double& x : s.points) {
            x = x / 3 + 1;
            for (std::uint64_t k = random() % 3; k > 0; --k) x = std::nextafter(x, 2);
        }
        compare_with_all_pairs(s, "round " + std::to_string(round));
    }
}

TEST(SurfaceCheck, AgreesWithCgal) {
    using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
    std::mt19937_64 random(3);
    for (int round = 0; round < 200; ++round) {
        Surface s;
        for (int i = 0; i < 18; ++i)
            s.points.push_back(static_cast<double>(random() % 4) +
                               (round % 2 == 0 ? 0 : static_cast<double>(random() % 64) / 64));
        s.cells = {0, 1, 2, 3, 4, 5};
        const auto point = [&](std::size_t i) {
            return Kernel::Point_3(s.points[3 * i], s.points[3 * i + 1], s.points[3 * i + 2]);
        };
        const Kernel::Triangle_3 a(point(0), point(1), point(2)), b(point(3), point(4), point(5));
        const RationalTriangle ra = triangle_of(s, 0), rb = triangle_of(s, 1);
        if (a.is_degenerate() || b.is_degenerate() || !common_nodes(ra, rb).empty()) continue;
        EXPECT_EQ(count(check_surface(s), DefectKind::self_intersection) != 0, CGAL::do_intersect(a, b)) << round;
    }
}

TEST(SurfaceCheck, WitnessesLieInBothTriangles) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Surface s = random_soup(4, 12, 12, seed + 100);
        const CheckReport r = check_surface(s, {.contacts = 1000});
        EXPECT_EQ(r.contacts.size(), count(r, DefectKind::self_intersection));
        for (const CellContact& c : r.contacts) {
            Rational3 p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = mpq_class(c.common.fraction[k]);
            const RationalTriangle a = triangle_of(s, static_cast<std::size_t>(c.cells[0])),
                                   b = triangle_of(s, static_cast<std::size_t>(c.cells[1]));
            EXPECT_TRUE(lies_on(a, p) && lies_on(b, p));
            const std::vector<Rational3> all = common_points(a, b);
            const bool point = std::ranges::all_of(all, [&](const Rational3& x) { return x == all[0]; });
            EXPECT_EQ(c.dimension == 0, point);
        }
    }
}

/// Volumes of the parts of space that sides of voxels bound: of the full ones connected over sides, and of the empty
/// ones.
std::multiset<double> volumes_of(const Voxels& v) {
    const int n = v.n + 2;
    std::vector<int> seen(static_cast<std::size_t>(n * n * n), 0);
    const auto index = [&](int x, int y, int z) { return static_cast<std::size_t>(((z + 1) * n + y + 1) * n + x + 1); };
    std::multiset<double> volumes;
    for (int z = -1; z <= v.n; ++z) {
        for (int y = -1; y <= v.n; ++y) {
            for (int x = -1; x <= v.n; ++x) {
                if (seen[index(x, y, z)] != 0) continue;
                const bool full = v.at(x, y, z);
                double volume = 0;
                bool outside = false;
                std::vector<std::array<int, 3>> open{{x, y, z}};
                seen[index(x, y, z)] = 1;
                while (!open.empty()) {
                    const auto at = open.back();
                    open.pop_back();
                    ++volume;
                    for (const auto& step :
                         {std::array{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
                        const std::array<int, 3> to{at[0] + step[0], at[1] + step[1], at[2] + step[2]};
                        if (std::ranges::any_of(to, [&](int c) { return c < -1 || c > v.n; })) {
                            outside = true;
                            continue;
                        }
                        if (v.at(to[0], to[1], to[2]) != full || seen[index(to[0], to[1], to[2])]++ != 0) continue;
                        open.push_back(to);
                    }
                }
                if (!outside) volumes.insert(volume);
            }
        }
    }
    return volumes;
}

TEST(SurfaceCheck, RegionsOfVoxels) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Voxels v = random_voxels(2 + static_cast<int>(seed % 5), seed % 2 == 0 ? 0.5 : 0.75, seed);
        const Surface s = surface_of(v);
        if (s.cells.empty()) continue;
        const CheckReport r = check_surface(s);
        ASSERT_TRUE(r.certified()) << seed;
        std::multiset<double> found;
        for (const SurfaceRegion& region : r.surface->regions) found.insert(region.volume);
        EXPECT_EQ(found, volumes_of(v)) << seed;
        EXPECT_TRUE(r.surface->oriented && r.surface->outward) << seed;
        double volume = 0;
        for (const SurfaceShell& shell : r.surface->shells) volume += shell.volume.value();
        EXPECT_EQ(volume, static_cast<double>(std::ranges::count(v.full, 1))) << seed;
    }
}

TEST(SurfaceCheck, ShellsInShells) {
    // Cubes one in the other, each with a side less than the one before; beside them another.
    Surface s;
    const auto add_cube = [&](double low, double high, bool inward) {
        Surface cube = surface_of({1, {1}});
        const auto first = static_cast<Mesh::Index>(s.point_count());
        for (const double x : cube.points) s.points.push_back(low + x * (high - low));
        for (std::size_t i = 0; i < cube.cells.size(); i += 3) {
            if (inward) std::swap(cube.cells[i], cube.cells[i + 1]);
            for (std::size_t k = 0; k < 3; ++k) s.cells.push_back(first + cube.cells[i + k]);
        }
    };
    add_cube(0, 10, false);
    add_cube(1, 9, true);
    add_cube(2, 8, false);
    add_cube(20, 21, true);
    const CheckReport r = check_surface(s);
    EXPECT_TRUE(r.certified());
    ASSERT_EQ(r.surface->shells.size(), 4);
    std::map<Mesh::Index, const SurfaceShell*> by_first;
    for (const SurfaceShell& shell : r.surface->shells) by_first[shell.first] = &shell;
    const auto inside = [&](Mesh::Index first) {
        const std::int64_t i = by_first.at(first)->inside;
        return i < 0 ? Mesh::Index{-1} : r.surface->shells[static_cast<std::size_t>(i)].first;
    };
    EXPECT_EQ(inside(0), -1);
    EXPECT_EQ(inside(12), 0);
    EXPECT_EQ(inside(24), 12);
    EXPECT_EQ(inside(36), -1);
    EXPECT_EQ(by_first.at(12)->volume, -512);
    std::multiset<double> volumes;
    for (const SurfaceRegion& region : r.surface->regions) volumes.insert(region.volume);
    EXPECT_EQ(volumes, (std::multiset<double>{1, 216, 512 - 216, 1000 - 512}));
    EXPECT_EQ(count(r, DefectKind::inside_out), 1);
    EXPECT_FALSE(r.surface->outward);
}

TEST(SurfaceCheck, WhatIsWrong) {
    const Surface cube = surface_of({1, {1}});
    Surface open = cube;
    open.cells.resize(open.cells.size() - 3);
    CheckReport r = check_surface(open);
    EXPECT_FALSE(r.certified());
    EXPECT_EQ(count(r, DefectKind::open_edge), 3);
    EXPECT_TRUE(r.find(DefectKind::open_edge)->breaks());

    Surface turned = cube;
    std::swap(turned.cells[0], turned.cells[1]);
    r = check_surface(turned);
    EXPECT_TRUE(r.certified());  // it bounds a region all the same
    EXPECT_EQ(count(r, DefectKind::misoriented_edge), 3);
    EXPECT_FALSE(r.surface->oriented);

    // A crack of an ulp: one triangle has a node of its own.
    Surface crack = cube;
    crack.points.insert(crack.points.end(), {std::nextafter(cube.points[0], 1), cube.points[1], cube.points[2]});
    for (std::size_t i = 0; i < 3; ++i) {
        if (crack.cells[i] == 0) crack.cells[i] = 8;
    }
    r = check_surface(crack);
    EXPECT_FALSE(r.certified());
    EXPECT_EQ(count(r, DefectKind::near_nodes), 1);
    EXPECT_GE(count(r, DefectKind::crack), 1);

    // The same place: one node.
    Surface doubled = cube;
    doubled.points.insert(doubled.points.end(), cube.points.begin(), cube.points.begin() + 3);
    for (std::size_t i = 0; i < 3; ++i) {
        if (doubled.cells[i] == 0) doubled.cells[i] = 8;
    }
    r = check_surface(doubled);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(count(r, DefectKind::coincident_nodes), 1);

    Surface bad = cube;
    bad.cells[0] = 99;
    bad.points[4] = std::numeric_limits<double>::quiet_NaN();
    r = check_surface(bad);
    EXPECT_EQ(count(r, DefectKind::index_out_of_range), 1);
    EXPECT_EQ(count(r, DefectKind::not_finite), 1);
    bad.cells.pop_back();
    EXPECT_EQ(count(check_surface(bad), DefectKind::bad_structure), 1);
    EXPECT_FALSE(check_surface(Surface()).certified());

    // A node on an edge of a neighbour: no edge fits, and the triangles meet beyond it.
    Surface junction;
    junction.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 0, 0, 0, -1, 0, 2, -1, 0};
    junction.cells = {0, 1, 2, 0, 4, 3, 3, 5, 1};
    r = check_surface(junction);
    EXPECT_EQ(count(r, DefectKind::node_on_facet), 1);
    EXPECT_EQ(r.find(DefectKind::node_on_facet)->places[0].nodes[0], 3);
}

// Triangles that break S1 are left out of all else.
TEST(SurfaceCheck, RegionsBesideWhatHasNoArea) {
    Surface s = surface_of({1, {1}});
    s.cells.insert(s.cells.end(), {0, 1, 1});
    s.points.insert(s.points.end(), {5, 0, 0, 6, 0, 0, 7, 0, 0, 0, 0, 0});
    s.cells.insert(s.cells.end(), {8, 9, 10});
    const CheckReport r = check_surface(s);
    EXPECT_FALSE(r.certified());
    EXPECT_EQ(count(r, DefectKind::repeated_node), 1);
    EXPECT_EQ(count(r, DefectKind::degenerate_triangle), 1);
    ASSERT_EQ(r.surface->regions.size(), 1);
    EXPECT_EQ(r.surface->regions[0].volume, 1);
    EXPECT_EQ(r.surface->places, 11);  // the last node is where one of the cube is
}

/// Two sheets bent at one edge, each with nodes of its own there: they pass through each other, or touch.
TEST(SurfaceCheck, SheetsThatPassThroughEachOther) {
    for (const bool pass : {true, false}) {
        Surface s;
        // Around the axis: 0 and 2, 1 and 3 are a sheet, or 0 and 1, 2 and 3.
        s.points = {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
        for (Mesh::Index i = 0; i < 4; ++i) {
            const Mesh::Index sheet = pass ? i % 2 : i / 2, low = 2 * sheet;
            s.cells.insert(s.cells.end(), {low, low + 1, 4 + i});
        }
        const CheckReport r = check_surface(s);
        EXPECT_EQ(count(r, DefectKind::self_intersection), pass ? 1 : 0);
        EXPECT_EQ(r.contacts.size(), pass ? 1 : 0);
        if (pass) {
            EXPECT_EQ(pairs_of(r, DefectKind::self_intersection), Pairs({{0, 1}}));
        }
    }
}

TEST(SurfaceCheck, PinchedNodesAndEdges) {
    Surface s = surface_of({2, {1, 0, 0, 1, 0, 0, 0, 0}});  // two voxels that share an edge
    CheckReport r = check_surface(s);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(count(r, DefectKind::nonmanifold_edge), 1);
    s = surface_of({2, {1, 0, 0, 0, 0, 0, 0, 1}});  // a node
    r = check_surface(s);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(count(r, DefectKind::nonmanifold_edge), 0);
    EXPECT_EQ(count(r, DefectKind::nonmanifold_node), 1);
    EXPECT_EQ(r.surface->shell_count, 2);
    EXPECT_FALSE(r.surface->manifold);
}

TEST(SurfaceCheck, ThreadsDoNotMatter) {
    const Surface s = random_soup(30, 3000, 2000, 5);
    const CheckReport one = check_surface(s, {.threads = 1, .examples = 50}),
                      two = check_surface(s, {.threads = 2, .examples = 50});
    ASSERT_EQ(one.defects.size(), two.defects.size());
    for (std::size_t i = 0; i < one.defects.size(); ++i) {
        EXPECT_EQ(one.defects[i].kind, two.defects[i].kind);
        EXPECT_EQ(one.defects[i].count, two.defects[i].count);
        for (std::size_t k = 0; k < one.defects[i].places.size(); ++k)
            EXPECT_EQ(one.defects[i].places[k].cells, two.defects[i].places[k].cells);
    }
}

// PLCs.

Plc cube_plc() {
    Plc plc;
    plc.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    for (const std::vector<std::int32_t>& ring :
         {std::vector<std::int32_t>{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
        plc.facets.push_back({.polygons = {ring}, .holes = {}});
    return plc;
}

TEST(PlcCheck, Cube) {
    Plc plc = cube_plc();
    plc.regions = {0.5, 0.5, 0.5, 1, 0.1, 0.5, 0.5, 0, 2, 0.1};
    plc.holes = {3, 3, 3};
    const CheckReport r = check_plc(plc);
    EXPECT_TRUE(r.certified());
    ASSERT_EQ(r.surface->regions.size(), 1);
    EXPECT_EQ(r.surface->regions[0].volume, 1);
    ASSERT_EQ(r.surface->seeds.size(), 3);
    EXPECT_EQ(r.surface->seeds[0].region, -1);  // the hole
    EXPECT_EQ(r.surface->seeds[1].region, 0);
    EXPECT_EQ(r.surface->seeds[2].facet, 0);
    EXPECT_EQ(count(r, DefectKind::misplaced_point), 2);
}

TEST(PlcCheck, InnerFacetsMayBeOpen) {
    Plc plc = cube_plc();
    plc.points.insert(plc.points.end(), {.25, .25, .5, .75, .25, .5, .5, .75, .5});
    plc.facets.push_back({.polygons = {{8, 9, 10}}, .holes = {}});
    const CheckReport r = check_plc(plc);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(count(r, DefectKind::open_edge), 3);
    plc.facets.erase(plc.facets.begin());
    EXPECT_FALSE(check_plc(plc).certified());
}

TEST(PlcCheck, FacetsWithHolesSegmentsAndPoints) {
    Plc plc = cube_plc();
    // A square hole in the lower facet, which a well closes; a segment and a point in the upper one.
    plc.points.insert(plc.points.end(), {.25, .25, 0,  .75, .25, 0,  .75, .75, 0,  .25, .75, 0,   //
                                         .25, .25, .5, .75, .25, .5, .75, .75, .5, .25, .75, .5,  //
                                         .25, .5,  1,  .75, .5,  1,  .5,  .75, 1});
    plc.facets[0].polygons.push_back({8, 9, 10, 11});
    plc.facets[0].holes = {.5, .5, 0};
    for (const std::vector<std::int32_t>& ring : {std::vector<std::int32_t>{12, 13, 14, 15},
                                                  {8, 9, 13, 12},
                                                  {9, 10, 14, 13},
                                                  {10, 11, 15, 14},
                                                  {11, 8, 12, 15}})
        plc.facets.push_back({.polygons = {ring}, .holes = {}});
    plc.facets[1].polygons.push_back({16, 17});
    plc.facets[1].polygons.push_back({18});
    CheckReport r = check_plc(plc);
    EXPECT_TRUE(r.certified());
    ASSERT_EQ(r.surface->regions.size(), 1);
    EXPECT_EQ(r.surface->regions[0].volume, 1 - .125);
    // Without the segment in it, another facet's edge lies in the upper one.
    plc.facets[1].polygons.resize(1);
    plc.facets.push_back({.polygons = {{16, 17, 14}}, .holes = {}});
    r = check_plc(plc);
    EXPECT_FALSE(r.certified());
    EXPECT_GE(count(r, DefectKind::self_intersection) + count(r, DefectKind::segment_in_facet), 1);
}

TEST(PlcCheck, SegmentThatIsADiagonal) {
    // The diagonal of a facet, by which it is cut, is an edge of another one.
    Plc plc = cube_plc();
    plc.points.insert(plc.points.end(), {.5, .5, .5});
    for (const std::array<std::int32_t, 2>& diagonal : {std::array<std::int32_t, 2>{0, 2}, {1, 3}}) {
        Plc with = plc;
        with.facets.push_back({.polygons = {{diagonal[0], diagonal[1], 8}}, .holes = {}});
        CheckReport r = check_plc(with);
        EXPECT_FALSE(r.certified());
        with.facets[0].polygons.push_back({diagonal[0], diagonal[1]});
        r = check_plc(with);
        EXPECT_TRUE(r.certified()) << diagonal[0];
    }
}

TEST(PlcCheck, BadFacets) {
    Plc plc = cube_plc();
    plc.facets[0].polygons[0] = {0, 2, 1, 3};  // crosses itself
    CheckReport r = check_plc(plc);
    EXPECT_EQ(count(r, DefectKind::bad_facet), 1);
    EXPECT_FALSE(r.certified());
    plc = cube_plc();
    plc.points.insert(plc.points.end(), {.5, 0, 0});  // on an edge that two facets have
    plc.facets.push_back({.polygons = {{8}}, .holes = {}});
    r = check_plc(plc);
    EXPECT_EQ(count(r, DefectKind::node_on_facet), 1);
    plc = cube_plc();
    plc.points[2] = 0x1p-40;  // one of its facets is off its plane
    r = check_plc(plc);
    EXPECT_EQ(r.surface->off_plane, 1);
    EXPECT_NEAR(r.surface->max_off_plane, 0x1p-40, 0x1p-41);
    EXPECT_TRUE(r.certified());
}

TEST(PlcCheck, LooseSegmentsAndPoints) {
    Plc plc = cube_plc();
    plc.points.insert(plc.points.end(), {.5, .5, .25, .5, .5, .75, .5, .5, 1.5, .5, .5, 0});
    plc.facets.push_back({.polygons = {{8, 9}}, .holes = {}});  // inside
    EXPECT_EQ(count(check_plc(plc), DefectKind::segment_in_facet), 0);
    plc.facets.back().polygons = {{9, 10}};  // through the upper facet
    const CheckReport r = check_plc(plc);
    EXPECT_EQ(count(r, DefectKind::segment_in_facet), 1);
    EXPECT_EQ(count(r, DefectKind::node_on_facet), 1);  // the last point
}

// Two segments of no facet: every way in which they can meet, moved, turned and scaled exactly.
TEST(PlcCheck, LooseSegmentsThatMeet) {
    using P = std::array<double, 3>;
    struct Pair {
        std::array<P, 4> at;
        int meet;
    };
    const std::array<Pair, 10> pairs{{
        {{P{0, 0, 0}, {2, 2, 2}, {0, 2, 1}, {2, 0, 1}}, 1},    // cross
        {{P{0, 0, 0}, {2, 2, 2}, {0, 2, 1}, {2, 0, 1.5}}, 0},  // pass each other
        {{P{0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {5, 0, 0}}, 1},    // an end on the other
        {{P{0, 0, 0}, {2, 2, 2}, {1, 1, 1}, {5, 5, 5}}, 1},    // overlap on a line
        {{P{0, 0, 0}, {2, 2, 2}, {3, 3, 3}, {5, 5, 5}}, 0},    // apart on a line
        {{P{0, 0, 0}, {0, 0, 2}, {0, 0, 1}, {0, 0, 5}}, 1},    // on a line along an axis
        {{P{0, 0, 0}, {0, 0, 2}, {0, 0, 3}, {0, 0, 5}}, 0},
        {{P{0, 0, 0}, {0, 0, 2}, {0, 1, 1}, {0, 5, 1}}, 0},   // in a plane of axes, apart
        {{P{0, 0, 0}, {0, 0, 2}, {0, -1, 1}, {0, 5, 1}}, 1},  // in it, crossing
        {{P{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}}, 0},   // parallel
    }};
    for (std::size_t turn = 0; turn < 3; ++turn) {
        for (const double scale : {1.0, 0x1p-400, 0x1p400}) {
            for (const Pair& pair : pairs) {
                Plc plc = cube_plc();
                for (double& x : plc.points) x = x * scale + 16 * scale;
                for (const P& p : pair.at) {
                    for (std::size_t k = 0; k < 3; ++k) plc.points.push_back(p[(k + turn) % 3] * scale);
                }
                plc.facets.push_back({.polygons = {{8, 9}}, .holes = {}});
                plc.facets.push_back({.polygons = {{10, 11}}, .holes = {}});
                EXPECT_EQ(count(check_plc(plc), DefectKind::segments_meet), pair.meet) << turn << ' ' << scale;
            }
        }
    }
    Plc plc = cube_plc();  // a fan from one node
    plc.points.insert(plc.points.end(), {5, 5, 5, 6, 5, 5, 7, 5, 5, 5, 6, 5});
    for (const Mesh::Index end : {9, 11}) plc.facets.push_back({.polygons = {{8, end}}, .holes = {}});
    EXPECT_TRUE(check_plc(plc).certified());
    plc.facets.push_back({.polygons = {{8, 10}}, .holes = {}});  // over the first
    EXPECT_EQ(count(check_plc(plc), DefectKind::segments_meet), 1);
}

// Loose nodes at one place are one, and many segments that do not meet are no work.
TEST(PlcCheck, LooseSegmentsAtOnePlaceAndMany) {
    Plc plc = cube_plc();
    plc.points.insert(plc.points.end(), {5, 5, 5, 6, 5, 5, 6, 5, 5, 7, 6, 5, 1, 1, 1, 4, 4, 4});
    for (const auto& [a, b] : {std::pair<Mesh::Index, Mesh::Index>{8, 9}, {10, 11}, {12, 13}})
        plc.facets.push_back({.polygons = {{a, b}}, .holes = {}});
    CheckReport r = check_plc(plc);
    EXPECT_EQ(count(r, DefectKind::segments_meet), 0);
    EXPECT_EQ(count(r, DefectKind::segment_in_facet), 0);
    EXPECT_EQ(count(r, DefectKind::coincident_nodes), 2) << "9 and 10; 12 and a corner of the cube";
    plc = cube_plc();
    const auto add = [&](double x, double y, double z) {
        plc.points.insert(plc.points.end(), {x, y, z});
        return static_cast<Mesh::Index>(plc.point_count() - 1);
    };
    for (int i = 0; i < 20000; ++i) {
        const Mesh::Index a = add(5, i, 0), b = add(5, i, 1);
        plc.facets.push_back({.polygons = {{a, b}}, .holes = {}});
    }
    EXPECT_TRUE(check_plc(plc).certified());  // each against each other would take a minute
    const Mesh::Index a = add(5, -1, .5), b = add(5, 20000, .5);
    plc.facets.push_back({.polygons = {{a, b}}, .holes = {}});
    r = check_plc(plc);
    EXPECT_EQ(count(r, DefectKind::segments_meet), 1000);
    EXPECT_TRUE(r.find(DefectKind::segments_meet)->at_least);
    EXPECT_EQ(count(check_plc(plc, {.verdict_only = true}), DefectKind::segments_meet), 1);
}

// Polygons that turn as surfaces do are asked whether they turn alike; those of .poly are not.
TEST(PlcCheck, TurnedFacets) {
    const Plc plc = cube_plc();
    EXPECT_EQ(count(check_plc(plc), DefectKind::misoriented_edge), 0);
    EXPECT_EQ(count(check_plc(plc, {.turned_facets = true}), DefectKind::misoriented_edge), 4);
}

TEST(PlcCheck, PolygonsThatNameANodeTwice) {
    Plc plc = cube_plc();
    plc.facets[2].polygons[0] = {0, 1, 1, 5, 4};
    const CheckReport r = check_plc(plc);
    EXPECT_FALSE(r.certified());
    ASSERT_EQ(count(r, DefectKind::repeated_node), 1);
    EXPECT_EQ(r.cell_number(r.find(DefectKind::repeated_node)->places[0].cells)[0], 2);
    EXPECT_EQ(r.surface->regions.size(), 1);
    // The last and the first; a triangle is told once.
    plc.facets[2].polygons[0] = {1, 5, 4, 0, 1};
    EXPECT_EQ(count(check_plc(plc), DefectKind::repeated_node), 1);
    plc.facets[2].polygons[0] = {0, 1, 5, 4};
    plc.facets.push_back({.polygons = {{0, 1, 1}}, .holes = {}});
    EXPECT_EQ(count(check_plc(plc), DefectKind::repeated_node), 1);
    EXPECT_EQ(check_plc(plc).surface->regions.size(), 1);
}

TEST(PlcCheck, RegionPointsOutside) {
    Plc plc = cube_plc();
    plc.holes = {3, 3, 3};
    EXPECT_TRUE(check_plc(plc).certified());
    plc.regions = {5, 6, 7, 1, 0.1};
    const CheckReport r = check_plc(plc);
    EXPECT_FALSE(r.certified());
    const std::vector<DefectPlace>& places = r.find(DefectKind::misplaced_point)->places;
    ASSERT_EQ(places.size(), 2);
    EXPECT_EQ(places[1].point, (std::array<double, 3>{5, 6, 7}));
}

// A point where facets meet is told of the lowest.
TEST(PlcCheck, SeedsOnSeveralFacets) {
    Plc plc = cube_plc();
    for (Mesh::Index node = 0; node < 8; ++node) {
        const double* const p = &plc.points[3 * static_cast<std::size_t>(node)];
        plc.holes.assign(p, p + 3);
        const auto lowest = std::ranges::find_if(
            plc.facets, [&](const PlcFacet& f) { return std::ranges::count(f.polygons[0], node) != 0; });
        EXPECT_EQ(check_plc(plc).surface->seeds[0].facet, lowest - plc.facets.begin());
    }
}

}  // namespace
}  // namespace barycert::testing
