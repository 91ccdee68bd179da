// Sides that are not flat, and what lies beyond them.

#include "mesh/index/warped_sides.hpp"

#include <gtest/gtest.h>

#include "mesh/pulling.hpp"

namespace barycert::mesh {
namespace {

/// Cubes of 2 by 1 by 1, node 0 to 11 by x, then y, then z; a node of the side between them moved by `bend`.
struct Made {
    Mesh mesh;

    explicit Made(double bend) {
        for (const double z : {0.0, 1.0}) {
            for (const double y : {0.0, 1.0}) {
                for (const double x : {0.0, 1.0, 2.0}) mesh.points.insert(mesh.points.end(), {x, y, z});
            }
        }
        mesh.points[std::size_t{3} * 10] += bend;
    }
    void add(std::uint8_t type, const std::vector<Mesh::Index>& nodes) {
        mesh.shapes.types.push_back(type);
        mesh.shapes.nodes.insert(mesh.shapes.nodes.end(), nodes.begin(), nodes.end());
        mesh.shapes.ends.push_back(static_cast<std::int64_t>(mesh.shapes.nodes.size()));
    }
    SidesOfCells sides(std::vector<std::uint8_t> has_map = {}) {
        EXPECT_FALSE(cut_into_simplices(mesh));
        if (has_map.empty()) has_map.assign(mesh.shapes.count(), 1);
        return compare_sides(mesh, warped_sides(mesh, has_map));
    }
};

const std::vector<Mesh::Index> left{0, 1, 4, 3, 6, 7, 10, 9}, right{1, 2, 5, 4, 7, 8, 11, 10};
const std::vector<Mesh::Index> right_voxel{1, 2, 4, 5, 7, 8, 10, 11};

TEST(WarpedSides, FlatOnesAreNone) {
    Made cubes(0);
    cubes.add(12, left);
    cubes.add(12, right);
    const SidesOfCells sides = cubes.sides();
    EXPECT_EQ(sides.warped, 0U);
    EXPECT_TRUE(sides.split.empty());
}

TEST(WarpedSides, OneInTwoCellsCountsOnceAndFits) {
    for (const std::vector<Mesh::Index>& turned : {right, {5, 4, 1, 2, 11, 10, 7, 8}, {2, 1, 7, 8, 5, 4, 10, 11}}) {
        Made cubes(0.25);
        cubes.add(12, left);
        cubes.add(12, turned);
        const SidesOfCells sides = cubes.sides();
        EXPECT_EQ(sides.warped, 1U);  // all else stays in its plane
        EXPECT_TRUE(sides.split.empty());
    }
    Made cubes(0.25);
    cubes.add(11, right_voxel);
    cubes.add(12, left);
    EXPECT_EQ(cubes.sides().warped, 1U);
    EXPECT_TRUE(compare_sides(cubes.mesh, warped_sides(cubes.mesh, std::vector<std::uint8_t>{1, 1})).split.empty());
}

TEST(WarpedSides, TwoTrianglesBeyondAreAnotherSurface) {
    for (const bool hexahedron_first : {true, false}) {
        Made cells(0.25);
        if (hexahedron_first) cells.add(12, left);
        // The right cube as two wedges, along the diagonal from the lowest node of the side, 1 to 10.
        cells.add(13, {1, 10, 4, 2, 11, 5});
        cells.add(13, {1, 7, 10, 2, 8, 11});
        if (!hexahedron_first) cells.add(12, left);
        const SidesOfCells sides = cells.sides();
        ASSERT_EQ(sides.split.size(), 1U);
        EXPECT_EQ(sides.split[0].whole, hexahedron_first ? 0 : 2);
        EXPECT_EQ(sides.split[0].beyond, hexahedron_first ? 1 : 0);
        EXPECT_EQ(sides.warped, 1U);
    }
}

TEST(WarpedSides, ACellWithoutAMapHasTrianglesThere) {
    Made cubes(0.25);
    cubes.add(12, left);
    cubes.add(12, right);
    const SidesOfCells sides = cubes.sides({1, 0});
    ASSERT_EQ(sides.split.size(), 1U);
    EXPECT_EQ(sides.split[0].whole, 0);
    EXPECT_EQ(sides.split[0].beyond, 1);
    EXPECT_EQ(compare_sides(cubes.mesh, warped_sides(cubes.mesh, std::vector<std::uint8_t>{0, 0})).warped, 0U);
}

TEST(WarpedSides, BoundariesAreNotSplit) {
    Made cube(0.25);
    cube.add(12, left);
    const SidesOfCells sides = cube.sides();
    EXPECT_EQ(sides.warped, 1U);
    EXPECT_TRUE(sides.split.empty());
}

}  // namespace
}  // namespace barycert::mesh
