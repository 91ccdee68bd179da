// Perspective-correct kernels on a triangle in window coordinates with a depth w at each vertex.
#include "barycert/perspective.hpp"
#include "barycert/kernels/perspective_formulas.hpp"

#include <algorithm>
#include <limits>

#include "barycert/kernels/registry.hpp"

namespace barycert::kernels {
namespace {

int exact_perspective(const double* vertices, const double* point, double* weights) {
    const Result<PerspectiveWeights> w = perspective_weights(vertices, point);
    if (!w || w->degenerate) return 1;
    std::copy(w->weights.begin(), w->weights.end(), weights);
    return 0;
}

double exact_perspective_value(const double* vertices, const double* point, const double* values) {
    const Result<Value> v = perspective_value(vertices, point, values);
    return v ? v->value : std::numeric_limits<double>::quiet_NaN();
}

constexpr Simplex in_window = Simplex::triangle;

const Formula perspective_kernels[] = {
    {"perspective-textbook",
     "1/Z = alpha/Z_A + beta/Z_B + gamma/Z_C, I = Z (alpha I_A/Z_A + beta I_B/Z_B + gamma I_C/Z_C), Z the w of a "
     "vertex; alpha, beta, gamma as in triangle.beta-gamma",
     "perspective-correct rasterisation notes",
     "alpha carries the rounding of both others, and where B and C are far and A is near its error is what is left of "
     "the weights",
     perspective_textbook<double>, Declares::no, More{nullptr, nullptr, "", textbook_value<double>}},
    {"perspective-varying", "(sum alpha_i (I_i/w_i)) / (sum alpha_i (1/w_i)), alpha by signed areas",
     "varying variables of a pipeline: v/w and 1/w are linear in the window",
     "as triangle.signed-area: points within a few ulps of an edge get a wrong sign or a false zero",
     perspective_varying<double>, Declares::yes,
     More{nullptr, in_float<in_window, perspective_varying<float>, 3>,
          "rounds coordinates to 24 bits first: points nearer to an edge than 2^-24 of their coordinates change sides",
          varying_value<double>, value_in_float<in_window, varying_value<float>, 3>}},
    {"perspective-affine", "W_a = (bc x bp)/(ab x ac) and cyclic in the window, w left out",
     "texture mapping without division by w",
     "right where all w are equal: with w = 1 and 3 at the ends, the middle of an edge gets 1/2 in place of 3/4 and "
     "1/4",
     perspective_affine<double>, Declares::yes},
    {"perspective-projected-z",
     "as perspective-textbook with z = far/(far-near) - (near far/(far-near))/w in place of w, near 2^-10, far 2^10",
     "a common error: the z of the z-buffer taken for the depth",
     "z is all but 1 everywhere, so that the weights are all but those of perspective-affine",
     perspective_projected_z<double>, Declares::no},
    {"perspective-exact",
     "W_i = n_i w_j w_k / sum n_m w_k w_l, V = sum W_i f_i exactly, each rounded once, ties to even",
     "barycert/perspective.hpp: integers", "on no finite input with w > 0; costs more than a plain formula",
     exact_perspective, Declares::yes, More{.value = exact_perspective_value, .certifies = true}},
};

}  // namespace

constinit const std::span<const Formula> perspective_formulas = perspective_kernels;

}  // namespace barycert::kernels
