// Plain witnesses: the same fault on fewer bits.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "audit/search/evaluation.hpp"
#include "audit/search/moves.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"
#include "core/base/ulp.hpp"

namespace barycert {

using namespace audit;

namespace {

class Simplifier {
public:
    Simplifier(const Kernel& kernel, const Witness& witness, const ExponentRange& range)
        : kernel_(kernel),
          range_(range),
          reason_(search_reason_named(witness.reason)),
          best_(witness.c),
          cost_(plain_cost(best_)) {}

    Case run() {
        const double from = reason_ < search_reasons ? badness(reason_, ask(best_)) : -1;
        if (from < 0) return best_;
        least_ = reason_ < finding_count ? 0 : from / 1024;
        for (int pass = 0; pass < passes; ++pass) {
            const int before = cost_;
            values();
            whole();
            for (int k = 0; k < coordinate_count(best_); ++k) one(k);
            solved();
            together();
            if (cost_ == before) break;
        }
        return best_;
    }

    std::uint64_t steps() const { return steps_; }

private:
    static constexpr int passes = 12, tries_together = 4000;

    Evaluation ask(const Case& c) {
        ++steps_;
        return evaluate(kernel_, c);
    }

    /// Takes the case if it is plainer and shows the same.
    bool take(const Case& c) {
        const int now = plain_cost(c);
        if (now >= cost_ || !admissible(c, range_)) return false;
        const double shown = badness(reason_, ask(c));
        if (shown < 0 || shown < least_) return false;
        best_ = c;
        cost_ = now;
        return true;
    }

    void values() {
        Case c = best_;
        c.values = {};
        if (take(c)) return;
        for (std::size_t i = 0; i < 4; ++i) {
            for (const double f : {0.0, 1.0, -1.0}) {
                c = best_;
                c.values[i] = f;
                if (take(c)) break;
            }
            for (int bits = 1; bits < significant_bits(best_.values[i]); ++bits) {
                c = best_;
                c.values[i] = rounded_to(best_.values[i], bits);
                if (take(c)) break;
            }
        }
    }

    /// Moves a vertex to the origin; brings the largest or the smallest exponent to zero, by axis and for all.
    void whole() {
        for (int i = 0; i < vertex_count(best_.simplex); ++i) {
            Case c = best_;
            for (int k = 0; k < coordinate_count(c); ++k) {
                if (!is_depth(c, k)) coordinate(c, k) -= best_.vertex(i, axis_of(c, k));
            }
            take(c);
        }
        for (int axis = -1; axis < best_.stride(); ++axis) {
            for (const bool largest : {true, false}) scale(axis, largest);
        }
    }

    void scale(int axis, bool largest) {
        Case c = best_;
        std::optional<int> extreme;
        for (int k = 0; k < coordinate_count(c); ++k) {
            const double x = coordinate(c, k);
            if (x == 0 || (axis >= 0 && axis_of(c, k) != axis)) continue;
            const int e = std::ilogb(x);
            if (!extreme || (largest ? e > *extreme : e < *extreme)) extreme = e;
        }
        if (extreme.value_or(0) == 0) return;
        for (int k = 0; k < coordinate_count(c); ++k) {
            if (axis < 0 || axis_of(c, k) == axis) coordinate(c, k) = std::ldexp(coordinate(c, k), -*extreme);
        }
        take(c);
    }

    bool set(int k, double x) {
        Case c = best_;
        coordinate(c, k) = x;
        return take(c);
    }

    /// The plainest first: zero, one, fewer bits, a smaller exponent, another sign.
    void one(int k) {
        if (coordinate(best_, k) == 0) {
            set(k, 0);  // of -0
            return;
        }
        for (const double x : {0.0, 1.0, -1.0, 0.5, 2.0}) {
            if (set(k, x)) return;
        }
        const int all = significant_bits(coordinate(best_, k));
        for (int bits = 1; bits < all; ++bits) {
            const double x = coordinate(best_, k);
            if (set(k, rounded_to(x, bits)) || set(k, rounded_to(x, bits, 1)) || set(k, rounded_to(x, bits, -1))) break;
        }
        for (int e = std::ilogb(coordinate(best_, k)); e != 0;) {
            e /= 2;
            const double x = coordinate(best_, k);
            if (set(k, std::ldexp(x, e - std::ilogb(x)))) break;
        }
        set(k, -coordinate(best_, k));
    }

    /// Fewer bits of all numbers but one, and that one so that a weight, or the cell, is zero again or nearly: most
    /// faults live beside these zeros, and rounding leads away from them. First all numbers at once, then each alone.
    void solved() {
        constexpr std::array steps{1, 2, 3, 4, 6, 9, 13, 19, 27, 38};
        for (const int bits : steps) {
            if (solved_with(bits, -1)) break;
        }
        for (int k = 0; k < coordinate_count(best_); ++k) {
            for (const int bits : steps) {
                if (bits >= significant_bits(coordinate(best_, k)) || solved_with(bits, k)) break;
            }
        }
    }

    /// `only`: the number that is rounded; -1: all.
    bool solved_with(int bits, int only) {
        Case rounded = best_;
        for (int k = 0; k < coordinate_count(rounded); ++k) {
            double& x = coordinate(rounded, k);
            if ((only < 0 || only == k) && x != 0 && significant_bits(x) > bits) x = rounded_to(x, bits);
        }
        if (!admissible(rounded, range_)) return false;
        const Evaluation at = ask(rounded);
        const int n = vertex_count(rounded.simplex), d = space_dimension(rounded.simplex);
        for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
            for (int axis = 0; axis < d; ++axis) {
                const int of_point = vertex_numbers(rounded) + axis;
                const int of_vertex = rounded.stride() * static_cast<int>(i) + axis;
                if (of_point != only && solved_at(rounded, at, {i, false, of_point})) return true;
                if (of_vertex != only && solved_at(rounded, at, {i, true, of_vertex})) return true;
            }
        }
        return false;
    }

    bool solved_at(Case c, const Evaluation& at, const Zero& zero) {
        Evaluation answer;
        const auto asked = [&](const Case& x) {
            answer = ask(x);
            return &answer;
        };
        to_zero(c, at, zero, first_step(c, zero.coordinate), range_, asked);
        const double x = coordinate(c, zero.coordinate);
        for (const int ulps : {0, 1, -1, 2, -2, 4, -4}) {
            coordinate(c, zero.coordinate) = base::places_above(x, ulps);
            if (take(c)) return true;
        }
        return false;
    }

    /// All numbers of at most so many bits, a few of them off by some units of the last: where one number alone cannot
    /// change, several can.
    void together() {
        base::Random random(1);
        for (int t = 0; t < tries_together; ++t) {
            int most = 0;
            for (int k = 0; k < coordinate_count(best_); ++k)
                most = std::max(most, significant_bits(coordinate(best_, k)));
            if (most < 2) return;
            const int bits = random.integer(1, most - 1);
            Case c = best_;
            for (int k = 0; k < coordinate_count(c); ++k) {
                const int off = random.below(3) == 0 ? random.integer(-2, 2) : 0;
                double& x = coordinate(c, k);
                if (x != 0 && significant_bits(x) > bits) x = rounded_to(x, bits, off);
            }
            take(c);
        }
    }

    const Kernel& kernel_;
    ExponentRange range_;
    std::size_t reason_;
    Case best_;
    int cost_;
    double least_ = 0;
    std::uint64_t steps_ = 0;
};

}  // namespace

Witness plainest_witness(const Kernel& kernel, const Witness& witness, std::uint64_t* steps, int min_exponent,
                         int max_exponent) {
    const ExactEnvironment environment;
    Simplifier simplifier(kernel, witness, {min_exponent, max_exponent});
    Witness plain = witness;
    plain.c = simplifier.run();
    const std::size_t reason = search_reason_named(witness.reason);
    if (reason < search_reasons) plain.magnitude = magnitude(reason, evaluate(kernel, plain.c));
    if (steps != nullptr) *steps += simplifier.steps();
    return plain;
}

}  // namespace barycert
