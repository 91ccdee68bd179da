/// How the file of each simplex adds its kernels to the catalogue.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/kernels.hpp"
#include "barycert/kernels/variants.hpp"

namespace barycert::kernels {

void add_segment(std::vector<Kernel>& list);
void add_triangle(std::vector<Kernel>& list);
void add_perspective(std::vector<Kernel>& list);
void add_triangle3d(std::vector<Kernel>& list);
void add_tetrahedron(std::vector<Kernel>& list);

/// The default value function: sum of weight times value, left to right.
ValueFunction weighted_sum(Simplex s);

/// `<simplex>.exact`: the correctly rounded weights and values of weights.hpp.
void add_exact(std::vector<Kernel>& list, Simplex s);

struct Text {
    const char* formula;
    const char* source;
    const char* fails;
};

enum class Declares : bool { no, yes };

/// The kernel `<simplex>.<formula_name>` with the default value function.
Kernel make_kernel(Simplex s, std::string_view formula_name, WeightsFunction weights, Declares declares, Text text);

/// Adds copies of `base` (by value: the list grows) as `<name>.fast-math` and so on, those that this CPU can run.
void add_variants(std::vector<Kernel>& list, Kernel base, WeightsFunction Variants::*function);

/// A formula in single precision, its arguments rounded on the way in and its weights widened on the way out. `stride`
/// is the count of numbers of a vertex.
template <Simplex s, int (*formula)(const float*, const float*, float*), int stride = space_dimension(s)>
int in_float(const double* vertices, const double* point, double* weights) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    float v[n * stride], p[d], w[n];
    for (int i = 0; i < n * stride; ++i) v[i] = static_cast<float>(vertices[i]);
    for (int i = 0; i < d; ++i) p[i] = static_cast<float>(point[i]);
    const int status = formula(v, p, w);
    if (status != 0) return status;
    for (int i = 0; i < n; ++i) weights[i] = static_cast<double>(w[i]);
    return 0;
}

/// The same for a formula of values.
template <Simplex s, float (*formula)(const float*, const float*, const float*), int stride = space_dimension(s)>
double value_in_float(const double* vertices, const double* point, const double* values) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    float v[n * stride], p[d], f[n];
    for (int i = 0; i < n * stride; ++i) v[i] = static_cast<float>(vertices[i]);
    for (int i = 0; i < d; ++i) p[i] = static_cast<float>(point[i]);
    for (int i = 0; i < n; ++i) f[i] = static_cast<float>(values[i]);
    return static_cast<double>(formula(v, p, f));
}

}  // namespace barycert::kernels
