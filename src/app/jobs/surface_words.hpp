/// Words of jobs about a surface: where in its polygons points lie, and what is inside.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert::jobs {

/// Edges between triangles of one polygon or facet: a polygon is cut there, and has none.
class InnerEdges {
public:
    explicit InnerEdges(const Surface& surface);

    /// Where in its polygon, or triangle if it is none, the nearest point lies.
    Feature feature(const SurfaceNearest& nearest) const;

private:
    using Edge = std::array<Mesh::Index, 3>;  ///< polygon and nodes, the lower one first
    const Surface& surface_;
    std::vector<Edge> edges_;  ///< ascending
};

/// Notes, once for a run, by which rule points are inside, unless it is that of winding numbers; or why none is.
void note_sides(const SideRules& sides, const Surface& surface, const std::string& path, Notes& notes);

}  // namespace barycert::jobs
