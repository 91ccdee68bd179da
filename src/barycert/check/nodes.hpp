/// What the nodes are by themselves.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// 1 for each node whose coordinates are all finite. Finds not_finite, coincident_nodes, unused_node.
std::vector<std::uint8_t> check_nodes(const Mesh& mesh, DefectList& defects);

}  // namespace barycert::check
