// Faults seeded into the catalogue's formulas.
#include <algorithm>
#include <span>
#include <utility>

#include "barycert/audit/mutants/mutants.hpp"
#include "barycert/kernels/perspective_formulas.hpp"
#include "barycert/kernels/space_formulas.hpp"
#include "barycert/kernels/tetrahedron_formulas.hpp"
#include "barycert/kernels/triangle_formulas.hpp"

namespace barycert::audit {
namespace {

using namespace kernels;

struct FaultyFormula {
    const char *sound, *fault, *change;
    WeightsFunction weights;
};

// Of signed areas and volumes.
constexpr FaultyFormula areas_and_volumes[] = {
    {"triangle.signed-area", "swapped-vertices", "the weights of b and c are exchanged",
     [](const double* v, const double* p, double* w) {
         const int status = signed_area(v, p, w);
         std::swap(w[1], w[2]);
         return status;
     }},
    // b - c where b - a belongs.
    {"triangle.signed-area", "wrong-origin", "one area relative to another vertex",
     [](const double* v, const double* p, double* w) {
         const int status = signed_area(v, p, w);
         if (status == 0) w[2] = cross(at2(v, 1) - at2(v, 2), at2(p, 0) - at2(v, 0)) / twice_area(v);
         return status;
     }},
    {"triangle.signed-area", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     [](const double* v, const double* p, double* w) {
         const int status = signed_area(v, p, w);
         if (status == 0 && twice_area(v) < 0) {
             for (int i = 0; i < 3; ++i) w[i] = -w[i];
         }
         return status;
     }},
    {"triangle.signed-area", "absolute-guard", "adds 1e-50 to the divisor",
     [](const double* v, const double* p, double* w) {
         areas_over(twice_area(v) + 1e-50, v, p, w);
         return 0;
     }},
    {"triangle.signed-area", "absolute-tolerance", "degenerate below an area of 1e-12",
     [](const double* v, const double* p, double* w) {
         return magnitude(twice_area(v)) < 1e-12 ? 1 : signed_area(v, p, w);
     }},
    {"tetrahedron.signed-volume", "swapped-vertices", "the weights of a and d are exchanged",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         std::swap(w[0], w[3]);
         return status;
     }},
    // The row (b, a, c) for (a, b, c): an odd permutation.
    {"tetrahedron.signed-volume", "odd-permutation", "one determinant with two rows exchanged",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         w[3] = -w[3];
         return status;
     }},
    // x of one vertex where its y belongs.
    {"tetrahedron.signed-volume", "wrong-index", "x of a vertex where its y belongs",
     [](const double* v, const double* p, double* w) {
         double u[12];
         std::copy_n(v, 12, u);
         u[10] = v[9];
         double x[4];
         const int status = signed_volume(v, p, w);
         if (status == 0 && signed_volume(u, p, x) == 0) w[0] = x[0];
         return status;
     }},
    // A determinant without the last of the three products with its minors.
    {"tetrahedron.signed-volume", "dropped-term", "one product of a determinant is missing",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         const auto q = at3(p, 0), edge = at3(v, 1) - q, minor = cross(at3(v, 2) - q, at3(v, 3) - q);
         if (status == 0) w[0] = (edge.x * minor.x + edge.y * minor.y) / volume(v);
         return status;
     }},
    // One weight goes through a float.
    {"tetrahedron.signed-volume", "single-precision", "one weight goes through a float",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         if (status == 0) w[2] = static_cast<double>(static_cast<float>(w[2]));
         return status;
     }},
    {"tetrahedron.signed-volume", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         if (status == 0 && volume(v) < 0) {
             for (int i = 0; i < 4; ++i) w[i] = -w[i];
         }
         return status;
     }},
    {"tetrahedron.signed-volume", "absolute-guard", "adds 1e-50 to the divisor",
     [](const double* v, const double* p, double* w) {
         volumes_over(volume(v) + 1e-50, v, p, w);
         return 0;
     }},
    {"tetrahedron.signed-volume", "absolute-tolerance", "degenerate below a volume of 1e-12",
     [](const double* v, const double* p, double* w) {
         return magnitude(volume(v)) < 1e-12 ? 1 : signed_volume(v, p, w);
     }},
    {"tetrahedron.signed-volume", "clamped", "negative weights become 0, the others are scaled",
     [](const double* v, const double* p, double* w) {
         if (signed_volume(v, p, w) != 0) return 1;
         double sum = 0;
         for (int i = 0; i < 4; ++i) sum += w[i] = std::max(w[i], 0.0);
         for (int i = 0; i < 4; ++i) w[i] /= sum;
         return 0;
     }},
    {"tetrahedron.signed-volume", "forced-closure", "the last weight is 1 less the others",
     [](const double* v, const double* p, double* w) {
         const int status = signed_volume(v, p, w);
         w[3] = 1 - w[0] - w[1] - w[2];
         return status;
     }},
    // A quarter each where the cell is degenerate: finite, plausible, wrong.
    {"tetrahedron.signed-volume", "even-weights", "a quarter each where the cell is degenerate",
     [](const double* v, const double* p, double* w) {
         if (signed_volume(v, p, w) != 0) w[0] = w[1] = w[2] = w[3] = 0.25;
         return 0;
     }},
};

// Of projections on segments and triangles in space, and of perspective.
constexpr FaultyFormula projections[] = {
    {"segment.dominant-axis", "wrong-comparison", "takes the axis on which the segment is shortest",
     [](const double* v, const double* p, double* w) {
         int axis = 0;
         for (int i = 1; i < 3; ++i) {
             if (magnitude(v[3 + i] - v[i]) < magnitude(v[3 + axis] - v[axis])) axis = i;
         }
         return signed_length(v, p, w, axis);
     }},
    {"segment.projection", "dropped-term", "the last product of a dot product is missing",
     [](const double* v, const double* p, double* w) {
         const auto a = at3(v, 0), direction = at3(v, 1) - a, to_point = at3(p, 0) - a;
         const double whole = dot(direction, direction);
         if (whole == 0) return 1;
         w[1] = (to_point.x * direction.x + to_point.y * direction.y) / whole;
         w[0] = 1 - w[1];
         return 0;
     }},
    // The normal of the first two edges for that of the last two: turned round.
    {"triangle3d.cross-product", "odd-permutation", "one area turned round",
     [](const double* v, const double* p, double* w) {
         const int status = cross_product(v, p, w);
         w[1] = -w[1];
         return status;
     }},
    {"triangle3d.gram", "dropped-term", "no product of the two edges",
     [](const double* v, const double* p, double* w) {
         const auto a = at3(v, 0), ab = at3(v, 1) - a, ac = at3(v, 2) - a, ap = at3(p, 0) - a;
         const double bb = dot(ab, ab), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
         w[1] = pb / bb;  // as if the edges were at right angles
         w[2] = pc / cc;
         w[0] = 1 - w[1] - w[2];
         return 0;
     }},
    {"triangle.perspective-textbook", "dropped-depth", "the depth of c is left out",
     [](const double* v, const double* p, double* w) {
         return with_depths(v, p, {v[2], v[5], 1.0}, w);
     }},
    {"triangle.perspective-textbook", "swapped-vertices", "each depth is that of the next vertex",
     [](const double* v, const double* p, double* w) {
         return with_depths(v, p, {v[5], v[8], v[2]}, w);
     }},
};

Mutant with_tolerance(const Kernel& sound, const char* fault, const char* change, double tolerance) {
    Mutant m = mutant_of(sound, fault, change, sound.weights);
    m.kernel.tolerance = tolerance;
    return m;
}

}  // namespace

void add_plain_mutants(std::vector<Mutant>& list) {
    const auto add = [&](std::span<const FaultyFormula> formulas) {
        for (const FaultyFormula& f : formulas)
            list.push_back(mutant_of(catalogued(f.sound), f.fault, f.change, f.weights));
    };
    add(areas_and_volumes);
    const Kernel tolerant = catalogued("tetrahedron.vtk-tolerance");
    list.push_back(with_tolerance(tolerant, "tolerance-times-ten", "inside if every weight >= -0.01", 0.01));
    Kernel solver = tolerant;
    solver.name = "tetrahedron.tolerance-1e-10";
    solver.tolerance = 1e-10;
    list.push_back(with_tolerance(solver, "tolerance-times-ten", "inside if every weight >= -1e-9", 1e-9));
    add(projections);
}

}  // namespace barycert::audit
