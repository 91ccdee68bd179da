/// Tetrahedra that fill a closed surface without new nodes, searched one after the other.
///
/// A front is what bounds the part that is not filled yet; at first it is the surface. At the triangle of it that has
/// fewest nodes to go with, a tetrahedron is tried: with the node that closes most of the front, then with that of
/// lowest number. It must lie on the inner side, strictly; hold no other node; and its interior must meet neither the
/// surface nor the tetrahedra before it. When the front is empty, the tetrahedra fill what the surface encloses: of the
/// same sign, with disjoint interiors, and with the surface as the boundary of their sum. Where no node is left for a
/// triangle, the last choice is taken back. There are surfaces that cannot be filled so (Schoenhardt's prism), and to
/// tell is hard (Ruppert and Seidel 1992): the search ends after a fixed amount of work.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/face_cut.hpp"

namespace barycert::mesh {

/// The tetrahedra, each turned as the cells of cut_solid; none if none are found. `own`: all nodes of the surface,
/// ascending by their numbers; `surface`: triangles turned alike, each edge passed as often one way as the other.
/// Depends on these sets alone, not on the order of the triangles.
std::vector<std::array<Mesh::Index, 4>> find_tetrahedra(const NumberedNodes& nodes, std::span<const Mesh::Index> own,
                                                        std::span<const NodeTriangle> surface);

}  // namespace barycert::mesh
