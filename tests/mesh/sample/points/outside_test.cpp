// E1: nothing is silent. Points outside, by every policy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Mesh own_with_field(const std::string& stem) {
    Mesh mesh = own_mesh(stem);
    base::Random random(1);
    mesh.cell_fields = random_fields(mesh.cell_count(), {2}, false, random);
    return mesh;
}

/// Some inside, some outside, none at the ends of the doubles.
std::vector<double> points_around(const Mesh& mesh, base::Random& random) {
    std::vector<double> points = awkward_points(mesh, 60, random);
    for (double& x : points) x = std::abs(x) < 1e20 ? x : 7.3;
    return points;
}

/// The value of the linear field at the orthogonal projection to what the nodes span.
double true_projected(const Mesh& mesh, const Field& field, std::size_t c, const Nearest& nearest,
                      const double* point) {
    std::vector<Mesh::Index> nodes(nearest.nodes.begin(), nearest.nodes.end());
    std::erase(nodes, -1);
    const std::size_t n_corners = mesh.corners(), first = n_corners * static_cast<std::size_t>(nearest.cell);
    for (std::size_t i = 0; i < n_corners; ++i) {
        const auto node = static_cast<std::size_t>(mesh.cells[first + i]);
        if (!std::isfinite(field.data[static_cast<std::size_t>(field.components) * node + c])) return std::nan("");
    }
    const auto d = static_cast<std::size_t>(mesh.dimension), n = static_cast<std::size_t>(field.components);
    const auto at = [&](Mesh::Index node) { return field.data[n * static_cast<std::size_t>(node) + c]; };
    if (nodes.size() == 1) return at(nodes[0]);
    Case question{.simplex = nodes.size() == 3 ? Simplex::triangle3d : Simplex::segment};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k)
            question.vertices[3 * i + k] = mesh.points[d * static_cast<std::size_t>(nodes[i]) + k];
        question.values[i] = at(nodes[i]);
    }
    for (std::size_t k = 0; k < d; ++k) question.point[k] = point[k];
    return ask_oracle(question).value;
}

void expect_outside(const Mesh& mesh, const std::vector<double>& points, const OutsidePolicy& policy,
                    const std::string& what) {
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    ASSERT_TRUE(sampler);
    Table samples;
    const SampleCounts& counts = samples.counts;
    ASSERT_TRUE(sampler->sample(points, {.outside = policy}, samples)) << what;
    expect_true_owners(mesh, points, samples, what);
    expect_true_values(mesh, points, samples, what);
    const std::size_t columns = sampler->columns().size(), rows = samples.cells.size();
    const auto d = static_cast<std::size_t>(mesh.dimension);
    ASSERT_EQ(samples.distances.size(), rows) << what;
    double farthest = 0;
    std::size_t with = 0, without = 0;
    std::size_t told = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        const double* const point = &points[d * i];
        const std::string where = what + " at " + text_of(point, mesh.dimension);
        if (samples.cells[i] >= 0) {
            EXPECT_EQ(samples.distances[i], 0) << where;
            continue;
        }
        const Nearest nearest = *locator->nearest(point, policy.limit);
        const double* found = &samples.values[columns * i];
        if (nearest.cell < 0) {
            ++without;
            for (std::size_t c = 0; c < columns; ++c) EXPECT_TRUE(std::isnan(found[c])) << where;
            EXPECT_TRUE(std::isnan(samples.distances[i])) << where;
            continue;
        }
        ++with;
        EXPECT_EQ(samples.distances[i], nearest.distance) << where;
        farthest = std::max(farthest, nearest.distance);
        for (const FieldChoice& f : all_fields(mesh)) {
            const auto n = static_cast<std::size_t>(f.field->components);
            for (std::size_t c = 0; c < n; ++c, ++found) {
                const double right = f.of_cells ? f.field->data[n * static_cast<std::size_t>(nearest.cell) + c]
                                     : policy.kind == Outside::nearest
                                         ? true_projected(mesh, *f.field, c, nearest, point)
                                         : true_value(mesh, *f.field, c, nearest.cell, point);
                if (same(*found, right) || told++ >= 3) continue;
                ADD_FAILURE() << where << ": " << f.field->name << "." << c << " is " << base::hexadecimal(right)
                              << ", found " << base::hexadecimal(*found);
            }
        }
    }
    const std::size_t inside = counts.locations.inside();
    EXPECT_EQ(counts.locations.outside, with + without) << what;
    EXPECT_EQ(policy.kind == Outside::nearest ? counts.snapped : counts.extrapolated, with) << what;
    EXPECT_EQ(policy.kind == Outside::nearest ? counts.extrapolated : counts.snapped, 0U) << what;
    EXPECT_EQ(counts.without_value, without) << what;
    EXPECT_EQ(counts.farthest, farthest) << what;
    EXPECT_EQ(counts.values.cases(), inside + with) << what << ": every point with a value counts for one tier";
    EXPECT_GT(with, 0U) << what;
}

TEST(SampleOutside, E1Nearest) {
    for (const char* stem : {"cube-hole", "bracket", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_with_field(stem);
        expect_outside(mesh, points_around(mesh, random), {.kind = Outside::nearest}, stem);
    }
}

TEST(SampleOutside, E1NearestWithinALimit) {
    for (const char* stem : {"cube-hole", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_with_field(stem);
        expect_outside(mesh, points_around(mesh, random), {.kind = Outside::nearest, .limit = 0.1}, stem);
    }
}

TEST(SampleOutside, E1Extrapolate) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "bracket", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_with_field(stem);
        expect_outside(mesh, points_around(mesh, random), {.kind = Outside::extrapolate}, stem);
    }
}

// The limit is one of `nearest`.
TEST(SampleOutside, E1ExtrapolationKnowsNoLimit) {
    const Mesh mesh = own_with_field("plate");
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const std::vector<double> point{1000, 1000};
    Table samples;
    const SampleCounts& counts = samples.counts;
    ASSERT_TRUE(sampler->sample(point, {.outside = {.kind = Outside::extrapolate, .limit = 0.1}}, samples));
    EXPECT_EQ(counts.extrapolated, 1U);
    EXPECT_FALSE(std::isnan(samples.values[0]));
}

// A nodal value that is not finite makes its component NaN and is counted, at the nearest node, too.
TEST(SampleOutside, E1NearestValuesThatAreNotFinite) {
    Mesh mesh = box(3, {1, 1, 1});
    mesh.point_fields = {{"f", 2, std::vector<double>(16, 1.0)}};
    mesh.point_fields[0].data[0] = infinity;
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const std::vector<double> points{-1, -1, -1, -1, -1, 0.25, -1, 0.25, 0.125, 0.5, 0.25, 0.125};
    Table samples;
    const SampleCounts& counts = samples.counts;
    ASSERT_TRUE(sampler->sample(points, {.outside = {.kind = Outside::nearest}}, samples));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(std::isnan(samples.values[2 * i])) << "point " << i << ": " << samples.values[2 * i];
        EXPECT_EQ(samples.values[2 * i + 1], 1) << "point " << i;
    }
    EXPECT_EQ(counts.values.not_finite, 4U);
}

// The nearest vertex gives the value that a point on it has.
TEST(SampleOutside, E1NearestVertexIsAsThePointOnIt) {
    base::Random random(3);
    Mesh mesh = box(2, {1, 1, 1});
    mesh.point_fields = {{"f", 5, {}}};
    mesh.point_fields[0].data.assign(20, -0.0);
    for (std::size_t i = 1; i < 5; ++i) mesh.point_fields[0].data[i] = random.uniform(-1, 1);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    Table samples;
    ASSERT_TRUE(sampler->sample(std::vector<double>{0, 0, -1, -2}, {.outside = {.kind = Outside::nearest}}, samples));
    for (std::size_t c = 0; c < 5; ++c)
        EXPECT_TRUE(same(samples.values[c], samples.values[5 + c]))
            << c << ": " << samples.values[c] << " and " << samples.values[5 + c];
}

// Second order: the projection is rounded, so the value is near that of the quadratic there.
TEST(SampleOutside, E1NearestOnSecondOrderCells) {
    base::Random random(2);
    const Mesh mesh = own_with_field("cube-hole-o2");
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, {{&mesh.point_fields[0], false}});
    const std::vector<double> points = points_around(mesh, random);
    Table samples;
    const SampleCounts& counts = samples.counts;
    ASSERT_TRUE(sampler->sample(points, {.outside = {.kind = Outside::nearest}}, samples));
    std::size_t checked = 0;
    for (std::size_t i = 0; i < samples.cells.size(); ++i) {
        const double* const p = &points[3 * i];
        if (samples.cells[i] >= 0) continue;
        // attribute0 is linear, so the linear interpolation of its corners is it, up to its own rounding.
        const double right = true_projected(mesh, mesh.point_fields[0], 0, *locator->nearest(p, infinity), p);
        ASSERT_NEAR(samples.values[i], right, 0x1p-45) << text_of(p, 3);
        ++checked;
    }
    EXPECT_GT(checked, 20U);
    EXPECT_EQ(counts.snapped, checked);
}

TEST(SampleOutside, E1NanAndFill) {
    base::Random random(4);
    const Mesh mesh = own_with_field("bracket");
    const std::vector<double> points = points_around(mesh, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const std::size_t columns = sampler->columns().size();
    for (const OutsidePolicy& policy :
         {OutsidePolicy{}, OutsidePolicy{.kind = Outside::fill, .fill = -7}, OutsidePolicy{.kind = Outside::fill}}) {
        Table samples;
        const SampleCounts& counts = samples.counts;
        ASSERT_TRUE(sampler->sample(points, {.outside = policy}, samples));
        expect_true_values(mesh, points, samples, "bracket");
        for (std::size_t i = 0; i < samples.cells.size(); ++i) {
            for (std::size_t c = 0; c < columns && samples.cells[i] < 0; ++c) {
                ASSERT_TRUE(
                    same(samples.values[columns * i + c], policy.kind == Outside::fill ? policy.fill : std::nan("")));
            }
        }
        EXPECT_EQ(counts.without_value, counts.locations.outside);
        EXPECT_EQ(counts.snapped + counts.extrapolated, 0U);
        EXPECT_EQ(counts.farthest, 0);
        EXPECT_TRUE(samples.distances.empty());
    }
}

// A point a hair outside has the value of the point it is snapped to, NaN too where a node with NaN takes part.
TEST(SampleOutside, N3NotFiniteAsInside) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1};
    mesh.cells = {0, 1, 2};
    mesh.point_fields = {{"f", 1, {1, 2, std::nan("")}}};
    const auto sampler = Sampler::build(mesh, {"f"});
    ASSERT_TRUE(sampler);
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        const auto rows =
            sampler->sample(std::vector<double>{0.5, 0, 0.5, -tiny, 1, 0, 2, 0, 0, 0.5, -tiny, 0.5, 0, 1, 0, 2},
                            {.rounding = rounding, .outside = {.kind = Outside::nearest}});
        ASSERT_TRUE(rows);
        const double expected[]{1.5, 1.5, 2, 2};
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rows->value(i, 0), expected[i]) << i;
        for (std::size_t i = 4; i < 8; ++i) EXPECT_TRUE(std::isnan(rows->value(i, 0))) << i;
    }
}

// The first one in the caller's order, counted from where the caller says, whatever the order they were found in.
TEST(SampleOutside, E1ErrorNamesTheFirst) {
    base::Random random(5);
    const Mesh mesh = own_with_field("cube-hole");
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const SampleOptions options{.outside = {.kind = Outside::error}, .threads = 2};
    Table samples;
    const SampleCounts& counts = samples.counts;
    std::vector<double> points;
    for (int i = 0; i < 30000; ++i) {
        const double* const node = &mesh.points[3 * random.below(mesh.point_count())];
        points.insert(points.end(), node, node + 3);
    }
    ASSERT_TRUE(sampler->sample(points, options, samples));
    EXPECT_EQ(counts.without_value, 0U);
    for (const std::size_t bad : {29000U, 20011U, 777U, 776U, 0U}) {
        points[3 * bad] = -0.25;
        const Status status = sampler->sample(points, options, samples, 1000000);
        ASSERT_FALSE(status);
        EXPECT_NE(status.error().message().find("point " + std::to_string(1000000 + bad) + " "), std::string::npos)
            << status.error().message();
        samples = *locator->locate(points);
        const Status later = sampler->evaluate(points, options, samples, 500);
        ASSERT_FALSE(later);
        EXPECT_NE(later.error().message().find("point " + std::to_string(500 + bad) + " "), std::string::npos)
            << later.error().message();
    }
    EXPECT_EQ(counts.locations.points(), 0U) << "a call that fails counts nothing";
}

}  // namespace
}  // namespace barycert::testing
