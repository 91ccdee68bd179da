/// A piece of a mesh with its locator: owners, weights and nearest points in space.
#pragma once

#include <array>
#include <optional>

#include "barycert/locator.hpp"
#include "barycert/pieces/piece.hpp"
#include "barycert/simplex.hpp"

namespace barycert::pieces {

struct Closest {
    Mesh::Index cell = -1;  ///< the lowest of those that are as near; -1: none within the limit
    double distance = 0;
    bool inside = false;  ///< the point lies in the cell
    std::array<double, 3> point{};
    std::array<double, 4> weights{};  ///< of the nearest point in the cell, in the order of its vertices
};

/// Stays where it is, for the locator refers to its mesh.
struct IndexedPiece : Piece {
    std::optional<Locator> locator;
    double some_cells = 0;  ///< some cell sizes: the cell of a point so near is worth a look

    /// Makes the locator. Requires cells.
    Status build();

    Simplex simplex() const { return mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron; }
    /// The owner of a point in space; -1: outside, or a coordinate is not finite.
    Mesh::Index owner(const double* x) const;
    /// Correctly rounded weights, in a cell that is not degenerate, of a point on the axes of the mesh. Requires finite
    /// coordinates.
    std::array<double, 4> weights(Mesh::Index cell, const double* point) const;
    /// The point of the cells that is nearest to one in space; none if a coordinate is not finite.
    Closest closest(const double* x, double limit) const;
};

}  // namespace barycert::pieces
