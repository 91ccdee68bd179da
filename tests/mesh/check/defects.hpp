/// Defects to plant into a good mesh, each with what must be said of it.
#pragma once

#include <cstddef>
#include <vector>

#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {

/// A box of cubes within a larger mesh, where a defect is planted. Defects change it in place or add to the end of the
/// mesh, so that each may be planted beside others.
struct Site {
    Mesh& mesh;
    std::size_t first_node, nodes, first_cell, cells;
    double width;  ///< of the box along x

    std::size_t any_node(base::Random& random) const { return first_node + random.below(nodes); }
};

struct PlantedDefect {
    const char* name;
    DefectSet must;  ///< these are found
    DefectSet may;   ///< these may be found besides
    void (*plant)(const Site& site, base::Random& random);
    bool only_3d = false;
};

/// All that is told of it breaks nothing.
bool harmless(const PlantedDefect& defect);

extern const std::vector<PlantedDefect> defects;

/// Side of the cubes along each axis.
constexpr int site_side = 3;

/// A mesh of `sites` boxes, far from each other; with neighbours, and with a .face in 3D.
Mesh mesh_of_sites(int d, int sites);
Site site_of(Mesh& mesh, int sites, int index);

}  // namespace barycert::testing
