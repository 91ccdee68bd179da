#include "mesh/facets/plc_triangles.hpp"

#include <algorithm>
#include <cstddef>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "mesh/facets/facet_triangles.hpp"

namespace barycert::surface {

void add_facet(Surface& surface, std::size_t facet, const FacetTriangles& cut) {
    for (const auto& t : cut.triangles) {
        surface.cells.insert(surface.cells.end(), t.begin(), t.end());
        surface.facets.push_back(static_cast<Mesh::Index>(facet));
    }
}

void settle_facets(Surface& surface, std::size_t facets) {
    surface.facet_count = facets;
    if (surface.facets.size() == facets && std::ranges::adjacent_find(surface.facets) == surface.facets.end())
        surface.facets.clear();
}

PlcTriangles triangles_of(const Plc& plc) {
    PlcTriangles all;
    all.surface.points = plc.points;
    all.surface.index_base = plc.index_base;
    all.surface.notes = plc.notes;
    for (std::size_t i = 0; i < plc.facets.size(); ++i) {
        const PlcFacet& facet = plc.facets[i];
        const FacetTriangles cut = triangles_of_facet(plc.points, facet.polygons, facet.holes);
        for (const FacetFault& fault : cut.faults) all.faults.push_back({i, fault});
        add_facet(all.surface, i, cut);
    }
    settle_facets(all.surface, plc.facets.size());
    return all;
}

}  // namespace barycert::surface
