/// Newton's method on the map of a cell, and proofs of what it finds: see inverse.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// Whether a point of the reference cell may have these coordinates.
template <class T>
bool may_be_inside(const Reference& of, const std::array<Ball<T>, 3>& x) {
    const auto negative = [](const Ball<T>& b) { return b.sign() == -1; };
    Ball<T> rest(1);
    for (std::size_t k = 0; k < of.dimension(); ++k) {
        const bool summed = of.is_simplex() || (of.element == Element::wedge && k < 2);
        if (negative(x[k]) || (!summed && negative(Ball<T>(1) - x[k]))) return false;
        if (summed) rest = rest - x[k];
    }
    return !negative(rest);
}

/// The number of 30 bits behind the point that x is, or else a fraction with a denominator up to 2^16 that rounds to
/// about x; nothing where there is none, as nearly everywhere.
inline std::optional<Rational> simple_fraction(double x) {
    const double near = std::nearbyint(x * 0x1p30) * 0x1p-30;
    if (std::abs(near - x) <= 0x1p-60) return Rational(near);
    // Continued fractions: p / q, and the one before.
    double rest = x;
    std::int64_t p_before = 0, q_before = 1, p = 1, q = 0;
    for (int step = 0; step < 24 && std::abs(rest) < 0x1p17; ++step) {
        const double whole = std::floor(rest);
        const auto a = static_cast<std::int64_t>(whole);
        p_before = std::exchange(p, a * p + p_before);
        q_before = std::exchange(q, a * q + q_before);
        if (q > 0x10000) break;
        if (std::abs(static_cast<double>(p) / static_cast<double>(q) - x) <= 0x1p-51) return Rational(p) / Rational(q);
        rest = 1 / (rest - whole);
    }
    return std::nullopt;
}

/// A point beside the nodes of a cell, all of them divided by one power of two.
///
/// The map of a pyramid takes all of r and s to the apex, near which its Jacobian says nothing of them. But with
/// w = 1 - t, X - apex is w times what r and s say: so r and s are those of a smaller pyramid with the same apex, whose
/// base is 2^-shrink times as far from it, and w is 2^-shrink times its own.
class Inverse {
public:
    /// `shrink`: for a point near the apex of a pyramid x is that of a smaller one. Then functions() and
    /// may_be_inside() know the cell's own.
    Inverse(const Reference& reference, const Places& places, const double* point, bool shrink = false)
        : of_(reference), d_(reference.dimension()) {
        double most = largest(of_, places);
        for (std::size_t k = 0; k < d_; ++k) most = std::max(most, std::abs(point[k]));
        const int down = exponent_above(most) + 1;  // differences do not overflow
        const auto difference = [&](const double* a, const double* b, std::size_t k) {
            return TwoDoubles::sum(std::ldexp(a[k], -down), -std::ldexp(b[k], -down));
        };
        if (shrink && of_.element == Element::pyramid) {
            double base = 0, own = 0;
            for (std::size_t k = 0; k < d_; ++k) {
                own = std::max(own, std::abs(difference(point, places.at[4], k).high));
                for (std::size_t i = 0; i < 4; ++i)
                    base = std::max(base, std::abs(difference(places.at[i], places.at[4], k).high));
            }
            // The base stays farther away than the point, but in the flattest pyramids; 2^-954 is left of the last
            // bits.
            if (own > 0 && base > 64 * own) shrink_ = std::min(exponent_above(base) - exponent_above(own) - 2, 900);
        }
        amid_ = shrink_ != 0;
        most = 0;
        for (std::size_t i = 0; i < of_.nodes; ++i) {
            for (std::size_t k = 0; k < d_; ++k) {
                TwoDoubles q = difference(places.at[i], point, k);
                if (shrink_ != 0 && i < 4) {
                    const TwoDoubles edge = difference(places.at[i], places.at[4], k);
                    q = TwoDoubles(std::ldexp(edge.high, -shrink_), std::ldexp(edge.low, -shrink_)) +
                        difference(places.at[4], point, k);
                }
                if (places.other[i] != nullptr) {
                    const TwoDoubles sum = q + difference(places.other[i], point, k);
                    q = {sum.high / 2, sum.low / 2};
                    amid_ = true;
                }
                offset_[i][k] = q;
                most = std::max(most, std::abs(q.high));
            }
        }
        const int up = exponent_above(most);
        shift_ = -down - up;
        for (std::size_t i = 0; i < of_.nodes; ++i) {
            for (std::size_t k = 0; k < d_; ++k)
                offset_[i][k] = {std::ldexp(offset_[i][k].high, -up), std::ldexp(offset_[i][k].low, -up)};
        }
        places_ = places;
        point_ = point;
    }

    /// About the point of the reference cell; false if Newton's method does not get there. `beside`: one that lies
    /// outside the reference cell will do.
    bool search(bool beside = false) {
        constexpr std::array<Vector<double>, 9> starts{{{0.5, 0.5, 0.5},
                                                        {0.1, 0.1, 0.1},
                                                        {0.8, 0.1, 0.05},
                                                        {0.1, 0.8, 0.05},
                                                        {0.05, 0.1, 0.8},
                                                        {0.8, 0.8, 0.2},
                                                        {0.8, 0.2, 0.8},
                                                        {0.2, 0.8, 0.8},
                                                        {0.9, 0.9, 0.9}}};
        for (std::size_t i = 0; i < starts.size(); ++i) {
            Vector<double> x = starts[i];
            if (of_.is_simplex() || of_.element == Element::wedge) {
                if (i == 0) x = {0.3, 0.3, of_.element == Element::wedge ? 0.5 : 0.3};
                if (x[0] + x[1] + (of_.is_simplex() && d_ == 3 ? x[2] : 0) > 1) continue;
            }
            if (d_ == 2) x[2] = 0;
            if (!newton(x) || !(beside || near_cell(x))) continue;
            x_ = x;
            return true;
        }
        return false;
    }

    /// Newton's method from a place near one that is known to be the only one within `radius` of it that is taken to
    /// the point, and wanted: then enclose() finds that one or nothing.
    bool search_near(const Vector<double>& place, const Vector<double>& radius) {
        Vector<double> x = place;
        if (d_ == 2) x[2] = 0;
        if (!newton(x)) return false;
        x_ = x;
        for (std::size_t k = 0; k < d_; ++k)
            alone_ = std::min(alone_, radius[k] * (1 - 0x1p-40) - std::abs(x[k] - place[k]) * (1 + 0x1p-40));
        return alone_ > 0;
    }

    /// In the plane the third coordinate is 0.
    const Vector<double>& found() const { return x_; }
    /// The approximate inverse of the Jacobian there.
    const Matrix& inverse() const { return inverse_; }
    /// The power of two by which coordinates were multiplied: they are below 1 from the point.
    int shift() const { return shift_; }

    /// x enclosed, by as many steps as it takes to get below `goal`, if it can be.
    template <class T>
    bool enclose(std::array<Ball<T>, 3>& x, double goal) const {
        std::array<Vector<Ball<T>>, max_nodes> q;
        for (std::size_t i = 0; i < of_.nodes; ++i) {
            for (std::size_t k = 0; k < d_; ++k) q[i][k] = offset<T>(i, k);
        }
        Vector<Ball<T>> c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = Ball<T>(T(k < d_ ? x_[k] : 0.0));
        double box = 0, m = 0, radius = 0;
        for (int step = 0; step < 200; ++step) {
            std::array<Ball<T>, max_nodes> n;
            shape_functions(of_, c, n, nullptr);
            Vector<Ball<T>> rest, correction;
            double most = 0;
            for (std::size_t k = 0; k < d_; ++k) {
                rest[k] = Ball<T>(0);
                for (std::size_t i = 0; i < of_.nodes; ++i) rest[k] = rest[k] + n[i] * q[i][k];
            }
            for (std::size_t k = 0; k < d_; ++k) {
                correction[k] = Ball<T>(0);
                for (std::size_t j = 0; j < d_; ++j)
                    correction[k] = correction[k] + Ball<T>(T(inverse_[k][j])) * rest[j];
                most = std::max(most, correction[k].most());
            }
            if (step == 0) {
                box = 4 * most + 0x1p-45;
                m = contraction(box);
                if (!(m < 0.25 && box <= alone_)) return false;
            }
            // Within the box of the first step: it started at its middle, and moved by less than half of it.
            const double before = radius;
            radius = 2 * most * m;
            for (std::size_t k = 0; k < d_; ++k) {
                c[k] = c[k] - correction[k];
                radius = std::max(radius, 2 * most * m + c[k].radius);
            }
            if (step > 0 && !(most < box / 8)) return false;
            x = c;
            for (std::size_t k = 0; k < d_; ++k) x[k].radius = radius * (1 + 0x1p-40);
            for (std::size_t k = 0; k < d_; ++k) c[k].radius = 0;
            if (radius < goal) return true;
            if (step > 1 && !(radius < before / 2)) return true;  // no better in these numbers
        }
        return true;
    }

    /// The shape functions of the cell at x as enclose() has it.
    template <class T>
    void functions(const std::array<Ball<T>, 3>& x, std::array<Ball<T>, max_nodes>& n) const {
        if (shrink_ == 0) return shape_functions(of_, x, n, nullptr);
        const Ball<T> w = from_apex(x);
        shape_functions(of_, {x[0], x[1], Ball<T>(0)}, n, nullptr);
        for (std::size_t i = 0; i < 4; ++i) n[i] = n[i] * w;
        n[4] = Ball<T>(1) - w;
    }
    /// The Jacobian of the map at x as enclose() has it, [coordinate][variable], in units of offset(); and the
    /// derivatives of functions() by the same variables, of slopes[node][variable]. All are times Reference::scale.
    template <class T>
    void derivatives(const std::array<Ball<T>, 3>& x, std::array<Vector<Ball<T>>, 3>& jacobian,
                     std::array<Vector<Ball<T>>, max_nodes>& slopes) const {
        std::array<Ball<T>, max_nodes> n;
        shape_functions(of_, x, n, &slopes);
        for (std::size_t k = 0; k < d_; ++k) {
            for (std::size_t j = 0; j < d_; ++j) {
                jacobian[k][j] = Ball<T>(0);
                for (std::size_t i = 0; i < of_.nodes; ++i)
                    jacobian[k][j] = jacobian[k][j] + slopes[i][j] * offset<T>(i, k);
            }
        }
        if (shrink_ == 0) return;
        const Ball<T> w = from_apex(x), by(T(std::ldexp(1.0, -shrink_)));
        const Ball<T> base(0);
        shape_functions(of_, {x[0], x[1], base}, n, &slopes);
        for (std::size_t i = 0; i < 4; ++i) slopes[i] = {slopes[i][0] * w, slopes[i][1] * w, -(n[i] * by)};
        slopes[4] = {base, base, by};
    }
    /// Whether x, as enclose() has it, may be in the reference cell.
    template <class T>
    bool may_be_inside(const std::array<Ball<T>, 3>& x) const {
        if (shrink_ == 0) return isoparametric::may_be_inside(of_, x);
        return isoparametric::may_be_inside(of_, std::array<Ball<T>, 3>{x[0], x[1], Ball<T>(1) - from_apex(x)});
    }

    /// x of the cell as rational numbers, if they can be told.
    std::optional<Vector<Rational>> exactly(const Vector<double>& about) const {
        Vector<Rational> x{};
        if (affine(x)) return x;
        for (std::size_t k = 0; k < d_; ++k) {
            const std::optional<Rational> fraction = simple_fraction(about[k]);
            if (!fraction) return std::nullopt;
            x[k] = *fraction;
        }
        if (shrink_ != 0) x[2] = 1 - Rational(1 - x[2]) * Rational(std::ldexp(1.0, -shrink_));
        return is_at(x) ? std::optional(x) : std::nullopt;
    }

    template <class T>
    Ball<T> offset(std::size_t node, std::size_t axis) const {
        const TwoDoubles& q = offset_[node][axis];
        // The sum of two is rounded: both are at most 4 in these units.
        const double off = amid_ ? 0x1p-100 : 0x1p-1060;
        if constexpr (std::is_same_v<T, double>) {
            return {q.high, std::abs(q.low) + off};
        } else if constexpr (std::is_same_v<T, TwoDoubles>) {
            return {q, off};
        } else {
            const T from = T(places_.at[node][axis]) - T(point_[axis]);
            if (shrink_ != 0 && node < 4) {
                const T apex(places_.at[4][axis]);
                const T edge = ldexp(T(T(places_.at[node][axis]) - apex), -shrink_);
                return Ball<T>(ldexp(T(edge + (apex - T(point_[axis]))), shift_));
            }
            if (places_.other[node] == nullptr) return Ball<T>(ldexp(from, shift_));
            return Ball<T>(ldexp(T(from + (T(places_.other[node][axis]) - T(point_[axis]))), shift_ - 1));
        }
    }

private:
    template <class T>
    Ball<T> from_apex(const std::array<Ball<T>, 3>& x) const {
        return (Ball<T>(1) - x[2]) * Ball<T>(T(std::ldexp(1.0, -shrink_)));
    }

    bool newton(Vector<double>& x) {
        Vector<double> q{};
        double last = std::numeric_limits<double>::infinity();
        for (int step = 0; step < 40; ++step) {
            std::array<double, max_nodes> n;
            std::array<Vector<double>, max_nodes> dn;
            shape_functions(of_, x, n, &dn);
            Matrix jacobian{};
            q = {};
            for (std::size_t i = 0; i < of_.nodes; ++i) {
                for (std::size_t k = 0; k < d_; ++k) {
                    const double at = offset_[i][k].high;
                    q[k] += n[i] * at;
                    for (std::size_t j = 0; j < d_; ++j) jacobian[k][j] += dn[i][j] * at;
                }
            }
            if (!invert(jacobian)) return false;
            double moved = 0;
            for (std::size_t k = 0; k < d_; ++k) {
                double by = 0;
                for (std::size_t j = 0; j < d_; ++j) by += inverse_[k][j] * q[j];
                by = std::clamp(by, -1.0, 1.0);
                x[k] -= by;
                moved = std::max(moved, std::abs(by));
            }
            if (!(moved < 8)) return false;
            if (moved < 0x1p-40 || (moved < 0x1p-26 && moved >= last / 2)) return true;
            last = moved;
        }
        return false;
    }

    bool near_cell(const Vector<double>& x) const {
        constexpr double off = 0x1p-20;
        return may_be_inside<double>({Ball<double>(x[0], off), Ball<double>(x[1], off), Ball<double>(x[2], off)});
    }

    /// Sets inverse_.
    bool invert(const Matrix& a) {
        const std::optional<Matrix> found = inverse_matrix(a, d_);
        if (found) inverse_ = *found;
        return found.has_value();
    }

    /// The largest row sum of |1 - Y X'| over the box of that radius around x_.
    double contraction(double radius) const {
        std::array<Ball<double>, 3> x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = {x_[k], k < d_ ? radius : 0};
        std::array<Vector<Ball<double>>, max_nodes> slopes;
        std::array<Vector<Ball<double>>, 3> jacobian;
        derivatives(x, jacobian, slopes);
        double most = 0;
        for (std::size_t row = 0; row < d_; ++row) {
            double sum = 0;
            for (std::size_t column = 0; column < d_; ++column) {
                Ball<double> entry(row == column ? 1 : 0);
                for (std::size_t k = 0; k < d_; ++k)
                    entry = entry - Ball<double>(inverse_[row][k]) * jacobian[k][column];
                sum += entry.most();
            }
            most = std::max(most, sum * (1 + 0x1p-48));
        }
        return most;
    }

    Rational at(std::size_t node, std::size_t axis) const { return exact_place(places_, node, axis); }

    /// Where the map is affine: opposite edges are the same vectors. Sets x.
    bool affine(Vector<Rational>& x) const {
        const auto same = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t e) {  // b - a == e - c
            for (std::size_t k = 0; k < d_; ++k) {
                if (at(b, k) - at(a, k) != at(e, k) - at(c, k)) return false;
            }
            return true;
        };
        std::array<std::size_t, 3> along{1, 3, 4};
        switch (of_.element) {
            case Element::hexahedron:
                if (!same(0, 1, 4, 5) || !same(0, 1, 7, 6) || !same(0, 3, 4, 7)) return false;
                [[fallthrough]];
            case Element::quadrilateral:
            case Element::pyramid:
                if (!same(0, 1, 3, 2)) return false;
                break;
            case Element::wedge:
                if (!same(0, 1, 3, 4) || !same(0, 2, 3, 5)) return false;
                along = {1, 2, 3};
                break;
            default:
                return false;
        }
        // Gauss on [edges | p - p0].
        std::array<std::array<Rational, 4>, 3> a;
        for (std::size_t k = 0; k < d_; ++k) {
            for (std::size_t j = 0; j < d_; ++j) a[k][j] = at(along[j], k) - at(0, k);
            a[k][d_] = Rational(point_[k]) - at(0, k);
        }
        if (!eliminate(a, d_)) return false;
        for (std::size_t k = 0; k < d_; ++k) x[k] = a[k][d_];
        if (of_.element == Element::pyramid) {
            if (x[2] == 1) return false;  // the apex
            for (std::size_t k = 0; k < 2; ++k) x[k] /= Rational(1 - x[2]);
        }
        return true;
    }

    bool is_at(const Vector<Rational>& x) const {
        std::array<Rational, max_nodes> n;
        shape_functions(of_, x, n, nullptr);
        for (std::size_t k = 0; k < d_; ++k) {
            Rational sum = -Rational(point_[k]) * of_.scale;
            for (std::size_t i = 0; i < of_.nodes; ++i) sum += n[i] * at(i, k);
            if (sum != 0) return false;
        }
        return true;
    }

    const Reference& of_;
    std::size_t d_;
    int shift_ = 0, shrink_ = 0;
    bool amid_ = false;  ///< some nodes are amid two places, or moved towards the apex
    Places places_{};
    const double* point_ = nullptr;
    std::array<Vector<TwoDoubles>, max_nodes> offset_;  ///< of nodes from the point, below 1
    Vector<double> x_{};
    double alone_ = std::numeric_limits<double>::infinity();  ///< of search_near()
    Matrix inverse_{};
};

}  // namespace barycert::core::isoparametric
