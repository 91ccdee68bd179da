// ConformityReport to a PLC: on meshes whose PLC is known, and on planted differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

Mesh mesh_of(const std::string& name) {
    return read_tetgen(BARYCERT_DATA_DIR "/meshes/" + name).value();
}
Plc plc_of(const std::string& name) {
    return read_plc(BARYCERT_DATA_DIR "/plc/" + name).value();
}

ConformityReport conformity(const Mesh& mesh, const Plc& plc, int threads = 1) {
    CheckOptions options;
    options.plc = &plc;
    options.threads = threads;
    options.contacts = 0;
    return check_mesh(mesh, options).conformity.value();
}

/// The unit cube: six squares, one of them with a square hole in which another facet lies.
Plc cube() {
    Plc plc;
    for (int i = 0; i < 8; ++i) plc.points.insert(plc.points.end(), {i % 2 * 4.0, i / 2 % 2 * 4.0, i / 4 * 4.0});
    plc.points.insert(plc.points.end(), {1, 1, 0, 3, 1, 0, 3, 3, 0, 1, 3, 0});
    plc.facets = {{{{0, 1, 3, 2}, {8, 9, 10, 11}}, {2, 2, 0}, 0},
                  {{{8, 9, 10, 11}}, {}, 0},
                  {{{4, 5, 7, 6}}, {}, 0},
                  {{{0, 1, 5, 4}}, {}, 0},
                  {{{2, 3, 7, 6}}, {}, 0},
                  {{{0, 2, 6, 4}}, {}, 0},
                  {{{1, 3, 7, 5}}, {}, 0},
                  {{{0, 1}, {1, 3}}, {}, 0}};
    return plc;
}

TEST(ConformityReport, OfTheProjectsOwnMeshes) {
    struct Known {
        const char *mesh, *plc;
        std::uint64_t facets, exact, rounded;
    };
    // The torus is given by triangles, of which TetGen joins coplanar ones and cuts them the other way.
    for (const Known& k : {Known{"cube-hole", "cube-hole.poly", 326, 326, 0},
                           {"bracket", "bracket.poly", 32, 32, 0},
                           {"cube-hole-o2", "cube-hole.poly", 326, 326, 0},
                           {"flange", "flange.poly", 194, 24, 170},
                           {"lattice-box", "lattice-box.poly", 6, 6, 0},
                           {"torus", "torus.off", 1296, 720, 0},
                           {"needle-slit", "needle-slit.smesh", 13, 5, 8}}) {
        const ConformityReport c = conformity(mesh_of(k.mesh), plc_of(k.plc));
        EXPECT_EQ(c.facets, k.facets) << k.mesh;
        EXPECT_EQ(c.exact, k.exact) << k.mesh;
        EXPECT_EQ(c.rounded, k.rounded) << k.mesh;
        EXPECT_EQ(c.violated, k.facets - k.exact - k.rounded) << k.mesh;
        EXPECT_EQ(c.missing_vertices, 0U) << k.mesh;
        EXPECT_LE(c.relative_distance, 0x1p-50) << k.mesh;
        EXPECT_EQ(c.relative_distance > 0, k.rounded > 0) << k.mesh;
    }
}

TEST(ConformityReport, FacetsWithHolesAndWithoutArea) {
    const Mesh mesh = box(3, {4, 4, 4});
    const ConformityReport c = conformity(mesh, cube());
    EXPECT_EQ(c.facets, 7U);  // the last has segments alone
    EXPECT_EQ(c.exact, 7U);
    EXPECT_EQ(c.missing_vertices, 0U);
    // Coarser cells do not respect the square in the bottom.
    const ConformityReport coarse = conformity(mapped(box(3, {1, 1, 1}), {4, 4, 4}, {0, 0, 0}), cube());
    EXPECT_EQ(coarse.exact, 5U);
    EXPECT_EQ(coarse.violated, 2U);
    EXPECT_EQ(coarse.missing_vertices, 4U);
    ASSERT_EQ(coarse.examples.size(), 2U);
    EXPECT_EQ(coarse.examples[0].facet, 0);
    EXPECT_EQ(coarse.examples[1].facet, 1);
    // Faces cover both, though no union of faces is either.
    for (const ViolatedFacet& f : coarse.examples) EXPECT_NEAR(f.covered, 1, 0x1p-40);
}

// The part that a face has in common with a facet counts, wherever its centroid lies.
TEST(ConformityReport, TheShareThatIsCoveredIsAnArea) {
    Plc plc;
    plc.points = {2.5, 0, 0, 6.5, 0, 0, 6.5, 4, 0, 2.5, 4, 0, 3, 1, 0, 3.5, 1, 0, 3.5, 2, 0, 3, 2, 0};
    plc.facets = {{{{0, 1, 2, 3}}, {}, 0}, {{{3, 2, 1, 0}, {4, 5, 6, 7}}, {3.25, 1.5, 0}, 0}};
    const ConformityReport c = conformity(box(3, {4, 4, 4}), plc);
    ASSERT_EQ(c.examples.size(), 2U);
    EXPECT_NEAR(c.examples[0].covered, 6.0 / 16, 0x1p-40);
    EXPECT_NEAR(c.examples[1].covered, 5.5 / 15.5, 0x1p-40);
    for (std::size_t i = 2; i < plc.points.size(); i += 3) plc.points[i] = -1;  // no face is there
    plc.facets[1].holes[2] = -1;
    for (const ViolatedFacet& f : conformity(box(3, {4, 4, 4}), plc).examples) EXPECT_EQ(f.covered, 0);
}

// A bow-tie whose halves cancel: it has no area to respect.
TEST(ConformityReport, ABowTieHasNoArea) {
    Plc plc;
    plc.points = {0, 0, 0, 4, 4, 0, 4, 0, 0, 0, 4, 0};
    plc.facets = {{{{0, 1, 2, 3}}, {}, 0}};
    const ConformityReport c = conformity(box(3, {4, 4, 4}), plc);
    EXPECT_EQ(c.facets, 0U);
    EXPECT_EQ(c.violated, 0U);
}

TEST(ConformityReport, AFaceCanLieInside) {
    Plc plc;
    plc.points = {2, 0, 0, 2, 4, 0, 2, 4, 4, 2, 0, 4};
    plc.facets = {{{{0, 1, 2, 3}}, {}, 0}};
    EXPECT_EQ(conformity(box(3, {4, 4, 4}), plc).exact, 1U);
    for (double& x : plc.points) x = x == 2 ? 2.5 : x;  // between the layers
    EXPECT_EQ(conformity(box(3, {4, 4, 4}), plc).violated, 1U);
}

TEST(ConformityReport, ANodeThatIsMovedIsTold) {
    const auto node = [](int x, int y, int z) { return static_cast<std::size_t>(x + 5 * (y + 5 * z)); };
    const Mesh good = box(3, {4, 4, 4});
    // On the middle of the side x = 0, off its plane: by an ulp of 4, then by a thousandth.
    ASSERT_EQ(node_at(good, static_cast<Mesh::Index>(node(0, 2, 2))), (std::vector<double>{0, 2, 2}));
    Mesh rounded = good, moved = good;
    rounded.points[3 * node(0, 2, 2)] = 0x1p-50;
    moved.points[3 * node(0, 2, 2)] = 0x1p-10;
    const ConformityReport r = conformity(rounded, cube()), m = conformity(moved, cube());
    EXPECT_EQ(r.exact, 6U);
    EXPECT_EQ(r.rounded, 1U);
    EXPECT_EQ(r.max_distance, 0x1p-50);
    EXPECT_EQ(r.relative_distance, 0x1p-52);
    EXPECT_EQ(m.exact, 6U);
    ASSERT_EQ(m.violated, 1U);
    EXPECT_EQ(m.examples[0].facet, 5);
    EXPECT_EQ(m.examples[0].covered, 13.0 / 16);  // six triangles of half a square are gone
    // A corner of the cube off its place by an ulp is missing.
    Mesh corner = good;
    corner.points[3 * node(4, 4, 4)] += 0x1p-50;
    EXPECT_EQ(conformity(corner, cube()).missing_vertices, 1U);
}

/// Square prisms over a polygon of nodes in the plane z = 0, by a fan from its first node.
Mesh slab(const std::vector<std::array<double, 2>>& polygon) {
    Mesh mesh;
    for (const double z : {0.0, 1.0}) {
        for (const auto& p : polygon) mesh.points.insert(mesh.points.end(), {p[0], p[1], z});
    }
    const auto n = static_cast<Mesh::Index>(polygon.size());
    for (Mesh::Index i = 1; i + 1 < n; ++i) {
        const Mesh::Index a = 0, b = i, c = i + 1;  // the prism over a b c in three cells
        for (const Mesh::Index corner : {a, b, c, c + n, a, b, c + n, b + n, a, b + n, c + n, a + n})
            mesh.cells.push_back(corner);
    }
    return mesh;
}

TEST(ConformityReport, EqualAreasAreNotEnough) {
    // A bulge at the top as large as the dent at the bottom: all corners of the square are nodes.
    const Mesh bulge = slab({{0.5, 0.25}, {1, 0}, {1, 1}, {0.5, 1.25}, {0, 1}, {0, 0}});
    ASSERT_TRUE(check_mesh(bulge).certified());
    Plc square;
    square.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    square.facets = {{{{0, 1, 2, 3}}, {}, 0}};
    const ConformityReport c = conformity(bulge, square);
    EXPECT_EQ(c.missing_vertices, 0U);
    EXPECT_EQ(c.violated, 1U);
    // The whole mesh beside its place by a twentieth.
    const ConformityReport shifted = conformity(mapped(box(3, {4, 4, 4}), {1, 1, 1}, {0.05, 0, 0}), cube());
    EXPECT_EQ(shifted.violated, 7U);
}

TEST(ConformityReport, PolygonsSideBySideOrOneInAnotherAreOneFilledFacet) {
    const Mesh mesh = mapped(box(3, {4, 2, 1}), {0.5, 0.5, 1}, {0, 0, 0});
    Plc plc;
    plc.points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, 0, 1, 0.5, 0};
    plc.facets = {{{{0, 1, 4, 5}, {1, 2, 3, 4}}, {}, 0}, {{{1, 2, 3, 4}, {4, 5, 0, 1}}, {}, 0}};
    EXPECT_EQ(conformity(mesh, plc).exact, 2U);
    plc.facets = {{{{0, 2, 3, 5}, {0, 1, 4, 5}}, {}, 0}};
    EXPECT_EQ(conformity(mesh, plc).exact, 1U);
    // The second as a hole: the mesh fills it, so the faces in it are no part of the facet, and the rest is whole.
    plc.facets[0].holes = {0.25, 0.25, 0};
    EXPECT_EQ(conformity(mesh, plc).exact, 1U);
    // A polygon without an area first.
    plc.facets = {{{{0, 6, 1}, {0, 2, 3, 5}}, {}, 0}};
    EXPECT_EQ(conformity(mesh, plc).facets, 1U);
    EXPECT_EQ(conformity(mesh, plc).exact, 1U);
}

// The middle of the triangle at the lowest corner of the first ring lies in the other ring, which is larger.
TEST(ConformityReport, ARingAroundTheCornerOfALargerOne) {
    Plc plc;
    plc.points = {0, 0, 0, 4, 0, 0, 4, 1, 0, 1, 1, 0, 1, 4, 0, 0, 4, 0, 4, 4, 0};
    plc.facets = {{{{0, 1, 2, 3, 4, 5}, {3, 2, 6, 4}}, {}, 0}};
    EXPECT_EQ(conformity(box(3, {4, 4, 4}), plc).exact, 1U);
}

// A hole whose lowest corner has a vertex of the hole below one of its sides, where neither the hole nor the facet is.
TEST(ConformityReport, AHoleWithASpurBesideItsLowestCorner) {
    for (const bool turned : {false, true}) {
        Plc plc;
        plc.points = {7, 7, 0, 11, 7, 0, 11, 3, 0, 25, 3, 0, 25, 17, 0, 7, 17, 0,
                      8, 8, 0, 12, 8, 0, 12, 4, 0, 24, 4, 0, 24, 16, 0, 8, 16, 0};
        plc.facets = {{{{0, 1, 2, 3, 4, 5}, {6, 7, 8, 9, 10, 11}}, {16, 12, 0}, 0}};
        if (turned) std::reverse(plc.facets[0].polygons[1].begin(), plc.facets[0].polygons[1].end());
        EXPECT_EQ(conformity(box(3, {28, 20, 1}), plc).exact, 1U) << turned;
    }
}

// The plane is that of the second ring, which is wider and begins elsewhere; askew to the axes.
TEST(ConformityReport, ASmallRingFirst) {
    const std::array<double, 2> vertices[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {4, 0}, {4, 4}, {0, 4}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        Plc plc;
        plc.facets = {{{{0, 1, 2, 3}, {2, 1, 4, 5, 6, 3}}, {}, 0}};
        for (const auto& at : vertices) {
            std::array<double, 3> p{4, 4, 4};
            p[u] = at[0];
            p[v] = at[1];
            plc.points.insert(plc.points.end(), p.begin(), p.end());
        }
        Mesh mesh = box(3, {4, 4, 4});
        for (std::vector<double>* points : {&plc.points, &mesh.points}) {
            for (std::size_t i = 0; i < points->size(); i += 3)
                (*points)[i + axis] += (*points)[i + u] + 2 * (*points)[i + v];
        }
        EXPECT_EQ(conformity(mesh, plc).exact, 1U) << axis;
    }
}

// A vertex in the middle of a side: nothing but the node is missing.
TEST(ConformityReport, AVertexOnASideThatIsNoNode) {
    Plc plc;
    plc.points = {0, 0, 0, 0.5, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
    plc.facets = {{{{0, 1, 2, 3, 4}}, {}, 0}};
    const ConformityReport c = conformity(box(3, {4, 4, 4}), plc);
    EXPECT_EQ(c.missing_vertices, 1U);
    EXPECT_EQ(c.exact, 0U);
    EXPECT_EQ(c.rounded, 1U);
    plc.points[3] = 1;
    EXPECT_EQ(conformity(box(3, {4, 4, 4}), plc).exact, 1U);
}

// Most faces of the mesh lie beyond the box of the facet, by rounding alone.
TEST(ConformityReport, FacesAnUlpBesideTheBoxOfTheirFacet) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double to : {-infinity, infinity}) {
            const double at = to < 0 ? 1 : 5;
            Plc plc;
            for (const auto& [u, v] : {std::pair{1, 1}, {5, 1}, {5, 5}, {1, 5}}) {
                std::array<double, 3> p{at, at, at};
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                plc.points.insert(plc.points.end(), p.begin(), p.end());
            }
            plc.facets = {{{{0, 1, 2, 3}}, {}, 0}};
            Mesh mesh = mapped(box(3, {4, 4, 4}), {1, 1, 1}, {1, 1, 1});
            for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
                const double u = mesh.points[i + (axis + 1) % 3], v = mesh.points[i + (axis + 2) % 3];
                const bool corner = (u == 1 || u == 5) && (v == 1 || v == 5);
                double& x = mesh.points[i + axis];
                if (x == at && !corner) x = std::nextafter(x, to);
            }
            const ConformityReport c = conformity(mesh, plc);
            EXPECT_EQ(c.exact, 0U) << axis;
            EXPECT_EQ(c.rounded, 1U) << axis << (to < 0 ? " below" : " above");
        }
    }
}

TEST(ConformityReport, AtTheEndsOfTheRange) {
    for (const double s : {0x1p-1060, 0x1p-560, 0x1p560, 0x1p1021}) {
        Plc plc = cube();
        for (double& x : plc.points) x *= s;
        for (PlcFacet& f : plc.facets) {
            for (double& x : f.holes) x *= s;
        }
        EXPECT_EQ(conformity(mapped(box(3, {4, 4, 4}), {s, s, s}, {0, 0, 0}), plc).exact, 7U) << s;
        // A cell aside: the square in the bottom, and the side that is now inside.
        EXPECT_EQ(conformity(mapped(box(3, {4, 4, 4}), {s, s, s}, {s, 0, 0}), plc).exact, 2U) << s;
    }
}

// Differences of coordinates are beyond all doubles.
TEST(ConformityReport, FromOneEndOfTheRangeToTheOther) {
    constexpr double s = 0x1p1022;
    Plc plc = cube();
    for (double& x : plc.points) x = (x - 2) * s;
    for (PlcFacet& f : plc.facets) {
        for (double& x : f.holes) x = (x - 2) * s;
    }
    const Mesh mesh = mapped(mapped(box(3, {4, 4, 4}), {1, 1, 1}, {-2, -2, -2}), {s, s, s}, {0, 0, 0});
    const ConformityReport c = conformity(mesh, plc);
    EXPECT_EQ(c.facets, 7U);
    EXPECT_EQ(c.exact, 7U);
    EXPECT_EQ(c.max_distance, 0);
}

TEST(ConformityReport, DoesNotDependOnThreadsOrderOrOrientation) {
    base::Random random(2);
    const Mesh flange = mesh_of("flange");
    Mesh other = renumbered(flange, random);
    flip_some(other, random);
    const Plc plc = plc_of("flange.poly");
    const ConformityReport a = conformity(flange, plc, 1), b = conformity(other, plc, 3);
    EXPECT_EQ(a.exact, b.exact);
    EXPECT_EQ(a.rounded, b.rounded);
    EXPECT_EQ(a.max_distance, b.max_distance);
}

TEST(ConformityReport, OfBrokenMeshesEndsWell) {
    Mesh mesh = box(3, {2, 2, 2});
    mesh.cells[5] = -1;
    mesh.cells[9] = 1000;
    mesh.points[4] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(conformity(mesh, cube()).facets, 7U);
    EXPECT_EQ(conformity(Mesh(), cube()).violated, 7U);
    EXPECT_EQ(conformity(mesh, Plc()).facets, 0U);
    Mesh plane = box(2, {2, 2, 1});
    const Plc plc = cube();
    CheckOptions options;
    options.plc = &plc;
    EXPECT_FALSE(check_mesh(plane, options).conformity);
}

}  // namespace
}  // namespace barycert::testing
