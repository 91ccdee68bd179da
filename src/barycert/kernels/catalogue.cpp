#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/kernels/registry.hpp"

namespace barycert {
namespace kernels {
namespace {

template <int n>
double sum_of(const double* w, const double* f) {
    double sum = w[0] * f[0];
    for (int i = 1; i < n; ++i) sum += w[i] * f[i];
    return sum;
}

struct Variant {
    const char* suffix;
    const Variants* functions;
    const char* fails;
};

std::vector<Variant> available_variants() {
    std::vector<Variant> list{
        {"fast-math", &fast_math_variants,
         "-ffast-math: the compiler's choice of reciprocals and sums on top of the formula's own faults"},
        {"O0", &unoptimised_variants,
         "-O0: the formula's own faults, bit for bit; any difference is a compiler's doing"}};
#ifdef BARYCERT_CONTRACTED
    if (__builtin_cpu_supports("fma") != 0) {
        list.push_back({"contracted", &contracted_variants,
                        "-ffp-contract=fast: ab-cd keeps one product exact and rounds the other; ab-ab is not 0"});
    }
#endif
    return list;
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
    return k;
}

void add_formulas(std::vector<Kernel>& list, Simplex s, std::span<const Formula> formulas) {
    for (const Formula& f : formulas) {
        const Kernel base = make_kernel(s, f);
        list.push_back(base);
        const auto add = [&](const char* suffix, const char* fails, WeightsFunction weights, CaseValueFunction value) {
            Kernel& k = list.emplace_back(base);
            k.name += std::string(".") + suffix;
            k.fails = fails;
            k.weights = weights;
            k.interpolate = value;
        };
        if (f.more.variants != nullptr) {
            for (const Variant& v : available_variants())
                add(v.suffix, v.fails, v.functions->*f.more.variants, base.interpolate);
        }
        if (f.more.single != nullptr) add("float32", f.more.single_fails, f.more.single, f.more.single_value);
    }
}

}  // namespace kernels

const std::vector<Kernel>& catalogue() {
    static const std::vector<Kernel> all = [] {
        std::vector<Kernel> list;
        kernels::add_segment(list);
        kernels::add_exact(list, Simplex::segment);
        kernels::add_triangle(list);
        kernels::add_exact(list, Simplex::triangle);
        kernels::add_perspective(list);
        kernels::add_triangle3d(list);
        kernels::add_exact(list, Simplex::triangle3d);
        kernels::add_tetrahedron(list);
        kernels::add_exact(list, Simplex::tetrahedron);
        return list;
    }();
    return all;
}

std::vector<Kernel> kernels_matching(std::string_view glob) {
    std::vector<Kernel> list;
    for (const Kernel& k : catalogue()) {
        if (base::glob_match(glob, k.name)) list.push_back(k);
    }
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
