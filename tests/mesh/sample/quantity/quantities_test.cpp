// Gradients, lengths, components and means at points: exact ones, rounded by the definition, or within the bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/grid.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"
#include "tests/mesh/sample/quantity/quantities.hpp"

namespace barycert::testing {
namespace {

using testing_rational::nearest;

const std::vector<std::string> all_quantities{"grad(f0)",   "|f0|",       "f0.1",      "mean(g)", "grad(mean(g)).0",
                                              "|g|",        "|grad(f1)|", "|mean(g)|", "f1",      "g.0",
                                              "grad(f0).y", "grad(f1.0)"};

/// Node fields f0 of two components and f1 of one, cell field g of two.
Mesh with_fields(Mesh mesh, bool awkward, base::Random& random) {
    mesh.point_fields = random_fields(mesh.point_count(), {2, 1}, awkward, random);
    mesh.cell_fields = random_fields(mesh.cell_count(), {2}, awkward, random);
    mesh.cell_fields[0].name = "g";
    return mesh;
}

std::size_t column_of(const Sampler& sampler, const std::string& name) {
    const auto& all = sampler.columns();
    const auto it = std::find(all.begin(), all.end(), name);
    EXPECT_NE(it, all.end()) << name;
    return static_cast<std::size_t>(it - all.begin());
}

/// Every number of every row inside.
std::size_t expect_true_quantities(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    const auto sampler = Sampler::build(mesh, all_quantities);
    if (!sampler) {
        ADD_FAILURE() << what << ": " << sampler.error().message();
        return 0;
    }
    const Table rows = sampler->sample(points).value();
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Field &f0 = mesh.point_fields[0], &f1 = mesh.point_fields[1], &g = mesh.cell_fields[0];
    const auto found = [&](std::size_t i, const std::string& name) { return rows.value(i, column_of(*sampler, name)); };
    const auto gradient_of = [&](const Field& field, std::size_t c, std::size_t i) {
        const auto q = quadratic_case(mesh, field, c, rows.cells[i], &points[d * i]);
        std::vector<Rational> out;
        const auto l = *second_path::weights(q.linear);
        for (std::size_t k = 0; k < d; ++k) out.emplace_back(0);
        for (std::size_t v = 0; v < l.size(); ++v) {
            Case unit = q.linear;
            unit.values.fill(0);
            unit.values[v] = 1;
            const auto of_weight = *testing_fields::exact_gradient(unit);
            // The derivative of the value by weight v, see weights.hpp; linear: the value of the corner.
            Rational by = Rational(q.linear.values[v]) * (q.mids.empty() ? Rational(1) : Rational(4 * l[v] - 1));
            for (std::size_t e = 0; e < q.mids.size(); ++e) {
                const auto ends = testing_fields::edge(e);
                for (const std::size_t side : {0U, 1U}) {
                    if (static_cast<std::size_t>(ends[side]) == v)
                        by += 4 * l[static_cast<std::size_t>(ends[1 - side])] * Rational(q.mids[e]);
                }
            }
            for (std::size_t k = 0; k < d; ++k) out[k] += by * of_weight[k];
        }
        return out;
    };
    // Means at nodes, as a field of their own.
    Field mean{"m", 2, {}};
    for (std::size_t node = 0; node < mesh.point_count(); ++node) {
        for (std::size_t c = 0; c < 2; ++c) {
            const auto exact = exact_mean(mesh, g, c, static_cast<Mesh::Index>(node));
            mean.data.push_back(exact ? second_path::nearest(*exact) : std::nan(""));
        }
    }
    std::size_t inside = 0;
    for (std::size_t i = 0; i < rows.cells.size() && !::testing::Test::HasFailure(); ++i) {
        if (rows.cells[i] < 0) {
            for (std::size_t c = 0; c < rows.columns.size(); ++c) EXPECT_TRUE(std::isnan(rows.value(i, c))) << what;
            continue;
        }
        ++inside;
        const double* const p = &points[d * i];
        const auto cell = static_cast<std::size_t>(rows.cells[i]);
        SCOPED_TRACE(what + text_of(p, mesh.dimension) + " in " + std::to_string(rows.cells[i]));
        for (std::size_t c = 0; c < 2; ++c) {
            const auto exact = gradient_of(f0, c, i);
            for (std::size_t k = 0; k < d; ++k)
                EXPECT_TRUE(nearest(found(i, "grad(f0)." + std::to_string(d * c + k)), exact[k]));
        }
        EXPECT_TRUE(nearest(found(i, "grad(f0).y"), gradient_of(f0, 0, i)[1]));
        Rational slope(0), length(0);
        for (const Rational& x : gradient_of(f1, 0, i)) slope += x * x;
        EXPECT_TRUE(is_near_root(found(i, "|grad(f1)|"), slope, 2));
        EXPECT_TRUE(
            same(found(i, "grad(f1.0)." + std::to_string(d - 1)), second_path::nearest(gradient_of(f1, 0, i)[d - 1])));
        for (std::size_t c = 0; c < 2; ++c) {
            const Rational x = *exact_value(mesh, f0, c, rows.cells[i], p);
            length += x * x;
        }
        EXPECT_TRUE(is_near_root(found(i, "|f0|"), length, 2));
        EXPECT_TRUE(found(i, "|f0|") < 0x1p-1000 || is_near_root(found(i, "|f0|"), length, 1.51));
        EXPECT_TRUE(nearest(found(i, "f0.1"), *exact_value(mesh, f0, 1, rows.cells[i], p)));
        for (std::size_t c = 0; c < 2; ++c)
            EXPECT_TRUE(
                nearest(found(i, "mean(g)." + std::to_string(c)), *exact_value(mesh, mean, c, rows.cells[i], p)));
        EXPECT_TRUE(nearest(found(i, "grad(mean(g)).0"), gradient_of(mean, 0, i)[0]));
        const Rational a(g.data[2 * cell]), b(g.data[2 * cell + 1]);
        EXPECT_TRUE(is_near_root(found(i, "|g|"), a * a + b * b, 0.51));
        EXPECT_TRUE(same(found(i, "g.0"), g.data[2 * cell]));
        EXPECT_TRUE(nearest(found(i, "f1"), *exact_value(mesh, f1, 0, rows.cells[i], p)));
    }
    return inside;
}

TEST(Quantities, OfOwnMeshes) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "lattice-eighths", "plate", "needle-slit"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = with_fields(own_mesh(stem), false, random);
        EXPECT_GT(expect_true_quantities(mesh, awkward_points(mesh, 2, random), stem), 10U) << stem;
    }
}

TEST(Quantities, OfBadMeshesAndAwkwardValues) {
    for (const int d : {2, 3}) {
        std::size_t inside = 0;
        for (std::uint64_t k = 0; k < 60 && !HasFailure(); ++k) {
            base::Random random = base::Random::stream(7, static_cast<std::uint64_t>(d), k);
            Mesh mesh = k % 3 == 0   ? random_soup(d, random)
                        : k % 3 == 1 ? grown_complex(d, random)
                                     : damaged_box(d, random);
            if (mesh.cells.empty()) continue;
            // The largest values overflow in a gradient, but a length of such is infinite only if it must be: left out.
            mesh = with_fields(std::move(mesh), false, random);
            for (double& x : mesh.point_fields[1].data) x *= 0x1p-1060;
            const std::array<double, 3> extremes{0x1p-1040, 1, 0x1p400};
            const double scale = extremes[k / 3 % 3];
            for (double& x : mesh.points) x *= scale;
            inside += expect_true_quantities(mesh, awkward_points(mesh, 1, random), std::to_string(k));
        }
        EXPECT_GT(inside, 100U);
    }
}

// Hidden columns, filled grids, known owners and threads: the same bits.
TEST(Quantities, D1WhateverFindsTheOwner) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = with_fields(own_mesh(stem), true, random);
        for (const std::vector<std::string>& names :
             {std::vector<std::string>{"|f0|"}, {"|f0|", "f0"}, {"f1", "|f0|", "g"}, {"grad(f0)"}, all_quantities}) {
            const auto sampler = Sampler::build(mesh, names);
            ASSERT_TRUE(sampler) << sampler.error().message();
            const Bounds3 box = bounds_of_cells(mesh);
            const Grid grid = over(mesh.dimension, {7, 5, mesh.dimension == 2 ? 1 : 6}, box.low, box.high);
            for (const Outside outside : {Outside::nan, Outside::fill, Outside::nearest, Outside::extrapolate}) {
                SampleOptions options;
                options.outside = {.kind = outside, .fill = -3};
                expect_law(*sampler, grid, options, stem);
                const std::vector<double> points = points_of(grid);
                options.threads = 1;
                const Table one = sampler->sample(points, options).value();
                options.threads = 4;
                EXPECT_TRUE(same(one, sampler->sample(points, options).value())) << stem;
                Table again = one;
                again.values.assign(again.values.size(), 17);
                ASSERT_TRUE(sampler->evaluate(points, options, again));
                EXPECT_TRUE(same(one, again)) << stem;
                for (std::size_t i = 0; outside == Outside::fill && i < one.cells.size(); ++i) {
                    for (std::size_t c = 0; one.cells[i] < 0 && c < one.columns.size(); ++c)
                        ASSERT_EQ(one.value(i, c), -3) << stem;
                }
            }
        }
    }
}

// A point on a facet has the gradient of the lowest cell, and one outside that of the nearest cell.
TEST(Quantities, GradientsJump) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 1, 1};
    mesh.cells = {1, 2, 3, 0, 1, 2};
    mesh.point_fields = {{"T", 1, {0, 1, 2, 7}}};
    const auto sampler = Sampler::build(mesh, {"grad(T)", "T"});
    const std::vector<double> points{0.5, 0.5, 0.25, 0.25, 2, 2, -1, 0.5};
    const auto row = [&](const Table& rows, std::size_t i) {
        return std::vector<double>(rows.values.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                   rows.values.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    };
    // The first component of one component is itself.
    EXPECT_EQ(Sampler::build(mesh, {"grad(T).y.x"})->sample(points)->values.at(0), 6);
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        Table rows = sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::nearest}}).value();
        EXPECT_EQ(sampler->columns(), (std::vector<std::string>{"T", "grad(T).0", "grad(T).1"}));
        EXPECT_EQ(row(rows, 0), (std::vector<double>{1.5, 5, 6}));
        EXPECT_EQ(row(rows, 1), (std::vector<double>{0.75, 1, 2}));
        EXPECT_EQ(row(rows, 2), (std::vector<double>{7, 5, 6}));
        EXPECT_EQ(row(rows, 3), (std::vector<double>{1, 1, 2}));
        rows = sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::extrapolate}}).value();
        EXPECT_EQ(row(rows, 2), (std::vector<double>{18, 5, 6}));
    }
}

// On cells of second order at the nearest point, or where the point is.
TEST(Quantities, GradientsOfSecondOrderOutside) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 0.5, 0, 0.5, 0.5, 0, 0.5};
    mesh.cells = {0, 1, 2};
    mesh.mid_nodes = {3, 4, 5};
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    Field f{"T", 1, {}};  // x^2 + 3 x y
    for (std::size_t i = 0; i < 6; ++i) {
        const double x = mesh.points[2 * i], y = mesh.points[2 * i + 1];
        f.data.push_back(x * x + 3 * x * y);
    }
    mesh.point_fields = {f};
    const auto sampler = Sampler::build(mesh, {"grad(T)", "grad(T).x", "|grad(T)|"});
    ASSERT_TRUE(sampler) << sampler.error().message();
    const std::vector<double> points{0.25, 0.5, 0.25, -2, 3, 0, 2, 2};
    const auto at = [](double x, double y) { return std::array<double, 2>{2 * x + 3 * y, 3 * x}; };
    const auto expect = [&](const Table& rows, std::size_t i, std::array<double, 2> g) {
        EXPECT_EQ(rows.value(i, 0), g[0]);
        EXPECT_EQ(rows.value(i, 1), g[1]);
        EXPECT_EQ(rows.value(i, 2), g[0]);
        EXPECT_NEAR(rows.value(i, 3), std::hypot(g[0], g[1]), 1e-15 * std::hypot(g[0], g[1]));
    };
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        const Table snapped =
            sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::nearest}}).value();
        expect(snapped, 0, at(0.25, 0.5));
        expect(snapped, 1, at(0.25, 0));
        expect(snapped, 2, at(1, 0));
        expect(snapped, 3, at(0.5, 0.5));
        const Table beyond =
            sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::extrapolate}}).value();
        for (std::size_t i = 0; i < 4; ++i) expect(beyond, i, at(points[2 * i], points[2 * i + 1]));
    }
}

TEST(Quantities, LengthsAtTheEndsOfTheRange) {
    Mesh mesh = box(2, {1, 1, 1});
    const double max = std::numeric_limits<double>::max(), tiny = 0x1p-1074;
    const auto length = [&](std::vector<double> v) {
        mesh.point_fields = {{"v", static_cast<int>(v.size()), {}}};
        for (std::size_t i = 0; i < mesh.point_count(); ++i)
            mesh.point_fields[0].data.insert(mesh.point_fields[0].data.end(), v.begin(), v.end());
        const std::vector<double> point{0.25, 0.5};
        return Sampler::build(mesh, {"|v|"})->sample(point)->values.at(0);
    };
    EXPECT_EQ(length({3, -4}), 5);
    EXPECT_EQ(length({3 * tiny, -4 * tiny}), 5 * tiny);
    EXPECT_EQ(length({0x1.8p1021, -0x1p1022}), 0x1.4p1022);
    EXPECT_EQ(length({-0.0}), 0);
    EXPECT_EQ(length({-2.5}), 2.5);
    EXPECT_EQ(length({max, 0}), max);
    EXPECT_TRUE(std::isinf(length({max, max})));
    EXPECT_EQ(length({tiny, 1e300}), 1e300);
    EXPECT_TRUE(std::isnan(length({std::nan(""), 1})));
    EXPECT_EQ(length({1, 1, 1, 1, -1, 1, 1, 1, 1, 4}), 5);
}

}  // namespace
}  // namespace barycert::testing
