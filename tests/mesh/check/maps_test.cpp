// Reports of a check about isoparametric maps: signs of Jacobians, and facets that both cells have.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/shape_functions.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

using Index = Mesh::Index;

std::size_t nodes_of(int dimension, int order) {
    constexpr std::array<std::array<std::size_t, 3>, 2> counts{{{6, 10, 15}, {10, 20, 35}}};
    return counts[static_cast<std::size_t>(dimension - 2)][static_cast<std::size_t>(order - 2)];
}

/// Simplices of orders 1 (straight) to 4, which share nodes at one place.
class Curved {
public:
    explicit Curved(int dimension) { mesh.dimension = dimension; }

    Mesh mesh;

    void add(int order, std::vector<std::array<int, 3>> corners) {
        const int d = mesh.dimension;
        if (order == 1) {
            for (const auto& corner : corners) mesh.shapes.nodes.push_back(node(corner));
        } else {
            for (const auto& index : core::isoparametric::simplex_reference(d, nodes_of(d, order))->indices) {
                std::array<int, 3> place{};
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    for (std::size_t k = 0; k < 3; ++k) place[k] += index[i] * corners[i][k] / order;
                }
                mesh.shapes.nodes.push_back(node(place));
            }
        }
        mesh.shapes.types.push_back(static_cast<std::uint8_t>(d == 2 ? (order == 1 ? 5 : 69) : order == 1 ? 10 : 71));
        mesh.shapes.ends.push_back(static_cast<std::int64_t>(mesh.shapes.nodes.size()));
    }

    /// Moves that node of the shape, with all cells that have it, or for that cell alone.
    void move(std::size_t shape, std::size_t node, double by, bool alone) {
        const auto d = static_cast<std::size_t>(mesh.dimension);
        Index& number =
            mesh.shapes.nodes[static_cast<std::size_t>(shape == 0 ? 0 : mesh.shapes.ends[shape - 1]) + node];
        if (alone) {
            for (std::size_t k = 0; k < d; ++k)
                mesh.points.push_back(mesh.points[d * static_cast<std::size_t>(number) + k]);
            number = static_cast<Index>(mesh.points.size() / d) - 1;
        }
        for (std::size_t k = 0; k < d; ++k) mesh.points[d * static_cast<std::size_t>(number) + k] += by;
    }

    MapReport maps() {
        EXPECT_FALSE(mesh::cut_into_simplices(mesh));
        return check_mesh(mesh).maps.value_or(MapReport{});
    }

private:
    Index node(const std::array<int, 3>& at) {
        const auto [known, added] = nodes_.emplace(at, static_cast<Index>(nodes_.size()));
        if (added) mesh.points.insert(mesh.points.end(), at.begin(), at.begin() + mesh.dimension);
        return known->second;
    }
    std::map<std::array<int, 3>, Index> nodes_;
};

/// Two cells at the facet opposite to their first and their last corner.
Curved pair(int dimension, int order, int other) {
    Curved made(dimension);
    if (dimension == 2) {
        made.add(order, {{0, 0, 0}, {120, 0, 0}, {0, 120, 0}});
        made.add(other, {{0, 120, 0}, {120, 0, 0}, {120, 120, 0}});
    } else {
        made.add(order, {{0, 0, 0}, {120, 0, 0}, {0, 120, 0}, {0, 0, 120}});
        made.add(other, {{0, 0, 120}, {120, 0, 0}, {0, 120, 0}, {120, 120, 120}});
    }
    return made;
}

/// A node on the edge between two corners.
std::size_t node_between(int dimension, int order, std::size_t a, std::size_t b) {
    const auto& indices = core::isoparametric::simplex_reference(dimension, nodes_of(dimension, order))->indices;
    const auto is_there = [&](const auto& index) {
        return index[a] != 0 && index[b] != 0 && index[a] + index[b] == order;
    };
    return static_cast<std::size_t>(std::ranges::find_if(indices, is_there) - indices.begin());
}

TEST(CheckMaps, CurvedFacetsAreTheSameInBothCells) {
    for (const int d : {2, 3}) {
        for (int order = 2; order <= 4; ++order) {
            SCOPED_TRACE(std::to_string(d) + ", order " + std::to_string(order));
            const std::size_t node = node_between(d, order, 1, 2);
            for (const double by : {0.0, 6.0}) {
                Curved shared = pair(d, order, order);
                shared.move(0, node, by, false);
                const MapReport maps = shared.maps();
                EXPECT_EQ(maps.curved_facets, 1U);
                EXPECT_EQ(maps.split_facets, 0U);
                EXPECT_TRUE(maps.split.empty());
                EXPECT_EQ(maps.max_gap, 0);
            }
            Curved split = pair(d, order, order);
            split.move(0, node, 6, true);
            const MapReport maps = split.maps();
            EXPECT_EQ(maps.curved_facets, 1U);
            EXPECT_EQ(maps.split_facets, 1U);
            EXPECT_DOUBLE_EQ(maps.max_gap, 6 * std::sqrt(d));
            EXPECT_EQ(maps.split, (std::vector<std::array<Index, 2>>{{0, 1}}));
        }
    }
}

/// A facet that is straight in one cell is to be straight in the other, whichever comes first.
TEST(CheckMaps, CurvedFacetsBesideStraightCellsAndOtherOrders) {
    for (const int d : {2, 3}) {
        for (const auto& [first, second] : {std::pair(1, 2), {2, 1}, {1, 3}, {4, 1}, {2, 3}, {3, 2}, {4, 2}}) {
            SCOPED_TRACE(std::to_string(d) + ": " + std::to_string(first) + " beside " + std::to_string(second));
            const MapReport straight = pair(d, first, second).maps();
            EXPECT_EQ(straight.curved_facets, 1U);
            EXPECT_EQ(straight.split_facets, 0U);
            for (const std::size_t shape : {std::size_t{0}, std::size_t{1}}) {
                const int order = shape == 0 ? first : second;
                if (order == 1) continue;
                Curved curved = pair(d, first, second);
                const bool last = d == 2 && shape == 1;
                const std::size_t node = node_between(d, order, last ? 0 : 1, last ? 1 : 2);
                curved.move(shape, node, 3, true);
                const MapReport maps = curved.maps();
                EXPECT_EQ(maps.split_facets, 1U);
                EXPECT_DOUBLE_EQ(maps.max_gap, 3 * std::sqrt(d));
            }
        }
    }
}

TEST(CheckMaps, BoundariesAndInnerNodesAreOfOneCell) {
    Curved made = pair(2, 3, 3);
    const auto& indices = core::isoparametric::simplex_reference(2, 10)->indices;
    for (std::size_t node = 3; node < 10; ++node) {
        if (indices[node][0] != 0) made.move(0, node, 1, true);
    }
    const MapReport maps = made.maps();
    EXPECT_EQ(maps.curved_facets, 1U);
    EXPECT_EQ(maps.split_facets, 0U);
}

TEST(CheckMaps, SecondOrderMeshesToo) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 4, 0, 0, 4, 4, 4, 2, 0, 2.5, 2.5, 0, 2, 4, 2, 2, 4};
    mesh.cells = {0, 1, 2, 3, 2, 1};
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    mesh.mid_nodes = {4, 5, 6, 8, 5, 7};
    const auto maps = check_mesh(mesh).maps;
    ASSERT_TRUE(maps);
    EXPECT_EQ(maps->positive, 2U);
    EXPECT_EQ(maps->curved_facets, 1U);
    EXPECT_EQ(maps->split_facets, 0U);
    // A node of its own amid the edge makes the other cell straight.
    mesh.points.insert(mesh.points.end(), {2, 2});
    mesh.mid_nodes[4] = 9;
    const auto other = check_mesh(mesh).maps;
    ASSERT_TRUE(other);
    EXPECT_EQ(other->cells, 1U);
    EXPECT_EQ(other->split_facets, 1U);
    EXPECT_DOUBLE_EQ(other->max_gap, std::sqrt(0.5));
    EXPECT_EQ(other->split, (std::vector<std::array<Index, 2>>{{0, 1}}));
}

TEST(CheckMaps, SignsOfJacobians) {
    for (const double height : {2.0, 0.0, -2.0}) {
        Mesh mesh;
        mesh.points = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 2, 2, 2, 2, 0, 2, 2};
        mesh.points[20] = height;  // of node 6
        mesh.shapes.types = {12};
        mesh.shapes.ends = {8};
        mesh.shapes.nodes = {0, 1, 2, 3, 4, 5, 6, 7};
        EXPECT_FALSE(mesh::cut_into_simplices(mesh));
        const CheckReport report = check_mesh(mesh);
        ASSERT_TRUE(report.maps);
        EXPECT_EQ(report.maps->positive, height > 0 ? 1U : 0U) << height;
        EXPECT_EQ(report.maps->changing, height > 0 ? 0U : 1U) << height;
        EXPECT_EQ(report.maps->examples.size(), height > 0 ? 0U : 1U);
        EXPECT_EQ(report.maps->curved_facets, 0U);
    }
}

}  // namespace
}  // namespace barycert::testing
