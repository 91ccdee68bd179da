// The catalogue's formulas as one shared library, compiled anew for each set of compiler flags (CMakeLists.txt). Only
// formulas that are headers of their own: those that call Eigen would measure Eigen's code, too.
#include "variant.hpp"

#include "audit/kernels/perspective_formulas.hpp"
#include "audit/kernels/space_formulas.hpp"
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/triangle_formulas.hpp"

#ifndef FLAGS_SCALAR
#define FLAGS_SCALAR double
#endif

namespace {

using namespace barycert::kernels;
using T = FLAGS_SCALAR;

/// Arguments rounded on the way in, weights widened on the way out; of doubles nothing changes.
template <int numbers, int dimension, int count, int (*formula)(const T*, const T*, T*)>
int in_scalar(const double* vertices, const double* point, double* weights) {
    T v[numbers], p[dimension], w[count];
    for (int i = 0; i < numbers; ++i) v[i] = static_cast<T>(vertices[i]);
    for (int i = 0; i < dimension; ++i) p[i] = static_cast<T>(point[i]);
    const int status = formula(v, p, w);
    if (status != 0) return status;
    for (int i = 0; i < count; ++i) weights[i] = static_cast<double>(w[i]);
    return 0;
}

template <int (*formula)(const T*, const T*, T*)>
constexpr FlagsFunction segment = in_scalar<6, 3, 2, formula>;
template <int (*formula)(const T*, const T*, T*)>
constexpr FlagsFunction triangle = in_scalar<6, 2, 3, formula>;
template <int (*formula)(const T*, const T*, T*)>
constexpr FlagsFunction window = in_scalar<9, 2, 3, formula>;
template <int (*formula)(const T*, const T*, T*)>
constexpr FlagsFunction triangle3d = in_scalar<9, 3, 3, formula>;
template <int (*formula)(const T*, const T*, T*)>
constexpr FlagsFunction tetrahedron = in_scalar<12, 3, 4, formula>;

const FlagsEntry entries[] = {
    {"segment.signed-length-x", segment<signed_length_x<T>>},
    {"segment.dominant-axis", segment<dominant_axis<T>>},
    {"segment.projection", segment<segment_projection<T>>},
    {"triangle.signed-area", triangle<signed_area<T>>},
    {"triangle.relative-to-point", triangle<relative_to_point<T>>},
    {"triangle.beta-gamma", triangle<beta_gamma<T>>},
    {"triangle.alpha-beta", triangle<alpha_beta<T>>},
    {"triangle.unsigned-area", triangle<unsigned_area<T>>},
    {"triangle.bilinear", triangle<bilinear<T>>},
    {"triangle.homogeneous", triangle<homogeneous3<T>>},
    {"triangle.perspective-textbook", window<perspective_textbook<T>>},
    {"triangle.perspective-varying", window<perspective_varying<T>>},
    {"triangle3d.dominant-plane", triangle3d<dominant_plane<T>>},
    {"triangle3d.gram", triangle3d<gram<T>>},
    {"triangle3d.cross-product", triangle3d<cross_product<T>>},
    {"tetrahedron.signed-volume", tetrahedron<signed_volume<T>>},
    {"tetrahedron.two-cross-products", tetrahedron<two_cross_products<T>>},
    {"tetrahedron.unsigned-volume", tetrahedron<unsigned_volume<T>>},
    {"tetrahedron.cramer", tetrahedron<cramer<T>>},
    {"tetrahedron.one-minus-sum", tetrahedron<one_minus_sum<T>>},
    {"tetrahedron.homogeneous", tetrahedron<homogeneous4<T>>},
    {"tetrahedron.trilinear", tetrahedron<trilinear<T>>},
};

}  // namespace

extern "C" const FlagsEntry* flags_entries(int* count) {
    *count = static_cast<int>(sizeof(entries) / sizeof(entries[0]));
    return entries;
}
