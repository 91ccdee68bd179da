// Input that a Sampler refuses.
#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "barycert/sampler.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

TEST(SampleErrors, FieldsThatDoNotFit) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const Field one{"one", 1, std::vector<double>(8)}, two{"two", 2, std::vector<double>(16)};
    const Field short_of{"short", 1, std::vector<double>(7)}, none{"none", 0, {}};
    const Field cells{"cells", 1, std::vector<double>(6)};
    EXPECT_TRUE(Sampler::build(*locator, {{&one, false}, {&two, false}, {&cells, true}}));
    for (const FieldChoice& wrong : {FieldChoice{&short_of, false}, FieldChoice{&none, false}, FieldChoice{&one, true},
                                     FieldChoice{&cells, false}, FieldChoice{}}) {
        const auto sampler = Sampler::build(*locator, {{&one, false}, wrong});
        ASSERT_FALSE(sampler);
        if (wrong.field != nullptr) {
            EXPECT_NE(sampler.error().message().find(wrong.field->name), std::string::npos);
        }
    }
}

TEST(SampleErrors, PointsAndLocations) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const Field field{"f", 1, std::vector<double>(8)};
    const auto sampler = Sampler::build(*locator, {{&field, false}});
    Table samples;
    const auto evaluated = [&](const std::vector<double>& points, std::vector<Mesh::Index> cells,
                               std::vector<Feature> features) {
        Table rows;
        rows.cells = std::move(cells);
        rows.features = std::move(features);
        return sampler->evaluate(points, {}, rows).has_value();
    };
    EXPECT_FALSE(sampler->sample(std::vector<double>(4), {}, samples));
    for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        std::vector<double> points(30, 0.5);
        points[13] = bad;
        const Status status = sampler->sample(points, {}, samples, 100);
        ASSERT_FALSE(status);
        EXPECT_NE(status.error().message().find("point 104"), std::string::npos) << status.error().message();
        EXPECT_FALSE(sampler->sample(points, {.rounding = Rounding::plain, .outside = {}}, samples));
        EXPECT_FALSE(evaluated(points, std::vector<Mesh::Index>(10, 0), std::vector<Feature>(10, Feature::interior)));
    }
    const std::vector<double> points(6, 0.5);
    const std::vector<Feature> features(2, Feature::interior);
    for (const Mesh::Index wrong : {-2, 6, std::numeric_limits<Mesh::Index>::max()})
        EXPECT_FALSE(evaluated(points, {0, wrong}, features));
    EXPECT_FALSE(evaluated(points, {0}, features));
    EXPECT_FALSE(evaluated(points, {0, 1}, {Feature::interior}));
    EXPECT_TRUE(evaluated(points, {0, -1}, features));
}

}  // namespace
}  // namespace barycert::testing
