#include "core/isoparametric/gradient.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "barycert/simplex.hpp"
#include "core/isoparametric/affine_function.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/component.hpp"
#include "core/isoparametric/continuation.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/newton.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Gradients of all components, and which of their numbers are still to be found.
class Gradients {
public:
    Gradients(const Reference& of, const Places& places, const double* values, std::size_t components, double* out)
        : of_(of),
          d_(of.dimension()),
          places_(places),
          values_(values),
          all_(components),
          open_(d_ * components, 0),
          off_(open_.size(), 0),
          out_(out) {
        std::vector<std::uint8_t> open(components, 0);
        std::vector<double> known(components);
        scale_components(of_.nodes, ~std::uint64_t{0}, values, all_, open, known.data());
        for (std::size_t i = 0; i < open_.size(); ++i) {
            open_[i] = open[i / d_];
            out_[i] = known[i / d_];
        }
    }

    bool left() const { return std::ranges::count(open_, 1) != 0; }
    double off() const { return open_.empty() ? 0 : *std::ranges::max_element(off_); }

    /// With x enclosed in these numbers; false if it cannot be, or lies outside of the cell though not `beyond`.
    template <class T>
    bool enclosed(const Inverse& inverse, bool beyond, double goal, Vector<double>* about) {
        std::array<Ball<T>, 3> x;
        if (!inverse.enclose<T>(x, goal) || !(beyond || inverse.may_be_inside(x))) return false;
        for (std::size_t k = 0; about != nullptr && k < d_; ++k) {
            if constexpr (std::is_same_v<T, TwoDoubles>) (*about)[k] = x[k].mid.high;
        }
        std::array<Vector<Ball<T>>, 3> jacobian, cofactor;
        std::array<Vector<Ball<T>>, max_nodes> slopes;
        inverse.derivatives(x, jacobian, slopes);
        cofactor = cofactors(jacobian, d_);
        Ball<T> determinant(0);
        for (std::size_t j = 0; j < d_; ++j) determinant = determinant + jacobian[0][j] * cofactor[0][j];
        const std::optional<Ball<T>> by = inverse_of(determinant);
        if (!by) return false;
        for (std::size_t c = 0; c < all_.size(); ++c) {
            Vector<Ball<T>> f;
            for (std::size_t j = 0; j < d_; ++j) {
                f[j] = Ball<T>(0);
                for (std::size_t i = 0; i < of_.nodes; ++i) {
                    if (all_[c].values[i] != 0) f[j] = f[j] + slopes[i][j] * Ball<T>(T(all_[c].values[i]));
                }
            }
            for (std::size_t k = 0; k < d_; ++k) {
                const std::size_t at = d_ * c + k;
                if (open_[at] == 0) continue;
                Ball<T> sum(0);
                for (std::size_t j = 0; j < d_; ++j) sum = sum + f[j] * cofactor[k][j];
                settle(at, sum * *by, all_[c].exponent + inverse.shift());
            }
        }
        return true;
    }

    /// At x itself. False where the Jacobian is zero.
    bool exactly(const Vector<Rational>& x) {
        std::array<Rational, max_nodes> n;
        std::array<Vector<Rational>, max_nodes> slopes;
        shape_functions(of_, x, n, &slopes);
        // The rows of J^T, and f.
        std::array<std::array<Rational, 3>, 3> transposed;
        for (std::size_t j = 0; j < d_; ++j) {
            for (std::size_t k = 0; k < d_; ++k) {
                for (std::size_t i = 0; i < of_.nodes; ++i)
                    transposed[j][k] += slopes[i][j] * exact_place(places_, i, k);
            }
        }
        for (std::size_t c = 0; c < all_.size(); ++c) {
            std::array<std::array<Rational, 4>, 3> rows;
            for (std::size_t j = 0; j < d_; ++j) {
                for (std::size_t k = 0; k < d_; ++k) rows[j][k] = transposed[j][k];
                for (std::size_t i = 0; i < of_.nodes; ++i) rows[j][d_] += slopes[i][j] * value(i, c);
            }
            if (is_open(c) && !solve(rows, c)) return false;
        }
        return true;
    }

    /// Of components whose values are those of an affine function.
    void affine() {
        for (std::size_t c = 0; c < all_.size(); ++c) {
            if (!is_open(c)) continue;
            const auto f = affine_function(of_, places_, values_ + c, all_.size());
            for (std::size_t k = 0; f && k < d_; ++k) put(d_ * c + k, rounded(f->gradient[k]));
        }
    }

private:
    bool is_open(std::size_t c) const { return std::count(open_.begin() + at(c), open_.begin() + at(c + 1), 1) != 0; }
    std::ptrdiff_t at(std::size_t c) const { return static_cast<std::ptrdiff_t>(d_ * c); }
    Rational value(std::size_t node, std::size_t c) const { return Rational(values_[all_.size() * node + c]); }
    void settle(std::size_t at, const Ball<TwoDoubles>& g, int exponent) {
        if (const std::optional<double> found = value_of(g, exponent)) put(at, *found);
    }
    template <unsigned bits>
    void settle(std::size_t at, const Ball<Wide<bits>>& g, int exponent) {
        if (const std::optional<double> found = value_of(g, exponent, &out_[at], &off_[at])) put(at, *found);
    }
    void put(std::size_t at, double found) {
        out_[at] = found + 0.0;
        off_[at] = 0;
        open_[at] = 0;
    }

    bool solve(std::array<std::array<Rational, 4>, 3>& rows, std::size_t c) {
        if (!eliminate(rows, d_)) return false;
        for (std::size_t k = 0; k < d_; ++k) put(d_ * c + k, rounded(rows[k][d_]));
        return true;
    }

    const Reference& of_;
    std::size_t d_;
    const Places& places_;
    const double* values_;
    std::vector<Component> all_;
    std::vector<std::uint8_t> open_;
    std::vector<double> off_;
    double* out_;
};

/// At what `search` finds, true if it did; `beyond`: also outside of the cell.
template <class Search>
Evaluated gradients_at(const Reference& of, const Places& places, const double* point, const double* values,
                       std::size_t components, double* out, bool beyond, Search search) {
    Gradients gradients(of, places, values, components, out);
    if (!gradients.left()) return {Certainty::proved, Tier::double_double};
    Inverse inverse(of, places, point, !beyond);
    Vector<double> about{};
    const bool found = search(inverse);
    if (found && gradients.enclosed<TwoDoubles>(inverse, beyond, 0x1p-88, &about) && !gradients.left())
        return {Certainty::proved, Tier::double_double};
    if (const auto x = inverse.exactly(about); x && gradients.exactly(*x)) return {Certainty::proved, Tier::exact};
    if (!found) return {};
    gradients.affine();
    if (gradients.left() && !gradients.enclosed<Wide<300>>(inverse, beyond, 0x1p-250, nullptr)) return {};
    if (gradients.left()) gradients.enclosed<Wide<1200>>(inverse, beyond, 0x1p-940, nullptr);
    return {gradients.left() ? Certainty::undecided : Certainty::proved, Tier::exact, gradients.off()};
}

}  // namespace

Evaluated evaluate_gradients(const Reference& of, const Places& places, const double* point, const double* values,
                             std::size_t components, double* out) {
    return gradients_at(of, places, point, values, components, out, false,
                        [](Inverse& inverse) { return inverse.search(); });
}

Evaluated evaluate_gradients_beyond(const Reference& of, const Places& places, const double* point,
                                    const std::array<double, 3>& from, const double* values, std::size_t components,
                                    double* out) {
    // As of evaluate_beyond(): 0.1 has too many bits for other maps than affine ones.
    if (Inverse(of, places, point).exactly({0.1, 0.1, 0.1}))
        return gradients_at(of, places, point, values, components, out, true, [](Inverse&) { return false; });
    return gradients_at(of, places, point, values, components, out, true, [&](Inverse& inverse) {
        const auto place = continue_inverse(of, inverse, from);
        return place && inverse.search_near(place->about, place->radius);
    });
}

Evaluated gradients_at_place(const Reference& of, const Places& places, const std::array<double, 3>& x,
                             const double* values, std::size_t components, double* out) {
    Gradients gradients(of, places, values, components, out);
    if (!gradients.left()) return {Certainty::proved, Tier::double_double};
    if (!gradients.exactly({Rational(x[0]), Rational(x[1]), Rational(x[2])})) return {};
    return {Certainty::proved, Tier::exact};
}

}  // namespace barycert::core::isoparametric
