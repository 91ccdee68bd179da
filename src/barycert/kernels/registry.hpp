/// How the file of each simplex adds its kernels to the catalogue, from a table of formulas.
#pragma once

#include <span>
#include <vector>

#include "barycert/kernels.hpp"
#include "barycert/kernels/variants.hpp"

namespace barycert::kernels {

void add_segment(std::vector<Kernel>& list);
void add_triangle(std::vector<Kernel>& list);
void add_perspective(std::vector<Kernel>& list);
void add_triangle3d(std::vector<Kernel>& list);
void add_tetrahedron(std::vector<Kernel>& list);

/// `<simplex>.exact`: the correctly rounded weights and values of weights.hpp.
void add_exact(std::vector<Kernel>& list, Simplex s);

enum class Declares : bool { no, yes };

/// What else there is of a formula.
struct More {
    WeightsFunction Variants::*variants = nullptr;  ///< compiled under other flags
    WeightsFunction single = nullptr;               ///< in single precision, `<name>.float32`
    const char* single_fails = "";
    CaseValueFunction value = nullptr, single_value = nullptr;  ///< straight from the case
    ValueFunction sum = nullptr;                                ///< in place of the sum of weight times value
    double tolerance = 0;                                       ///< above 0: RegionRule::tolerant
};

constexpr More more(WeightsFunction Variants::*variants, WeightsFunction single = nullptr, const char* fails = "",
                    CaseValueFunction value = nullptr, CaseValueFunction single_value = nullptr) {
    return {variants, single, fails, value, single_value};
}
constexpr More summed_by(ValueFunction sum) {
    return {.sum = sum};
}
constexpr More tolerant(double tolerance) {
    return {.tolerance = tolerance};
}

/// A row of the catalogue.
struct Formula {
    const char *name, *formula, *source, *fails;
    WeightsFunction weights;
    Declares declares;
    More more = {};
};

/// The kernel `<simplex>.<name>`, of what is in `more` without variants and single precision.
Kernel make_kernel(Simplex s, const Formula& formula);

/// Each formula, its variants that this CPU can run, `<name>.fast-math` and so on, and then in single precision.
void add_formulas(std::vector<Kernel>& list, Simplex s, std::span<const Formula> formulas);

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

/// Is a file a whole shared library, as far as its headers tell?
///
/// dlopen maps what the headers of an ELF file announce, and touches it: where the file ends before that, the system
/// ends the process (SIGBUS). So every part that a header names must lie within the file. Errors: the file cannot be
/// read, is no regular file, is no shared library in ELF for this machine, or is truncated. What its code does, and
/// whether headers that agree with the file's size are true, is not looked at.
Status check_shared_library(const std::string& path);

}  // namespace barycert::kernels
