#include <cmath>
#include <utility>

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

ValueFunction weighted_sum(Simplex s) {
    const int n = vertex_count(s);
    return n == 2 ? sum_of<2> : n == 3 ? sum_of<3> : sum_of<4>;
}

Kernel make_kernel(Simplex s, std::string_view formula_name, WeightsFunction weights, Declares declares, Text text) {
    Kernel k;
    k.name = std::string(name(s)) + "." + std::string(formula_name);
    k.simplex = s;
    k.formula = text.formula;
    k.source = text.source;
    k.fails = text.fails;
    k.declares_degenerate = declares == Declares::yes;
    k.weights = weights;
    k.value = weighted_sum(s);
    return k;
}

// By value: `base` may stand in the list that grows. NOLINTNEXTLINE(performance-unnecessary-value-param)
void add_variants(std::vector<Kernel>& list, Kernel base, WeightsFunction Variants::*function) {
    for (const Variant& variant : available_variants()) {
        Kernel k = base;
        k.name += std::string(".") + variant.suffix;
        k.fails = variant.fails;
        k.weights = variant.functions->*function;
        list.push_back(std::move(k));
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
