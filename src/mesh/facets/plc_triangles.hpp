/// Triangles of PLCs.
#pragma once

#include <cstddef>
#include <vector>

#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "mesh/facets/facet_triangles.hpp"

namespace barycert::surface {

struct PlcTriangles {
    struct Fault {
        std::size_t facet;
        FacetFault fault;
    };
    Surface surface;  ///< of the facets without faults; points are those of the PLC
    std::vector<Fault> faults;
};

PlcTriangles triangles_of(const Plc& plc);

/// Adds the triangles of a facet.
void add_facet(Surface& surface, std::size_t facet, const FacetTriangles& cut);

/// When all facets are added. Surface::facets is left empty where each is one triangle.
void settle_facets(Surface& surface, std::size_t facets);

}  // namespace barycert::surface
