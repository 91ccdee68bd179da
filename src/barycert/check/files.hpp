/// Do the neighbours and faces that came with a mesh belong to its cells?
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/facets.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// P5: finds wrong_neighbour and wrong_face. Nothing where the mesh has none.
void check_files(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const Facets& facets, DefectList& defects);

}  // namespace barycert::check
