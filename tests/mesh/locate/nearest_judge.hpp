/// How far is a point from a mesh? In exact rational numbers, cell by cell: the slow twin of Locator::nearest.
#pragma once

#include <gmpxx.h>

#include <span>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::testing {

struct TrueNearest {
    mpq_class square;                ///< of the distance
    std::vector<Mesh::Index> cells;  ///< all cells that are so near, ascending; none: the mesh has no proper cell
};

/// The mesh must outlive it, and be consistent.
class NearestJudge {
public:
    explicit NearestJudge(const Mesh& mesh) : mesh_(mesh) {}

    TrueNearest nearest(const double* point) const;

    /// Squared distance to the closed cell's boundary (2D: to the closed cell).
    mpq_class to_cell(const double* point, Mesh::Index cell) const;

    /// Squared distance to the affine hull of 1 to 3 nodes. Requires: they span as much as they can.
    mpq_class to_hull(const double* point, std::span<const Mesh::Index> nodes) const;

    bool degenerate(Mesh::Index cell) const;

private:
    const Mesh& mesh_;
};

/// |computed - sqrt(square)| in units of the last place of sqrt(square) as a double, or of the smallest subnormal.
double ulps_from_root(double computed, const mpq_class& square);

}  // namespace barycert::testing
