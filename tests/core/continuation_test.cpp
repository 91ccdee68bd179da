// The inverse of a cell's map continued beyond it: against the same way followed in many small steps in long double,
// with shape functions written apart; values against Newton's method in 100 digits from what that finds.
#include "core/isoparametric/continuation.hpp"
#include "core/isoparametric/cell_polynomial.hpp"

#include <gtest/gtest.h>

#include <random>

namespace barycert::core::isoparametric {
namespace {

using Real = long double;
using Hundred = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// Shape functions of linear cells, by VTK's number.
template <class T>
std::vector<T> linear_functions(int type, const std::array<T, 3>& x) {
    const T &r = x[0], &s = x[1], &t = x[2];
    const T a = 1 - r, b = 1 - s, c = 1 - t;
    if (type == 9) return {a * b, r * b, r * s, a * s};
    if (type == 13) return {(a - s) * c, r * c, s * c, (a - s) * t, r * t, s * t};
    if (type == 14) return {a * b * c, r * b * c, r * s * c, a * s * c, t};
    return {a * b * c, r * b * c, r * s * c, a * s * c, a * b * t, r * b * t, r * s * t, a * s * t};
}

/// Lagrange's polynomials: products over the nodes of lower index.
template <class T>
std::vector<T> lagrange_functions(const Reference& of, const std::array<T, 3>& x) {
    std::vector<T> l{T(1)}, out;
    for (std::size_t k = 0; k < of.dimension(); ++k) {
        l[0] -= x[k];
        l.push_back(x[k]);
    }
    for (const auto& index : of.indices) {
        T n = 1;
        for (std::size_t c = 0; c < l.size(); ++c) {
            for (int k = 0; k < index[c]; ++k) n *= (of.order * l[c] - k) / T(index[c] - k);
        }
        out.push_back(n);
    }
    return out;
}

struct BentCell {
    const Reference* of = nullptr;
    int type = 0;  ///< 0: a simplex
    std::vector<std::array<double, 3>> at;
    std::vector<double> values;

    Places places() const {
        Places p{};
        for (std::size_t i = 0; i < at.size(); ++i) p.at[i] = at[i].data();
        return p;
    }
    template <class T>
    std::array<T, 4> point_and_value(const std::array<T, 3>& x) const {
        const std::vector<T> n = type == 0 ? lagrange_functions(*of, x) : linear_functions(type, x);
        std::array<T, 4> sum{};
        for (std::size_t i = 0; i < n.size(); ++i) {
            for (std::size_t k = 0; k < of->dimension(); ++k) sum[k] += n[i] * at[i][k];
            sum[3] += n[i] * values[i];
        }
        return sum;
    }
    /// The Jacobian matrix by differences, and a Newton step towards a point; returns the determinant.
    template <class T>
    T step(std::array<T, 3>& x, const std::array<T, 3>& to, const T& h) const {
        const std::size_t d = of->dimension();
        const auto here = point_and_value(x);
        std::array<std::array<T, 4>, 3> a{};
        for (std::size_t j = 0; j < d; ++j) {
            auto up = x, down = x;
            up[j] += h;
            down[j] -= h;
            const auto high = point_and_value(up), low = point_and_value(down);
            for (std::size_t k = 0; k < d; ++k) a[k][j] = (high[k] - low[k]) / (2 * h);
        }
        for (std::size_t k = 0; k < d; ++k) a[k][3] = to[k] - here[k];
        T determinant = 1;
        for (std::size_t c = 0; c < d; ++c) {
            std::size_t pivot = c;
            for (std::size_t i = c + 1; i < d; ++i) {
                using std::abs;
                if (abs(a[i][c]) > abs(a[pivot][c])) pivot = i;
            }
            if (pivot != c) determinant = -determinant;
            std::swap(a[pivot], a[c]);
            determinant *= a[c][c];
            if (a[c][c] == 0) return 0;
            for (std::size_t i = 0; i < d; ++i) {
                if (i == c) continue;
                const T factor = a[i][c] / a[c][c];
                for (std::size_t j = c; j < 4; ++j) a[i][j] -= factor * a[c][j];
            }
        }
        for (std::size_t k = 0; k < d; ++k) x[k] += a[k][3] / a[k][k];
        return determinant;
    }
};

enum class Way { clear, near_fold, folds };

/// Follows the straight way; `x` becomes the place at its end. Steps get smaller where places move fast; where the
/// smallest one does not help, the way ends.
Way follow(const BentCell& cell, std::array<Real, 3>& x, const double* point) {
    constexpr Real largest = 1 / 256.0L;
    const auto start = cell.point_and_value(x);
    std::array<Real, 3> own{start[0], start[1], start[2]}, same = x;
    const Real first = cell.step<Real>(same, own, 1e-6L);
    Real done = 0, step = largest, least = 1;
    while (done < 1) {
        const Real next = std::min<Real>(done + step, 1);
        std::array<Real, 3> to{}, at = x;
        for (std::size_t k = 0; k < cell.of->dimension(); ++k) to[k] = start[k] * (1 - next) + point[k] * next;
        Real ratio = HUGE_VALL, moved = 0;
        for (int n = 0; n < 4; ++n) ratio = std::min(ratio, cell.step<Real>(at, to, 1e-6L) / first);
        for (std::size_t k = 0; k < 3; ++k) moved = std::max(moved, std::abs(at[k] - x[k]));
        if (ratio > 0 && moved < 0.0625L) {
            x = at;
            done = next;
            step = std::min(2 * step, largest);
            least = std::min(least, ratio);
        } else if ((step /= 2) < 1e-7L) {
            return Way::folds;
        }
    }
    return least > 0.03L ? Way::clear : Way::near_fold;
}

double value_in_hundred_digits(const BentCell& cell, const std::array<Real, 3>& about, const double* point) {
    std::array<Hundred, 3> x{Hundred(about[0]), Hundred(about[1]), Hundred(about[2])};
    const std::array<Hundred, 3> to{Hundred(point[0]), Hundred(point[1]), Hundred(point[2])};
    for (int n = 0; n < 12; ++n) cell.step<Hundred>(x, to, Hundred("1e-30"));
    return cell.point_and_value(x)[3].convert_to<double>();
}

class Continuation : public ::testing::Test {
protected:
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

    BentCell linear(int type, double by) {
        BentCell cell{linear_reference(static_cast<std::uint8_t>(type)), type, {}, {}};
        constexpr std::array<std::array<double, 3>, 8> cube{
            {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
        constexpr std::array<std::array<double, 3>, 6> wedge{
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
        for (std::size_t i = 0; i < cell.of->nodes; ++i)
            cell.at.push_back(type == 13 ? wedge[i] : type == 14 && i == 4 ? std::array{0.5, 0.5, 1.0} : cube[i]);
        return warped(cell, by);
    }
    BentCell simplex(int dimension, std::size_t nodes, double by) {
        BentCell cell{simplex_reference(dimension, nodes), 0, {}, {}};
        for (const auto& index : cell.of->indices) {
            cell.at.emplace_back();
            for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k)
                cell.at.back()[k] = static_cast<double>(index[k + 1]) / cell.of->order;
        }
        return warped(cell, by / ((cell.of->order - 1) * (cell.of->order - 1)));
    }
    BentCell warped(BentCell cell, double by) {
        for (auto& node : cell.at) {
            for (std::size_t k = 0; k < cell.of->dimension(); ++k) node[k] += uniform(-by, by);
            cell.values.push_back(uniform(-1, 1));
        }
        return cell;
    }
    /// On the border of the reference cell, but not at the apex of a pyramid.
    std::array<double, 3> border_place(const BentCell& cell) {
        const std::size_t d = cell.of->dimension();
        std::array<double, 3> x{};
        for (std::size_t k = 0; k < d; ++k) x[k] = uniform(0, 1);
        if (cell.of->is_simplex()) {
            while (x[0] + x[1] + x[2] > 1)
                for (double& y : x) y /= 2;
        } else if (cell.type == 13 && x[0] + x[1] > 1) {
            x[0] /= 2;
            x[1] /= 2;
        }
        const auto side = static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(d));
        x[side] = cell.type == 0 || cell.type == 14 || uniform(0, 1) < 0.5 || (cell.type == 13 && side < 2) ? 0 : 1;
        return x;
    }

    struct Counts {
        int clear = 0, near_fold = 0, folds = 0, proved = 0;
    };
    /// Ways of all lengths up to `length`, outwards and inwards.
    void expect_followed(const BentCell& cell, double length, Counts& counts) {
        const std::array<double, 3> from = border_place(cell);
        std::array<Real, 3> x{from[0], from[1], from[2]};
        const auto start = cell.point_and_value(x);
        std::array<double, 3> point{};
        const double by = uniform(0, length);
        for (std::size_t k = 0; k < cell.of->dimension(); ++k)
            point[k] = static_cast<double>(start[k]) + uniform(-by, by);
        const Way way = follow(cell, x, point.data());
        double value = 0;
        const Evaluated found =
            evaluate_beyond(*cell.of, cell.places(), point.data(), from, cell.values.data(), 1, &value);
        const bool proved = found.certainty == Certainty::proved;
        (way == Way::clear ? counts.clear : way == Way::near_fold ? counts.near_fold : counts.folds)++;
        counts.proved += proved ? 1 : 0;
        if (way == Way::clear) {
            EXPECT_TRUE(proved);
        } else if (way == Way::folds) {
            EXPECT_FALSE(proved);
        }
        if (proved && way != Way::folds) {
            EXPECT_EQ(value, value_in_hundred_digits(cell, x, point.data()));
        }
    }

    std::mt19937 random_{54};
};

TEST_F(Continuation, LinearCells) {
    for (const int type : {9, 12, 13, 14}) {
        for (const double by : {0.05, 0.15}) {
            Counts counts;
            for (int i = 0; i < 40 && !HasFailure(); ++i) expect_followed(linear(type, by), i % 2 == 0 ? 1 : 5, counts);
            ASSERT_FALSE(HasFailure()) << type << ' ' << by;
            EXPECT_GT(counts.clear, by < 0.1 ? 20 : 12) << type << ' ' << by;
            EXPECT_LT(counts.near_fold, 10) << type << ' ' << by;
        }
    }
}

TEST_F(Continuation, CurvedSimplices) {
    int folds = 0;
    for (const auto& [dimension, nodes] : {std::pair{2, 6}, {2, 10}, {2, 15}, {3, 10}, {3, 20}, {3, 35}}) {
        Counts counts;
        for (int i = 0; i < 40 && !HasFailure(); ++i)
            expect_followed(simplex(dimension, static_cast<std::size_t>(nodes), 0.05), i % 2 == 0 ? 0.3 : 1.5, counts);
        ASSERT_FALSE(HasFailure()) << dimension << "D, " << nodes << " nodes";
        EXPECT_GT(counts.clear, 10) << nodes;
        folds += counts.folds;
        EXPECT_LT(counts.near_fold, 10) << nodes;
    }
    EXPECT_GT(folds, 5);
}

// x = r (1 - s) + r s / 2, y = s: r = x / (1 - y / 2). At y = 2 all r are taken to x = 0.
TEST_F(Continuation, ToTheFoldAndNotBeyond) {
    BentCell cell{linear_reference(9), 9, {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0, 1, 0}}, {0, 1, 1, 0}};
    const auto value_at = [&](double x, double y) -> std::optional<double> {
        const std::array<double, 3> point{x, y, 0};
        double value = 0;
        const Evaluated found =
            evaluate_beyond(*cell.of, cell.places(), point.data(), {0.5, 1, 0}, cell.values.data(), 1, &value);
        if (found.certainty != Certainty::proved) return std::nullopt;
        return value;
    };
    EXPECT_EQ(value_at(0.25, 1.5), 1);
    EXPECT_EQ(value_at(-3, 1.75), -24);
    EXPECT_EQ(value_at(0x1p-10, 2 - 0x1p-10), 2);
    EXPECT_EQ(value_at(0.25, 2), std::nullopt);
    EXPECT_EQ(value_at(0.25, 2.5), std::nullopt);
    // The other way it does not vanish.
    EXPECT_EQ(value_at(500.5, -999), 1);
}

// The same cells far from the origin, and of another size: all is relative to the cell.
TEST_F(Continuation, MovedAndScaledCells) {
    for (int i = 0; i < 40; ++i) {
        BentCell cell = linear(12, 0.08);
        for (auto& node : cell.at) {
            for (double& x : node) x = std::round(x * 0x1p20) * 0x1p-20;
        }
        const std::array<double, 3> from = border_place(cell);
        const std::array<double, 3> point{std::round(uniform(-1, 2) * 8) / 8, std::round(uniform(-1, 2) * 8) / 8,
                                          std::round(uniform(-1, 2) * 8) / 8};
        double value = 0, moved = 0;
        const Evaluated own =
            evaluate_beyond(*cell.of, cell.places(), point.data(), from, cell.values.data(), 1, &value);
        std::array<double, 3> there{};
        const double shift = 0x1p30, scale = 0x1p-200;
        for (std::size_t k = 0; k < 3; ++k) there[k] = (point[k] + shift) * scale;
        for (auto& node : cell.at) {
            for (double& x : node) x = (x + shift) * scale;
        }
        const Evaluated other =
            evaluate_beyond(*cell.of, cell.places(), there.data(), from, cell.values.data(), 1, &moved);
        EXPECT_EQ(own.certainty, other.certainty);
        EXPECT_EQ(value, moved);
    }
}

// The Taylor coefficients at a place give the shape functions' sums back, exactly.
TEST_F(Continuation, TaylorCoefficientsOfWholeNumbers) {
    std::vector<const Reference*> all;
    for (const int type : {9, 12, 13, 14}) all.push_back(linear_reference(static_cast<std::uint8_t>(type)));
    for (const std::size_t nodes : {6, 10, 15}) all.push_back(simplex_reference(2, nodes));
    for (const std::size_t nodes : {10, 20, 35}) all.push_back(simplex_reference(3, nodes));
    for (const Reference* const of : all) {
        std::vector<std::array<double, 3>> at(of->nodes);
        Places places{};
        for (std::size_t i = 0; i < of->nodes; ++i) {
            for (double& x : at[i]) x = std::floor(uniform(0, 16)) / 16;
            places.at[i] = at[i].data();
        }
        const std::array<double, 3> point{};
        const Inverse beside(*of, places, point.data());
        const Vector<double> c{3, -2, of->dimension() == 2 ? 0.0 : 5.0}, h{-1, 4, of->dimension() == 2 ? 0.0 : 2.0};
        const CellPolynomial map(*of, beside);
        const CellCoefficients<double> taylor = map.about(c);
        std::array<double, max_nodes> n;
        shape_functions(*of, Vector<double>{c[0] + h[0], c[1] + h[1], c[2] + h[2]}, n, nullptr);
        for (std::size_t k = 0; k < of->dimension(); ++k) {
            double sum = 0, expected = 0;
            for (std::size_t t = 0; t < map.basis().terms.size(); ++t) {
                double power = 1;
                for (std::size_t axis = 0; axis < 3; ++axis) power *= std::pow(h[axis], map.basis().terms[t][axis]);
                sum += taylor[t][k] * power;
            }
            for (std::size_t i = 0; i < of->nodes; ++i) expected += n[i] * std::ldexp(at[i][k], beside.shift());
            EXPECT_EQ(sum, expected);
        }
    }
}

}  // namespace
}  // namespace barycert::core::isoparametric
