// Kernels on segments and triangles in 3-space. On segments each formula of weights comes with two ways to a value,
// which differ in rounding.
#include <span>

#include "audit/kernels/registry.hpp"
#include "audit/kernels/space_formulas.hpp"
#include "barycert/simplex.hpp"

namespace barycert::kernels {
namespace {

/// t Va + (1-t) Vb with t = W_a.
double blend(const double* w, const double* f) {
    return w[0] * f[0] + (1 - w[0]) * f[1];
}

/// Va + (Vb - Va) W_b.
double increment(const double* w, const double* f) {
    return f[0] + (f[1] - f[0]) * w[1];
}

const Formula segment_kernels[] = {
    {"signed-length-x", "W_a = (xb-xp)/(xb-xa), W_b = (xp-xa)/(xb-xa); V = t Va + (1-t) Vb with t = W_a",
     "interpolation on a scanline, any graphics textbook",
     "declares a segment perpendicular to x degenerate although its ends differ; equal end values need not come back",
     signed_length_x<double>, Declares::yes, More{.sum = blend}},
    {"signed-length-x.increment", "W_b = (xp-xa)/(xb-xa); V = Va + (Vb-Va) W_b",
     "digital differential analysers; the usual lerp",
     "as signed-length-x for the weights; the value at b need not be Vb, for Va >> Vb it loses Vb altogether",
     signed_length_x<double>, Declares::yes, More{.sum = increment}},
    {"dominant-axis", "W_a = (kb-kp)/(kb-ka) on the axis k of greatest |b-a|; V = t Va + (1-t) Vb with t = W_a",
     "line rasterisation (Bresenham 1965, octants)",
     "a point off the line is projected along two axes instead of orthogonally; overflows where |b-a| does",
     dominant_axis<double>, Declares::yes, More{.sum = blend}},
    {"dominant-axis.increment", "W_b = (kp-ka)/(kb-ka) on the axis k of greatest |b-a|; V = Va + (Vb-Va) W_b",
     "line rasterisation (Bresenham 1965, octants)", "as dominant-axis for the weights; the value at b need not be Vb",
     dominant_axis<double>, Declares::yes, More{.sum = increment}},
    {"projection", "W_b = (p-a).(b-a) / (b-a).(b-a), W_a = 1 - W_b", "Ericson, Real-Time Collision Detection, 5.1.2",
     "squares leave the range: ends closer than 1e-162 are declared degenerate, further than 1.4e154 give 0 or NaN; "
     "a point whose foot is an end gets a sign by chance",
     segment_projection<double>, Declares::yes},
};

const Formula triangle3d_kernels[] = {
    {"dominant-plane", "drop the axis of greatest |n|, n = ab x ac; then signed areas in the plane",
     "Ericson, Real-Time Collision Detection, 3.4",
     "a point off the plane is projected along an axis instead of orthogonally; else as triangle.signed-area",
     dominant_plane<double>, Declares::yes},
    {"gram", "(ab.ab ab.ac; ab.ac ac.ac) (W_b, W_c) = (ap.ab, ap.ac) by Cramer's rule, W_a = 1-W_b-W_c",
     "Ericson, Real-Time Collision Detection, 3.4",
     "squares the condition: needles under 1e-8 in height over length lose every digit or divide by 0", gram<double>,
     Declares::no,
     More{nullptr, in_float<Simplex::triangle3d, gram<float>>,
          "as gram, from needles of 2e-4 in height over length on"}},
    {"cross-product", "W_a = n.(bc x bp) / n.n and cyclic, n = ab x ac",
     "Heidrich 2005, J. Graphics Tools 10(3), related form",
     "products of fourth degree: edges below 1e-81 are declared degenerate, on edges a wrong sign",
     cross_product<double>, Declares::yes},
};

}  // namespace

constinit const std::span<const Formula> segment_formulas = segment_kernels;
constinit const std::span<const Formula> triangle3d_formulas = triangle3d_kernels;

}  // namespace barycert::kernels
