/// A face of a cell, or a polygon in the plane, cut into triangles of its own nodes by a rule that depends on these
/// alone: on their numbers and places, not on the cell, nor on where the ring starts or which way it runs. So both
/// cells at a face cut it alike.
///
/// The rule. The ring is taken from its node of lowest number on, towards the neighbour of that with the lower number,
/// and projected along the axis on which its normal is longest. It is cut from its node of lowest number if all
/// triangles to the edges that do not have it turn one way, none of them flat; else from the next node for which that
/// holds; else corner by corner: an ear is a corner that is convex, and whose closed triangle holds no other node; that
/// of highest number goes first. Where the ring is no simple polygon in that projection, the next axis is asked. Signs
/// are exact; the normal is computed in double, in the order above, and so the same for both cells.
///
/// A face that is plane and convex, without flat corners, gets the triangles at its node of lowest number.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// Nodes of a mesh, their places, and the numbers by which they are ordered.
struct NumberedNodes {
    const double* points = nullptr;  ///< `dimension` coordinates a node
    int dimension = 3;
    std::span<const Mesh::Index> numbers = {};  ///< of each node, no two the same; empty: its index

    const double* at(Mesh::Index node) const { return points + dimension * static_cast<std::ptrdiff_t>(node); }
    Mesh::Index number(Mesh::Index node) const {
        return numbers.empty() ? node : numbers[static_cast<std::size_t>(node)];
    }
    bool lower(Mesh::Index a, Mesh::Index b) const { return number(a) < number(b); }
};

using NodeTriangle = std::array<Mesh::Index, 3>;

/// Appends the triangles of the ring, turned as it is. False, and nothing is appended, if it is no simple polygon in
/// any projection along an axis. Requires: three nodes or more, all different; finite coordinates.
bool cut_face(const NumberedNodes& nodes, std::span<const Mesh::Index> ring, std::vector<NodeTriangle>& triangles);

/// The rule cuts the ring from its node of lowest number. Same preconditions.
bool is_cut_from_lowest(const NumberedNodes& nodes, std::span<const Mesh::Index> ring);

/// All points lie on one line.
bool on_one_line(const NumberedNodes& nodes, std::span<const Mesh::Index> some);

/// The same in the plane or in space: on one line, or in one plane.
bool are_flat(const NumberedNodes& nodes, std::span<const Mesh::Index> some);

}  // namespace barycert::mesh
