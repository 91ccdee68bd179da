// Small cases whose answers a reader can check. A quotient of small integers is written as a division: IEEE division
// of exact operands is the correctly rounded quotient.
#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

const std::array<double, 12> corner{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

Case tetrahedron(const std::array<double, 3>& point) {
    return {Simplex::tetrahedron, corner, point, {1, 2, 3, 4}};
}
Case triangle(const std::array<double, 3>& point) {
    return {Simplex::triangle, {0, 0, 3, 0, 0, 3}, point, {1, 2, 4}};
}
Case triangle3d(const std::array<double, 3>& point) {
    return {Simplex::triangle3d, {1, 0, 0, 0, 1, 0, 0, 0, 1}, point, {1, 2, 4}};
}
Case segment(const std::array<double, 3>& point) {
    return {Simplex::segment, {0, 0, 0, 1, 2, 2}, point, {1, 4}};
}

struct Expected {
    Feature feature;
    std::uint8_t support;
    std::array<double, 4> weights;
    double value;
};

void expect(const Case& c, const Expected& e) {
    const OracleAnswer a = check(c);
    EXPECT_EQ(a.feature, e.feature);
    EXPECT_EQ(a.support, e.support);
    EXPECT_EQ(a.weights, e.weights);
    EXPECT_EQ(a.value, e.value);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(a.signs[i], (e.weights[i] > 0) - (e.weights[i] < 0));
    const bool boundary = e.feature == Feature::face || e.feature == Feature::edge || e.feature == Feature::vertex;
    EXPECT_EQ(a.region, e.feature == Feature::outside ? Region::outside
                        : boundary                    ? Region::boundary
                                                      : Region::interior);
}

TEST(ByHand, Tetrahedron) {
    expect(tetrahedron({0.25, 0.25, 0.25}), {Feature::interior, 0b1111, {0.25, 0.25, 0.25, 0.25}, 2.5});
    expect(tetrahedron({0.25, 0.25, 0}), {Feature::face, 0b0111, {0.5, 0.25, 0.25, 0}, 1.75});
    expect(tetrahedron({0.5, 0.25, 0.25}), {Feature::face, 0b1110, {0, 0.5, 0.25, 0.25}, 2.75});
    expect(tetrahedron({0.5, 0, 0}), {Feature::edge, 0b0011, {0.5, 0.5, 0, 0}, 1.5});
    expect(tetrahedron({0, 0.5, 0.5}), {Feature::edge, 0b1100, {0, 0, 0.5, 0.5}, 3.5});
    for (std::size_t i = 0; i < 4; ++i) {
        Expected e{Feature::vertex, static_cast<std::uint8_t>(1U << i), {}, 1.0 + static_cast<double>(i)};
        e.weights[i] = 1;
        expect(tetrahedron({corner[3 * i], corner[3 * i + 1], corner[3 * i + 2]}), e);
    }
    // Extrapolation: the weights stay affine.
    expect(tetrahedron({1, 1, 1}), {Feature::outside, 0b1111, {-2, 1, 1, 1}, 7});
    // Outside though a weight is zero: on the line of an edge, on the plane of a face.
    expect(tetrahedron({2, 0, 0}), {Feature::outside, 0b0011, {-1, 2, 0, 0}, 3});
    expect(tetrahedron({-1, 1, 0}), {Feature::outside, 0b0110 | 0b0001, {1, -1, 1, 0}, 2});
}

TEST(ByHand, EitherOrientation) {
    // Swapped vertices make the signed volume negative; catches a sign taken from the numerator alone.
    Case c = tetrahedron({0.5, 0.25, 0.125});
    c.vertices = {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
    expect(c, {Feature::interior, 0b1111, {0.125, 0.25, 0.5, 0.125}, 0.125 + 0.5 + 1.5 + 0.5});
}

TEST(ByHand, Triangle) {
    expect(triangle({1, 1, 0}), {Feature::interior, 0b111, {1 / 3.0, 1 / 3.0, 1 / 3.0, 0}, 7 / 3.0});
    expect(triangle({2, 0, 0}), {Feature::edge, 0b011, {1 / 3.0, 2 / 3.0, 0, 0}, 5 / 3.0});
    expect(triangle({1, 2, 0}), {Feature::edge, 0b110, {0, 1 / 3.0, 2 / 3.0, 0}, 10 / 3.0});
    expect(triangle({0, 3, 0}), {Feature::vertex, 0b100, {0, 0, 1, 0}, 4});
    expect(triangle({4, -1, 0}), {Feature::outside, 0b110, {0, 4 / 3.0, -1 / 3.0, 0}, 4 / 3.0});
    // The value is rounded once, not summed from rounded weights: thrice 7/3 is exactly 7.
    Case c = triangle({1, 1, 0});
    c.values = {7, 7, 7};
    EXPECT_EQ(ask_oracle(c).value, 7);
}

TEST(ByHand, TriangleInSpaceProjects) {
    const std::array<double, 4> thirds{1 / 3.0, 1 / 3.0, 1 / 3.0, 0};
    expect(triangle3d({0, 0, 0}), {Feature::interior, 0b111, thirds, 7 / 3.0});
    expect(triangle3d({5, 5, 5}), {Feature::interior, 0b111, thirds, 7 / 3.0});
    expect(triangle3d({2, 1, 1}), {Feature::vertex, 0b001, {1, 0, 0, 0}, 1});
    expect(triangle3d({1, 1, 0.5}), {Feature::edge, 0b011, {0.5, 0.5, 0, 0}, 1.5});
    expect(triangle3d({3, 0, 0}), {Feature::outside, 0b111, {7 / 3.0, -2 / 3.0, -2 / 3.0, 0}, -5 / 3.0});
}

TEST(ByHand, SegmentProjects) {
    expect(segment({3, 0, 0}), {Feature::interior, 0b11, {2 / 3.0, 1 / 3.0, 0, 0}, 2});
    expect(segment({0, 2, -2}), {Feature::vertex, 0b01, {1, 0, 0, 0}, 1});
    expect(segment({9, 0, 0}), {Feature::vertex, 0b10, {0, 1, 0, 0}, 4});
    expect(segment({0, 0, -9}), {Feature::outside, 0b11, {3, -2, 0, 0}, -5});
}

TEST(ByHand, DegenerateSimplicesOfEveryKind) {
    const auto dimension = [](Simplex s, std::array<double, 12> v) {
        const Case c{s, v, {0.5, 0.25, 0.125}, {1, 2, 3, 4}};
        EXPECT_EQ(check(c).region, vertex_count(s) == affine_dimension(c) + 1 ? Region::outside : Region::degenerate);
        return affine_dimension(c);
    };
    EXPECT_EQ(dimension(Simplex::tetrahedron, {5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5}), 0);  // a point
    EXPECT_EQ(dimension(Simplex::tetrahedron, {0, 0, 0, 1, 2, 3, 0, 0, 0, 2, 4, 6}), 1);  // collinear, one twice
    EXPECT_EQ(dimension(Simplex::tetrahedron, {0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0}), 1);
    EXPECT_EQ(dimension(Simplex::tetrahedron, {0, 0, 9, 1, 0, 9, 0, 1, 9, 1, 1, 9}), 2);  // a square
    EXPECT_EQ(dimension(Simplex::tetrahedron, {0, 0, 9, 1, 0, 9, 2, 0, 9, 1, 1, 9}), 2);  // three collinear first
    EXPECT_EQ(dimension(Simplex::tetrahedron, {2, 2, 2, 3, 2, 2, 2, 3, 2, 2, 2, 3}), 3);
    EXPECT_EQ(dimension(Simplex::triangle, {3, 3, 3, 3, 3, 3}), 0);
    EXPECT_EQ(dimension(Simplex::triangle, {0, 0, 1, 3, 2, 6}), 1);
    EXPECT_EQ(dimension(Simplex::triangle, {2, 2, 3, 2, 2, 3}), 2);
    EXPECT_EQ(dimension(Simplex::triangle3d, {3, 3, 3, 3, 3, 3, 3, 3, 3}), 0);
    EXPECT_EQ(dimension(Simplex::triangle3d, {0, 0, 0, 1, 2, 3, 2, 4, 6}), 1);
    EXPECT_EQ(dimension(Simplex::triangle3d, {2, 2, 2, 3, 2, 2, 2, 3, 2}), 2);
    EXPECT_EQ(dimension(Simplex::segment, {1, 2, 3, 1, 2, 3}), 0);
    EXPECT_EQ(dimension(Simplex::segment, {2, 2, 2, 3, 2, 2}), 1);
}

// 0.1 + 0.2 is not 0.3: collinear on paper, a sliver in doubles. Catches any tolerance.
TEST(ByHand, AlmostDegenerateIsNotDegenerate) {
    const Case c{Simplex::triangle, {0, 0, 0.1, 0.3, 0.2, 0.1 + 0.2 + 0.3}, {0.1, 0.2}, {1, 2, 3}};
    EXPECT_NE(check(c).region, Region::degenerate);
}

}  // namespace
}  // namespace barycert::exact
