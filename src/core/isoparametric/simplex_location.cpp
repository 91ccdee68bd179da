// Where points are in curved simplices: tier after tier, the cheapest first.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include "core/base/vectors.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/simplex_basis.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Whether no point of the cell is at zero, of control points from there. A box of the reference cell may be left out.
class ZeroExclusion {
public:
    using Coordinates = std::array<double, 4>;   ///< barycentric ones in the reference cell
    using Corners = std::array<Coordinates, 4>;  ///< of a part of it

    explicit ZeroExclusion(const SimplexBasis& s) : s_(s) {}

    /// Leaves out a simplex like the reference cell around `x`, where zero is taken, in which it is taken nowhere else:
    /// with Y about the inverse of the Jacobian there, |1 - Y X'| < 1 in all of it. The largest that is found of those
    /// 2, 1, 1/2, ... times as large as the cell. No part that excludes() comes to fits into
    /// one of min_radius.
    void leave_out_around(const std::vector<Vector<double>>& points, const Vector<double>& x, const Matrix& y) {
        middle_ = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
        for (radius_ = 2; radius_ > min_radius; radius_ /= 2) {
            if (contracts(restricted(points, around()), y)) return;
        }
        radius_ = 0;
    }

    /// Certainly not in the part of the cell with those corners: it is cut at the middle of its longest edge, `depth`
    /// times at most.
    bool excludes(const std::vector<Vector<double>>& points, const Corners& at, int depth) const {
        if (apart(restricted(points, at)) || left_out(at)) return true;
        if (depth == 0) return false;
        const std::size_t corners = s_.reference.dimension() + 1;
        std::size_t a = 0, b = 1;
        double longest = 0;
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                double square = 0;
                for (std::size_t k = 1; k < 4; ++k) square += (at[i][k] - at[j][k]) * (at[i][k] - at[j][k]);
                if (square > longest) std::tie(longest, a, b) = std::tuple(square, i, j);
            }
        }
        for (const std::size_t gone : {a, b}) {
            Corners half = at;
            for (std::size_t k = 0; k < 4; ++k) half[gone][k] = (at[a][k] + at[b][k]) / 2;
            if (!excludes(points, half, depth - 1)) return false;
        }
        return true;
    }

    /// On one side of a plane: along an axis, or across the middle of the control points.
    bool apart(const std::vector<Vector<double>>& points) const {
        const std::size_t d = s_.reference.dimension();
        const auto beyond = [&](const Vector<double>& n) {
            double low = HUGE_VAL, high = -HUGE_VAL, size = 0;
            for (const auto& p : points) {
                const double x = n[0] * p[0] + n[1] * p[1] + (d == 3 ? n[2] * p[2] : 0);
                low = std::min(low, x);
                high = std::max(high, x);
            }
            for (std::size_t k = 0; k < d; ++k) size += std::abs(n[k]);
            const double off = 4 * control_error * size;
            return low > off || high < -off;
        };
        Vector<double> sum{};
        for (std::size_t k = 0; k < d; ++k) {
            Vector<double> axis{};
            axis[k] = 1;
            if (beyond(axis)) return true;
            for (const auto& p : points) sum[k] += p[k];
        }
        if (beyond(sum)) return true;
        // Across the facets of the corners.
        const std::size_t corners = d + 1;
        for (std::size_t c = 0; c < corners; ++c) {
            const auto& p = points[(c + 1) % corners];
            const auto& q = points[(c + 2) % corners];
            const auto& r = points[(c + 3) % corners];
            const auto n = d == 2 ? Vector<double>{q[1] - p[1], p[0] - q[0], 0}
                                  : base::cross(base::minus(q, p), base::minus(r, p));
            if (beyond(n)) return true;
        }
        return false;
    }

private:
    /// Coordinates from the middle are at least -radius_ / corners in what is left out. Corners of parts are averages
    /// of 0 and 1, exact; the middle is about 1 in size, and a difference off by a few 2^-53. A thousandth of the
    /// radius, by which a part has to lie deeper, is more than 2^-32: min_radius / (1000 corners).
    bool left_out(const Corners& at) const {
        constexpr double within = 0.999;
        const std::size_t corners = s_.reference.dimension() + 1;
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t c = 0; c < corners; ++c) {
                if (!(at[i][c] - middle_[c] >= -within * radius_ / static_cast<double>(corners))) return false;
            }
        }
        return radius_ > 0;
    }

    /// Control points over the simplex with those corners, by de Casteljau's algorithm: at one of them in each step.
    std::vector<Vector<double>> restricted(const std::vector<Vector<double>>& points, const Corners& at) const {
        const std::size_t corners = s_.reference.dimension() + 1;
        std::vector<Vector<double>> all, level, next;
        for (const auto& of : s_.reference.indices) {
            level = points;
            std::size_t degree = 0;
            for (std::size_t corner = 0; corner < corners; ++corner) {
                for (int k = 0; k < of[corner]; ++k, ++degree) {
                    const SimplexBasis::Level& raised = s_.levels[degree];
                    next.assign(raised.size(), {});
                    for (std::size_t i = 0; i < raised.size(); ++i) {
                        for (std::size_t c = 0; c < corners; ++c) {
                            for (std::size_t j = 0; j < 3; ++j) next[i][j] += at[corner][c] * level[raised[i][c]][j];
                        }
                    }
                    std::swap(level, next);
                }
            }
            all.push_back(level.front());
        }
        return all;
    }
    /// Returns the corners of the simplex around the middle that may be left out.
    Corners around() const {
        const std::size_t corners = s_.reference.dimension() + 1;
        Corners at{};
        for (std::size_t corner = 0; corner < corners; ++corner) {
            at[corner] = middle_;
            for (std::size_t c = 0; c < corners; ++c)
                at[corner][c] += radius_ * ((c == corner ? 1 : 0) - 1 / static_cast<double>(corners));
        }
        return at;
    }

    /// Whether |1 - Y X'|, the largest sum of a row, is below 1 where `points` are the control points. Entries of X'
    /// are averages of differences of control points, times order / radius_: the largest of these bounds them.
    ///
    /// A control point over around() is a sum of products of `order` coordinates: its error is that of a control point
    /// times the sum of the coordinates' absolute values, to the power of the order. Doubled, for the roundings on the
    /// way and of the sums here.
    bool contracts(const std::vector<Vector<double>>& points, const Matrix& y) const {
        const std::size_t d = s_.reference.dimension();
        double reach = 2 * radius_;
        for (std::size_t c = 0; c <= d; ++c) reach += std::abs(middle_[c]);
        const double by = s_.reference.order / radius_,
                     off_point = 2 * control_error * std::pow(std::max(reach, 1.0), s_.reference.order);
        for (std::size_t row = 0; row < d; ++row) {
            std::array<double, 3> most{};
            double off = 0;
            for (std::size_t k = 0; k < d; ++k) off += std::abs(y[row][k]) * by * 2 * off_point;
            for (const auto& slope : s_.slopes) {
                for (std::size_t column = 0; column < d; ++column) {
                    double entry = row == column ? -1 : 0;
                    for (std::size_t k = 0; k < d; ++k)
                        entry += y[row][k] * by * (points[slope.by[column]][k] - points[slope.base][k]);
                    most[column] = std::max(most[column], std::abs(entry));
                }
            }
            const double sum = most[0] + most[1] + most[2] + static_cast<double>(d) * off;
            if (!(sum < contraction)) return false;
        }
        return true;
    }

    /// Any number below 1 would do: the rest is far more than what the sums here lose by rounding.
    static constexpr double contraction = 0.49;
    static constexpr double min_radius = 0x1p-20;

    const SimplexBasis& s_;
    Coordinates middle_{};
    double radius_ = 0;
};

/// A point and a simplex, and what the tiers that were asked have found. Each tier answers or says that it does not
/// know.
class SimplexTiers {
public:
    SimplexTiers(const Reference& of, const Places& places, const double* point, unsigned flat,
                 const std::array<int, 4>& beyond)
        : of_(of),
          places_(places),
          point_(point),
          flat_(flat),
          beyond_(beyond),
          corners_(of.dimension() + 1),
          scale_(scale_of(of, places)),
          inverse_(of, places, point),
          exclusion_(simplex_of(of)) {}

    /// Inside, by doubles: of points that are inside the straight simplex, as most are.
    std::optional<InSimplex> inside_by_doubles() {
        if (*std::min_element(beyond_.begin(), beyond_.begin() + static_cast<std::ptrdiff_t>(corners_)) < 0) return {};
        beside_ = inverse_.search();
        std::array<Ball<double>, 3> x;
        if (!beside_ || !inverse_.enclose<double>(x, goal_of_doubles)) return {};
        return if_inside(judge(x, false));
    }

    /// Outside, as the hull of the control points is.
    std::optional<InSimplex> outside_of_hull() {
        points_ = rounded_control_points(simplex_of(of_), places_, scale_);
        for (auto& p : points_) {
            for (std::size_t k = 0; k < of_.dimension(); ++k) p[k] -= point_[k] * scale_;
        }
        if (exclusion_.apart(points_)) return InSimplex{.proved = true};
        return {};
    }

    /// Inside or on the boundary: by two doubles; what these leave open exactly, or by 300 bits.
    std::optional<InSimplex> inside_by_more_digits() {
        beside_ = beside_ || inverse_.search() || inverse_.search(true);
        std::array<Ball<TwoDoubles>, 3> x;
        if (!beside_ || !inverse_.enclose<TwoDoubles>(x, goal_of_two_doubles)) return {};
        if (const auto found = judge(x, false)) return if_inside(found);
        Vector<double> about{};
        for (std::size_t k = 0; k + 1 < corners_; ++k) about[k] = x[k].mid.high;
        if (const auto exact = inverse_.exactly(about)) return if_inside(judge(*exact));
        std::array<Ball<Wide<300>>, 3> wide;
        if (!inverse_.enclose<Wide<300>>(wide, goal_of_wide)) return {};
        return if_inside(judge(wide, true));
    }

    /// Outside, as the point is nowhere in the cell but, perhaps, where the tiers before have found it outside. Not
    /// proved where that takes too long. After outside_of_hull() and inside_by_more_digits().
    InSimplex outside_by_exclusion() {
        // A cut halves the volume: 24 leave parts a 256th as wide as the cell in space, a 4096th in the plane. What is
        // not excluded then mostly is at the boundary of what is left out, as smaller parts would be.
        constexpr int max_cuts = 24;
        constexpr ZeroExclusion::Corners whole{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
        if (beside_) {
            const double by = of_.scale * std::ldexp(1 / scale_, inverse_.shift());  // to the scale of points_
            Matrix y = inverse_.inverse();
            for (auto& row : y) {
                for (double& x : row) x *= by;
            }
            exclusion_.leave_out_around(points_, inverse_.found(), y);
        }
        return {.proved = exclusion_.excludes(points_, whole, max_cuts)};
    }

private:
    // Below these radii of x no further step is made. A step in doubles leaves some 2^-45; where 2^-30 does not decide,
    // a point lies about on a facet. Two doubles have 106 bits, of which sums of 35 terms take some. 300 bits are for
    // points on a facet: InSimplex promises 2^-240 for 1 less the sum of three coordinates.
    static constexpr double goal_of_doubles = 0x1p-30, goal_of_two_doubles = 0x1p-88, goal_of_wide = 0x1p-250;

    static std::optional<InSimplex> if_inside(const std::optional<InSimplex>& found) {
        return found && found->inside ? found : std::nullopt;
    }

    /// By the signs of barycentric coordinates; nothing if one is not known, but at the `last` tier that is a zero.
    template <class T>
    std::optional<InSimplex> judge(const std::array<Ball<T>, 3>& x, bool last) const {
        InSimplex in{.inside = true, .proved = true};
        Ball<T> sum(0);
        for (std::size_t k = 0; k + 1 < corners_; ++k) sum = sum + x[k];
        for (std::size_t c = 0; c < corners_; ++c) {
            const Ball<T> own = c == 0 ? Ball<T>(1) - sum : x[c - 1];
            if (const auto sign = own.sign()) {
                if (*sign < 0) in.inside = false;
                continue;
            }
            if ((flat_ >> c & 1U) != 0) {
                if (beyond_[c] < 0) in.inside = false;
                if (beyond_[c] == 0) in.zeros |= 1U << c;
                continue;
            }
            if (!last) return std::nullopt;
            in.zeros |= 1U << c;
            in.proved = false;
        }
        return in;
    }
    InSimplex judge(const Vector<Rational>& x) const {
        InSimplex in{.inside = true, .proved = true};
        Rational sum = 0;
        for (std::size_t k = 0; k + 1 < corners_; ++k) sum += x[k];
        for (std::size_t c = 0; c < corners_; ++c) {
            const Rational own = c == 0 ? Rational(1 - sum) : x[c - 1];
            if (own < 0) in.inside = false;
            if (own == 0) in.zeros |= 1U << c;
        }
        return in;
    }

    const Reference& of_;
    const Places& places_;
    const double* point_;
    unsigned flat_;
    const std::array<int, 4>& beyond_;
    std::size_t corners_;
    double scale_;
    Inverse inverse_;
    ZeroExclusion exclusion_;
    std::vector<Vector<double>> points_ = {};  ///< control points from the point
    bool beside_ = false;                      ///< Newton's method has found a place, in the cell or outside
};

}  // namespace

InSimplex locate_in_simplex(const Reference& of, const Places& places, const double* point, unsigned flat,
                            const std::array<int, 4>& beyond) {
    SimplexTiers tiers(of, places, point, flat, beyond);
    if (const auto found = tiers.inside_by_doubles()) return *found;
    if (const auto found = tiers.outside_of_hull()) return *found;
    if (const auto found = tiers.inside_by_more_digits()) return *found;
    return tiers.outside_by_exclusion();
}

}  // namespace barycert::core::isoparametric
