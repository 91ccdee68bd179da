/// The tiers that run on SIMD lanes, dispatched at run time to the widest instruction set at hand.
///
/// Each function works through cases in structure of arrays (layout of CaseArrays), writes what its error bound proves,
/// and lists the numbers of the cases it leaves undecided. Nothing is said of their output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

namespace barycert::core {

/// Cases in structure of arrays: coordinate k of vertex i of case j is vertices[d * i + k][j], that of its point is
/// point[k][j].
struct CaseBlock {
    const double* vertices[12];
    const double* point[3];  ///< null for cells without a point
    std::size_t count;       ///< any; below 2^32
};

/// Each returns how many cases are undecided, their numbers, ascending, in undecided[0 ...], which has room for
/// `count`.

/// out[j] for case j.
std::size_t sign_lanes(Simplex s, const CaseBlock& cases, WeightSigns* out, std::uint32_t* undecided);

/// out[n * j + i] for weight i of case j, n = vertex_count(s).
std::size_t weight_lanes(Simplex s, const CaseBlock& cases, double* out, std::uint32_t* undecided);

/// values[n * c + i][j] is component c at vertex i of case j; out[components * j + c]. With Rounding::plain by the
/// plain formula in double (D = sum of volumes, sum of volume times value, divided): nothing is proved, and undecided
/// is what has a value that is not finite.
std::size_t value_lanes(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* values,
                        int components, double* out, std::uint32_t* undecided);

/// Values as above; component k of the gradient of c goes to out[d * c + k][j]. Requires: triangle or tetrahedron;
/// every array has room for a multiple of 8 cases, or the count is 1.
std::size_t gradient_lanes(Simplex s, const CaseBlock& cells, const double* const* values, int components,
                           double* const* out, std::uint32_t* undecided);

/// values[m * c + i][j] is component c at node i of case j, m the nodes of a cell, mid-edge nodes behind corners; the
/// value of component c of case j goes to out[c][j]. Rounding as of values, preconditions as of gradients.
std::size_t quadratic_lanes(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* values,
                            int components, double* const* out, std::uint32_t* undecided);

/// The corners of each edge that a mid-edge node stands on, in the order of weights.hpp; the first three are those of
/// a triangle.
inline constexpr int quadratic_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/// The edge between corners i < j.
constexpr int quadratic_edge(int i, int j) {
    for (int e = 0; e < 6; ++e) {
        if (quadratic_edges[e][0] == i && quadratic_edges[e][1] == j) return e;
    }
    return -1;
}

/// Computes the values that plain lanes leave undecided: out[components * j + c] of the cases j in `undecided`, where
/// one of the `nodes` values of component c is not finite. Leaves out a node that has no part in the value; where such
/// a node has a part, the value is NaN.
void mend_plain_values(Simplex s, const CaseBlock& cases, std::span<const std::uint32_t> undecided,
                       const double* const* values, int nodes, int components, double* out);

// Perspective-correct interpolation at points of one triangle, `vertices` as perspective.hpp has them. Arrays of points
// and answers have room for a multiple of 8, or count is 1. Points and values that are not finite are undecided.

/// Three weights, one depth, or values.
enum class PerspectiveAnswer : std::uint8_t { weights, depth, values };

/// `points`: a block without vertices. out[i][j] is number i of the answer at point j. `values`, of
/// PerspectiveAnswer::values alone: values[components * i + c] is component c at vertex i.
std::size_t perspective_lanes(PerspectiveAnswer what, const double* vertices, const CaseBlock& points,
                              const double* values, int components, double* const* out, std::uint32_t* undecided);

/// a * b + c is rounded once in the lanes as they were compiled for this target.
bool lanes_contract();

}  // namespace barycert::core
