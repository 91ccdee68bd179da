// Faults seeded into barycert's own kernels, which promise the last bit.
#include <array>
#include <cmath>

#include "barycert/audit/mutants/mutants.hpp"
#include "barycert/base/ulp.hpp"
#include "barycert/weights.hpp"

namespace barycert::audit {
namespace {

template <Simplex s>
int exact_but_closed(const double* v, const double* p, double* w) {
    const Result<Weights> exact = barycentric_weights(s, v, p);
    if (!exact || exact->degenerate) return 1;
    w[0] = 1;
    for (int i = 1; i < vertex_count(s); ++i) {
        w[i] = exact->weights[static_cast<std::size_t>(i)];
        w[0] -= w[i];
    }
    return 0;
}

/// The value from weights that were rounded before.
template <Simplex s>
double value_rounded_twice(const double* v, const double* p, const double* f) {
    const Result<Weights> exact = barycentric_weights(s, v, p);
    if (!exact || exact->degenerate) return std::nan("");
    double sum = 0;
    for (int i = 0; i < vertex_count(s); ++i) sum += exact->weights[static_cast<std::size_t>(i)] * f[i];
    return sum;
}

/// Between two values whose weights are one half the exact value often lies midway between two doubles: it belongs to
/// the even one, and gets the one farther from zero here.
template <Simplex s>
double value_ties_away(const double* v, const double* p, const double* f) {
    const Result<Weights> w = barycentric_weights(s, v, p);
    const Result<Value> right = interpolate(s, v, p, f);
    if (!w || w->degenerate || !right) return std::nan("");
    std::array<double, 2> half{};
    std::size_t halves = 0;
    for (int i = 0; i < vertex_count(s); ++i) {
        const double weight = w->weights[static_cast<std::size_t>(i)];
        if (weight == 0.5 && halves < 2) half[halves++] = f[i];
    }
    if (halves != 2) return right->value;
    // The sum without its rounding error, which is half an ulp where there is a tie. Halving loses nothing here.
    const double sum = half[0] + half[1], part = sum - half[0];
    const double error = (half[0] - (sum - part)) + (half[1] - part);
    const double ulp = std::ldexp(1.0, base::ulp_exponent(sum));
    const bool towards_zero = error != 0 && (error > 0) == (sum > 0);
    if (std::fabs(error) == ulp / 2 && towards_zero) return (sum + std::copysign(ulp, sum)) / 2;
    return right->value;
}

template <Simplex s>
void add_certified(std::vector<Mutant>& list) {
    const Kernel sound = catalogued((std::string(name(s)) + ".exact").c_str());
    list.push_back(mutant_of(sound, "forced-closure", "the first weight is 1 less the others", exact_but_closed<s>));
    Mutant twice = mutant_of(sound, "rounded-twice", "values come from rounded weights", sound.weights);
    twice.kernel.interpolate = value_rounded_twice<s>;
    list.push_back(twice);
    Mutant away =
        mutant_of(sound, "ties-away", "a value midway between two doubles goes away from zero", sound.weights);
    away.kernel.interpolate = value_ties_away<s>;
    list.push_back(away);
}

}  // namespace

void add_certified_mutants(std::vector<Mutant>& list) {
    add_certified<Simplex::triangle>(list);
    add_certified<Simplex::tetrahedron>(list);
}

}  // namespace barycert::audit
