/// Internal: the tiers that run on SIMD lanes, dispatched at run time to the widest instruction set at hand.
///
/// Each function works through cases in structure of arrays (layout of CaseArrays), writes what its error bound proves,
/// and lists the numbers of the cases it leaves undecided. Nothing is said of their output.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"

namespace barycert::lanes {

struct Cases {
    const double* vertices[12];
    const double* point[3];
    std::size_t count;  ///< any; below 2^32
};

/// Each returns how many are undecided, their numbers, ascending, in undecided[0 ...], which has room for `count`.

/// out[j] for case j.
std::size_t signs(Simplex s, const Cases& cases, WeightSigns* out, std::uint32_t* undecided);

/// out[n * j + i] for weight i of case j, n = vertex_count(s).
std::size_t weights(Simplex s, const Cases& cases, double* out, std::uint32_t* undecided);

/// values[n * c + i][j] is component c at vertex i of case j; out[components * j + c].
std::size_t values(Simplex s, const Cases& cases, const double* const* values, int components, double* out,
                   std::uint32_t* undecided);

/// As `values`, by the plain formula in double (D = sum of volumes, sum of volume times value, divided): nothing is
/// proved, everything decided. For Rounding::plain.
void plain_values(Simplex s, const Cases& cases, const double* const* values, int components, double* out);

/// a * b + c is rounded once in the lanes as they were compiled for this target.
bool contract();

}  // namespace barycert::lanes
