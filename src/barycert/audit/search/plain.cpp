// Plain witnesses: the same fault on fewer bits.
#include <algorithm>
#include <array>
#include <cmath>

#include "barycert/audit/search/coordinates.hpp"
#include "barycert/audit/search/evaluation.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/random.hpp"
#include "barycert/environment.hpp"

namespace barycert {

using namespace audit;

namespace {

/// How much there is to write down: bits, then the size of exponents, then signs.
int cost(double x) {
    if (x == 0) return 0;
    const auto exponent = static_cast<unsigned>(std::abs(exponent_of(x)));
    return 8 * significant_bits(x) + 2 * static_cast<int>(std::bit_width(exponent)) + (x < 0 ? 1 : 0);
}

int cost(const Case& c) {
    int sum = 0;
    for (int k = 0; k < coordinate_count(c); ++k) sum += cost(coordinate(c, k));
    for (const double f : c.values) sum += cost(f);
    return sum;
}

class Simplifier {
public:
    Simplifier(const Kernel& kernel, const Witness& witness)
        : kernel_(kernel), reason_(search_reason_named(witness.reason)), best_(witness.c) {
        shown_ = reason_ < search_reasons;
        if (!shown_) return;
        const double from = badness(reason_, ask(best_));
        shown_ = from >= 0;
        least_ = reason_ < finding_count ? 0 : from / 1024;
        cost_ = cost(best_);
    }

    Case run() {
        if (!shown_) return best_;
        for (int pass = 0; pass < passes; ++pass) {
            const int before = cost_;
            values();
            whole();
            for (int k = 0; k < coordinate_count(best_); ++k) one(k);
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
        const int now = cost(c);
        if (now >= cost_ || !admissible(c, {})) return false;
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
        int extreme = 0;
        bool any = false;
        for (int k = 0; k < coordinate_count(c); ++k) {
            const double x = coordinate(c, k);
            if (x == 0 || (axis >= 0 && axis_of(c, k) != axis)) continue;
            const int e = exponent_of(x);
            extreme = !any ? e : largest ? std::max(extreme, e) : std::min(extreme, e);
            any = true;
        }
        if (!any || extreme == 0) return;
        for (int k = 0; k < coordinate_count(c); ++k) {
            if (axis < 0 || axis_of(c, k) == axis) coordinate(c, k) = std::ldexp(coordinate(c, k), -extreme);
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
        if (coordinate(best_, k) == 0) return;
        for (const double x : {0.0, 1.0, -1.0, 0.5, 2.0}) {
            if (set(k, x)) return;
        }
        const int all = significant_bits(coordinate(best_, k));
        for (int bits = 1; bits < all; ++bits) {
            const double x = coordinate(best_, k);
            if (set(k, rounded_to(x, bits)) || set(k, rounded_to(x, bits, 1)) || set(k, rounded_to(x, bits, -1))) break;
        }
        for (int e = exponent_of(coordinate(best_, k)); e != 0;) {
            e /= 2;
            const double x = coordinate(best_, k);
            if (set(k, std::ldexp(x, e - exponent_of(x)))) break;
        }
        set(k, -coordinate(best_, k));
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
    std::size_t reason_;
    Case best_;
    bool shown_ = false;
    double least_ = 0;
    int cost_ = 0;
    std::uint64_t steps_ = 0;
};

}  // namespace

Witness plainest_witness(const Kernel& kernel, const Witness& witness, std::uint64_t* steps) {
    const ExactEnvironment environment;
    Simplifier simplifier(kernel, witness);
    Witness plain = witness;
    plain.c = simplifier.run();
    const std::size_t reason = search_reason_named(witness.reason);
    if (reason < search_reasons) plain.magnitude = magnitude(reason, evaluate(kernel, plain.c));
    if (steps != nullptr) *steps += simplifier.steps();
    return plain;
}

}  // namespace barycert
