// Faults seeded into the catalogue's formulas.
#include <algorithm>
#include <utility>

#include "barycert/audit/mutants/mutants.hpp"
#include "barycert/kernels/perspective_formulas.hpp"
#include "barycert/kernels/space_formulas.hpp"
#include "barycert/kernels/tetrahedron_formulas.hpp"

namespace barycert::audit {
namespace {

using namespace kernels;

using Numbers = const double*;

/// A formula, and what is done to its weights.
struct FaultyFormula {
    const char *sound, *fault, *change;
    WeightsFunction formula;
    void (*spoil)(Numbers v, Numbers p, double* w) = nullptr;
};

void turn_all(double* w, int n) {
    for (int i = 0; i < n; ++i) w[i] = -w[i];
}

// Of signed areas and volumes.
constexpr FaultyFormula areas_and_volumes[] = {
    {"triangle.signed-area", "swapped-vertices", "the weights of b and c are exchanged", signed_area<double>,
     [](Numbers, Numbers, double* w) { std::swap(w[1], w[2]); }},
    // b - c where b - a belongs.
    {"triangle.signed-area", "wrong-origin", "one area relative to another vertex", signed_area<double>,
     [](Numbers v, Numbers p, double* w) {
         w[2] = cross(at2(v, 1) - at2(v, 2), at2(p, 0) - at2(v, 0)) / twice_area(v);
     }},
    {"triangle.signed-area", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     signed_area<double>,
     [](Numbers v, Numbers, double* w) {
         if (twice_area(v) < 0) turn_all(w, 3);
     }},
    {"triangle.signed-area", "absolute-guard", "adds 1e-50 to the divisor",
     [](Numbers v, Numbers p, double* w) { return areas_over(twice_area(v) + 1e-50, v, p, w), 0; }},
    {"triangle.signed-area", "absolute-tolerance", "degenerate below an area of 1e-12",
     [](Numbers v, Numbers p, double* w) { return magnitude(twice_area(v)) < 1e-12 ? 1 : signed_area(v, p, w); }},
    {"tetrahedron.signed-volume", "swapped-vertices", "the weights of a and d are exchanged", signed_volume<double>,
     [](Numbers, Numbers, double* w) { std::swap(w[0], w[3]); }},
    // The row (b, a, c) for (a, b, c): an odd permutation.
    {"tetrahedron.signed-volume", "odd-permutation", "one determinant with two rows exchanged", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[3] = -w[3]; }},
    {"tetrahedron.signed-volume", "wrong-index", "x of a vertex where its y belongs", signed_volume<double>,
     [](Numbers v, Numbers p, double* w) {
         double u[12], x[4];
         std::copy_n(v, 12, u);
         u[10] = v[9];
         if (signed_volume(u, p, x) == 0) w[0] = x[0];
     }},
    // A determinant without the last of the three products with its minors.
    {"tetrahedron.signed-volume", "dropped-term", "one product of a determinant is missing", signed_volume<double>,
     [](Numbers v, Numbers p, double* w) {
         const auto q = at3(p, 0), edge = at3(v, 1) - q, minor = cross(at3(v, 2) - q, at3(v, 3) - q);
         w[0] = (edge.x * minor.x + edge.y * minor.y) / volume(v);
     }},
    {"tetrahedron.signed-volume", "single-precision", "one weight goes through a float", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[2] = static_cast<double>(static_cast<float>(w[2])); }},
    {"tetrahedron.signed-volume", "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
     signed_volume<double>,
     [](Numbers v, Numbers, double* w) {
         if (volume(v) < 0) turn_all(w, 4);
     }},
    {"tetrahedron.signed-volume", "absolute-guard", "adds 1e-50 to the divisor",
     [](Numbers v, Numbers p, double* w) { return volumes_over(volume(v) + 1e-50, v, p, w), 0; }},
    {"tetrahedron.signed-volume", "absolute-tolerance", "degenerate below a volume of 1e-12",
     [](Numbers v, Numbers p, double* w) { return magnitude(volume(v)) < 1e-12 ? 1 : signed_volume(v, p, w); }},
    {"tetrahedron.signed-volume", "clamped", "negative weights become 0, the others are scaled", signed_volume<double>,
     [](Numbers, Numbers, double* w) {
         double sum = 0;
         for (int i = 0; i < 4; ++i) sum += w[i] = std::max(w[i], 0.0);
         for (int i = 0; i < 4; ++i) w[i] /= sum;
     }},
    {"tetrahedron.signed-volume", "forced-closure", "the last weight is 1 less the others", signed_volume<double>,
     [](Numbers, Numbers, double* w) { w[3] = 1 - w[0] - w[1] - w[2]; }},
    // Finite, plausible, wrong.
    {"tetrahedron.signed-volume", "even-weights", "a quarter each where the cell is degenerate",
     [](Numbers v, Numbers p, double* w) {
         if (signed_volume(v, p, w) != 0) std::fill_n(w, 4, 0.25);
         return 0;
     }},
};

// Of projections on segments and triangles in space, and of perspective.
constexpr FaultyFormula projections[] = {
    {"segment.dominant-axis", "wrong-comparison", "takes the axis on which the segment is shortest",
     [](Numbers v, Numbers p, double* w) {
         int axis = 0;
         for (int i = 1; i < 3; ++i) {
             if (magnitude(v[3 + i] - v[i]) < magnitude(v[3 + axis] - v[axis])) axis = i;
         }
         return signed_length(v, p, w, axis);
     }},
    {"segment.projection", "dropped-term", "the last product of a dot product is missing", segment_projection<double>,
     [](Numbers v, Numbers p, double* w) {
         const auto a = at3(v, 0), direction = at3(v, 1) - a, to_point = at3(p, 0) - a;
         w[1] = (to_point.x * direction.x + to_point.y * direction.y) / dot(direction, direction);
         w[0] = 1 - w[1];
     }},
    // The normal of the first two edges for that of the last two: turned round.
    {"triangle3d.cross-product", "odd-permutation", "one area turned round", cross_product<double>,
     [](Numbers, Numbers, double* w) { w[1] = -w[1]; }},
    {"triangle3d.gram", "dropped-term", "no product of the two edges",
     [](Numbers v, Numbers p, double* w) {
         const auto a = at3(v, 0), ab = at3(v, 1) - a, ac = at3(v, 2) - a, ap = at3(p, 0) - a;
         w[1] = dot(ap, ab) / dot(ab, ab);  // as if the edges were at right angles
         w[2] = dot(ap, ac) / dot(ac, ac);
         w[0] = 1 - w[1] - w[2];
         return 0;
     }},
    {"triangle.perspective-textbook", "dropped-depth", "the depth of c is left out",
     [](Numbers v, Numbers p, double* w) {
         return with_depths(v, p, {v[2], v[5], 1.0}, w);
     }},
    {"triangle.perspective-textbook", "swapped-vertices", "each depth is that of the next vertex",
     [](Numbers v, Numbers p, double* w) {
         return with_depths(v, p, {v[5], v[8], v[2]}, w);
     }},
};

template <const auto& table, std::size_t i>
int faulty(Numbers v, Numbers p, double* w) {
    const int status = table[i].formula(v, p, w);
    if (status == 0 && table[i].spoil != nullptr) table[i].spoil(v, p, w);
    return status;
}

template <const auto& table, std::size_t... i>
void add_faulty(std::vector<Mutant>& list, std::index_sequence<i...>) {
    (list.push_back(mutant_of(catalogued(table[i].sound), table[i].fault, table[i].change, faulty<table, i>)), ...);
}

Mutant with_tolerance(const Kernel& sound, const char* fault, const char* change, double tolerance) {
    Mutant m = mutant_of(sound, fault, change, sound.weights);
    m.kernel.tolerance = tolerance;
    return m;
}

}  // namespace

void add_plain_mutants(std::vector<Mutant>& list) {
    add_faulty<areas_and_volumes>(list, std::make_index_sequence<std::size(areas_and_volumes)>());
    const Kernel tolerant = catalogued("tetrahedron.vtk-tolerance");
    list.push_back(with_tolerance(tolerant, "tolerance-times-ten", "inside if every weight >= -0.01", 0.01));
    Kernel solver = tolerant;
    solver.name = "tetrahedron.tolerance-1e-10";
    solver.tolerance = 1e-10;
    list.push_back(with_tolerance(solver, "tolerance-times-ten", "inside if every weight >= -1e-9", 1e-9));
    add_faulty<projections>(list, std::make_index_sequence<std::size(projections)>());
}

}  // namespace barycert::audit
