// The sign of a Jacobian all over a cell: proved where Bernstein coefficients alone do not tell it.

#include <gtest/gtest.h>

#include <random>

#include "core/isoparametric/bernstein.hpp"
#include "core/isoparametric/newton.hpp"

namespace barycert::core::isoparametric {
namespace {

struct SignedCell {
    const Reference& reference;
    std::vector<std::array<double, 3>> nodes;

    Places places() const {
        Places p{};
        for (std::size_t i = 0; i < nodes.size(); ++i) p.at[i] = nodes[i].data();
        return p;
    }
    JacobianSign sign() const { return jacobian_sign(reference, places()); }
    int sign_at(const Vector<Rational>& x) const {
        std::array<Rational, max_nodes> n;
        std::array<Vector<Rational>, max_nodes> dn;
        shape_functions(reference, x, n, &dn);
        std::array<Vector<Rational>, 3> columns{};
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) {
                columns[j][k] = j == k ? 1 : 0;
                if (j >= reference.dimension() || k >= reference.dimension()) continue;
                columns[j][k] = 0;
                for (std::size_t i = 0; i < reference.nodes; ++i) columns[j][k] += dn[i][j] * Rational(nodes[i][k]);
            }
        }
        return base::dot(columns[0], base::cross(columns[1], columns[2])).sign();
    }
};

/// The image of a triangle of order 4 under (x, y) -> (x, 3 (x - a)^2 y + (y - a)^3 + more y): all nodes are exact. Its
/// Jacobian is 3 (x - a)^2 + 3 (y - a)^2 + more.
SignedCell touching(double a, double more) {
    SignedCell cell{*simplex_reference(2, 15), {}};
    for (const auto& index : cell.reference.indices) {
        const double x = index[1] / 4.0, y = index[2] / 4.0;
        cell.nodes.push_back({x, 3 * (x - a) * (x - a) * y + (y - a) * (y - a) * (y - a) + more * y, 0});
    }
    return cell;
}

TEST(JacobianSign, BisectionsTellWhatCoefficientsDoNot) {
    for (const double a : {0.25, 0.25 + 0x1p-12, 0.3125}) {
        EXPECT_EQ(touching(a, 1).sign(), JacobianSign::positive) << a;
        EXPECT_EQ(touching(a, 0x1p-5).sign(), JacobianSign::positive) << a;
        EXPECT_EQ(touching(a, -0x1p-5).sign(), JacobianSign::changes) << a;
        EXPECT_EQ(touching(a, -1).sign(), JacobianSign::changes) << a;
    }
    // Zero at one point, where no part has a corner: nothing tells.
    EXPECT_EQ(touching(0.25 + 0x1p-12, 0).sign(), JacobianSign::unknown);
}

TEST(JacobianSign, NoCoefficientNeedBeLargerThanZeroButAtCorners) {
    // A side of order 2 whose Jacobian is x^2 + (1 - x)^2 along it, with a coefficient that is zero.
    SignedCell cell{*linear_reference(9), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    EXPECT_EQ(cell.sign(), JacobianSign::positive);
    cell.nodes[2] = {0.5, 0.5, 0};  // straight at that corner
    EXPECT_EQ(cell.sign(), JacobianSign::changes);
    cell.nodes[2] = {0.5, 0.5 + 0x1p-53, 0};
    EXPECT_EQ(cell.sign(), JacobianSign::positive);
    cell.nodes[2] = {0.5, 0.5 - 0x1p-54, 0};
    EXPECT_EQ(cell.sign(), JacobianSign::changes);
}

class AllCells : public testing::TestWithParam<int> {};

/// Corners of cells in the reference cell; of simplices all nodes are added.
SignedCell regular_cell(int which) {
    using Nodes = std::vector<std::array<double, 3>>;
    const Nodes hexahedron{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    if (which == 0) return {*linear_reference(12), hexahedron};
    if (which == 1) return {*linear_reference(13), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    if (which == 2) return {*linear_reference(14), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}};
    if (which == 3) return {*linear_reference(9), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    constexpr std::array<std::pair<int, std::size_t>, 6> simplices{
        {{2, 6}, {2, 10}, {2, 15}, {3, 10}, {3, 20}, {3, 35}}};
    const auto [dimension, nodes] = simplices[static_cast<std::size_t>(which - 4)];
    SignedCell cell{*simplex_reference(dimension, nodes), {}};
    for (const auto& index : cell.reference.indices) {
        cell.nodes.push_back({});
        for (std::size_t k = 0; k < cell.reference.dimension(); ++k)
            cell.nodes.back()[k] = static_cast<double>(index[k + 1]) / cell.reference.order;
    }
    return cell;
}

// Where a sign is proved, no point has another one.
TEST_P(AllCells, ProvedSignsHoldAtAllPoints) {
    std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 3);
    std::size_t proved = 0, changing = 0, unknown = 0;
    for (int i = 0; i < 60; ++i) {
        SignedCell cell = regular_cell(GetParam());
        const int order = cell.reference.order;
        const double bend = (1 + i % 10) / 10.0 * (cell.reference.is_simplex() ? 0.8 / (order * order) : 0.8);
        for (auto& node : cell.nodes) {
            for (std::size_t k = 0; k < cell.reference.dimension(); ++k)
                node[k] += std::uniform_real_distribution(-bend, bend)(random);
        }
        const JacobianSign sign = cell.sign();
        ++(sign == JacobianSign::unknown ? unknown : sign == JacobianSign::changes ? changing : proved);
        for (int j = 0; j < 40; ++j) {
            Vector<Rational> x{};
            int left = 16;
            for (std::size_t k = 0; k < cell.reference.dimension(); ++k) {
                const bool summed = cell.reference.is_simplex() || (cell.reference.element == Element::wedge && k < 2);
                const int own = std::uniform_int_distribution(0, summed ? left : 16)(random);
                if (summed) left -= own;
                x[k] = Rational(own) / 16;
            }
            if (cell.reference.element == Element::pyramid && x[2] == 1) continue;
            if (sign == JacobianSign::positive || sign == JacobianSign::negative) {
                ASSERT_EQ(cell.sign_at(x), static_cast<int>(sign)) << i;
            }
        }
    }
    EXPECT_GT(proved, 5U);
    EXPECT_EQ(unknown, 0U);
    if (GetParam() != 3) {
        EXPECT_GT(changing, 0U);
    }
}
INSTANTIATE_TEST_SUITE_P(, AllCells, testing::Range(0, 10));

}  // namespace
}  // namespace barycert::core::isoparametric
