/// Do two boundary facets meet where they must not? Exactly, by signs of orientations alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/mesh.hpp"

namespace barycert::index {

/// A facet by its nodes and their places: a triangle in 3-space that has an area, that is, at least one of its
/// projections along the axes has an area; or a segment in the plane that has a length.
struct PlacedFacet {
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};
    std::array<const double*, 3> at{};
};

/// True if the facet is not degenerate: a triangle with an area, a segment with a length.
bool proper(int d, const PlacedFacet& f);

/// True if the two closed facets have a point in common that is not in the face which they share by their nodes (which
/// may be empty, a node or an edge). Requires: both proper, not of the same nodes, coordinates finite.
bool facets_conflict(int d, const PlacedFacet& f, const PlacedFacet& g);

/// The same of a segment in space, the first two nodes of `segment`, and a triangle. Requires: they do not have
/// two nodes in common; the triangle is proper, coordinates finite.
bool segment_conflicts(const PlacedFacet& segment, const PlacedFacet& triangle);

/// Two facets by their numbers.
struct FacetPair {
    std::uint32_t first, second;
};

/// Takes out pairs of triangles without a conflict, as far as a plane tells: that of one triangle, or one through a
/// side of it, parallel to an axis. All corners of the other one but common ones are certainly beyond it, so that it
/// has nothing of both but the common face. On SIMD lanes, by determinants in double with their bounds. Requires:
/// the points are aligned as a NodeRecord's.
std::span<FacetPair> without_separated(std::span<const PlacedFacet> facets, std::span<FacetPair> pairs);

/// The nodes, ascending, of the face of f (all of it, an edge, a node) whose relative interior has the point; all -1
/// if the point is not on f. Requires: f is proper, coordinates finite.
std::array<Mesh::Index, 3> face_around(int d, const PlacedFacet& f, const double* point);

}  // namespace barycert::index
