// Curved simplices of order 2 to 4: points are found where they were made, values against Newton's method in 100
// digits, and points outside are told.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/lanes.hpp"
#include "core/isoparametric/newton.hpp"

namespace barycert::core::isoparametric {
namespace {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

struct Kind {
    int dimension, order;
    std::size_t nodes;
};

struct CurvedSimplex {
    const Reference& reference;
    std::vector<std::array<double, 3>> at;
    std::vector<double> values;

    Places places() const {
        Places p{};
        for (std::size_t i = 0; i < at.size(); ++i) p.at[i] = at[i].data();
        return p;
    }
    /// The point and the value at barycentric coordinates.
    template <class T>
    std::array<T, 4> image(const std::array<T, 4>& l) const {
        std::array<T, 4> sum{};
        for (std::size_t i = 0; i < at.size(); ++i) {
            T n = 1;
            for (std::size_t c = 0; c < 4; ++c) {
                for (int k = 0; k < reference.indices[i][c]; ++k)
                    n *= (reference.order * l[c] - k) / T(reference.indices[i][c] - k);
            }
            for (std::size_t k = 0; k < 3; ++k) sum[k] += n * at[i][k];
            sum[3] += n * values[i];
        }
        return sum;
    }
};

class CurvedSimplices : public testing::TestWithParam<Kind> {
protected:
    std::mt19937_64 random{17};
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
    std::size_t d() const { return static_cast<std::size_t>(GetParam().dimension); }

    CurvedSimplex cell(double bend, double shift = 0) {
        const Reference& r = *simplex_reference(GetParam().dimension, GetParam().nodes);
        CurvedSimplex c{r, {}, {}};
        for (std::size_t i = 0; i < r.nodes; ++i) {
            std::array<double, 3> p{};
            for (std::size_t k = 0; k < d(); ++k)
                p[k] = static_cast<double>(r.indices[i][k + 1]) / r.order + uniform(-bend, bend) + shift;
            c.at.push_back(p);
            c.values.push_back(uniform(-1, 1));
        }
        return c;
    }
    std::array<double, 4> coordinates() {
        std::array<double, 4> l{};
        double sum = 0;
        for (std::size_t c = 0; c <= d(); ++c) sum += l[c] = -std::log(uniform(1e-9, 1));
        for (double& x : l) x /= sum;
        l[0] = 1 - l[1] - l[2] - l[3];
        return l;
    }
    /// The value at the point, from about there.
    double value_by_newton(const CurvedSimplex& c, const std::array<double, 4>& p, const std::array<double, 4>& start) {
        std::array<Number, 4> l{};
        for (std::size_t k = 1; k < 4; ++k) l[k] = start[k];
        const Number h("1e-40");
        const auto image = [&](std::array<Number, 4> at) {
            at[0] = 1 - at[1] - at[2] - at[3];
            return c.image<Number>(at);
        };
        for (int step = 0; step < 12; ++step) {
            std::array<std::array<Number, 4>, 3> a{};
            const auto here = image(l);
            for (std::size_t j = 0; j < d(); ++j) {
                auto moved = l;
                moved[j + 1] += h;
                const auto there = image(moved);
                for (std::size_t k = 0; k < d(); ++k) a[k][j] = (there[k] - here[k]) / h;
            }
            for (std::size_t k = 0; k < d(); ++k) a[k][d()] = Number(p[k]) - here[k];
            for (std::size_t e = 0; e < d(); ++e) {
                std::size_t pivot = e;
                for (std::size_t i = e; i < d(); ++i) pivot = abs(a[i][e]) > abs(a[pivot][e]) ? i : pivot;
                std::swap(a[pivot], a[e]);
                for (std::size_t i = 0; i < d(); ++i) {
                    if (i == e) continue;
                    const Number f = a[i][e] / a[e][e];
                    for (std::size_t j = e; j <= d(); ++j) a[i][j] -= f * a[e][j];
                }
            }
            for (std::size_t k = 0; k < d(); ++k) l[k + 1] += a[k][d()] / a[k][k];
        }
        return image(l)[3].convert_to<double>();
    }
};

TEST_P(CurvedSimplices, V1ValuesAreRoundedOnceWhereThePointIs) {
    std::size_t straight = 0;
    const double bend = GetParam().order == 2 ? 0.06 : 0.02;
    for (int i = 0; i < 300; ++i) {
        const CurvedSimplex c = cell(bend, i % 4 == 0 ? 100 : 0);
        if (proved_orientation(c.reference, c.places()) != 1) {
            ++straight;
            continue;
        }
        const auto l = coordinates();
        const auto p = c.image<double>(l);
        const InSimplex in = locate_in_simplex(c.reference, c.places(), p.data(), 0, {});
        ASSERT_TRUE(in.inside) << i;
        ASSERT_TRUE(in.proved);
        ASSERT_EQ(in.zeros, 0U);
        double value = 0;
        ASSERT_EQ(evaluate(c.reference, c.places(), p.data(), ~0ULL, c.values.data(), 1, &value).certainty,
                  Certainty::proved);
        ASSERT_EQ(value, value_by_newton(c, p, l)) << i;
    }
    EXPECT_LT(straight, 100U);
}

/// Where a point is left out of what is searched, it is one of the reference triangle's plane.
TEST_P(CurvedSimplices, PointsOfThePlaneHaveNoThirdCoordinate) {
    const CurvedSimplex c = cell(0.01);
    const auto p = c.image<double>(coordinates());
    Inverse inverse(c.reference, c.places(), p.data());
    ASSERT_TRUE(inverse.search());
    EXPECT_EQ(inverse.found()[2] == 0, d() == 2);
}

TEST_P(CurvedSimplices, PointsOutsideAreTold) {
    const double bend = GetParam().order == 2 ? 0.05 : 0.015;
    std::size_t told = 0, far = 0;
    for (int i = 0; i < 400; ++i) {
        const CurvedSimplex c = cell(bend);
        if (proved_orientation(c.reference, c.places()) != 1) continue;
        // Beyond a facet, as far as the next cell would be.
        auto l = coordinates();
        const std::size_t facet = random() % (d() + 1);
        const double beyond = std::ldexp(1.0, -static_cast<int>(random() % 30) - 2);
        const double rest = 1 - l[facet];
        for (double& x : l) x /= rest;
        for (std::size_t k = 0; k < 4; ++k) l[k] *= 1 + beyond;
        l[facet] = -beyond;
        const auto p = c.image<double>(l);
        const InSimplex in = locate_in_simplex(c.reference, c.places(), p.data(), 0, {});
        ++far;
        ASSERT_FALSE(in.inside) << i << " by " << beyond;
        told += in.proved ? 1 : 0;
    }
    EXPECT_GT(told, far * 9 / 10) << "of " << far;
}

// Nodes on the lattice of order 64, and points whose coordinates are fractions of few bits.
TEST_P(CurvedSimplices, PointsOnFacetsOfALatticeAreOnThem) {
    std::size_t found = 0;
    for (int i = 0; i < 400; ++i) {
        CurvedSimplex c = cell(0);
        for (std::size_t node = 0; node < c.at.size(); ++node) {
            for (std::size_t k = 0; k < d(); ++k) {
                const double bend = GetParam().order == 2 ? static_cast<double>(random() % 5) - 2
                                                          : static_cast<double>(random() % 3) - 1;
                c.at[node][k] = 48.0 * c.reference.indices[node][k + 1] / c.reference.order + bend;
            }
        }
        if (proved_orientation(c.reference, c.places()) != 1) continue;
        std::array<double, 4> l{};
        int left = 8;
        for (std::size_t k = 1; k <= d(); ++k) {
            const int own = static_cast<int>(random() % static_cast<unsigned>(left + 1));
            l[k] = own / 8.0;
            left -= own;
        }
        l[0] = left / 8.0;
        const auto exact = c.image<Number>({l[0], l[1], l[2], l[3]});
        const auto p = c.image<double>(l);
        bool representable = true;
        for (std::size_t k = 0; k < d(); ++k) representable &= abs(exact[k] - Number(p[k])) < Number("1e-60");
        if (!representable) continue;
        unsigned zeros = 0;
        for (std::size_t k = 0; k <= d(); ++k) zeros |= l[k] == 0 ? 1U << k : 0U;
        const InSimplex in = locate_in_simplex(c.reference, c.places(), p.data(), 0, {});
        ++found;
        ASSERT_TRUE(in.inside && in.proved) << i;
        ASSERT_EQ(in.zeros, zeros) << i;
    }
    EXPECT_GT(found, GetParam().order == 3 ? 0U : 30U);
}

TEST_P(CurvedSimplices, HullsHoldTheCell) {
    for (int i = 0; i < 200; ++i) {
        const CurvedSimplex c = cell(0.3);
        const auto box = hull_box(c.reference, c.places());
        for (int k = 0; k < 20; ++k) {
            const auto p = c.image<double>(coordinates());
            for (std::size_t axis = 0; axis < d(); ++axis)
                ASSERT_TRUE(box[axis] <= p[axis] && p[axis] <= box[3 + axis]);
        }
    }
}

// Many at a time: nearly all inside are proved, none outside is, and values are those of Newton's method. Some nodes
// are amid two corners, exactly: there the value is that of the cell by numbers of any precision.
TEST_P(CurvedSimplices, V1LanesAreRoundedOnce) {
    if (GetParam().nodes != 10 || d() != 3) return;
    constexpr std::array<std::array<std::size_t, 2>, 6> ends{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    std::size_t inside = 0, proved_inside = 0, proved_values = 0;
    for (int round = 0; round < 200; ++round) {
        std::array<double, 30 * max_lanes> rows{};
        std::array<double, 18 * max_lanes> others{};
        std::array<double, 3 * max_lanes> points{};
        std::array<double, 20 * max_lanes> values{};
        std::array<double, 2 * max_lanes> out{};
        std::vector<CurvedSimplex> cells;
        std::vector<Places> places;
        std::vector<std::array<double, 4>> at;
        const std::size_t count = 1 + random() % max_lanes;
        while (cells.size() < count) {
            CurvedSimplex c = cell(round < 100 ? 0.06 : 0.11, round % 4 == 0 ? 100 : 0);
            if (proved_orientation(c.reference, c.places()) != 1) continue;
            auto l = coordinates();
            if (round % 3 == 0) {  // near a facet, on either side
                const double by = std::ldexp(1.0, -static_cast<int>(random() % 50)), rest = 1 - l[3];
                for (double& x : l) x *= (1 + by) / rest;
                l[3] = round % 2 == 0 ? -by : by;
                l[0] = 1 - l[1] - l[2] - l[3];
            } else if (round % 3 == 1) {  // well beyond the facet whose coordinate is not one of the map's
                const double beyond = uniform(0.01, 1.5);
                for (std::size_t k = 1; k < 4; ++k) l[k] *= (1 + beyond) / (1 - l[0]);
                l[0] = -beyond;
            }
            at.push_back(l);
            cells.push_back(std::move(c));
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
            CurvedSimplex& c = cells[lane];
            Places& p = places.emplace_back(c.places());
            for (std::size_t e = 0; e < 6 && round % 2 == 1; e += 2) {
                p.at[4 + e] = c.at[ends[e][0]].data();
                p.other[4 + e] = c.at[ends[e][1]].data();
            }
            const auto image = c.image<double>(at[lane]);
            for (std::size_t k = 0; k < 3; ++k) points[k * max_lanes + lane] = image[k];
            for (std::size_t i = 0; i < 10; ++i) {
                const double* const other = p.other[i] == nullptr ? p.at[i] : p.other[i];
                for (std::size_t k = 0; k < 3; ++k) {
                    rows[(3 * i + k) * max_lanes + lane] = p.at[i][k];
                    if (i >= 4) others[(3 * (i - 4) + k) * max_lanes + lane] = other[k];
                }
                values[i * max_lanes + lane] = c.values[i];
                values[(10 + i) * max_lanes + lane] = -3 * c.values[i];
            }
        }
        const LanesProved proved = evaluate_lanes(
            {count, LaneElement::tetrahedron, rows.data(), others.data(), points.data(), values.data(), 2, out.data()});
        ASSERT_EQ((proved.inside | proved.values) >> count, 0U);
        for (std::size_t lane = 0; lane < count; ++lane) {
            const CurvedSimplex& c = cells[lane];
            const std::array<double, 4> p{points[lane], points[max_lanes + lane], points[2 * max_lanes + lane], 0};
            const InSimplex in = locate_in_simplex(c.reference, places[lane], p.data(), 0, {});
            inside += in.inside && in.zeros == 0 ? 1 : 0;
            if ((proved.inside >> lane & 1U) != 0) {
                ASSERT_TRUE(in.inside && in.zeros == 0) << round;
                ++proved_inside;
            }
            if ((proved.values >> lane & 1U) == 0) continue;
            ASSERT_TRUE(in.inside || round % 3 == 0) << round;
            if (!in.inside) continue;
            ++proved_values;
            double value = 0;
            evaluate(c.reference, places[lane], p.data(), ~0ULL, c.values.data(), 1, &value);
            ASSERT_EQ(out[lane], value) << round;
            ASSERT_EQ(out[max_lanes + lane] == 0, value == 0);
            if (round % 2 == 0 && round % 3 != 1) {
                ASSERT_EQ(value, value_by_newton(c, p, at[lane])) << round;
            }
        }
    }
    EXPECT_GT(inside, 600U);
    EXPECT_GT(proved_inside, inside * 8 / 10) << "of " << inside;
    EXPECT_GT(proved_values, inside * 95 / 100) << "of " << inside;
}

INSTANTIATE_TEST_SUITE_P(kinds, CurvedSimplices,
                         testing::Values(Kind{2, 2, 6}, Kind{2, 3, 10}, Kind{2, 4, 15}, Kind{3, 2, 10}, Kind{3, 3, 20},
                                         Kind{3, 4, 35}));

}  // namespace
}  // namespace barycert::core::isoparametric
