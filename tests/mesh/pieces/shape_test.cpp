// Pieces in space, and what ranks take all of them for.

#include <gtest/gtest.h>

#include "mesh/pieces/piece.hpp"
#include "tests/mesh/pieces/threads.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::testing {
namespace {

using pieces::Box;
using pieces::Piece;
using pieces::PieceFacts;
using pieces::Shape;

/// agree_on_shape on ranks that know these.
std::string agreed(const std::vector<PieceFacts>& facts, Shape& shape) {
    std::vector<std::string> errors(facts.size());
    std::vector<Shape> shapes(facts.size());
    Threads(static_cast<int>(facts.size())).run([&](pieces::Communicator& ranks) {
        pieces::Exchange exchange(ranks);
        const auto at = static_cast<std::size_t>(ranks.rank());
        const Result<Shape> result = agree_on_shape(exchange, facts[at]);
        errors[at] = result ? "" : result.error().message();
        if (result) shapes[at] = *result;
    });
    for (const std::string& error : errors) EXPECT_EQ(error, errors.front());
    for (const Shape& one : shapes) EXPECT_EQ(one, shapes.front());
    shape = shapes.front();
    return errors.front();
}

TEST(Shapes, HaveTheHighestDimensionOfAnyPiece) {
    Shape shape;
    EXPECT_EQ(agreed({{.dimension = 2}, {.dimension = 3}, {}}, shape), "");
    EXPECT_EQ(shape.dimension, 3);
    EXPECT_EQ(agreed({{}, {}}, shape), "");
    EXPECT_EQ(shape.dimension, 0);
    EXPECT_EQ(agreed({{.dimension = 1}, {.dimension = 0}, {}}, shape), "it has no cells but points and lines");
}

TEST(Shapes, AreByNumbersIfAllThatCountHaveNumbers) {
    Shape shape;
    agreed({{.dimension = 3, .numbered = true}, {.dimension = 3, .numbered = true}, {}}, shape);
    EXPECT_TRUE(shape.by_numbers);
    agreed({{.dimension = 3, .numbered = true}, {.dimension = 3}}, shape);
    EXPECT_FALSE(shape.by_numbers);
    // Triangles beside tetrahedra do not count.
    agreed({{.dimension = 3, .numbered = true}, {.dimension = 2}}, shape);
    EXPECT_TRUE(shape.by_numbers);
}

TEST(Shapes, AreMixedIfTypesDifferAnywhere) {
    const auto of = [](int low, int high, int dimension = 3, bool numbered = true) {
        return PieceFacts{.dimension = dimension, .low_type = low, .high_type = high, .nodes_numbered = numbered};
    };
    Shape shape;
    agreed({of(10, 10), {}, of(10, 10)}, shape);
    EXPECT_FALSE(shape.mixed);
    EXPECT_TRUE(shape.nodes_by_numbers);
    agreed({of(24, 24), of(24, 24)}, shape);
    EXPECT_FALSE(shape.mixed);
    agreed({of(12, 12), of(12, 12)}, shape);
    EXPECT_TRUE(shape.mixed);
    agreed({of(10, 10), of(24, 24)}, shape);
    EXPECT_TRUE(shape.mixed);
    agreed({of(10, 10), of(5, 9, 2, false)}, shape);
    EXPECT_FALSE(shape.mixed);
    EXPECT_TRUE(shape.nodes_by_numbers);
    agreed({of(10, 10), of(10, 12, 3, false)}, shape);
    EXPECT_TRUE(shape.mixed);
    EXPECT_FALSE(shape.nodes_by_numbers);
}

TEST(Shapes, OfTrianglesLieAcrossOneAxis) {
    Shape shape;
    const Box low{{0, 1, 0}, {1, 1, 1}}, high{{5, 1, -3}, {6, 1, 1}}, off{{0, 2, 0}, {1, 2, 1}};
    EXPECT_EQ(agreed({{2, false, low}, {}, {2, false, high}}, shape), "");
    EXPECT_EQ(shape.normal, 1);
    EXPECT_EQ(agreed({{2, false, low}, {2, false, off}}, shape), "its polygons do not lie in one plane across an axis");
    EXPECT_EQ(agreed({{.dimension = 2}, {.dimension = 2}}, shape), "");  // ghosts alone
    EXPECT_EQ(shape.normal, -1);
}

Piece triangles(double y) {
    Piece piece;
    piece.mesh.points = {9, 9, 9, 0, y, 0, 4, y, 0, 0, y, 2, 4, y, 2};
    piece.mesh.cells = {1, 2, 3, 2, 3, 4};
    return piece;
}

TEST(Pieces, OfTrianglesAreFlatInTheirPlane) {
    Piece piece = triangles(-3);
    EXPECT_FALSE(piece.flatten(2));
    ASSERT_TRUE(piece.flatten(-1));
    EXPECT_EQ(piece.normal, 1);
    EXPECT_EQ(piece.plane, -3);
    EXPECT_EQ(piece.mesh.dimension, 2);
    const double in[3] = {1, -3, 2}, off[3] = {1, -2, 2};
    double point[3], back[3];
    EXPECT_TRUE(piece.project(in, point));
    EXPECT_EQ(point[0], 1);
    EXPECT_EQ(point[1], 2);
    piece.place(point, back);
    EXPECT_TRUE(std::equal(in, in + 3, back));
    EXPECT_FALSE(piece.project(off, point));
    const Box box = piece.box_of(1);
    EXPECT_EQ(box.low, (std::array<double, 3>{0, -3, 0}));
    EXPECT_EQ(box.high, (std::array<double, 3>{4, -3, 2}));
}

// Whatever the order of nodes in a piece, their numbers tell which diagonal a side is cut along.
TEST(Pieces, AreCutByTheNumbersOfNodes) {
    const auto cut = [](const std::vector<Mesh::Index>& nodes, const std::vector<std::int64_t>& numbers) {
        Piece piece;
        piece.mesh.dimension = 2;
        piece.mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
        test::add_shape(piece.mesh, 9, nodes);
        EXPECT_FALSE(piece.cut(numbers).has_value());
        EXPECT_EQ(piece.mesh.shapes.nodes, nodes);
        EXPECT_EQ(piece.mesh.cell_numbers, (std::vector<Mesh::Index>{0, 0}));
        return piece.mesh.cells;
    };
    EXPECT_EQ(cut({0, 1, 2, 3}, {}), (std::vector<Mesh::Index>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(cut({0, 1, 2, 3}, {9, 8, 70, 60}), (std::vector<Mesh::Index>{1, 2, 3, 1, 3, 0}));
    EXPECT_EQ(cut({0, 1, 2, 3}, {9, 60, -8, 60}), (std::vector<Mesh::Index>{2, 3, 0, 2, 0, 1}));
}

// Boxes have curved cells whole: at the middle of this one's longest side.
TEST(Pieces, HaveBoxesOfWholeCells) {
    Piece piece;
    piece.mesh.dimension = 2;
    piece.mesh.points = {0, 0, 2, 0, 0, 2, 1, 0, 2, 2, 0, 1};
    piece.mesh.cells = {0, 1, 2};
    piece.mesh.mid_nodes = {3, 4, 5};
    EXPECT_EQ(piece.nodes_of(0), (std::vector<Mesh::Index>{0, 1, 2, 3, 4, 5}));
    // The side goes through (2, 2): along x up to 2.25, where its derivative 4 (1 - 2 t) x - ... is zero.
    const Box box = piece.box_of(0);
    EXPECT_GE(box.high[0], 2.25);
    EXPECT_GE(box.high[1], 2.25);
    EXPECT_LE(box.low[0], 0);
    EXPECT_EQ(box.low[2], 0);
    // A quadrilateral, by its nodes, of which both parts are asked.
    Piece quad;
    quad.mesh.dimension = 2;
    quad.mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
    test::add_shape(quad.mesh, 9, {0, 1, 2, 3});
    ASSERT_FALSE(quad.cut({}).has_value());
    EXPECT_EQ(quad.whole_of(0), 0U);
    EXPECT_EQ(quad.whole_of(1), 0U);
    EXPECT_EQ(quad.nodes_of(0), (std::vector<Mesh::Index>{0, 1, 2, 3}));
    EXPECT_EQ(quad.box_of(0).high, (std::array<double, 3>{1, 1, 0}));
}

}  // namespace
}  // namespace barycert::testing
