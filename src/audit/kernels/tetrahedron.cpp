// Kernels on a tetrahedron.
#include <cmath>
#include <span>

#include "audit/kernels/linear_formulas.hpp"
#include "audit/kernels/registry.hpp"
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/variants.hpp"
#include "audit/kernels/vectors.hpp"
#include "barycert/simplex.hpp"

namespace barycert::kernels {
namespace {

/// ab - cd with the rounding error of cd given back: at most 1.5 ulps (Jeannerod, Louvet, Muller 2013).
double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    const double error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

double kahan_volume(Vector3<double> q0, Vector3<double> q1, Vector3<double> q2, Vector3<double> q3) {
    const auto a = q1 - q0, b = q2 - q0, c = q3 - q0;
    return a.x * difference_of_products(b.y, c.z, b.z, c.y) + a.y * difference_of_products(b.z, c.x, b.x, c.z) +
           a.z * difference_of_products(b.x, c.y, b.y, c.x);
}

int kahan(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    return over(
        kahan_volume(a, b, c, d),
        {kahan_volume(q, b, c, d), kahan_volume(q, a, d, c), kahan_volume(q, a, b, d), kahan_volume(q, a, c, b)}, w);
}

constexpr const char* single_near_faces =
    "rounds coordinates to 24 bits first: points nearer to a face than 2^-24 of their coordinates change sides";

const Formula tetrahedron_kernels[] = {
    {"signed-volume", "W_a = V(p,b,c,d) / V(a,b,c,d) and cyclic, V(q0,q1,q2,q3) = det(q1-q0, q2-q0, q3-q0)",
     "volume coordinates, any finite element textbook",
     "differences and products are rounded: points on and near faces change sides; range is lost below 2^-358",
     signed_volume<double>, Declares::yes,
     More{&Variants::signed_volume, in_float<Simplex::tetrahedron, signed_volume<float>>, single_near_faces}},
    {"two-cross-products", "relative to p: a x b and c x d give the four determinants, divided by their sum",
     "ray-tetrahedron and interpolation loops tuned for speed",
     "their sum cancels for a point 2^20 cell sizes away: no digit of a weight is right, and the sum 1 hides it",
     two_cross_products<double>, Declares::yes, More{&Variants::two_cross_products}},
    {"unsigned-volume", "W_a = |V(p,b,c,d)| / sum of all four", "volume ratios, common lecture notes",
     "no weight is ever negative: every point outside looks like one inside", unsigned_volume<double>, Declares::no},
    {"cramer", "Cramer's rule for (a-d | b-d | c-d) (W_a,W_b,W_c) = p-d; W_d = V(p,a,b,c)/V(d,a,b,c) by its own",
     "Cramer 1750", "weights are relative to different origins: each sign errs on its own, and the sum need not be 1",
     cramer<double>, Declares::yes,
     More{&Variants::cramer, in_float<Simplex::tetrahedron, cramer<float>>, single_near_faces}},
    {"one-minus-sum", "Cramer's rule for W_a, W_b, W_c; W_d = 1 - W_a - W_b - W_c", "finite element codes",
     "W_d carries the rounding of the others: on face abc its sign is chance, and the sum 1 hides every error",
     one_minus_sum<double>, Declares::yes},
    {"homogeneous", "W_a = |1 p; 1 b; 1 c; 1 d| / |1 a; 1 b; 1 c; 1 d| and so on, 4x4 determinants",
     "homogeneous coordinates",
     "products of absolute coordinates cancel: at an offset of 2^17 cell sizes signs are chance", homogeneous4<double>,
     Declares::yes,
     More{nullptr, in_float<Simplex::tetrahedron, homogeneous4<float>>,
          "as homogeneous, already at an offset of 2^8 cell sizes"}},
    {"inverse", "(W_b, W_c, W_d) = (b-a | c-a | d-a)^-1 (p-a), W_a = 1-W_b-W_c-W_d", "Eigen Matrix3d::inverse()",
     "1/det is rounded before it is used and weights are differences of products: noise on every face",
     by_inverse<double, 3>, Declares::no,
     More{nullptr, in_float<Simplex::tetrahedron, by_inverse<float, 3>>, single_near_faces}},
    {"partial-lu", "(1 1 1 1; a b c d) W = (1; p)", "Eigen PartialPivLU",
     "backward stable only: on faces the zero weight comes out as rounding noise of either sign",
     by_decomposition<double, 3, Eigen::PartialPivLU>, Declares::no},
    {"full-lu", "(1 1 1 1; a b c d) W = (1; p)", "Eigen FullPivLU",
     "a pivot below 4 eps of the largest counts as zero: flat, tiny and huge cells get finite wrong weights in silence",
     by_decomposition<double, 3, Eigen::FullPivLU>, Declares::no},
    {"trilinear",
     "plane z = pz meets the edges, line y = py two sides of that section: weights on edges, sides, line in turn",
     "scan conversion, one dimension up",
     "0/0 where the section is a point or the line only touches it: highest and lowest vertices, some edges",
     trilinear<double>, Declares::no},
    {"kahan", "signed volumes with 2x2 minors by Kahan's ab-cd", "Jeannerod, Louvet & Muller 2013, Math. Comp. 82",
     "the minors are right to 1.5 ulps, the differences before and the sum after are not: fewer wrong signs, not none",
     kahan, Declares::yes},
    {"vtk-tolerance", "Cramer's rule for W_b, W_c, W_d with origin a, W_a = 1 - sum; inside if every W >= -0.001",
     "the lower bound of VTK's vtkTetra::EvaluatePosition, which also asks W <= 1.001",
     "points outside by up to a thousandth of a height are accepted as inside; only det == 0 is degenerate",
     parametric<double>, Declares::yes, More{.tolerance = 0.001}},
};

}  // namespace

constinit const std::span<const Formula> tetrahedron_formulas = tetrahedron_kernels;

}  // namespace barycert::kernels
