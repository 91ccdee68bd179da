#include "core/isoparametric/continuation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <optional>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/cell_polynomial.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Room for what is rounded in sums of a few positive doubles.
constexpr double room = 1 + 0x1p-40;

/// Y times a vector of balls: no coordinate is larger.
Vector<double> sizes_of_product(const Matrix& y, const Vector<Ball<double>>& x) {
    Vector<double> most{};
    for (std::size_t row = 0; row < 3; ++row) {
        Ball<double> sum(0);
        for (std::size_t k = 0; k < 3; ++k) sum = sum + Ball<double>(y[row][k]) * x[k];
        most[row] = sum.most();
    }
    return most;
}

/// The variable of a term of degree 1.
std::size_t axis_of(const CellBasis::Exponents& term) {
    return term[0] != 0 ? 0 : term[1] != 0 ? 1 : 2;
}

/// Proves what can be proved around a place, in boxes of some shape.
class Neighbourhood {
public:
    /// `target`: what is to be X less the point there; `way`: what it is yet to be moved by, at most.
    Neighbourhood(const CellPolynomial& map, std::size_t dimension, const Vector<double>& place,
                  const Vector<Ball<double>>& target, const Vector<Ball<double>>& way)
        : place_(place), dimension_(dimension), basis_(&map.basis()) {
        const CellCoefficients<Ball<double>> at = map.enclosed(place);
        Matrix jacobian{};
        for (std::size_t t = 0; t < basis_->terms.size(); ++t) {
            if (basis_->degree(t) != 1) continue;
            for (std::size_t k = 0; k < dimension_; ++k) jacobian[k][axis_of(basis_->terms[t])] = at[t][k].mid;
        }
        const std::optional<Matrix> inverse = inverse_matrix(jacobian, dimension_);
        if (!inverse) return;
        y_ = *inverse;
        bound_terms(at);
        Vector<Ball<double>> rest{Ball<double>(0), Ball<double>(0), Ball<double>(0)};
        for (std::size_t k = 0; k < dimension_; ++k) rest[k] = at[0][k] - target[k];
        choose_shape(sizes_of_product(y_, rest), sizes_of_product(y_, way));
    }

    const Vector<double>& place() const { return place_; }
    /// The target may be moved by that part of the way; negative if nothing is proved. Else a place that is taken to
    /// the target is within off() of this one in each coordinate, and there is no other within radius().
    double part() const { return best_.part; }
    double off(std::size_t axis) const { return 2 * best_.off * best_.shape[axis]; }
    double radius(std::size_t axis) const { return best_.radius * best_.shape[axis]; }

private:
    struct Box {
        Vector<double> shape{1, 1, 1};
        std::array<std::array<double, 4>, 3> growth{};  ///< of m, by row and power
        double off = 0, radius = 0, part = -1;
    };

    /// By term and row: no coordinate of Y times the coefficient is larger; of Y X' - 1 in place of Y X' for degree 1.
    void bound_terms(const CellCoefficients<Ball<double>>& at) {
        for (std::size_t t = 1; t < basis_->terms.size(); ++t) {
            for (std::size_t row = 0; row < dimension_; ++row) {
                Ball<double> sum(basis_->degree(t) == 1 && axis_of(basis_->terms[t]) == row ? -1 : 0);
                for (std::size_t k = 0; k < dimension_; ++k) sum = sum + Ball<double>(y_[row][k]) * at[t][k];
                terms_[t][row] = sum.most();
            }
        }
    }
    /// Chooses, among shapes between a cube and a box with the proportions of the way, the one that goes the farthest.
    void choose_shape(const Vector<double>& rest, const Vector<double>& way) {
        const double longest = std::max({way[0], way[1], way[2]});
        const bool moves = longest > 0x1p-900;  // else it is what balls add where nothing is left
        for (const double least : {1.0, 0x1p-2, 0x1p-4, 0x1p-8, 0x1p-16}) {
            Box box;
            for (std::size_t k = 0; k < dimension_ && moves; ++k)
                box.shape[k] = std::clamp(way[k] / longest, least, 1.0);
            bound(box, rest, way);
            if (box.part > best_.part) best_ = box;
            if (!moves || best_.part > 1) return;
        }
    }
    void bound(Box& box, const Vector<double>& rest, const Vector<double>& way) const {
        for (std::size_t t = 1; t < basis_->terms.size(); ++t) {
            const std::size_t degree = basis_->degree(t);
            double power = 1;
            for (std::size_t k = 0; k < dimension_; ++k) {
                for (int e = 0; e < basis_->terms[t][k]; ++e) power *= box.shape[k];
            }
            // The derivatives of h^b by all coordinates, times their lengths, sum up to its degree times a power.
            for (std::size_t row = 0; row < dimension_; ++row)
                box.growth[row][degree - 1] +=
                    static_cast<double>(degree) * terms_[t][row] * power / box.shape[row] * room;
        }
        double whole = 0;
        for (std::size_t k = 0; k < dimension_; ++k) {
            box.off = std::max(box.off, rest[k] / box.shape[k] * room);
            whole = std::max(whole, way[k] / box.shape[k] * room);
        }
        find_radius(box);
        if (!(integral(box, 2 * box.off) < box.off && 2 * box.off < box.radius)) return;
        const double reach = (box.radius - integral(box, box.radius)) * (1 - 0x1p-40) - box.off;
        if (reach > 0) box.part = whole > 0 ? std::min(reach / whole * (1 - 0x1p-40), 2.0) : 2;
    }
    /// m(R)
    static double contraction(const Box& box, double radius) {
        double most = 0;
        for (const auto& row : box.growth) {
            double sum = 0, power = 1;
            for (const double g : row) {
                sum += g * power;
                power *= radius;
            }
            most = std::max(most, sum * room);
        }
        return most;
    }
    /// M(R)
    static double integral(const Box& box, double radius) {
        double most = 0;
        for (const auto& row : box.growth) {
            double sum = 0, power = radius;
            for (std::size_t e = 0; e < row.size(); ++e) {
                sum += row[e] * power / static_cast<double>(e + 1);
                power *= radius;
            }
            most = std::max(most, sum * room);
        }
        return most;
    }
    /// R with m(R) somewhat below 1, where R - M(R) is about the largest; 0 if there is none.
    static void find_radius(Box& box) {
        constexpr double below = 0.97;
        double low = 0x1p40;
        while (low > 0x1p-30 && !(contraction(box, low) < below)) low /= 2;
        if (!(contraction(box, low) < below)) return;
        double high = 2 * low;
        for (int i = 0; i < 4; ++i) {
            const double middle = (low + high) / 2;
            (contraction(box, middle) < below ? low : high) = middle;
        }
        box.radius = low;
    }

    Vector<double> place_;
    std::size_t dimension_;
    const CellBasis* basis_;
    Matrix y_{};
    std::array<Vector<double>, max_nodes> terms_{};
    Box best_;
};

/// Newton's method from x to a place that is taken to the target, about.
bool approach(const CellPolynomial& map, std::size_t dimension, const Vector<double>& target, Vector<double>& x) {
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 40; ++step) {
        const CellCoefficients<double> at = map.about(x);
        std::array<std::array<double, 4>, 3> rows{};
        for (std::size_t t = 0; t < map.basis().terms.size(); ++t) {
            const CellBasis::Exponents& term = map.basis().terms[t];
            const std::size_t degree = map.basis().degree(t);
            if (degree > 1) continue;
            const std::size_t column = degree == 0 ? dimension : axis_of(term);
            for (std::size_t k = 0; k < dimension; ++k) rows[k][column] = at[t][k] - (degree == 0 ? target[k] : 0);
        }
        if (!eliminate(rows, dimension)) return false;
        double moved = 0, most = 1;
        for (std::size_t k = 0; k < dimension; ++k) {
            x[k] -= rows[k][dimension];
            moved = std::max(moved, std::abs(rows[k][dimension]));
            most = std::max(most, std::abs(x[k]));
        }
        moved /= most;
        if (!(moved < 0x1p40)) return false;
        if (moved < 0x1p-40 || (moved < 0x1p-26 && moved >= last / 2)) return true;
        last = moved;
    }
    return false;
}

}  // namespace

std::optional<ContinuedPlace> continue_inverse(const Reference& of, const Inverse& beside, const Vector<double>& from) {
    constexpr int most_steps = 200;
    constexpr double least_step = 0x1p-20;  // of the whole way
    const std::size_t d = of.dimension();
    const CellPolynomial map(of, beside);
    const Vector<Ball<double>> start = map.enclosed(from)[0];  // q - p
    // The target where the part `left`, 1 - s, of the way is still to go: that part of q - p.
    const auto target = [&](double left) {
        Vector<Ball<double>> at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = k < d ? Ball<double>(left) * start[k] : Ball<double>(0);
        return at;
    };
    double left = 1;
    Neighbourhood here(map, d, from, target(left), target(left));
    for (int step = 0; step < most_steps && here.part() > 0; ++step) {
        if (left == 0) return ContinuedPlace{here.place(), {here.radius(0), here.radius(1), here.radius(2)}};
        const double next = here.part() > 1 ? 0 : left * (1 - here.part() * 0.875);
        if (next != 0 && !(left - next > least_step)) return std::nullopt;
        Vector<double> x = here.place(), middle{};
        const Vector<Ball<double>> to = target(next);
        for (std::size_t k = 0; k < d; ++k) middle[k] = to[k].mid;
        if (!approach(map, d, middle, x)) return std::nullopt;
        const Neighbourhood there(map, d, x, to, to);
        for (std::size_t k = 0; k < d; ++k) {
            if (!((std::abs(x[k] - here.place()[k]) + there.off(k)) * room < here.radius(k))) return std::nullopt;
        }
        here = there;
        left = next;
    }
    return std::nullopt;
}

}  // namespace barycert::core::isoparametric
