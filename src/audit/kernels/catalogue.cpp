#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/kernels/registry.hpp"
#include "audit/kernels/variants.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"

namespace barycert {
namespace kernels {
namespace {

template <int n>
double sum_of(const double* w, const double* f) {
    double sum = w[0] * f[0];
    for (int i = 1; i < n; ++i) sum += w[i] * f[i];
    return sum;
}

// barycert's own kernels: exact signs, correctly rounded weights and values. They certify what they say, so that the
// audit holds them to the last bit.

template <Simplex s>
int exact_weights(const double* vertices, const double* point, double* weights) {
    const Result<Weights> w = barycentric_weights(s, vertices, point);
    if (!w || w->degenerate) return 1;
    std::copy_n(w->weights.begin(), vertex_count(s), weights);
    return 0;
}

template <Simplex s>
double exact_value(const double* vertices, const double* point, const double* values) {
    const Result<Value> v = interpolate(s, vertices, point, values);
    return v ? v->value : std::numeric_limits<double>::quiet_NaN();
}

template <Simplex s>
constexpr Formula exact_formula{"exact",
                                "W_i = n_i / d, V = sum n_i f_i / d exactly, each rounded once, ties to even",
                                "barycert/weights.hpp: double + correction with a proven bound, then integers",
                                "on no finite input; costs more than a plain formula",
                                exact_weights<s>,
                                Declares::yes,
                                More{.value = exact_value<s>, .certifies = true}};

/// Each formula, its variants that this CPU can run, `<name>.fast-math` and so on, and then in single precision.
void add_formulas(std::vector<Kernel>& list, Simplex s, std::span<const Formula> formulas, bool perspective = false) {
    for (const Formula& f : formulas) {
        Kernel base = make_kernel(s, f);
        base.perspective = perspective;
        list.push_back(base);
        const auto add = [&](const char* suffix, const char* fails, WeightsFunction weights, CaseValueFunction value) {
            Kernel& k = list.emplace_back(base);
            k.name += std::string(".") + suffix;
            k.fails = fails;
            k.weights = weights;
            k.interpolate = value;
        };
        if (const auto variant = f.more.variants; variant != nullptr) {
            add("fast-math",
                "-ffast-math: the compiler's choice of reciprocals and sums on top of the formula's own faults",
                fast_math_variants.*variant, base.interpolate);
            add("O0", "-O0: the formula's own faults, bit for bit; any difference is a compiler's doing",
                unoptimised_variants.*variant, base.interpolate);
#ifdef BARYCERT_CONTRACTED
            if (__builtin_cpu_supports("fma") != 0)
                add("contracted",
                    "-ffp-contract=fast: ab-cd keeps one product exact and rounds the other; ab-ab is not 0",
                    contracted_variants.*variant, base.interpolate);
#endif
        }
        if (f.more.single != nullptr) add("float32", f.more.single_fails, f.more.single, f.more.single_value);
    }
}

}  // namespace

Kernel make_kernel(Simplex s, const Formula& f) {
    const int n = vertex_count(s);
    Kernel k;
    k.name = std::string(name(s)) + "." + f.name;
    k.simplex = s;
    k.formula = f.formula;
    k.source = f.source;
    k.fails = f.fails;
    k.declares_degenerate = f.declares == Declares::yes;
    k.weights = f.weights;
    k.value = f.more.sum != nullptr ? f.more.sum : n == 2 ? sum_of<2> : n == 3 ? sum_of<3> : sum_of<4>;
    k.interpolate = f.more.value;
    k.rule = f.more.tolerance > 0 ? RegionRule::tolerant : RegionRule::sign;
    k.tolerance = f.more.tolerance;
    k.certifies = k.core = f.more.certifies;
    return k;
}

}  // namespace kernels

const std::vector<Kernel>& catalogue() {
    static const std::vector<Kernel> all = [] {
        std::vector<Kernel> list;
        const auto add = [&]<Simplex s>(std::span<const kernels::Formula> formulas) {
            kernels::add_formulas(list, s, formulas);
            kernels::add_formulas(list, s, std::span(&kernels::exact_formula<s>, 1));
        };
        add.operator()<Simplex::segment>(kernels::segment_formulas);
        add.operator()<Simplex::triangle>(kernels::triangle_formulas);
        kernels::add_formulas(list, Simplex::triangle, kernels::perspective_formulas, true);
        add.operator()<Simplex::triangle3d>(kernels::triangle3d_formulas);
        add.operator()<Simplex::tetrahedron>(kernels::tetrahedron_formulas);
        return list;
    }();
    return all;
}

std::vector<Kernel> kernels_matching(std::string_view glob) {
    std::vector<Kernel> list = catalogue();
    std::erase_if(list, [&](const Kernel& k) { return !base::glob_match(glob, k.name); });
    return list;
}

Region claimed_region(const Kernel& kernel, int status, std::span<const double> weights) {
    const ExactEnvironment environment;
    if (status != 0) return Region::degenerate;
    bool below = false, zero = false;
    for (const double w : weights) {
        if (!std::isfinite(w)) return Region::degenerate;
        below |= kernel.rule == RegionRule::tolerant ? !(w >= -kernel.tolerance) : w < 0;
        zero |= w == 0;
    }
    if (below) return Region::outside;
    return zero && kernel.rule == RegionRule::sign ? Region::boundary : Region::interior;
}

}  // namespace barycert
