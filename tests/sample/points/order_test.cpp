// D1: rows depend on point, mesh and fields alone; evaluate gives the bytes of sample.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "barycert/environment.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/check/meshes.hpp"
#include "tests/locate/points.hpp"
#include "tests/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Mesh own_with_fields(const std::string& stem) {
    Mesh mesh = own_mesh(stem);
    base::Random random(1);
    mesh.cell_fields = random_fields(mesh.cell_count(), {2}, true, random);
    return mesh;
}

Table sampled(const Sampler& sampler, const std::vector<double>& points, const SampleOptions& options,
              SampleCounts* counts = nullptr) {
    Table samples;
    const Status status = sampler.sample(points, options, samples);
    EXPECT_TRUE(status) << status.error().message();
    if (counts != nullptr) counts->add(samples.counts);
    return samples;
}

Table evaluated(const Sampler& sampler, const std::vector<double>& points, const Table& from,
                const SampleOptions& options, SampleCounts& counts) {
    Table samples;
    samples.cells = from.cells;
    samples.features = from.features;
    const Status status = sampler.evaluate(points, options, samples);
    EXPECT_TRUE(status) << status.error().message();
    counts.add(samples.counts);
    return samples;
}

bool equal(const SampleCounts& a, const SampleCounts& b) {
    const LocationCounts &x = a.locations, &y = b.locations;
    return x.interior == y.interior && x.face == y.face && x.edge == y.edge && x.vertex == y.vertex &&
           x.outside == y.outside && a.snapped == b.snapped && a.extrapolated == b.extrapolated &&
           a.without_value == b.without_value && a.farthest == b.farthest && a.values == b.values;
}

std::vector<SampleOptions> all_options() {
    std::vector<SampleOptions> all;
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        for (const Outside kind : {Outside::nan, Outside::fill, Outside::nearest, Outside::extrapolate})
            all.push_back({rounding, {.kind = kind, .fill = -0.0}, 1});
    }
    return all;
}

TEST(SampleOrder, D1ThreadsTargetsMethodsAndEvaluate) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate", "bracket"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_with_fields(stem);
        const std::vector<double> points = awkward_points(mesh, 40, random);
        const auto walks = Locator::build(mesh), asks = Locator::build(mesh, {.prove = Prove::never});
        const auto one = Sampler::build(*walks, all_fields(mesh)), other = Sampler::build(*asks, all_fields(mesh));
        for (SampleOptions options : all_options()) {
            const std::string what = std::string(stem) + (options.rounding == Rounding::plain ? ", plain" : "") +
                                     ", outside " + std::to_string(static_cast<int>(options.outside.kind));
            options.threads = 1;
            SampleCounts counts;
            const Table right = sampled(*one, points, options, &counts);
            EXPECT_TRUE(same(sampled(*other, points, options), right)) << what << ", candidates";
            for (const std::string& target : simd_targets()) {
                ASSERT_TRUE(use_simd_target(target));
                for (const int threads : {1, 8}) {
                    options.threads = threads;
                    SampleCounts again, later;
                    EXPECT_TRUE(same(sampled(*one, points, options, &again), right)) << what << target << threads;
                    EXPECT_TRUE(same(evaluated(*one, points, right, options, later), right)) << what << target;
                    // Which tier answered may depend on the target, by fused operations; where it is one it may not.
                    again.values = later.values = counts.values;
                    EXPECT_TRUE(equal(again, counts)) << what << target << threads;
                    EXPECT_TRUE(equal(later, counts)) << what << target << threads;
                }
            }
            EXPECT_TRUE(use_simd_target(""));
        }
    }
}

// More points than fit in a block.
TEST(SampleOrder, D1AHundredThousandPointsInAnyOrder) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_with_fields(stem);
        std::vector<double> points = inner_points(mesh, 95000, random);
        const std::vector<double> more = awkward_points(mesh, 600, random);
        points.insert(points.end(), more.begin(), more.end());
        const auto d = static_cast<std::size_t>(mesh.dimension);
        const auto locator = Locator::build(mesh);
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        const std::size_t columns = sampler->columns().size(), count = points.size() / d;
        ASSERT_GE(count, 100000U);
        for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
            SampleCounts counts, others;
            const Table right = sampled(*sampler, points, {.rounding = rounding, .outside = {}, .threads = 2}, &counts);
            EXPECT_EQ(counts.locations.points(), count);
            std::vector<std::size_t> order(count);
            std::iota(order.begin(), order.end(), std::size_t{0});
            for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
            std::vector<double> shuffled(points.size());
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t k = 0; k < d; ++k) shuffled[d * i + k] = points[d * order[i] + k];
            }
            const Table answers =
                sampled(*sampler, shuffled, {.rounding = rounding, .outside = {}, .threads = 3}, &others);
            EXPECT_TRUE(equal(counts, others)) << stem;
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(answers.cells[i], right.cells[order[i]]) << stem;
                ASSERT_EQ(answers.features[i], right.features[order[i]]) << stem;
                for (std::size_t c = 0; c < columns; ++c)
                    ASSERT_TRUE(same(answers.values[columns * i + c], right.values[columns * order[i] + c])) << stem;
            }
            SampleCounts later;
            EXPECT_TRUE(same(evaluated(*sampler, points, right, {.rounding = rounding, .outside = {}}, later), right))
                << stem;
            EXPECT_TRUE(equal(later, counts)) << stem;
        }
    }
}

TEST(SampleOrder, NoPointAndOnePoint) {
    const Mesh mesh = own_with_fields("plate");
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    for (const SampleOptions& options : all_options()) {
        SampleCounts counts;
        Table samples = sampled(*sampler, {mesh.points[2], mesh.points[3]}, options, &counts);
        EXPECT_EQ(samples.cells.size(), 1U);
        EXPECT_EQ(counts.locations.vertex, 1U);
        EXPECT_EQ(samples.values.size(), sampler->columns().size());
        ASSERT_TRUE(sampler->sample({}, options, samples));  // what was in it goes
        EXPECT_TRUE(samples.cells.empty() && samples.features.empty() && samples.values.empty());
        EXPECT_TRUE(samples.distances.empty());
        EXPECT_EQ(counts.locations.points(), 1U);
        ASSERT_TRUE(sampler->evaluate({}, options, samples));
        EXPECT_EQ(samples.counts.locations.points(), 0U);
    }
}

TEST(SampleOrder, NoFieldAndNoCell) {
    base::Random random(2);
    const Mesh mesh = own_with_fields("plate");
    const std::vector<double> points = awkward_points(mesh, 20, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto none = Sampler::build(*locator, {});
    ASSERT_TRUE(none);
    SampleCounts counts;
    const Table samples = sampled(*none, points, {}, &counts);
    EXPECT_TRUE(samples.values.empty());
    EXPECT_EQ(counts.locations.points(), points.size() / 2);
    EXPECT_EQ(counts.values.cases(), 0U);
    Mesh empty;
    empty.dimension = 2;
    empty.point_fields = {{"f", 2, {}}};
    const auto nowhere = Locator::build(empty, {.prove = Prove::never});
    const auto sampler = Sampler::build(*nowhere, all_fields(empty));
    ASSERT_TRUE(sampler);
    for (const SampleOptions& options : all_options()) {
        SampleCounts outside;
        const Table found = sampled(*sampler, {0, 0, 1, 2}, options, &outside);
        EXPECT_EQ(found.cells, (std::vector<Mesh::Index>{-1, -1}));
        EXPECT_EQ(outside.locations.outside, 2U);
        EXPECT_EQ(outside.without_value, 2U);
    }
}

// In plain double values are near, and owners are what they are.
TEST(SampleOrder, PlainRounding) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_with_fields(stem);
        mesh.cell_fields.clear();
        const std::vector<double> points = awkward_points(mesh, 150, random);
        const auto locator = Locator::build(mesh);
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        SampleCounts counts;
        const Table right = sampled(*sampler, points, {}),
                    plain = sampled(*sampler, points, {Rounding::plain, {}, 0}, &counts);
        EXPECT_EQ(plain.cells, right.cells);
        EXPECT_EQ(plain.features, right.features);
        EXPECT_EQ(counts.values.cases(), 0U) << "nothing is promised, nothing is counted";
        // Cells of these meshes cost at most some ten bits of 53 (barycert check), fields are below 10.
        for (std::size_t i = 0; i < right.values.size(); ++i) {
            if (std::isnan(right.values[i])) {
                ASSERT_TRUE(std::isnan(plain.values[i])) << stem;
            } else {
                ASSERT_NEAR(plain.values[i], right.values[i], 0x1p-40) << stem;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
