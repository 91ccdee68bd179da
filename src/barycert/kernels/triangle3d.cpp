// Kernels on a triangle in 3-space.
#include "barycert/kernels/triangle3d_formulas.hpp"

#include "barycert/kernels/registry.hpp"

namespace barycert::kernels {

void add_triangle3d(std::vector<Kernel>& list) {
    constexpr Simplex s = Simplex::triangle3d;
    const auto add = [&](const char* name, WeightsFunction weights, Declares declares, Text text) {
        list.push_back(make_kernel(s, name, weights, declares, text));
    };
    add("dominant-plane", dominant_plane<double>, Declares::yes,
        {"drop the axis of greatest |n|, n = ab x ac; then signed areas in the plane",
         "Ericson, Real-Time Collision Detection, 3.4",
         "a point off the plane is projected along an axis instead of orthogonally; else as triangle.signed-area"});
    const Text normal{
        "(ab.ab ab.ac; ab.ac ac.ac) (W_b, W_c) = (ap.ab, ap.ac) by Cramer's rule, W_a = 1-W_b-W_c",
        "Ericson, Real-Time Collision Detection, 3.4",
        "squares the condition: needles under 1e-8 in height over length lose every digit or divide by 0"};
    add("gram", gram<double>, Declares::no, normal);
    add("gram.float32", in_float<s, gram<float>>, Declares::no,
        {normal.formula, normal.source, "as gram, from needles of 2e-4 in height over length on"});
    add("cross-product", cross_product<double>, Declares::yes,
        {"W_a = n.(bc x bp) / n.n and cyclic, n = ab x ac", "Heidrich 2005, J. Graphics Tools 10(3), related form",
         "products of fourth degree: edges below 1e-81 are declared degenerate, on edges a wrong sign"});
}

}  // namespace barycert::kernels
