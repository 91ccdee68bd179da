// Families from meshes: where their points lie, told by the oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "audit/gap_points.hpp"
#include "audit/recipes.hpp"
#include "audit_helpers.hpp"
#include "core/base/finite.hpp"
#include "core/base/random.hpp"

namespace barycert::audit {
namespace {

std::map<Feature, int> features(const std::string& family, Simplex s) {
    std::map<Feature, int> count;
    for (std::uint64_t i = 0; i < 1000; ++i)
        ++count[ask_oracle(make_case(family_named(family), s, 1, i, own_meshes())).feature];
    return count;
}

TEST(MeshFamilies, InsideIsInside) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        EXPECT_GE(features("mesh.inside", s)[Feature::interior], 995) << name(s);
        EXPECT_EQ(features("mesh.centroids", s)[Feature::interior], 1000) << name(s);
    }
}

TEST(MeshFamilies, VerticesAreVertices) {
    for (const Simplex s : all_simplices) EXPECT_EQ(features("mesh.vertices", s)[Feature::vertex], 1000) << name(s);
}

TEST(MeshFamilies, OneUlpFromAVertexIsNotAVertex) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron})
        EXPECT_EQ(features("mesh.vertices.ulp", s)[Feature::vertex], 0) << name(s);
}

TEST(MeshFamilies, FacesHaveAllThreeKinds) {
    auto count = features("mesh.faces", Simplex::tetrahedron);
    EXPECT_GT(count[Feature::interior], 50);
    EXPECT_GT(count[Feature::outside], 50);
    EXPECT_GT(count[Feature::face], 50);
}

TEST(MeshFamilies, HullNearIsOutsideOrOnTheHull) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        auto count = features("mesh.hull.near", s);
        EXPECT_GE(count[Feature::outside], 900) << name(s);
        EXPECT_LE(count[Feature::interior], 50) << name(s);
    }
}

TEST(MeshFamilies, HullFarIsOutside) {
    EXPECT_GE(features("mesh.hull.far", Simplex::tetrahedron)[Feature::outside], 990);
}

TEST(MeshFamilies, NeighboursAreMostlyOutside) {
    auto count = features("mesh.neighbours", Simplex::tetrahedron);
    EXPECT_GE(count[Feature::outside], 700);  // the rest: facets without a neighbour
    auto vertices = features("mesh.neighbours.vertices", Simplex::tetrahedron);
    EXPECT_GE(vertices[Feature::vertex], 500);
    EXPECT_GE(vertices[Feature::outside], 100);
}

TEST(MeshFamilies, NodalValuesComeFromTheField) {
    MeshSource source;
    source.add("cube-hole", read_tetgen(BARYCERT_DATA_DIR "/meshes/cube-hole").value());
    const Mesh& mesh = source.meshes().front()->mesh;
    ASSERT_FALSE(mesh.point_fields.empty());
    ASSERT_GT(mesh.point_fields.size(), 1U);
    std::set<std::size_t> met;
    base::Random random(1);
    for (int i = 0; i < 100; ++i) {
        const Draw draw = draw_any(source, Simplex::tetrahedron, random);
        const auto carries = [&](const Field& f) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (draw.simplex.values[k] != f.data[static_cast<std::size_t>(draw.nodes[k])]) return false;
            }
            return true;
        };
        const auto field = std::find_if(mesh.point_fields.begin(), mesh.point_fields.end(), carries);
        ASSERT_NE(field, mesh.point_fields.end());
        met.insert(static_cast<std::size_t>(field - mesh.point_fields.begin()));
    }
    EXPECT_EQ(met.size(), mesh.point_fields.size());  // every field has its turn
}

/// Two tetrahedra, or triangles, as large as doubles allow; a field that is not finite everywhere.
Mesh largest_mesh(int dimension) {
    constexpr double most = std::numeric_limits<double>::max();
    Mesh m;
    m.dimension = dimension;
    if (dimension == 3) {
        m.points = {0, 0, 0, most, 0, 0, 0, most, 0, 0, 0, most, -most, -most, -most};
        m.cells = {0, 1, 2, 3, 1, 2, 0, 4};
    } else {
        m.points = {0, 0, most, 0, 0, most, -most, -most};
        m.cells = {0, 1, 2, 0, 2, 3};
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    m.point_fields.push_back({"T", 1, {1, nan, 3, HUGE_VAL, 5}});
    m.point_fields.back().data.resize(m.point_count());
    return m;
}

TEST(MeshFamilies, CasesAreFiniteWhateverTheMesh) {
    for (const int dimension : {2, 3}) {
        MeshSource source;
        source.add("largest", largest_mesh(dimension));
        for (const Family& f : all_families()) {
            for (const Simplex s : all_simplices) {
                if (!f.needs_mesh || !f.applies_to(s) || !source.supplies(s)) continue;
                for (std::uint64_t i = 0; i < 500; ++i) {
                    const Case c = make_case(f, s, 1, i, source);
                    ASSERT_TRUE(base::all_finite(c.vertices)) << f.name;
                    ASSERT_TRUE(base::all_finite(c.point)) << f.name;
                    ASSERT_TRUE(base::all_finite(c.values)) << f.name;
                }
            }
        }
        const Mesh mesh = largest_mesh(dimension);
        const GapPoints points(mesh);
        for (std::uint64_t i = 0; i < 500; ++i) ASSERT_TRUE(base::all_finite(points.make(Feature::edge, 1, i).point));
    }
}

TEST(MeshFamilies, AMeshSuppliesItsOwnSimplicesOnly) {
    MeshSource flat, solid;
    flat.add("plate", read_tetgen(BARYCERT_DATA_DIR "/meshes/plate").value());
    solid.add("cube-hole", read_tetgen(BARYCERT_DATA_DIR "/meshes/cube-hole").value());
    EXPECT_TRUE(flat.supplies(Simplex::triangle));
    EXPECT_FALSE(flat.supplies(Simplex::tetrahedron));
    EXPECT_FALSE(solid.supplies(Simplex::triangle));
    EXPECT_TRUE(solid.supplies(Simplex::segment));
    EXPECT_FALSE(MeshSource().supplies(Simplex::triangle));
}

}  // namespace
}  // namespace barycert::audit
