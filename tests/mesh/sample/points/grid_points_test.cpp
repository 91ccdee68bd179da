// Grids along axes whose cells are not listed: the answers of the same cells in lists, and of rationals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/sample/points/rows.hpp"
#include "tests/mesh/sample/quantity/quantities.hpp"

namespace barycert::testing {
namespace {

using Axes = std::vector<std::vector<double>>;

struct Grids {
    Mesh unlisted, listed;
};

/// With fields of nodes and cells; `odd`: some values are not finite, and some nodes have 0.
Grids make_grids(const Axes& axes, bool odd, base::Random& random) {
    Grids g;
    Mesh &bare = g.unlisted, &mesh = g.listed;
    bare.dimension = mesh.dimension = static_cast<int>(axes.size());
    const std::size_t d = axes.size(), corners = std::size_t{1} << d;
    std::array<std::size_t, 3> n{1, 1, 1};
    for (std::size_t k = 0; k < d; ++k) n[k] = (bare.axes[k] = axes[k]).size();
    for (std::size_t i = 0; i < n[0] * n[1] * n[2]; ++i) {
        const std::array<std::size_t, 3> at{i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
        for (std::size_t k = 0; k < d; ++k) mesh.points.push_back(axes[k][at[k]]);
        bool upper = false;
        for (std::size_t k = 0; k < d; ++k) upper = upper || at[k] + 1 == n[k];
        if (upper) continue;
        mesh.shapes.types.push_back(d == 3 ? 11 : 8);
        for (std::size_t c = 0; c < corners; ++c)
            mesh.shapes.nodes.push_back(
                static_cast<Mesh::Index>(i + (c & 1U) + (c >> 1U & 1U) * n[0] + (c >> 2U) * n[0] * n[1]));
        mesh.shapes.ends.push_back(static_cast<std::int64_t>(mesh.shapes.nodes.size()));
    }
    Field one{"one", 1, {}}, three{"three", 3, {}};
    for (std::size_t i = 0; i < 4 * mesh.point_count(); ++i) {
        double value = std::ldexp(random.uniform(-1, 1), random.integer(-3, 3));
        const auto kind = random.below(40);
        if (odd && kind < 3) value = kind == 0 ? 0.0 : kind == 1 ? HUGE_VAL : std::nan("");
        (i % 4 == 0 ? one : three).data.push_back(value);
    }
    Field cells{"cells", 2, {}};
    for (std::size_t i = 0; i < 2 * mesh.shapes.count(); ++i) cells.data.push_back(random.uniform(-1, 1));
    bare.point_fields = mesh.point_fields = {one, three};
    bare.cell_fields = mesh.cell_fields = {cells};
    EXPECT_FALSE(mesh::cut_into_simplices(mesh));
    return g;
}

/// Anywhere, exactly on planes, a few ulps from them, and outside.
std::vector<double> points_in(const Axes& axes, std::size_t count, base::Random& random) {
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::vector<double>& axis : axes) {
            const double low = axis.front(), high = axis.back(), plane = axis[random.below(axis.size())];
            const double beside = std::nextafter(plane, random.coin() ? HUGE_VAL : -HUGE_VAL);
            const auto kind = random.below(12);
            const double middle = plane / 2 + axis[random.below(axis.size())] / 2;
            points.push_back(kind < 3     ? plane
                             : kind == 3  ? beside
                             : kind == 4  ? middle
                             : kind == 11 ? random.uniform(low - 1, high + 1)
                                          : low + random.uniform(0, 1) * (high - low));
        }
    }
    return points;
}

Rational value_of(const Grids& g, const Field& field, std::size_t component, const double* p, bool multilinear) {
    const auto d = static_cast<std::size_t>(g.unlisted.dimension);
    std::array<std::size_t, 3> at{}, step{}, order{0, 1, 2};
    std::array<Rational, 3> t;
    std::size_t nodes = 1, lowest = 0;
    for (std::size_t k = 0; k < d; ++k) {
        const std::vector<double>& axis = g.unlisted.axes[k];
        while (at[k] + 2 < axis.size() && axis[at[k] + 1] < p[k]) ++at[k];
        t[k] = (Rational(p[k]) - Rational(axis[at[k]])) / (Rational(axis[at[k] + 1]) - Rational(axis[at[k]]));
        step[k] = nodes;
        nodes *= axis.size();
        lowest += at[k] * step[k];
    }
    const auto value = [&](std::size_t node) {
        return Rational(field.data[static_cast<std::size_t>(field.components) * node + component]);
    };
    Rational sum = 0;
    if (multilinear) {
        for (std::size_t corner = 0; corner < std::size_t{1} << d; ++corner) {
            Rational weight = 1;
            std::size_t node = lowest;
            for (std::size_t k = 0; k < d; ++k) {
                const bool high = (corner >> k & 1U) != 0;
                weight *= high ? t[k] : Rational(1 - t[k]);
                node += high ? step[k] : 0;
            }
            if (weight != 0) sum += weight * value(node);
        }
        return sum;
    }
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(d),
              [&](std::size_t a, std::size_t b) { return t[a] > t[b]; });
    sum = value(lowest);
    for (std::size_t i = 0, node = lowest; i < d; node += step[order[i++]])
        sum += t[order[i]] * (value(node + step[order[i]]) - value(node));
    return sum;
}

void expect_alike(const Grids& g, const Axes& axes, const std::vector<double>& points, bool odd) {
    const std::vector<std::string> fields{"one", "three", "|three|", "three.y", "cells"};
    const std::size_t d = axes.size();
    for (const CellInterpolation how : {CellInterpolation::linear, CellInterpolation::multilinear}) {
        const bool multilinear = how == CellInterpolation::multilinear;
        const BuildOptions options{.interpolation = how, .progress = {}};
        const auto of = [&](const Mesh& mesh) { return Sampler::build(mesh, fields, options); };
        const auto bare = of(g.unlisted), lists = of(g.listed);
        ASSERT_TRUE(bare) << bare.error().message();
        ASSERT_TRUE(lists) << lists.error().message();
        ASSERT_TRUE(bare->locator().certified());
        ASSERT_EQ(bare->locator().interpolation(), how);
        ASSERT_EQ(bare->locator().degenerate_cells(), 0U);
        const OutsidePolicy outside{.kind = multilinear ? Outside::fill : Outside::nan, .fill = -7};
        const Table a = bare->sample(points, {.outside = outside, .threads = 3}).value();
        const Table b = lists->sample(points, {.outside = outside}).value();
        const Table alone = bare->locator().locate(points).value();
        ASSERT_EQ(a.columns, b.columns);
        ASSERT_EQ(a.counts.locations.face, b.counts.locations.face);
        ASSERT_EQ(a.counts.locations.points(), b.counts.locations.points());
        ASSERT_EQ(a.counts.without_value, b.counts.without_value);
        EXPECT_EQ(a.counts.values.cases(), b.counts.values.cases());
        if (!odd) {
            EXPECT_GT(a.counts.values.double_double, 9 * a.counts.values.exact);
        }
        EXPECT_EQ(a.features, alone.features);
        EXPECT_EQ(a.cells, alone.cells);
        for (std::size_t i = 0; i < a.row_count(); ++i) {
            const double* const p = &points[d * i];
            ASSERT_EQ(a.cells[i], g.listed.cell_number(b.cells[i])) << i;
            ASSERT_EQ(a.features[i], b.features[i]) << i;
            const Location one = bare->locator().locate(p).value();
            ASSERT_EQ(one.cell, a.cells[i]);
            ASSERT_EQ(one.feature, a.features[i]);
            for (std::size_t c = 0; c < a.columns.size(); ++c)
                ASSERT_TRUE(same(a.value(i, c), b.value(i, c))) << i << a.columns[c] << multilinear;
            if (odd || a.cells[i] < 0) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const Rational exact = value_of(g, g.unlisted.point_fields[1], c, p, multilinear);
                ASSERT_TRUE(same(a.value(i, c + 1), second_path::nearest(exact))) << i << multilinear;
            }
        }
    }
}

TEST(GridPoints, D1L1V1AsListedCells) {
    base::Random random(37);
    for (int round = 0; round < 24; ++round) {
        SCOPED_TRACE(round);
        const bool uniform = round % 3 == 0, odd = round % 4 == 3;
        Axes axes(round % 5 == 4 ? 2 : 3);
        for (std::vector<double>& axis : axes) {
            double x = random.uniform(-4, 4);
            const double step = random.uniform(0.1, 2);
            for (std::size_t i = random.below(7) + 2; i > 0; --i) {
                axis.push_back(x);
                // From one step to the next 2^12 times as wide: the first guess is wrong.
                x += uniform ? step : std::ldexp(random.uniform(0.5, 1), random.integer(-8, 4));
            }
        }
        const Grids g = make_grids(axes, odd, random);
        expect_alike(g, axes, points_in(axes, 400, random), odd);
    }
}

// Values within 2^-150 of the middle between two doubles, or there: what two doubles hold cannot tell on which side.
TEST(GridPoints, V1NearTies) {
    base::Random random(53);
    const Axes axes{{0, 1}, {0, 1.25}, {-1, 0.125}};
    Grids g = make_grids(axes, false, random);
    for (int round = 0; round < 400; ++round) {
        const bool multilinear = round % 2 == 0;
        std::vector<double> p;
        for (const std::vector<double>& axis : axes) p.push_back(random.uniform(axis[0], axis[1]));
        std::vector<std::pair<Rational, std::size_t>> weights;
        for (std::size_t node = 0; node < 8; ++node) {
            Field unit{"unit", 1, std::vector<double>(8, 0.0)};
            unit.data[node] = 1;
            weights.emplace_back(value_of(g, unit, 0, p.data(), multilinear), node);
        }
        std::ranges::sort(weights, std::greater());
        Field near{"near", 1, std::vector<double>(8, 0.0)};
        near.data[weights[0].second] = random.uniform(1, 2);
        const double about = second_path::nearest(weights[0].first * near.data[weights[0].second]);
        const Rational middle = (Rational(about) + Rational(std::nextafter(about, 2.0))) / 2;
        Rational left = middle - weights[0].first * near.data[weights[0].second];
        for (std::size_t i = 1; i < 4; ++i) {
            double& value = near.data[weights[i].second];
            value = second_path::nearest(left / weights[i].first);
            left -= weights[i].first * value;
        }
        ASSERT_LT(abs(left), Rational(std::ldexp(1.0, -150)));
        g.unlisted.point_fields[0] = near;
        const auto how = multilinear ? CellInterpolation::multilinear : CellInterpolation::linear;
        const auto sampler = Sampler::build(g.unlisted, {"near"}, {.interpolation = how, .progress = {}});
        ASSERT_TRUE(sampler) << sampler.error().message();
        const Table rows = sampler->sample(p).value();
        EXPECT_EQ(rows.counts.values.exact, 1U);
        ASSERT_EQ(rows.values[0], second_path::nearest(middle - left)) << round;
    }
}

// On a grid of other points: as at these points.
TEST(GridPoints, D1OntoAGrid) {
    base::Random random(11);
    const Axes axes{{0, 1, 2.5}, {-1, 0, 1, 3}, {0, 0.25, 4}};
    const Grids g = make_grids(axes, false, random);
    const Bounds3 box = bounds_of_cells(g.unlisted);
    EXPECT_EQ(box.low, bounds_of_cells(g.listed).low);
    EXPECT_EQ(box.high, bounds_of_cells(g.listed).high);
    const Grid grid = grid_over(3, {9, 8, 7}, box.low, box.high).value();
    std::vector<std::vector<double>> values;
    for (const Mesh* mesh : {&g.unlisted, &g.listed}) {
        const Sampler sampler = Sampler::build(*mesh, {"three", "cells"}).value();
        std::vector<double>& own = values.emplace_back();
        const auto sink = [&](const TableView& rows) -> Status {
            own.insert(own.end(), rows.values.begin(), rows.values.end());
            return Done{};
        };
        const Result<SampleCounts> counts = resample(sampler, grid, {}, sink);
        ASSERT_TRUE(counts) << counts.error().message();
        EXPECT_EQ(counts->locations.outside, 0U);
    }
    EXPECT_EQ(values[0], values[1]);
}

// Steps and values that the lanes have no bound for; and none that is not decided in the end.
TEST(GridPoints, V1ExtremeSteps) {
    base::Random random(5);
    for (const auto& [low, step] : {std::pair(0.0, 0x1p-230), {0x1p-1000, 0x1p-1022}, {-0x1p1000, 0x1p998}}) {
        Axes axes(3);
        for (std::vector<double>& axis : axes)
            for (int i = 0; i < 4; ++i) axis.push_back(low + i * step);
        const Grids g = make_grids(axes, true, random);
        expect_alike(g, axes, points_in(axes, 60, random), true);
    }
}

// Axes whose length, or the number of cells a unit, no double holds: the first guess of a plane is any.
TEST(GridPoints, V1AxesBeyondDoubles) {
    base::Random random(6);
    for (const auto& [low, step] : {std::pair(0.0, 0x1p-1074), {-0x1.8p1023, 0x1p1023}}) {
        Axes axes(3);
        for (std::vector<double>& axis : axes) {
            axis = {low};
            for (int i = 0; i < 3; ++i) axis.push_back(axis.back() + step);
        }
        const Grids g = make_grids(axes, false, random);
        std::vector<double> points;
        for (int i = 0; i < 300; ++i) {  // halves of subnormal numbers round
            const double middle = axes[0][random.below(4)] / 2 + axes[0][random.below(4)] / 2;
            points.push_back(std::clamp(middle, axes[0].front(), axes[0].back()));
        }
        for (const CellInterpolation how : {CellInterpolation::linear, CellInterpolation::multilinear}) {
            const auto sampler = Sampler::build(g.unlisted, {"three"}, {.interpolation = how, .progress = {}});
            ASSERT_TRUE(sampler) << sampler.error().message();
            const Table rows = sampler->sample(points).value();
            EXPECT_EQ(rows.counts.locations.outside, 0U);
            for (std::size_t i = 0; i < rows.row_count(); ++i) {
                const bool multilinear = how == CellInterpolation::multilinear;
                const Rational exact = value_of(g, g.unlisted.point_fields[1], 1, &points[3 * i], multilinear);
                ASSERT_EQ(rows.value(i, 1), second_path::nearest(exact)) << i << multilinear << step;
            }
        }
    }
}

TEST(GridPoints, E1WhatAsksForListsOfCells) {
    base::Random random(1);
    const Mesh mesh = make_grids({{0, 1, 2}, {0, 1}, {0, 1}}, false, random).unlisted;
    const Locator locator = Locator::build(mesh).value();
    const Sampler sampler = Sampler::build(mesh, {"one"}).value();
    const std::vector<double> point{0.5, 0.5, 0.5};
    const auto expect_refused = [](const auto& result) {
        ASSERT_FALSE(result);
        EXPECT_NE(result.error().message().find("list"), std::string::npos) << result.error().message();
    };
    expect_refused(locator.locate_all(point));
    expect_refused(locator.nearest(point.data(), 1));
    expect_refused(sampler.sample(point, {.outside = {.kind = Outside::nearest}}));
    expect_refused(sampler.sample(point, {.rounding = Rounding::plain}));
    Table rows = locator.locate(point).value();
    rows.points = point;
    expect_refused(node_weights(locator, rows.view()));
    expect_refused(sampler.evaluate(point, {}, rows));
    expect_refused(Sampler::build(mesh, {"grad(one)"}));
    expect_refused(Sampler::build(mesh, {"mean(cells)"}));
    expect_refused(write_vtu(mesh, "never.vtu"));
    EXPECT_FALSE(check_mesh(mesh).certified());
    expect_refused(slice(mesh, {{1, 0, 0}, 0.5}));
    ClaimedRows claimed;
    claimed.points = point;
    expect_refused(Verifier(sampler, {}).verify(claimed));
    EXPECT_FALSE(locator.locate(std::vector<double>{0.5, std::nan(""), 0.5}));
    Mesh wrong = mesh;
    wrong.axes[1] = {1, 1};
    EXPECT_FALSE(Locator::build(wrong));
    wrong.axes[1] = {0, HUGE_VAL};
    EXPECT_FALSE(Locator::build(wrong));
    wrong = mesh;
    wrong.points = {0, 0, 0};
    EXPECT_FALSE(Locator::build(wrong));
}

}  // namespace
}  // namespace barycert::testing
