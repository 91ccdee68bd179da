/// TetGen behind one call. Only mesher.cpp sees TetGen's header.
///
/// TetGen prints to stdout, throws integers, calls exit() and may crash or never end: call make_mesh() in a child
/// process (child.hpp).
#pragma once

#include <string>
#include <string_view>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"

namespace barycert {

/// What TetGen throws, as an exception like any other.
struct TetgenFailure {
    int code;
};

/// The cells of the region that the facets enclose. `switches` are TetGen's, without a dash. The mesh has no cells if
/// TetGen carved everything away. Throws TetgenFailure, std::bad_alloc.
Mesh make_mesh(const Plc& plc, const std::string& switches);

/// What one of TetGen's error codes means, and what to do about it.
struct CodeMeaning {
    std::string_view what;
    std::string_view remedy;
};
CodeMeaning meaning_of(int code);

}  // namespace barycert
