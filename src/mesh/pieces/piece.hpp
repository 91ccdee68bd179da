/// A piece of a mesh as it lies in space, and what all pieces of the mesh are taken for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "mesh/cell_types.hpp"              // IWYU pragma: export: as well as their types
#include "mesh/facets/facet_triangles.hpp"  // IWYU pragma: export: bindings cut polygons
#include "mesh/index/box_tree.hpp"
#include "mesh/pieces/exchange.hpp"
#include "mesh/pulling.hpp"  // IWYU pragma: export: bindings tell which cells cannot be cut

namespace barycert::pieces {

using base::all_finite;
using base::held;
using index::Box;
using index::empty_box;

inline bool empty(const Box& box) {
    return !(box.low[0] <= box.high[0]);
}

/// At most `most` boxes, which together cover box_at(0), ..., box_at(count - 1); all of these lie in `around`. In
/// little memory, whatever their number: those whose middles lie near each other become one.
std::vector<Box> cover(const Box& around, std::size_t count, const std::function<Box(std::size_t)>& box_at,
                       std::size_t most);

/// Cells that fill space, or polygons in a plane across an axis; cut into simplices, unless they are such.
struct Piece {
    Mesh mesh;                         ///< of dimension 2 where triangles lie in a plane across an axis
    int normal = -1;                   ///< of the plane of polygons: axis 0, 1 or 2; -1: cells fill space
    double plane = 0;                  ///< its coordinate on that axis
    std::array<int, 3> axes{0, 1, 2};  ///< axis of space of each axis of the mesh

    /// The point on the axes of the mesh; false if it lies off the plane of the mesh.
    bool project(const double* x, double* point) const {
        for (std::size_t i = 0; i < 3; ++i) point[i] = x[axes[i]];
        return normal < 0 || x[normal] == plane;
    }
    /// The point in space of one on the axes of the mesh.
    void place(const double* point, double* x) const {
        x[axes[2]] = plane;
        for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) x[axes[a]] = point[a];
    }
    /// Cells as users know them: the whole one of a part, its nodes in VTK's order, and a box that it lies in.
    std::size_t whole_of(Mesh::Index cell) const;
    std::vector<Mesh::Index> nodes_of(std::size_t whole) const;
    Box box_of(std::size_t whole) const;

    /// Leaves two of three coordinates of polygons in one plane: across the axis `of`, or any if it is -1. False if
    /// they do not lie in such a plane.
    bool flatten(int of);
    /// Makes cells of the mesh's shapes (mesh/pulling.hpp), by these numbers of nodes; empty: as they come.
    std::optional<std::size_t> cut(const std::vector<std::int64_t>& numbers);
};

struct Closest {
    Mesh::Index cell = -1;  ///< the lowest of those that are as near; -1: none within the limit
    double distance = 0;
    bool inside = false;  ///< the point lies in the cell
    std::array<double, 3> point{};
    std::array<double, 4> weights{};  ///< of the nearest point in a straight cell, in the order of its vertices
};

/// How to take a data set that is a piece of a mesh: the pieces of one mesh are taken alike.
struct Shape {
    int dimension = 0;              ///< of the cells that count; 0: the highest of its own
    int normal = -1;                ///< polygons: the axis across which their plane lies; -1: any
    bool mixed = false;             ///< cells are of several types, or of one that is no simplex of order 1 or 2
    bool by_numbers = false;        ///< the mesh's cells are in the order of their numbers in the whole mesh
    bool nodes_by_numbers = false;  ///< cells are cut by the numbers of nodes in the whole mesh
    CellInterpolation interpolation = CellInterpolation::linear;
    Curved curved = Curved::isoparametric;

    friend bool operator==(const Shape&, const Shape&) = default;
};

/// Stays where it is, for the locator refers to its mesh.
struct IndexedPiece : Piece {
    std::optional<Locator> locator;
    double some_cells = 0;  ///< some cell sizes: the cell of a point so near is worth a look

    /// Makes the locator. Requires cells. Error: they are curved, and such cells are refused.
    Status build(const Shape& shape);
    /// Whether all cells are the simplices of their corners, with linear functions.
    bool straight() const { return !mapped() && mesh.mid_nodes.empty(); }
    bool straight(Mesh::Index cell) const;

    Simplex simplex() const { return mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron; }
    /// The owner of a point in space; -1: outside, or a coordinate is not finite.
    Mesh::Index owner(const double* x) const;
    /// Correctly rounded weights, in a straight cell that is not degenerate, of a finite point on the axes of the mesh.
    std::array<double, 4> weights(Mesh::Index cell, const double* point) const;
    /// The point of the cells that is nearest to one in space; none if a coordinate is not finite.
    Closest closest(const double* x, double limit) const;

private:
    bool mapped() const {
        return locator && (locator->has_curved_cells() || locator->interpolation() != CellInterpolation::linear);
    }
};

/// Fault of a data set that has such cells alone.
inline constexpr const char* only_lower = "it has no cells but points and lines";

/// Facts that a rank knows before its piece is read.
struct PieceFacts {
    int dimension = -1;        ///< the highest of its cells; -1: it has none
    bool numbered = false;     ///< its cells have numbers in the whole mesh
    Box polygons = empty_box;  ///< of their nodes
    int low_type = 255;        ///< of its cells of that dimension, by VTK's numbers
    int high_type = 0;
    bool nodes_numbered = true;  ///< no cell is cut, or its nodes have numbers in the whole mesh

    /// Whether types in that range are several, or one that is no simplex of order 1 or 2.
    static bool mixed(int low, int high) {
        return low < high || (low == high && low != 5 && low != 10 && low != 22 && low != 24);
    }
};

/// Returns what all pieces are taken for. The dimension is the highest that any piece has. Requires: every rank calls
/// it. Error: there are only points and lines, or polygons that do not lie in one plane across an axis.
Result<Shape> agree_on_shape(Exchange& exchange, const PieceFacts& mine);

}  // namespace barycert::pieces
