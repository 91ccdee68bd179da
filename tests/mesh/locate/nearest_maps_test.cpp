// The nearest point of cells with maps: against a search over the boundaries of reference cells, in long double.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "barycert/sampler.hpp"
#include "tests/mesh/curved_mesh.hpp"
#include "tests/mesh/shaped_mesh.hpp"
#include "tests/mesh/whole_cells.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;
using Real = long double;

/// A facet of a reference cell: o + u e + v f, 0 <= u, v <= 1; a triangle is o + u (e + v (f - e)).
struct Patch {
    ReferencePlace o{}, e{}, f{};
    bool triangle = false;

    ReferencePlace at(Real u, Real v) const {
        ReferencePlace x = o;
        for (std::size_t k = 0; k < 3; ++k) x[k] += triangle ? u * (e[k] + v * (f[k] - e[k])) : u * e[k] + v * f[k];
        return x;
    }
};

std::vector<Patch> facets_of(std::uint8_t type, int dimension) {
    if (dimension == 2 && type == 9) return {{{}, {1}}, {{1}, {0, 1}}, {{0, 1}, {1}}, {{}, {0, 1}}};
    if (dimension == 2) return {{{}, {1}}, {{1}, {-1, 1}}, {{}, {0, 1}}};
    if (type == 13)
        return {{{}, {1}, {0, 1}, true},
                {{0, 0, 1}, {1}, {0, 1}, true},
                {{}, {1}, {0, 0, 1}},
                {{}, {0, 1}, {0, 0, 1}},
                {{1}, {-1, 1}, {0, 0, 1}}};
    if (type == 12 || type == 14) {
        std::vector<Patch> all{{{}, {1}, {0, 1}},
                               {{}, {1}, {0, 0, 1}},
                               {{}, {0, 1}, {0, 0, 1}},
                               {{1}, {0, 1}, {0, 0, 1}},
                               {{0, 1}, {1}, {0, 0, 1}}};
        if (type == 12) all.push_back({{0, 0, 1}, {1}, {0, 1}});
        return all;
    }
    return {{{}, {1}, {0, 1}, true},
            {{}, {1}, {0, 0, 1}, true},
            {{}, {0, 1}, {0, 0, 1}, true},
            {{1}, {-1, 1}, {-1, 0, 1}, true}};
}

/// Multi-indices of VTK's Lagrange simplices.
constexpr std::array<std::string_view, 6> orders{
    "200 020 002 110 011 101",
    "300 030 003 210 120 021 012 102 201 111",
    "400 040 004 310 220 130 031 022 013 103 202 301 211 121 112",
    "2000 0200 0020 0002 1100 0110 1010 1001 0101 0011",
    "3000 0300 0030 0003 2100 1200 0210 0120 1020 2010 2001 1002 0201 0102 0021 0012 1101 0111 1011 1110",
    "4000 0400 0040 0004 3100 2200 1300 0310 0220 0130 1030 2020 3010 3001 2002 1003 0301 0202 0103 0031 0022 0013 "
    "2101 1201 1102 0121 0112 0211 2011 1012 1021 2110 1120 1210 1111"};

std::vector<std::vector<int>> indices_of(int dimension, int order) {
    std::vector<std::vector<int>> all(1);
    for (const char c : orders[static_cast<std::size_t>((dimension == 2 ? 0 : 3) + order - 2)]) {
        if (c == ' ') {
            all.emplace_back();
        } else {
            all.back().push_back(c - '0');
        }
    }
    return all;
}

/// Lagrange's polynomials: products over the nodes of lower index.
std::vector<Real> lagrange(int dimension, int order, const ReferencePlace& x) {
    std::vector<Real> l{1}, out;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        l[0] -= x[k];
        l.push_back(x[k]);
    }
    for (const auto& index : indices_of(dimension, order)) {
        Real n = 1;
        for (std::size_t c = 0; c < index.size(); ++c) {
            for (int k = 0; k < index[c]; ++k) n *= (order * l[c] - k) / (index[c] - k);
        }
        out.push_back(n);
    }
    return out;
}

struct Found {
    Real square = HUGE_VALL, value = 0;
};

class Judge {
public:
    Judge(const Mesh& mesh, int order) : mesh_(mesh), order_(order), cells_(whole_cells(mesh)) {}

    /// Searches all facets of all cells: a grid of places, and steps from the best ones that get smaller.
    Found nearest(const double* p) const {
        Found best;
        for (std::size_t cell = 0; cell < cells_.count(); ++cell) {
            for (const Patch& patch : facets_of(cells_.types[cell], mesh_.dimension)) {
                constexpr int grid = 12;
                std::vector<std::array<Real, 3>> places;
                for (int i = 0; i <= grid; ++i) {
                    for (int j = 0; j <= (mesh_.dimension == 2 ? 0 : grid); ++j) {
                        const Real u = static_cast<Real>(i) / grid, v = static_cast<Real>(j) / grid;
                        places.push_back({at(cell, patch, u, v, p).square, u, v});
                    }
                }
                std::ranges::sort(places);
                for (std::size_t start = 0; start < 2; ++start) {
                    const Found own = descend(cell, patch, places[start], 1.0L / grid, p);
                    if (own.square < best.square) best = own;
                }
            }
        }
        return best;
    }

private:
    Found descend(std::size_t cell, const Patch& patch, std::array<Real, 3> from, Real step, const double* p) const {
        Found best = at(cell, patch, from[1], from[2], p);
        while (step > 1e-11L) {
            bool moved = false;
            for (int i = -1; i <= 1; ++i) {
                for (int j = -1; j <= 1; ++j) {
                    const Real u = std::clamp<Real>(from[1] + i * step, 0, 1);
                    const Real v = std::clamp<Real>(from[2] + j * step, 0, 1);
                    const Found own = at(cell, patch, u, v, p);
                    if (!(own.square < best.square)) continue;
                    best = own;
                    from = {0, u, v};
                    moved = true;
                }
            }
            if (!moved) step /= 2;
        }
        return best;
    }

    Found at(std::size_t cell, const Patch& patch, Real u, Real v, const double* p) const {
        const ReferencePlace x = patch.at(u, v);
        const std::uint8_t type = cells_.types[cell];
        const std::vector<Real> n =
            type == 9 ? std::vector<Real>{(1 - x[0]) * (1 - x[1]), x[0] * (1 - x[1]), x[0] * x[1], (1 - x[0]) * x[1]}
            : order_ != 1 ? lagrange(mesh_.dimension, order_, x)
                          : shape_functions(type, x);
        const auto nodes = cells_.of(cell);
        const auto d = static_cast<std::size_t>(mesh_.dimension);
        Found out{0, 0};
        for (std::size_t i = 0; i < n.size(); ++i)
            out.value += n[i] * mesh_.point_fields[0].data[static_cast<std::size_t>(nodes[i])];
        for (std::size_t k = 0; k < d; ++k) {
            Real sum = -static_cast<Real>(p[k]);
            for (std::size_t i = 0; i < n.size(); ++i)
                sum += n[i] * mesh_.points[d * static_cast<std::size_t>(nodes[i]) + k];
            out.square += sum * sum;
        }
        return out;
    }

    const Mesh& mesh_;
    int order_;
    CellArrays cells_;
};

/// Compares distances and values of random points outside; returns how many there were.
std::size_t expect_as_judged(const Mesh& mesh, int order, const std::vector<double>& points, const std::string& what) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Sampler sampler =
        Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
    if (sampler.locator().unmapped_cells() != 0) return 0;  // taken as straight
    const Judge judge(mesh, order);
    const Table rows = sampler.sample(points, {.outside = {Outside::nearest}}).value();
    EXPECT_EQ(rows.counts.undecided + rows.counts.unmapped, 0U) << what;
    std::size_t outside = 0;
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        if (rows.cells[i] >= 0) continue;
        ++outside;
        const Found found = judge.nearest(&points[d * i]);
        const auto distance = static_cast<double>(std::sqrt(found.square));
        EXPECT_NEAR(rows.distances[i], distance, 1e-13 * (1 + distance)) << what << ' ' << i;
        EXPECT_NEAR(rows.values[i], static_cast<double>(found.value), 1e-7) << what << ' ' << i;
        const Nearest nearest = sampler.locator().nearest(&points[d * i], HUGE_VAL).value();
        EXPECT_EQ(nearest.distance, rows.distances[i]) << what << ' ' << i;
        EXPECT_GE(nearest.nodes[0], 0) << what << ' ' << i;
        if (::testing::Test::HasFailure()) return outside;
    }
    return outside;
}

class NearestInMaps : public ::testing::Test {
protected:
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    std::vector<double> points_around(const Mesh& mesh, std::size_t count, double by) {
        std::vector<double> points;
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < d; ++k) {
                double low = HUGE_VAL, high = -HUGE_VAL;
                for (std::size_t n = k; n < mesh.points.size(); n += d) {
                    low = std::min(low, mesh.points[n]);
                    high = std::max(high, mesh.points[n]);
                }
                points.push_back(uniform(low - by, high + by));
            }
        }
        return points;
    }
    void add_field(Mesh& mesh) {
        mesh.point_fields = {{"f", 1, {}}};
        for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_fields[0].data.push_back(uniform(-1, 1));
    }
    std::mt19937 random_{54};
};

TEST_F(NearestInMaps, CellsOfHigherOrderBentBothWays) {
    for (const int d : {2, 3}) {
        for (int order = 2; order <= 4; ++order) {
            std::size_t outside = 0;
            for (int round = 0; round < 4; ++round) {
                Mesh mesh;
                mesh.dimension = d;
                std::vector<Index> nodes;
                for (const auto& index : indices_of(d, order)) {
                    nodes.push_back(static_cast<Index>(nodes.size()));
                    for (std::size_t k = 1; k < index.size(); ++k)
                        mesh.points.push_back(static_cast<double>(index[k]) / order +
                                              uniform(-0.08, 0.08) / ((order - 1) * (order - 1)));
                }
                add_shape(mesh, static_cast<std::uint8_t>(d == 2 ? 69 : 71), nodes);
                cut(mesh);
                add_field(mesh);
                outside += expect_as_judged(mesh, order, points_around(mesh, d == 2 ? 30 : 8, 0.3),
                                            std::to_string(d) + "D, order " + std::to_string(order));
            }
            EXPECT_GT(outside, 10U);
        }
    }
}

TEST_F(NearestInMaps, BallsOfSecondOrder) {
    for (const int d : {2, 3}) {
        for (const double part : {-0.3, 0.4, 1.0}) {
            Mesh mesh = testing::curved_ball(d, part);
            add_field(mesh);
            const std::size_t outside = expect_as_judged(mesh, 2, points_around(mesh, d == 2 ? 40 : 12, 0.2),
                                                         std::to_string(d) + "D, " + std::to_string(part));
            EXPECT_GT(outside, 4U);
        }
    }
}

TEST_F(NearestInMaps, WarpedCellsOfAllTypes) {
    for (const int number : {9, 12, 13, 14}) {
        const auto type = static_cast<std::uint8_t>(number);
        std::size_t outside = 0;
        for (int round = 0; round < 6; ++round) {
            Mesh mesh;
            mesh.dimension = type == 9 ? 2 : 3;
            std::vector<Index> nodes;
            for (const auto& place : reference_corners(static_cast<std::uint8_t>(type == 9 ? 12 : type))) {
                if (type == 9 && nodes.size() == 4) break;
                nodes.push_back(static_cast<Index>(nodes.size()));
                for (std::size_t k = 0; k < (type == 9 ? 2U : 3U); ++k)
                    mesh.points.push_back(static_cast<double>(place[k]) + uniform(-0.15, 0.15));
            }
            add_shape(mesh, type, nodes);
            cut(mesh);
            add_field(mesh);
            outside += expect_as_judged(mesh, 1, points_around(mesh, 8, 0.2), "type " + std::to_string(type));
        }
        EXPECT_GT(outside, 10U);
    }
}

/// Its lower side is y = t (1 - t) / 2: bent inwards.
Mesh bent_triangle() {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 0.5, 0.125, 0.5, 0.5, 0, 0.5};
    mesh.cells = {0, 1, 2};
    mesh.mid_nodes = {3, 4, 5};
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    mesh.point_fields = {{"f", 1, {1, 2, 3, 4, 5, 6}}};
    return mesh;
}

TEST_F(NearestInMaps, TiesFarPointsAndCorners) {
    const Mesh mesh = bent_triangle();
    const Sampler sampler = Sampler::build(mesh).value();
    // Beside the middle of the bent side; before both ends; beyond a corner; far away.
    const std::vector<double> points{0.5, 0.06, 0.5, -2, -3, -4, 0.25, -1e300, 2, 0x1p-1000};
    const Table rows = sampler.sample(points, {.outside = {Outside::nearest}}).value();
    EXPECT_EQ(rows.counts.undecided, 0U);
    EXPECT_EQ(rows.distances[0], 0.125 - 0.06);
    EXPECT_EQ(rows.values[0], 4);
    EXPECT_EQ(rows.distances[1], std::sqrt(4.25));
    EXPECT_EQ(rows.values[1], 1);  // of two ends the one with the lower node
    EXPECT_EQ(rows.distances[2], 5);
    EXPECT_EQ(rows.values[2], 1);
    EXPECT_EQ(rows.distances[3], 1e300);
    EXPECT_EQ(rows.values[3], 1);
    EXPECT_EQ(rows.distances[4], 1);
    EXPECT_EQ(rows.values[4], 2);
}

// At the centre of curvature the square of the distance is 1 + (t - 1/2)^4 / 4: no proof that there is one nearest
// point.
TEST_F(NearestInMaps, WhatIsNotProvedIsCounted) {
    const Mesh mesh = bent_triangle();
    const std::vector<double> centre{0.5, -0.875};
    const Table rows = Sampler::build(mesh).value().sample(centre, {.outside = {Outside::nearest}}).value();
    EXPECT_EQ(rows.distances[0], 1);
    EXPECT_EQ(rows.values[0], 4);
    EXPECT_EQ(rows.counts.undecided, 1U);
    EXPECT_GT(rows.counts.max_off, 0);
    // Parts are cut until values on them differ by 2 of the errors of square_parts.hpp: 2^-40 (2^2 + 2 * 2 * 0.875).
    EXPECT_LT(rows.counts.max_off, 0x1p-40 * 7.5 * 3);
}

TEST_F(NearestInMaps, WhatIsExtrapolatedGoesOnFromTheBoundary) {
    const Mesh mesh = bent_triangle();
    const Sampler sampler = Sampler::build(mesh).value();
    for (const double t : {0.125, 0.5, 0.75}) {
        const double y = t * (1 - t) / 2;
        const std::vector<double> points{t, y, t, y - 0x1p-40, t, y - 0x1p-3};
        const Table rows = sampler.sample(points, {.outside = {Outside::extrapolate}}).value();
        EXPECT_GE(rows.cells[0], 0);
        EXPECT_EQ(rows.cells[1], -1);
        // In reference coordinates the derivatives are below 18 and 11, the inverse of the Jacobian has entries
        // below 2.
        EXPECT_NEAR(rows.values[0], rows.values[1], 64 * 0x1p-40);
        EXPECT_EQ(rows.counts.unmapped, 0U);
    }
}

/// 2^3 hexahedra; the field is the first coordinate, which the cells' own functions give back everywhere.
Mesh warped_hexahedra(double by, const auto& uniform) {
    Mesh mesh;
    for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 3; ++i) {
                for (const int x : {i, j, k}) mesh.points.push_back(x + uniform(-by, by));
            }
        }
    }
    for (const int k : {0, 9}) {
        for (const int j : {0, 3}) {
            for (const int i : {0, 1}) {
                std::vector<Index> nodes;
                for (const int corner : {0, 1, 4, 3, 9, 10, 13, 12}) nodes.push_back(i + j + k + corner);
                add_shape(mesh, 12, nodes);
            }
        }
    }
    cut(mesh);
    mesh.point_fields = {{"x", 1, {}}};
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) mesh.point_fields[0].data.push_back(mesh.points[i]);
    return mesh;
}

TEST_F(NearestInMaps, WarpedCellsAreContinuedFar) {
    for (const double by : {0.05, 0.15}) {
        const Mesh mesh = warped_hexahedra(by, [&](double low, double high) { return uniform(low, high); });
        const Sampler sampler =
            Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
        ASSERT_EQ(sampler.locator().unmapped_cells(), 0U);
        const std::vector<double> points = points_around(mesh, 400, 0.6);
        const Table rows = sampler.sample(points, {.outside = {Outside::extrapolate}}).value();
        std::uint64_t others = 0;
        for (std::size_t i = 0; i < rows.row_count(); ++i) others += rows.values[i] != points[3 * i] ? 1 : 0;
        EXPECT_EQ(others, rows.counts.unmapped) << by;
        EXPECT_LE(others, by < 0.1 ? 0U : 4U) << by;
    }
}

TEST_F(NearestInMaps, AffineCellsAreContinuedEverywhere) {
    Mesh mesh;
    std::vector<Index> nodes;
    for (const auto& place : reference_corners(12)) {
        nodes.push_back(static_cast<Index>(nodes.size()));
        for (const Real x : place) mesh.points.push_back(static_cast<double>(x));
    }
    add_shape(mesh, 12, nodes);
    cut(mesh);
    mesh.point_fields = {{"f", 1, {1, 2, 3, 4, 5, 6, 7, 8}}};
    const Sampler sampler =
        Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
    const std::vector<double> points{5, 6, 7, -300, 2, 0.5};
    const Table rows = sampler.sample(points, {.outside = {Outside::extrapolate}}).value();
    // 1 + r + 3 s - 2 r s + 4 t
    EXPECT_EQ(rows.values[0], 1 + 5 + 18 - 60 + 28);
    EXPECT_EQ(rows.values[1], 1 - 300 + 6 + 1200 + 2);
    EXPECT_EQ(rows.counts.unmapped, 0U);
}

TEST_F(NearestInMaps, WeightsGiveTheValues) {
    Mesh mesh = testing::curved_ball(3, 0.4);
    add_field(mesh);
    const Sampler sampler = Sampler::build(mesh).value();
    const std::vector<double> points = points_around(mesh, 60, 0.3);
    for (const Outside kind : {Outside::nearest, Outside::extrapolate}) {
        Table rows = sampler.sample(points, {.outside = {kind}}).value();
        rows.points = points;
        const NodeWeights weights = node_weights(sampler.locator(), rows.view(), {kind}).value();
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            double value = 0;
            for (std::size_t k = weights.begin[i]; k < weights.begin[i + 1]; ++k)
                value += weights.weights[k] * mesh.point_fields[0].data[static_cast<std::size_t>(weights.nodes[k])];
            EXPECT_NEAR(value, rows.values[i], 1e-13 * (1 + std::abs(value))) << i;
        }
    }
}

}  // namespace
}  // namespace barycert::test
