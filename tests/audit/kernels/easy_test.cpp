// Where nothing can go wrong, nothing does: integer simplices, points with weights in quarters, every vertex order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "barycert/kernels.hpp"

namespace barycert {
namespace {

using Quarters = std::array<int, 4>;  // weights times four

bool contains(const Kernel& k, const char* part) {
    return k.name.find(part) != std::string::npos;
}

/// Bound of |w - right|. Coordinates are multiples of 4 up to 32, so every product and sum of a closed formula is an
/// integer below 2^24 over another, and the quotient is a number of quarters: no rounding at all, in float too.
/// A reciprocal, an inverse, a decomposition, an auxiliary line or a step divides earlier: at most about 30 roundings
/// (two for each of 32 steps), each amplified by the condition of these simplices (< 20), so less than 2^10 u. A wrong
/// formula is off by a quarter.
double bound(const Kernel& k) {
    const double u = contains(k, ".float32") ? 0x1p-24 : 0x1p-53;
    for (const char* part : {".fast-math", "inverse", "-lu", "linear", "increments", "projected-z"}) {
        if (contains(k, part)) return 0x1p10 * u;
    }
    return 0;
}

/// Weights that a kernel is known not to have: these are pinned as failures in breaking_test.cpp.
bool excluded(const Kernel& k, const Quarters& weights) {
    const bool vertex = std::count(weights.begin(), weights.end(), 4) == 1;
    const bool outside = *std::min_element(weights.begin(), weights.end()) < 0;
    const bool boundary = std::count(weights.begin(), weights.begin() + vertex_count(k.simplex), 0) > 0;
    return (contains(k, "unsigned") && outside) || ((contains(k, "bilinear") || contains(k, "increments")) && vertex) ||
           (contains(k, "trilinear") && (boundary || outside));
}

void check(const Kernel& k, const std::vector<double>& corners, const Quarters& weights) {
    if (excluded(k, weights)) return;
    const int n = vertex_count(k.simplex), d = space_dimension(k.simplex);
    std::array<int, 4> order{0, 1, 2, 3};
    do {
        Case c;
        c.simplex = k.simplex;
        c.perspective = k.perspective;
        for (int i = 0; i < n && c.perspective; ++i) c.depth(i) = 2;  // all equal: no perspective
        for (int i = 0; i < n; ++i) {
            const int from = order[static_cast<std::size_t>(i)];
            for (int axis = 0; axis < d; ++axis) {
                c.vertex(i, axis) = corners[static_cast<std::size_t>(d * from + axis)];
                c.point[static_cast<std::size_t>(axis)] +=
                    c.vertex(i, axis) / 4 * weights[static_cast<std::size_t>(from)];
            }
        }
        double w[4];
        ASSERT_EQ(k.weights(c.vertices.data(), c.point.data(), w), 0) << k.name;
        for (int i = 0; i < n; ++i) {
            const double right = weights[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] / 4.0;
            EXPECT_LE(std::fabs(w[i] - right), bound(k)) << k.name << " weight " << i << " is " << w[i];
        }
    } while (std::next_permutation(order.begin(), order.begin() + n));
}

void check_all(Simplex s, const std::vector<std::vector<double>>& simplices, const std::vector<Quarters>& points) {
    for (const Kernel& k : kernels_matching(std::string(name(s)) + ".*")) {
        for (const auto& corners : simplices) {
            for (const Quarters& weights : points) check(k, corners, weights);
        }
    }
}

TEST(Easy, Segment) {
    check_all(Simplex::segment, {{0, 0, 0, 8, 0, 0}, {4, 8, 12, 20, 0, 4}},
              {{2, 2}, {1, 3}, {4, 0}, {0, 4}, {5, -1}, {-4, 8}});
}

TEST(Easy, Triangle) {
    check_all(Simplex::triangle, {{0, 0, 8, 0, 0, 8}, {4, 8, 28, 12, 8, 32}},
              {{1, 1, 2}, {2, 1, 1}, {4, 0, 0}, {2, 2, 0}, {0, 1, 3}, {3, 2, -1}, {-1, -1, 6}});
}

TEST(Easy, Triangle3d) {
    check_all(Simplex::triangle3d, {{0, 0, 0, 8, 0, 0, 0, 8, 0}, {4, 8, 0, 24, 12, 4, 8, 24, 12}},
              {{1, 1, 2}, {2, 1, 1}, {4, 0, 0}, {2, 2, 0}, {0, 1, 3}, {3, 2, -1}, {-1, -1, 6}});
}

TEST(Easy, Tetrahedron) {
    check_all(Simplex::tetrahedron, {{0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8}, {4, 8, 12, 20, 4, 8, 8, 24, 4, 4, 4, 28}},
              {{1, 1, 1, 1},
               {4, 0, 0, 0},
               {2, 2, 0, 0},
               {1, 1, 2, 0},
               {0, 1, 0, 3},
               {2, 2, 1, -1},
               {-1, -1, 3, 3},
               {7, -1, -1, -1}});
}

}  // namespace
}  // namespace barycert
