// Pieces in space, and what ranks take all of them for.

#include <gtest/gtest.h>

#include "barycert/pieces/piece.hpp"
#include "pieces/threads.hpp"

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
    EXPECT_EQ(agreed({{.dimension = 1}, {.dimension = 0}, {}}, shape), "it has neither tetrahedra nor triangles");
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

TEST(Shapes, OfTrianglesLieAcrossOneAxis) {
    Shape shape;
    const Box low{{0, 1, 0}, {1, 1, 1}}, high{{5, 1, -3}, {6, 1, 1}}, off{{0, 2, 0}, {1, 2, 1}};
    EXPECT_EQ(agreed({{2, false, low}, {}, {2, false, high}}, shape), "");
    EXPECT_EQ(shape.normal, 1);
    EXPECT_EQ(agreed({{2, false, low}, {2, false, off}}, shape),
              "its triangles do not lie in one plane across an axis");
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

TEST(Pieces, AreSortedByNumbers) {
    Piece piece = triangles(0);
    ASSERT_TRUE(piece.flatten(-1));
    EXPECT_TRUE(piece.sort_cells({3, 3}).empty());
    EXPECT_EQ(piece.sort_cells({7, -5}), (std::vector<Mesh::Index>{1, 0}));
    EXPECT_EQ(piece.mesh.cells, (std::vector<Mesh::Index>{2, 3, 4, 1, 2, 3}));
}

}  // namespace
}  // namespace barycert::testing
