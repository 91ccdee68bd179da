/// Are the answers right? Looked at before anything is timed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/sampler.hpp"
#include "sample_subject.hpp"

namespace barycert::bench {

/// Ends the program unless all this holds of the points of the subject, of which `rows` are the correct ones:
///   every owner holds its point, with that feature, by exact signs (weight_signs);
///   some owners, or that there is none, by asking all cells;
///   some values and features, by the oracle, which shares no code;
///   one thread, two threads, no certificate, evaluate() and fields together: the same bits;
///   plain: the same owners, values within 200 kappa 2^-53 of the largest nodal value. (Each of four weights is off by
///   at most 48 kappa u + u, weights.hpp, and kappa >= 3 pays for the rest.)
/// Prints what was looked at.
void verify_points(const Subject& subject, const Ours& ours, Table& rows);

/// Only that owners, features and values of these rows are right, by exact signs, core and oracle.
void verify_rows(const Subject& subject, const Table& rows);

/// Ends the program unless resample gives for the grid what sample does, bit for bit. `values`: those of the grid.
void verify_grid(const Subject& subject, const Ours& ours, std::vector<double>& values);

/// How somebody else's answers compare with rows that are known to be right.
struct Comparison {
    std::uint64_t missed = 0;         ///< inside, and not found
    std::uint64_t found_outside = 0;  ///< outside, and found
    std::uint64_t off = 0;            ///< values further than 1e-12 of the largest nodal value away
    double worst = 0;                 ///< largest difference of values, as a part of that
};
/// NaN: not found. Only where both have a value are values compared.
Comparison compare(const Subject& subject, std::span<const double> right, std::span<const double> theirs);

/// How many points are not in the closed cell of those four nodes, by exact signs. A cell of -1 is passed over.
std::uint64_t not_held(const Subject& subject, std::span<const std::array<Mesh::Index, 4>> cells);

/// The exact interpolation of the linear field in these cells, rounded correctly; NaN where the cell is -1.
std::vector<double> exact_values(const Subject& subject, std::span<const std::array<Mesh::Index, 4>> cells);

/// The corners of cells of the subject's mesh; -1 for -1.
std::vector<std::array<Mesh::Index, 4>> corners_of(const Subject& subject, std::span<const Mesh::Index> cells);

}  // namespace barycert::bench
