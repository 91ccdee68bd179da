// Faults seeded into kernels that certify what they say, correctly rounded weights: into barycert's own, and into some
// whose signs come from a filter in floating point where it proves them.
//
// The sound filter. Differences of coordinates are rounded once each; a determinant of them is a sum of products that
// each meet at most 8 roundings in 3D and 4 in 2D (weights.hpp), so that it is off by at most 8 u or 4 u times the
// sum of the products' magnitudes, to first order; what is of higher order, and the rounding of that sum itself, is
// below the margin taken: 10 u and 5 u. All that holds where no product underflows: differences are 0 or at least
// 2^-300. (Beyond the largest double the sum of magnitudes is infinite or not a number, and decides nothing.)

#include "barycert/audit/mutants/mutants.hpp"
#include "barycert/base/ulp.hpp"
#include "barycert/kernels/tetrahedron_formulas.hpp"
#include "barycert/kernels/triangle_formulas.hpp"
#include "barycert/weights.hpp"

namespace barycert::audit {
namespace {

using namespace kernels;

enum class FilterFault { none, constant_over_ten, no_underflow_guard, dropped_magnitude, tie_outside, tie_inside };

constexpr double unit = 0x1p-53;

/// A determinant and what its sign must exceed.
struct Bounded {
    double value, bound;
    bool certain() const { return std::fabs(value) > bound; }
};

bool far_from_underflow(std::initializer_list<double> differences) {
    return std::all_of(differences.begin(), differences.end(),
                       [](double x) { return x == 0 || std::fabs(x) >= 0x1p-300; });
}

template <FilterFault fault>
Bounded bounded(Vector3<double> a, Vector3<double> b, Vector3<double> c) {
    const auto size = [](double x, double y, double z, double t) { return std::fabs(x * y) + std::fabs(z * t); };
    double magnitude_sum = std::fabs(a.x) * size(b.y, c.z, b.z, c.y) + std::fabs(a.y) * size(b.z, c.x, b.x, c.z);
    if (fault != FilterFault::dropped_magnitude) magnitude_sum += std::fabs(a.z) * size(b.x, c.y, b.y, c.x);
    constexpr double constant = fault == FilterFault::constant_over_ten ? 1 : 10;
    const bool usable =
        fault == FilterFault::no_underflow_guard || far_from_underflow({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
    return {determinant(a, b, c), usable ? constant * unit * magnitude_sum : HUGE_VAL};
}

template <FilterFault fault>
Bounded bounded(Vector2<double> a, Vector2<double> b) {
    const double magnitude_sum = std::fabs(a.x * b.y) + std::fabs(a.y * b.x);
    constexpr double constant = fault == FilterFault::constant_over_ten ? 0.5 : 5;
    const bool usable = fault == FilterFault::no_underflow_guard || far_from_underflow({a.x, a.y, b.x, b.y});
    return {cross(a, b), usable ? constant * unit * magnitude_sum : HUGE_VAL};
}

int sign_of(const Bounded& b) {
    return b.value > 0 ? 1 : b.value < 0 ? -1 : 0;
}

/// The exact weights; where the filter is certain, with its signs. `orientation`: the exact one of the cell.
template <Simplex s, FilterFault fault, std::size_t n>
int with_signs(const double* v, const double* p, const std::array<Bounded, n>& part, const Bounded& whole,
               int orientation, double* w) {
    const Result<Weights> exact = barycentric_weights(s, v, p);
    if (!exact) return 1;
    const int side = whole.certain() ? sign_of(whole) : orientation;
    if (side == 0) return 1;
    for (std::size_t i = 0; i < n; ++i) {
        // A degenerate cell that passes for another has no exact weights.
        w[i] = exact->degenerate ? part[i].value / whole.value : exact->weights[i];
        if (part[i].certain()) w[i] = std::copysign(std::max(std::fabs(w[i]), 0x1p-1074), sign_of(part[i]) * side);
        if (w[i] == 0 && fault == FilterFault::tie_outside) w[i] = -0x1p-1074;
        if (w[i] == 0 && fault == FilterFault::tie_inside) w[i] = 0x1p-1074;
    }
    return 0;
}

template <FilterFault f>
int filtered_volume(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    const std::array<Bounded, 4> part{bounded<f>(b - q, c - q, d - q), bounded<f>(a - q, d - q, c - q),
                                      bounded<f>(a - q, b - q, d - q), bounded<f>(a - q, c - q, b - q)};
    const int orientation = static_cast<int>(orient3d(v, v + 3, v + 6, v + 9));
    return with_signs<Simplex::tetrahedron, f>(v, p, part, bounded<f>(b - a, c - a, d - a), orientation, w);
}

template <FilterFault f>
int filtered_area(const double* v, const double* p, double* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    const std::array<Bounded, 3> part{bounded<f>(b - q, c - q), bounded<f>(c - q, a - q), bounded<f>(a - q, b - q)};
    const int orientation = static_cast<int>(orient2d(v, v + 2, v + 4));
    return with_signs<Simplex::triangle, f>(v, p, part, bounded<f>(b - a, c - a), orientation, w);
}

Kernel filtered(const char* like, const char* name, WeightsFunction weights) {
    Kernel k = catalogued(like);
    k.name = name;
    k.formula = "exact weights; their signs from determinants where a bound proves these";
    k.source = "Shewchuk 1997, a static bound";
    k.fails = "on no finite input";
    k.weights = weights;
    return k;
}

template <FilterFault f>
void add_both(std::vector<Mutant>& list, const Kernel& area, const Kernel& volume, const char* fault,
              const char* change) {
    list.push_back(mutant_of(area, fault, change, filtered_area<f>));
    list.push_back(mutant_of(volume, fault, change, filtered_volume<f>));
}

// In barycert's own kernels.

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
    list.push_back(mutant_of(sound, "rounded-twice", "values come from rounded weights", sound.weights));
    list.back().kernel.interpolate = value_rounded_twice<s>;
    list.push_back(
        mutant_of(sound, "ties-away", "a value midway between two doubles goes away from zero", sound.weights));
    list.back().kernel.interpolate = value_ties_away<s>;
}

}  // namespace

void add_certified_mutants(std::vector<Mutant>& list) {
    using F = FilterFault;
    const Kernel area = filtered("triangle.exact", "triangle.filtered", filtered_area<F::none>);
    const Kernel volume = filtered("tetrahedron.exact", "tetrahedron.filtered", filtered_volume<F::none>);
    add_both<F::constant_over_ten>(list, area, volume, "wrong-constant",
                                   "the bound of the filter is ten times too small");
    // Not in 2D, where these two would be sound: rounding keeps the order of two products, underflow or not; and the
    // products of a sign in doubt are nearly equal, so that a bound by one of them is half of what it was.
    list.push_back(mutant_of(volume, "no-underflow-guard", "products that underflow are trusted",
                             filtered_volume<F::no_underflow_guard>));
    list.push_back(mutant_of(volume, "dropped-term", "the bound of the filter lacks a term",
                             filtered_volume<F::dropped_magnitude>));
    add_both<F::tie_outside>(list, area, volume, "tie-outside", "a weight of exactly zero counts as negative");
    add_both<F::tie_inside>(list, area, volume, "tie-inside", "a weight of exactly zero counts as positive");
    add_certified<Simplex::triangle>(list);
    add_certified<Simplex::tetrahedron>(list);
}

}  // namespace barycert::audit
