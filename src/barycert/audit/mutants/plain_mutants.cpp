// Faults seeded into the catalogue's formulas.
#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/audit/mutants/mutants.hpp"
#include "barycert/kernels/perspective_formulas.hpp"
#include "barycert/kernels/segment_formulas.hpp"
#include "barycert/kernels/tetrahedron_formulas.hpp"
#include "barycert/kernels/triangle3d_formulas.hpp"
#include "barycert/kernels/triangle_formulas.hpp"

namespace barycert::audit {
namespace {

using namespace kernels;

// Of signed areas and volumes.

int area_swapped(const double* v, const double* p, double* w) {
    const int status = signed_area(v, p, w);
    std::swap(w[1], w[2]);
    return status;
}

/// b - c where b - a belongs.
int area_wrong_origin(const double* v, const double* p, double* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    const double whole = cross(b - a, c - a);
    if (whole == 0) return 1;
    w[0] = cross(c - b, q - b) / whole;
    w[1] = cross(a - c, q - c) / whole;
    w[2] = cross(b - c, q - a) / whole;
    return 0;
}

int area_absolute(const double* v, const double* p, double* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    const double whole = magnitude(cross(b - a, c - a));
    if (whole == 0) return 1;
    w[0] = cross(c - b, q - b) / whole;
    w[1] = cross(a - c, q - c) / whole;
    w[2] = cross(b - a, q - a) / whole;
    return 0;
}

int area_flat_at_1e12(const double* v, const double* p, double* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2);
    return magnitude(cross(b - a, c - a)) < 1e-12 ? 1 : signed_area(v, p, w);
}

int area_guarded(const double* v, const double* p, double* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    const double whole = cross(b - a, c - a) + 1e-50;
    w[0] = cross(c - b, q - b) / whole;
    w[1] = cross(a - c, q - c) / whole;
    w[2] = cross(b - a, q - a) / whole;
    return 0;
}

int volume_swapped(const double* v, const double* p, double* w) {
    const int status = signed_volume(v, p, w);
    std::swap(w[0], w[3]);
    return status;
}

/// The row (b, a, c) for (a, b, c): an odd permutation.
int volume_odd(const double* v, const double* p, double* w) {
    const int status = signed_volume(v, p, w);
    w[3] = -w[3];
    return status;
}

/// x of one vertex where its y belongs.
int volume_wrong_index(const double* v, const double* p, double* w) {
    double u[12];
    std::copy_n(v, 12, u);
    u[10] = v[9];
    double x[4];
    const int status = signed_volume(v, p, w);
    if (status == 0 && signed_volume(u, p, x) == 0) w[0] = x[0];
    return status;
}

/// The last of the three products of a determinant.
int volume_dropped(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    const double whole = volume(a, b, c, d);
    if (whole == 0) return 1;
    const auto r = b - q, minor = cross(c - q, d - q);
    w[0] = (r.x * minor.x + r.y * minor.y) / whole;
    w[1] = volume(q, a, d, c) / whole;
    w[2] = volume(q, a, b, d) / whole;
    w[3] = volume(q, a, c, b) / whole;
    return 0;
}

/// One weight goes through a float.
int volume_single(const double* v, const double* p, double* w) {
    const int status = signed_volume(v, p, w);
    if (status == 0) w[2] = static_cast<double>(static_cast<float>(w[2]));
    return status;
}

int volume_absolute(const double* v, const double* p, double* w) {
    const int status = signed_volume(v, p, w);
    if (status == 0 && volume(at3(v, 0), at3(v, 1), at3(v, 2), at3(v, 3)) < 0) {
        for (int i = 0; i < 4; ++i) w[i] = -w[i];
    }
    return status;
}

int volume_guarded(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    const double whole = volume(a, b, c, d) + 1e-50;
    w[0] = volume(q, b, c, d) / whole;
    w[1] = volume(q, a, d, c) / whole;
    w[2] = volume(q, a, b, d) / whole;
    w[3] = volume(q, a, c, b) / whole;
    return 0;
}

int volume_flat_at_1e12(const double* v, const double* p, double* w) {
    return magnitude(volume(at3(v, 0), at3(v, 1), at3(v, 2), at3(v, 3))) < 1e-12 ? 1 : signed_volume(v, p, w);
}

int volume_clamped(const double* v, const double* p, double* w) {
    if (signed_volume(v, p, w) != 0) return 1;
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += w[i] = std::max(w[i], 0.0);
    for (int i = 0; i < 4; ++i) w[i] /= sum;
    return 0;
}

int volume_closed(const double* v, const double* p, double* w) {
    const int status = signed_volume(v, p, w);
    w[3] = 1 - w[0] - w[1] - w[2];
    return status;
}

/// A quarter each where the cell is degenerate: finite, plausible, wrong.
int volume_even(const double* v, const double* p, double* w) {
    if (signed_volume(v, p, w) != 0) w[0] = w[1] = w[2] = w[3] = 0.25;
    return 0;
}

// Of projections on segments and triangles in space.

int shortest_axis(const double* v, const double* p, double* w) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (magnitude(v[3 + i] - v[i]) < magnitude(v[3 + axis] - v[axis])) axis = i;
    }
    return signed_length(v, p, w, axis);
}

int projection_dropped(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), direction = at3(v, 1) - a, to_point = at3(p, 0) - a;
    const double whole = dot(direction, direction);
    if (whole == 0) return 1;
    w[1] = (to_point.x * direction.x + to_point.y * direction.y) / whole;
    w[0] = 1 - w[1];
    return 0;
}

/// The normal of the first two edges for that of the last two: turned round.
int cross_product_turned(const double* v, const double* p, double* w) {
    const int status = cross_product(v, p, w);
    w[1] = -w[1];
    return status;
}

int gram_dropped(const double* v, const double* p, double* w) {
    const auto a = at3(v, 0), ab = at3(v, 1) - a, ac = at3(v, 2) - a, ap = at3(p, 0) - a;
    const double bb = dot(ab, ab), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
    w[1] = pb / bb;  // as if the edges were at right angles
    w[2] = pc / cc;
    w[0] = 1 - w[1] - w[2];
    return 0;
}

// Of perspective.

int one_depth_forgotten(const double* v, const double* p, double* w) {
    return with_depths(v, p, {v[2], v[5], 1.0}, w);
}

int depths_shifted(const double* v, const double* p, double* w) {
    return with_depths(v, p, {v[5], v[8], v[2]}, w);
}

Mutant with_tolerance(const Kernel& sound, const char* fault, const char* change, double tolerance) {
    Mutant m = mutant_of(sound, fault, change, sound.weights);
    m.kernel.tolerance = tolerance;
    return m;
}

}  // namespace

void add_plain_mutants(std::vector<Mutant>& list) {
    const Kernel area = catalogued("triangle.signed-area"), volumes = catalogued("tetrahedron.signed-volume");
    list.push_back(mutant_of(area, "swapped-vertices", "the weights of b and c are exchanged", area_swapped));
    list.push_back(mutant_of(area, "wrong-origin", "one area relative to another vertex", area_wrong_origin));
    list.push_back(
        mutant_of(area, "unsigned-divisor", "divides by |whole|: right for cells of one orientation", area_absolute));
    list.push_back(mutant_of(area, "absolute-guard", "adds 1e-50 to the divisor", area_guarded));
    list.push_back(mutant_of(area, "absolute-tolerance", "degenerate below an area of 1e-12", area_flat_at_1e12));
    list.push_back(mutant_of(volumes, "swapped-vertices", "the weights of a and d are exchanged", volume_swapped));
    list.push_back(mutant_of(volumes, "odd-permutation", "one determinant with two rows exchanged", volume_odd));
    list.push_back(mutant_of(volumes, "wrong-index", "x of a vertex where its y belongs", volume_wrong_index));
    list.push_back(mutant_of(volumes, "dropped-term", "one product of a determinant is missing", volume_dropped));
    list.push_back(mutant_of(volumes, "single-precision", "one weight goes through a float", volume_single));
    list.push_back(mutant_of(volumes, "unsigned-divisor", "divides by |whole|: right for cells of one orientation",
                             volume_absolute));
    list.push_back(mutant_of(volumes, "absolute-guard", "adds 1e-50 to the divisor", volume_guarded));
    list.push_back(mutant_of(volumes, "absolute-tolerance", "degenerate below a volume of 1e-12", volume_flat_at_1e12));
    list.push_back(mutant_of(volumes, "clamped", "negative weights become 0, the others are scaled", volume_clamped));
    list.push_back(mutant_of(volumes, "forced-closure", "the last weight is 1 less the others", volume_closed));
    list.push_back(mutant_of(volumes, "even-weights", "a quarter each where the cell is degenerate", volume_even));
    const Kernel tolerant = catalogued("tetrahedron.vtk-tolerance");
    list.push_back(with_tolerance(tolerant, "tolerance-times-ten", "inside if every weight >= -0.01", 0.01));
    Kernel solver = tolerant;
    solver.name = "tetrahedron.tolerance-1e-10";
    solver.tolerance = 1e-10;
    list.push_back(with_tolerance(solver, "tolerance-times-ten", "inside if every weight >= -1e-9", 1e-9));
    const Kernel axis = catalogued("segment.dominant-axis"), onto = catalogued("segment.projection");
    list.push_back(
        mutant_of(axis, "wrong-comparison", "takes the axis on which the segment is shortest", shortest_axis));
    list.push_back(mutant_of(onto, "dropped-term", "the last product of a dot product is missing", projection_dropped));
    list.push_back(mutant_of(catalogued("triangle3d.cross-product"), "odd-permutation", "one area turned round",
                             cross_product_turned));
    list.push_back(
        mutant_of(catalogued("triangle3d.gram"), "dropped-term", "no product of the two edges", gram_dropped));
    const Kernel textbook = catalogued("triangle.perspective-textbook");
    list.push_back(mutant_of(textbook, "dropped-depth", "the depth of c is left out", one_depth_forgotten));
    list.push_back(mutant_of(textbook, "swapped-vertices", "each depth is that of the next vertex", depths_shifted));
}

}  // namespace barycert::audit
