/// Points of patches that may be nearest to a point p: found, proved, compared, and what is told of them.
///
/// Half the square of the distance from p to X(x) has the derivatives G_i = (X - p).X_i and H_ij = X_i.X_j +
/// (X - p).X_ij. Newton's method in double finds a zero of G about c; with Y about the inverse of H there, |1 - Y H| is
/// bounded over boxes around c by the Taylor coefficients of G at c, in balls. Where that is m < 1 there is at most one
/// zero in the box, and as in inverse.hpp there is one, enclosed by steps in more and more bits.
///
/// The square of the distance changes there by no more than its second derivatives times the square of what x may be
/// off: with 88 bits of x it has twice as many.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// About a zero of G.
struct Critical {
    Params<double> about{};
    std::array<std::array<double, 2>, 2> y{};
    /// |1 - Y H| at `about`, and by how much it grows with powers of a distance.
    std::array<std::array<std::array<double, 9>, 2>, 2> growth{};
    double most_slope = 0;  ///< no sum over a row of |H| exceeds it near `about`
    double unique = 0;      ///< no other zero in a box of that radius

    /// The largest row sum of |1 - Y H| over a box.
    double contraction(double radius, std::size_t variables) const;
};

/// How a number is known: rounded correctly, or off by at most so much.
struct RoundedDistance {
    double value = 0;
    double off = 0;
};

/// Beside a patch: a point of it that is given, or one nearest to p in some part of it.
class NearPatch {
public:
    /// Patch and point must stay.
    NearPatch(const Patch& patch, const double* point);

    std::size_t variables() const { return patch_->variables(); }
    const Patch& patch() const { return *patch_; }
    /// A zero of G, proved, that Newton's method finds from there; it may lie outside the patch.
    std::optional<Critical> critical(const Params<double>& from) const;

    /// Takes the point at x, as it is, or the critical one. That is the rest of what this class speaks of.
    void take(const Params<double>& x) {
        taken_.about = x;
        is_critical_ = false;
    }
    void take(const Critical& c) {
        taken_ = c;
        is_critical_ = variables() != 0;
    }
    const Params<double>& about() const { return taken_.about; }

    /// Certainly in the interior of the patch; what lies on its border is a point of another patch.
    bool inside();
    /// -1, 0, 1 as it is nearer than the other, as near as far as 250 bits tell, or farther.
    int compare(NearPatch& other);
    RoundedDistance distance();
    /// Each coordinate rounded, as far as 100 bits tell.
    std::array<double, 3> place();
    /// sum of N_i values[components * i + c], as evaluate() of inverse.hpp: i counts the nodes of the patch.
    Evaluated evaluate(const double* values, std::size_t components, double* out);

private:
    template <class T>
    using Map = PatchMap<Ball<T>>;
    template <class T>
    const Map<T>& map();
    template <class T>
    struct Enclosed {
        Params<Ball<T>> x{Ball<T>(0), Ball<T>(0)};  ///< around where it is
        Params<Ball<T>> middle{Ball<T>(0), Ball<T>(0)};
        double radius = 0;
    };
    /// False if there is no proof.
    template <class T>
    bool enclose(const Critical& c, double goal, Enclosed<T>& out);
    template <class T>
    Enclosed<T> enclosed();
    /// In rational numbers, if these can be told: where G is linear, or x has few bits.
    const std::optional<Params<Rational>>& exactly();
    std::optional<Params<Rational>> solve_linear(const PatchMap<Rational>& map) const;
    template <class T>
    std::optional<int> sign_of_difference(NearPatch& other);
    template <class T>
    Ball<T> square();
    template <unsigned bits>
    bool round_distance(RoundedDistance& out);
    bool round_quickly(RoundedDistance& out);
    /// A bit for each node whose function is not known to be zero.
    std::uint64_t active_nodes();
    template <class T>
    void shapes(const Params<T>& x, std::array<T, max_nodes>& n) const;

    const Patch* patch_;
    const double* point_;
    PatchUnits units_;
    Critical taken_;
    bool is_critical_ = false;
    std::shared_ptr<const Map<TwoDoubles>> doubles_;
    std::shared_ptr<const Map<Wide<300>>> wide_;
    std::shared_ptr<const Map<Wide<1200>>> wider_;
    std::shared_ptr<const PatchMap<Rational>> rational_;
    std::optional<std::optional<Params<Rational>>> exact_;
};

}  // namespace barycert::core::isoparametric
