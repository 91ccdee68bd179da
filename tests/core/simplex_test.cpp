#include "barycert/simplex.hpp"

#include <gtest/gtest.h>

namespace barycert {
namespace {

TEST(SimplexTypes, Counts) {
    EXPECT_EQ(vertex_count(Simplex::segment), 2);
    EXPECT_EQ(vertex_count(Simplex::triangle), 3);
    EXPECT_EQ(vertex_count(Simplex::triangle3d), 3);
    EXPECT_EQ(vertex_count(Simplex::tetrahedron), 4);
    for (const Simplex s : all_simplices) EXPECT_EQ(space_dimension(s), s == Simplex::triangle ? 2 : 3);
}

// Names stand in reports and witness files: they may not change.
TEST(SimplexTypes, Names) {
    EXPECT_EQ(name(Simplex::segment), "segment");
    EXPECT_EQ(name(Simplex::triangle), "triangle");
    EXPECT_EQ(name(Simplex::triangle3d), "triangle3d");
    EXPECT_EQ(name(Simplex::tetrahedron), "tetrahedron");
    for (const Simplex s : all_simplices) EXPECT_EQ(simplex_named(name(s)), s);
    for (const char* wrong : {"", "triangle3", "triangle3d ", "Triangle", "tet"})
        EXPECT_EQ(simplex_named(wrong), std::nullopt) << wrong;

    EXPECT_EQ(name(Region::interior), "interior");
    EXPECT_EQ(name(Region::boundary), "boundary");
    EXPECT_EQ(name(Region::outside), "outside");
    EXPECT_EQ(name(Region::degenerate), "degenerate");

    EXPECT_EQ(name(Feature::interior), "interior");
    EXPECT_EQ(name(Feature::face), "face");
    EXPECT_EQ(name(Feature::edge), "edge");
    EXPECT_EQ(name(Feature::vertex), "vertex");
    EXPECT_EQ(name(Feature::outside), "outside");
    EXPECT_EQ(name(Feature::degenerate), "degenerate");
}

// Catches a stride of 3 used for plane triangles.
TEST(SimplexTypes, VerticesAreStoredOneAfterTheOther) {
    for (const Simplex s : all_simplices) {
        Case c;
        c.simplex = s;
        double next = 0;
        for (int i = 0; i < vertex_count(s); ++i) {
            for (int axis = 0; axis < space_dimension(s); ++axis) c.vertex(i, axis) = ++next;
        }
        const Case& read = c;
        for (std::size_t k = 0; k < c.vertices.size(); ++k) {
            const double expected = static_cast<double>(k) < next ? static_cast<double>(k + 1) : 0;
            EXPECT_EQ(c.vertices[k], expected);
        }
        EXPECT_EQ(read.vertex(vertex_count(s) - 1, space_dimension(s) - 1), next);
    }
}

}  // namespace
}  // namespace barycert
