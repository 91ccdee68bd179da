/// The catalogue as tables of formulas, one a file.
#pragma once

#include <span>
#include <string>

#include "audit/kernels/variants.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert::kernels {

enum class Declares : bool { no, yes };

/// Further facts about a formula.
struct More {
    WeightsFunction Variants::*variants = nullptr;  ///< compiled under other flags
    WeightsFunction single = nullptr;               ///< in single precision, `<name>.float32`
    const char* single_fails = "";
    CaseValueFunction value = nullptr, single_value = nullptr;  ///< straight from the case
    ValueFunction sum = nullptr;                                ///< in place of the sum of weight times value
    double tolerance = 0;                                       ///< above 0: RegionRule::tolerant
    bool certifies = false;                                     ///< by barycert's own core
};

/// A row of the catalogue.
struct Formula {
    const char *name, *formula, *source, *fails;
    WeightsFunction weights;
    Declares declares;
    More more = {};
};

/// The kernel `<simplex>.<name>`, of what is in `more` without variants and single precision.
Kernel make_kernel(Simplex s, const Formula& formula);

extern const std::span<const Formula> segment_formulas, triangle_formulas, perspective_formulas, triangle3d_formulas,
    tetrahedron_formulas;

/// The arguments of a formula, rounded. `stride` is the count of numbers of a vertex.
template <Simplex s, int stride>
struct Narrowed {
    float v[vertex_count(s) * stride], p[space_dimension(s)];
    Narrowed(const double* vertices, const double* point) {
        for (int i = 0; i < vertex_count(s) * stride; ++i) v[i] = static_cast<float>(vertices[i]);
        for (int i = 0; i < space_dimension(s); ++i) p[i] = static_cast<float>(point[i]);
    }
};

/// A formula in single precision, its weights widened on the way out.
template <Simplex s, int (*formula)(const float*, const float*, float*), int stride = space_dimension(s)>
int in_float(const double* vertices, const double* point, double* weights) {
    const Narrowed<s, stride> c(vertices, point);
    float w[vertex_count(s)];
    const int status = formula(c.v, c.p, w);
    for (int i = 0; i < vertex_count(s) && status == 0; ++i) weights[i] = static_cast<double>(w[i]);
    return status;
}

/// The same for a formula of values.
template <Simplex s, float (*formula)(const float*, const float*, const float*), int stride = space_dimension(s)>
double value_in_float(const double* vertices, const double* point, const double* values) {
    const Narrowed<s, stride> c(vertices, point);
    float f[vertex_count(s)];
    for (int i = 0; i < vertex_count(s); ++i) f[i] = static_cast<float>(values[i]);
    return static_cast<double>(formula(c.v, c.p, f));
}

/// Is a file a whole shared library, as far as its headers tell?
///
/// dlopen maps what the headers of an ELF file announce, and touches it: where the file ends before that, the system
/// ends the process (SIGBUS). So every part that a header names must lie within the file. Errors: the file cannot be
/// read, is no regular file, is no shared library in ELF for this machine, or is truncated. Does not look at what its
/// code does, nor at whether headers that agree with the file's size are true.
Status check_shared_library(const std::string& path);

}  // namespace barycert::kernels
