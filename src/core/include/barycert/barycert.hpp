/// The exact core of barycert: exact signs of barycentric weights, and correctly rounded weights, values and gradients,
/// at the speed of floating point where floating point suffices.
///
/// Input: vertices of segments, triangles (in the plane or in space) and tetrahedra, points and nodal values, as
/// doubles in any unit. Output: signs, weights, values, gradients, points. Errors are returned as Result or Status.
/// Nothing prints or exits. Two things throw: a failed allocation (std::bad_alloc), and Result::value() on an Error.
///
/// Laws, each a test of that name (tests/core). S1, S2: predicates.hpp. W1, W2, V1, V2, G1: weights.hpp; of
/// what is drawn in perspective also perspective.hpp.
///   D1  Results depend on the input bits alone: not on threads, SIMD target, compiler,
///       optimisation, or the order of cases.
///   D2  Results do not depend on the caller's floating-point environment: rounding mode, flush-to-zero,
///       denormals-are-zero. Every call sets what it needs and restores what was there       environment.hpp
///   Z   A weight, value, gradient, parameter or coordinate that is exactly zero is +0, whatever the signs of the zeros
///       it was computed from. One that is not zero but rounds to zero keeps its sign.           all headers
///   A degenerate simplex is reported, never weighed. NaN or infinity in checked input is an Error, never a sign.
///
/// Not promised:
///   - anything about numbers before they were rounded to these doubles;
///   - that rounded weights sum to 1, or give back their point: rounding each one is incompatible with both;
///   - a time. Measured (bench_extremes, NOTES.md): nanoseconds where the filter decides; up to about a microsecond
///     where integers must decide and numbers differ by at most 2^72 in magnitude. Beyond that it grows with the
///     spread: up to some ten microseconds for orientations and condition numbers, some tens for weights, values and
///     gradients, and a hundred for insphere, triangles in space and quadratic fields;
///   - which tier decides (TierCounts): it is the same on every machine, but may change with the version;
///   - checks of indices: indices in range are required;
///   - signs (predicates.hpp) while floating-point exceptions are trapped; exception flags are not preserved;
///   - a stack of less than 128 KiB below the call, as integers do not use the heap. Measured, optimised, on x86-64 (a
///     test): up to 107 KiB where numbers spread over all exponents, without optimisation up to 142 KiB.
///
/// How it works: filter-inl.hpp (signs), refinement-inl.hpp (weights and values) and exact_tier.hpp (what these leave
/// undecided) prove their bounds where they use them; NOTES.md has measurements, and what was tried.
///
/// Example:
///
///     const double tetrahedron[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, point[] = {0.25, 0.25, 0.25};
///     const double values[] = {1, 2, 3, 4};
///     const Region region = weight_signs(Simplex::tetrahedron, tetrahedron, point).region();          // interior
///     const double value = interpolate(Simplex::tetrahedron, tetrahedron, point, values).value().value;  // 2.5
#pragma once

#include "barycert/environment.hpp"  // IWYU pragma: export
#include "barycert/perspective.hpp"  // IWYU pragma: export
#include "barycert/predicates.hpp"   // IWYU pragma: export
#include "barycert/result.hpp"       // IWYU pragma: export
#include "barycert/simplex.hpp"      // IWYU pragma: export
#include "barycert/weights.hpp"      // IWYU pragma: export
