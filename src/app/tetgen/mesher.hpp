/// TetGen behind one call. Only mesher.cpp sees TetGen's header.
///
/// TetGen prints, throws integers, calls exit(), may crash or never end: call make_mesh() in a child (child.hpp).
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"

namespace barycert {

/// The cells of the region that the facets enclose. `switches` are TetGen's, without a dash. The mesh has no cells if
/// TetGen carved everything away. Throws TetGen's error codes, which are integers, and std::bad_alloc.
Mesh make_mesh(const Plc& plc, std::string switches);

std::pair<std::string_view, std::string_view> meaning_of(int code);

}  // namespace barycert
