// barycert's own kernels: exact signs, correctly rounded weights and values. They certify what they say, so that the
// audit holds them to the last bit.
#include <algorithm>
#include <limits>

#include "barycert/kernels/registry.hpp"
#include "barycert/weights.hpp"

namespace barycert::kernels {
namespace {

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
void add(std::vector<Kernel>& list) {
    list.push_back(
        make_kernel(s, {"exact", "W_i = n_i / d, V = sum n_i f_i / d exactly, each rounded once, ties to even",
                        "barycert/weights.hpp: double + correction with a proven bound, then integers",
                        "on no finite input; costs more than a plain formula", exact_weights<s>, Declares::yes,
                        more(nullptr, nullptr, "", exact_value<s>)}));
    list.back().certifies = list.back().core = true;
}

}  // namespace

void add_exact(std::vector<Kernel>& list, Simplex s) {
    with_simplex(s, [&]<Simplex known>() { add<known>(list); });
}

}  // namespace barycert::kernels
