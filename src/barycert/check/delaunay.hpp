/// Is a mesh locally Delaunay?
#pragma once

#include <cstdint>

#include "barycert/mesh/mesh.hpp"

namespace barycert::check {

/// An interior facet is locally Delaunay if the apex of neither cell lies strictly inside the circumsphere of the other
/// (exact). A partition of a convex domain all of whose interior facets are so is a Delaunay triangulation (Delaunay's
/// lemma); with a boundary or facets to respect, a constrained one.
struct Delaunay {
    std::uint64_t facets = 0;       ///< interior facets tested: of two cells that are not degenerate
    std::uint64_t violations = 0;   ///< not locally Delaunay
    std::uint64_t cospherical = 0;  ///< the apex lies exactly on the sphere
    /// The worst: (R - distance of the apex from the centre) / R, in plain double; 0 if there is no violation.
    double worst_depth = 0;
    Mesh::Index worst_cell = -1;  ///< whose sphere it is
    Mesh::Index worst_node = -1;  ///< that lies inside
};

}  // namespace barycert::check
