// Kernels on a segment in 3-space. Each formula of weights comes with two ways to a value, which differ in rounding.
#include "barycert/kernels/registry.hpp"
#include "barycert/kernels/segment_formulas.hpp"

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

}  // namespace

void add_segment(std::vector<Kernel>& list) {
    const auto add = [&](const char* name, WeightsFunction weights, Text text, ValueFunction value) {
        list.push_back(make_kernel(Simplex::segment, name, weights, Declares::yes, text));
        list.back().value = value;
    };
    add("signed-length-x", signed_length_x<double>,
        {"W_a = (xb-xp)/(xb-xa), W_b = (xp-xa)/(xb-xa); V = t Va + (1-t) Vb with t = W_a",
         "interpolation on a scanline, any graphics textbook",
         "declares a segment perpendicular to x degenerate although its ends differ; equal end values need not come "
         "back"},
        blend);
    add("signed-length-x.increment", signed_length_x<double>,
        {"W_b = (xp-xa)/(xb-xa); V = Va + (Vb-Va) W_b", "digital differential analysers; the usual lerp",
         "as signed-length-x for the weights; the value at b need not be Vb, for Va >> Vb it loses Vb altogether"},
        increment);
    add("dominant-axis", dominant_axis<double>,
        {"W_a = (kb-kp)/(kb-ka) on the axis k of greatest |b-a|; V = t Va + (1-t) Vb with t = W_a",
         "line rasterisation (Bresenham 1965, octants)",
         "a point off the line is projected along two axes instead of orthogonally; overflows where |b-a| does"},
        blend);
    add("dominant-axis.increment", dominant_axis<double>,
        {"W_b = (kp-ka)/(kb-ka) on the axis k of greatest |b-a|; V = Va + (Vb-Va) W_b",
         "line rasterisation (Bresenham 1965, octants)",
         "as dominant-axis for the weights; the value at b need not be Vb"},
        increment);
    add("projection", segment_projection<double>,
        {"W_b = (p-a).(b-a) / (b-a).(b-a), W_a = 1 - W_b", "Ericson, Real-Time Collision Detection, 5.1.2",
         "squares leave the range: ends closer than 1e-162 are declared degenerate, further than 1.4e154 give 0 or "
         "NaN; "
         "a point whose foot is an end gets a sign by chance"},
        weighted_sum(Simplex::segment));
}

}  // namespace barycert::kernels
