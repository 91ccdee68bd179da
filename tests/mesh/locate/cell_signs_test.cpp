// The signs of a point in a cell of the index are those of weight_signs, where floating point just does, or does not,
// tell them.
#include "mesh/locate/cell_signs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "barycert/locator.hpp"
#include "core/base/random.hpp"
#include "mesh/index/cell_index.hpp"

namespace barycert::testing {
namespace {

using base::Random;

/// Vertices of whole numbers up to `largest`, times a power of two.
std::vector<double> whole_numbers(std::size_t d, int largest, int exponent, Random& random) {
    std::vector<double> vertices;
    for (std::size_t i = 0; i < d * (d + 1); ++i)
        vertices.push_back(std::ldexp(random.integer(-largest, largest), exponent));
    return vertices;
}

class CellSigns : public ::testing::TestWithParam<Simplex> {
protected:
    void same_as_weight_signs(const std::vector<double>& vertices, const double* point) {
        Mesh mesh;
        mesh.dimension = static_cast<int>(d_);
        mesh.points = vertices;
        for (int i = 0; i < vertex_count(GetParam()); ++i) mesh.cells.push_back(i);
        const locate::CellIndex index = locate::make_cell_index(mesh);
        TierCounts unused;
        const WeightSigns signs = locate::cell_signs(index, 0, point, tiers_);
        EXPECT_EQ(signs.bits(), weight_signs(GetParam(), vertices_of(index, 0).data(), point, &unused).bits());
    }

    const std::size_t d_ = static_cast<std::size_t>(space_dimension(GetParam()));
    Random random_{1};
    TierCounts tiers_;
};

// Products of numbers so small are rounded to multiples of 2^-1074, which the bounds of the filter leave out.
TEST_P(CellSigns, OfPointsInThePlanesOfTinyCells) {
    for (int exponent : {-300, -358, -360, -362, -365, -500, -537, -539, -541, -545}) {
        for (int i = 0; i < 1000; ++i) {
            const std::vector<double> v = whole_numbers(d_, 1 << 10, exponent, random_);
            // In the plane of all vertices but the last: u + s (v - u) + t (w - u) with whole s and t.
            double p[3] = {};
            const int s = random_.integer(-3, 3), t = random_.integer(-3, 3);
            for (std::size_t k = 0; k < d_; ++k)
                p[k] = v[k] + s * (v[d_ + k] - v[k]) + (d_ == 3 ? t * (v[6 + k] - v[k]) : 0);
            same_as_weight_signs(v, p);
        }
    }
    EXPECT_LT(tiers_.filter, tiers_.cases());
}

// The walk of one point has a filter of its own.
TEST_P(CellSigns, OfPointsInTheFacesOfTinyMeshes) {
    std::size_t found = 0;
    for (int exponent : {-300, -360, -362, -365, -500, -539, -541}) {
        for (int i = 0; i < 300; ++i) {
            std::vector<double> v = whole_numbers(d_, 1 << 9, exponent + 2, random_);
            double p[3] = {};
            const int s = random_.integer(0, 4), t = random_.integer(0, 4 - s);
            for (std::size_t k = 0; k < d_; ++k)
                p[k] = v[k] + s * (v[d_ + k] / 4 - v[k] / 4) + (d_ == 3 ? t * (v[6 + k] / 4 - v[k] / 4) : 0);
            Mesh mesh;
            mesh.dimension = static_cast<int>(d_);
            mesh.points = v;
            for (int n = 0; n < vertex_count(GetParam()); ++n) mesh.cells.push_back(n);
            const auto locator = Locator::build(mesh);
            ASSERT_TRUE(locator);
            const Location at = locator->locate(p).value();
            const WeightSigns signs = weight_signs(GetParam(), v.data(), p);
            EXPECT_EQ(at.cell, signs.contains() ? 0 : -1);
            EXPECT_EQ(at.feature, signs.contains() ? signs.feature(GetParam()) : Feature::outside);
            found += signs.contains() ? 1 : 0;
        }
    }
    EXPECT_GT(found, 1000U);
}

// Far from a cell that is nearly flat each weight is large and certain, and only their sum is not.
TEST_P(CellSigns, FarFromCellsThatAreNearlyFlat) {
    for (int i = 0; i < 20000; ++i) {
        std::vector<double> v;
        const double slope = random_.unit(), other = random_.unit();
        for (std::size_t n = 0; n <= d_; ++n) {
            const double x = random_.unit(), y = random_.unit();
            const double height = slope * x + other * y;  // rounded: not quite in one plane
            if (d_ == 3) v.insert(v.end(), {x, y, height});
            if (d_ == 2) v.insert(v.end(), {x, slope * x});
        }
        double p[3] = {random_.unit(), random_.unit(), random_.unit()};
        p[d_ - 1] += 2;
        same_as_weight_signs(v, p);
    }
    EXPECT_LT(tiers_.filter, tiers_.cases());
}

TEST_P(CellSigns, AnUlpFromThePlanesOfCells) {
    for (int i = 0; i < 20000; ++i) {
        std::vector<double> v;
        for (std::size_t n = 0; n < d_ * (d_ + 1); ++n) v.push_back(random_.unit());
        double p[3] = {};
        const double s = random_.unit(), t = random_.unit();
        for (std::size_t k = 0; k < d_; ++k)
            p[k] = v[k] + s * (v[d_ + k] - v[k]) + (d_ == 3 ? t * (v[6 + k] - v[k]) : 0);
        same_as_weight_signs(v, p);
    }
    EXPECT_LT(tiers_.filter, tiers_.cases());
}

INSTANTIATE_TEST_SUITE_P(, CellSigns, ::testing::Values(Simplex::triangle, Simplex::tetrahedron),
                         [](const auto& test) { return std::string(name(test.param)); });

}  // namespace
}  // namespace barycert::testing
