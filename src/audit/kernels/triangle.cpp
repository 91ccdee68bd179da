// Kernels on a triangle of the plane, and perspective-correct ones on a triangle in window coordinates with a depth w
// at each vertex.

#include <algorithm>
#include <limits>
#include <span>

#include "audit/kernels/linear_formulas.hpp"
#include "audit/kernels/perspective_formulas.hpp"
#include "audit/kernels/registry.hpp"
#include "audit/kernels/variants.hpp"
#include "barycert/perspective.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

namespace barycert::kernels {
namespace {

constexpr const char* single_near_edges =
    "rounds coordinates to 24 bits first: points nearer to an edge than 2^-24 of their coordinates change sides";

const Formula triangle_kernels[] = {
    {"signed-area", "W_a = (bc x bp)/(ab x ac) and cyclic",
     "signed areas; Shirley & Marschner, Fundamentals of Computer Graphics",
     "products are rounded: points within a few ulps of an edge get a wrong sign or a false zero", signed_area<double>,
     Declares::yes, More{&Variants::signed_area, in_float<Simplex::triangle, signed_area<float>>, single_near_edges}},
    {"relative-to-point", "W_a = (pb x pc) / (pb x pc + pc x pa + pa x pb) and cyclic",
     "orientation tests with the query point as pivot; Kettner et al. 2008",
     "one sign in six to one in three is wrong on the grids of neighbouring doubles along a line",
     relative_to_point<double>, Declares::yes},
    {"beta-gamma",
     "beta = ((y-yA)(xC-xA)-(x-xA)(yC-yA)) / ((yB-yA)(xC-xA)-(xB-xA)(yC-yA)), gamma with B and C exchanged, alpha = "
     "1-beta-gamma",
     "perspective-correct rasterisation notes",
     "alpha carries the rounding of both others: on edge BC its sign is chance, the sum 1 hides it", beta_gamma<double>,
     Declares::no, More{nullptr, in_float<Simplex::triangle, beta_gamma<float>>, single_near_edges}},
    {"alpha-beta",
     "alpha = (-(x-xB)(yC-yB)+(y-yB)(xC-xB)) / (-(xA-xB)(yC-yB)+(yA-yB)(xC-xB)), beta cyclic, gamma = 1-alpha-beta",
     "Shirley & Marschner, Fundamentals of Computer Graphics",
     "gamma carries the rounding of both others: on edge AB its sign is chance; the two denominators may differ",
     alpha_beta<double>, Declares::no},
    {"unsigned-area", "W_a = |PBC| / (|PBC|+|PCA|+|PAB|) and cyclic", "area ratios, common lecture notes",
     "no weight is ever negative: every point outside looks like one inside", unsigned_area<double>, Declares::no},
    {"bilinear", "the line y = py meets two edges in l and r: weights on each edge, then p = (1-u) l + u r",
     "Gouraud 1971, scan conversion",
     "0/0 at the topmost and the lowest vertex, where l and r coincide; poor near them", bilinear<double>,
     Declares::no},
    {"scanline-increments",
     "from the lowest vertex by constant steps: x and W along two sides for each unit of y, then W for each unit of x; "
     "the last step a fraction",
     "scanline rasterisation; the notes' sixth section",
     "each step rounds: the error grows with the size in pixels; 0/0 at the topmost and the lowest vertex. More than "
     "2^14 steps are jumped",
     increments<double>, Declares::no,
     More{nullptr, in_float<Simplex::triangle, increments<float>>,
          "rounds coordinates to 24 bits first, and each step too: over 4096 pixels about 12 bits are left (barycert "
          "render drift)",
          incremented_value<double>, value_in_float<Simplex::triangle, incremented_value<float>>}},
    {"homogeneous", "W_a = |1 p; 1 b; 1 c| / |1 a; 1 b; 1 c| and cyclic, 3x3 determinants", "homogeneous coordinates",
     "products of absolute coordinates cancel: at an offset of 2^26 triangle sizes no digit is left",
     homogeneous3<double>, Declares::yes,
     More{nullptr, in_float<Simplex::triangle, homogeneous3<float>>,
          "as homogeneous, from offsets of a hundred triangle sizes on; no digit is left at 2^12"}},
    {"inverse", "(W_b, W_c) = (b-a | c-a)^-1 (p-a), W_a = 1-W_b-W_c", "Eigen Matrix2d::inverse()",
     "1/det is rounded before it is used and two weights are differences: zeros on edges turn into rounding noise",
     by_inverse<double, 2>, Declares::no},
    {"partial-lu", "(1 1 1; a b c) W = (1; p)", "Eigen PartialPivLU",
     "backward stable only: on edges the zero weight comes out as rounding noise of either sign",
     by_decomposition<double, 2, Eigen::PartialPivLU>, Declares::no},
    {"full-lu", "(1 1 1; a b c) W = (1; p)", "Eigen FullPivLU",
     "a pivot below 3 eps of the largest counts as zero: flat, tiny and huge triangles get finite wrong weights in "
     "silence",
     by_decomposition<double, 2, Eigen::FullPivLU>, Declares::no},
};

int exact_perspective(const double* vertices, const double* point, double* weights) {
    const Result<PerspectiveWeights> w = perspective_weights(vertices, point);
    if (!w || w->degenerate) return 1;
    std::ranges::copy(w->weights, weights);
    return 0;
}

double exact_perspective_value(const double* vertices, const double* point, const double* values) {
    const Result<Value> v = perspective_value(vertices, point, values);
    return v ? v->value : std::numeric_limits<double>::quiet_NaN();
}

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
     More{nullptr, in_float<Simplex::triangle, perspective_varying<float>, 3>, single_near_edges, varying_value<double>,
          value_in_float<Simplex::triangle, varying_value<float>, 3>}},
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

constinit const std::span<const Formula> triangle_formulas = triangle_kernels;
constinit const std::span<const Formula> perspective_formulas = perspective_kernels;

}  // namespace barycert::kernels
