// Faults seeded into the catalogue's formulas and into kernels that certify what they say.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "audit/kernels/perspective_formulas.hpp"
#include "audit/kernels/space_formulas.hpp"
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/triangle_formulas.hpp"
#include "audit/kernels/vectors.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mutants.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/ulp.hpp"

namespace barycert::audit {
namespace {

using namespace kernels;

using Numbers = const double*;

/// A mutant of a kernel: the same but for its weights.
Mutant mutant_of(const Kernel& sound, const char* fault, const char* change, WeightsFunction weights) {
    Mutant m{sound, sound, fault, change};
    m.kernel.name += std::string("!") + fault;
    m.kernel.weights = weights;
    m.kernel.fails = change;
    return m;
}

/// A kernel of the catalogue.
Kernel catalogued(const char* name) {
    return kernels_matching(name).at(0);
}

/// A formula, and what is done to its weights.
struct FaultyFormula {
    const char *sound, *fault, *change;
    WeightsFunction formula;
    void (*spoil)(Numbers v, Numbers p, double* w) = nullptr;
};

void turn_all(double* w, int n) {
    for (int i = 0; i < n; ++i) w[i] = -w[i];
}

// Faults in signed areas and volumes.
constexpr FaultyFormula areas_and_volumes[] = {
    {"triangle.signed-area", "swapped-vertices", "the weights of b and c are exchanged", signed_area<double>,
     [](Numbers, Numbers, double* w) { std::swap(w[1], w[2]); }},
    // b - c where b - a belongs.
    {"triangle.signed-area", "wrong-origin", "one area relative to another vertex", signed_area<double>,
     [](Numbers v, Numbers p, double* w) {
         w[2] = cross(at2(v, 1) - at2(v, 2), at2(p, 0) - at2(v, 0)) / twice_area(v);
     }},
    {"triangle.signed-area", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     signed_area<double>,
     [](Numbers v, Numbers, double* w) {
         if (twice_area(v) < 0) turn_all(w, 3);
     }},
    {"triangle.signed-area", "absolute-guard", "adds 1e-50 to the divisor",
     [](Numbers v, Numbers p, double* w) { return areas_over(twice_area(v) + 1e-50, v, p, w), 0; }},
    {"triangle.signed-area", "absolute-tolerance", "degenerate below an area of 1e-12",
     [](Numbers v, Numbers p, double* w) { return magnitude(twice_area(v)) < 1e-12 ? 1 : signed_area(v, p, w); }},
    {"tetrahedron.signed-volume", "swapped-vertices", "the weights of a and d are exchanged", signed_volume<double>,
     [](Numbers, Numbers, double* w) { std::swap(w[0], w[3]); }},
    // The row (b, a, c) for (a, b, c): an odd permutation.
    {"tetrahedron.signed-volume", "odd-permutation", "one determinant with two rows exchanged", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[3] = -w[3]; }},
    {"tetrahedron.signed-volume", "wrong-index", "x of a vertex where its y belongs", signed_volume<double>,
     [](Numbers v, Numbers p, double* w) {
         double u[12], x[4];
         std::copy_n(v, 12, u);
         u[10] = v[9];
         if (signed_volume(u, p, x) == 0) w[0] = x[0];
     }},
    // A determinant without the last of the three products with its minors.
    {"tetrahedron.signed-volume", "dropped-term", "one product of a determinant is missing", signed_volume<double>,
     [](Numbers v, Numbers p, double* w) {
         const auto q = at3(p, 0), edge = at3(v, 1) - q, minor = cross(at3(v, 2) - q, at3(v, 3) - q);
         w[0] = (edge.x * minor.x + edge.y * minor.y) / volume(v);
     }},
    {"tetrahedron.signed-volume", "single-precision", "one weight goes through a float", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[2] = static_cast<double>(static_cast<float>(w[2])); }},
    {"tetrahedron.signed-volume", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     signed_volume<double>,
     [](Numbers v, Numbers, double* w) {
         if (volume(v) < 0) turn_all(w, 4);
     }},
    {"tetrahedron.signed-volume", "absolute-guard", "adds 1e-50 to the divisor",
     [](Numbers v, Numbers p, double* w) { return volumes_over(volume(v) + 1e-50, v, p, w), 0; }},
    {"tetrahedron.signed-volume", "absolute-tolerance", "degenerate below a volume of 1e-12",
     [](Numbers v, Numbers p, double* w) { return magnitude(volume(v)) < 1e-12 ? 1 : signed_volume(v, p, w); }},
    {"tetrahedron.signed-volume", "clamped", "negative weights become 0, the others are scaled", signed_volume<double>,
     [](Numbers, Numbers, double* w) {
         double sum = 0;
         for (int i = 0; i < 4; ++i) sum += w[i] = std::max(w[i], 0.0);
         for (int i = 0; i < 4; ++i) w[i] /= sum;
     }},
    {"tetrahedron.signed-volume", "forced-closure", "the last weight is 1 less the others", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[3] = 1 - w[0] - w[1] - w[2]; }},
    // Finite, plausible, wrong.
    {"tetrahedron.signed-volume", "even-weights", "a quarter each where the cell is degenerate",
     [](Numbers v, Numbers p, double* w) {
         if (signed_volume(v, p, w) != 0) std::fill_n(w, 4, 0.25);
         return 0;
     }},
};

// Faults in projections on segments and triangles in space, and in perspective.
constexpr FaultyFormula projections[] = {
    {"segment.dominant-axis", "wrong-comparison", "takes the axis on which the segment is shortest",
     [](Numbers v, Numbers p, double* w) {
         int axis = 0;
         for (int i = 1; i < 3; ++i) {
             if (magnitude(v[3 + i] - v[i]) < magnitude(v[3 + axis] - v[axis])) axis = i;
         }
         return signed_length(v, p, w, axis);
     }},
    {"segment.projection", "dropped-term", "the last product of a dot product is missing", segment_projection<double>,
     [](Numbers v, Numbers p, double* w) {
         const auto a = at3(v, 0), direction = at3(v, 1) - a, to_point = at3(p, 0) - a;
         w[1] = (to_point.x * direction.x + to_point.y * direction.y) / dot(direction, direction);
         w[0] = 1 - w[1];
     }},
    // The normal of the first two edges for that of the last two: turned round.
    {"triangle3d.cross-product", "odd-permutation", "one area turned round", cross_product<double>,
     [](Numbers, Numbers, double* w) { w[1] = -w[1]; }},
    {"triangle3d.gram", "dropped-term", "no product of the two edges",
     [](Numbers v, Numbers p, double* w) {
         const auto a = at3(v, 0), ab = at3(v, 1) - a, ac = at3(v, 2) - a, ap = at3(p, 0) - a;
         w[1] = dot(ap, ab) / dot(ab, ab);  // as if the edges were at right angles
         w[2] = dot(ap, ac) / dot(ac, ac);
         w[0] = 1 - w[1] - w[2];
         return 0;
     }},
    {"triangle.perspective-textbook", "dropped-depth", "the depth of c is left out",
     [](Numbers v, Numbers p, double* w) {
         return with_depths(v, p, {v[2], v[5], 1.0}, w);
     }},
    {"triangle.perspective-textbook", "swapped-vertices", "each depth is that of the next vertex",
     [](Numbers v, Numbers p, double* w) {
         return with_depths(v, p, {v[5], v[8], v[2]}, w);
     }},
};

template <const auto& table, std::size_t i>
int faulty(Numbers v, Numbers p, double* w) {
    const int status = table[i].formula(v, p, w);
    if (status == 0 && table[i].spoil != nullptr) table[i].spoil(v, p, w);
    return status;
}

template <const auto& table, std::size_t... i>
void add_faulty(std::vector<Mutant>& list, std::index_sequence<i...>) {
    (list.push_back(mutant_of(catalogued(table[i].sound), table[i].fault, table[i].change, faulty<table, i>)), ...);
}

// Faults seeded into kernels that certify what they say, correctly rounded weights: into barycert's own, and into some
// whose signs come from a filter in floating point where it proves them.
//
// The sound filter. Differences of coordinates are rounded once each; a determinant of them is a sum of products that
// each meet at most 8 roundings in 3D and 4 in 2D (weights.hpp), so that it is off by at most 8 u or 4 u times the
// sum of the products' magnitudes, to first order; what is of higher order, and the rounding of that sum itself, is
// below the margin taken: 10 u and 5 u. All that holds where no product underflows: differences are 0 or at least
// 2^-300. (Beyond the largest double the sum of magnitudes is infinite or not a number, and decides nothing.)

enum class FilterFault { none, constant_over_ten, no_underflow_guard, dropped_magnitude, tie_outside, tie_inside };

constexpr double unit = 0x1p-53;

/// A determinant and what its sign must exceed.
struct Bounded {
    double value, bound;
    bool certain() const { return std::fabs(value) > bound; }
    int sign() const { return value > 0 ? 1 : value < 0 ? -1 : 0; }
};

bool far_from_underflow(std::initializer_list<double> differences) {
    return std::ranges::all_of(differences, [](double x) { return x == 0 || std::fabs(x) >= 0x1p-300; });
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
    return {cross(a, b), far_from_underflow({a.x, a.y, b.x, b.y}) ? constant * unit * magnitude_sum : HUGE_VAL};
}

/// The exact weights; where the filter is certain, with its signs. `orientation`: the exact one of the cell.
template <Simplex s, FilterFault fault, std::size_t n>
int with_signs(const double* v, const double* p, const std::array<Bounded, n>& part, const Bounded& whole,
               int orientation, double* w) {
    const Result<Weights> exact = barycentric_weights(s, v, p);
    if (!exact) return 1;
    const int side = whole.certain() ? whole.sign() : orientation;
    if (side == 0) return 1;
    for (std::size_t i = 0; i < n; ++i) {
        // A degenerate cell that passes for another has no exact weights.
        w[i] = exact->degenerate ? part[i].value / whole.value : exact->weights[i];
        if (part[i].certain()) w[i] = std::copysign(std::max(std::fabs(w[i]), 0x1p-1074), part[i].sign() * side);
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
    std::copy_n(exact->weights.begin(), vertex_count(s), w);
    w[0] = 1;
    for (int i = 1; i < vertex_count(s); ++i) w[0] -= w[i];
    return 0;
}

/// The value from weights that were rounded before.
template <Simplex s>
double value_rounded_twice(const double* v, const double* p, const double* f) {
    const Result<Weights> exact = barycentric_weights(s, v, p);
    if (!exact || exact->degenerate) return std::nan("");
    return std::inner_product(f, f + vertex_count(s), exact->weights.begin(), 0.0);
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

std::vector<Mutant> made_mutants() {
    std::vector<Mutant> list;
    add_faulty<areas_and_volumes>(list, std::make_index_sequence<std::size(areas_and_volumes)>());
    const auto add = [&](const Kernel& tolerant, const char* change) {
        list.push_back(mutant_of(tolerant, "tolerance-times-ten", change, tolerant.weights));
        list.back().kernel.tolerance *= 10;
    };
    Kernel tolerant = catalogued("tetrahedron.vtk-tolerance");
    add(tolerant, "inside if every weight >= -0.01");
    tolerant.name = "tetrahedron.tolerance-1e-10";
    tolerant.tolerance = 1e-10;
    add(tolerant, "inside if every weight >= -1e-9");
    add_faulty<projections>(list, std::make_index_sequence<std::size(projections)>());
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
    return list;
}

}  // namespace
}  // namespace barycert::audit

namespace barycert {

const std::vector<Mutant>& all_mutants() {
    static const std::vector<Mutant> all = audit::made_mutants();
    return all;
}

}  // namespace barycert
