/// The cells in the order of space, by their names in mesh/index.
#pragma once

#include "mesh/index/cell_index.hpp"  // IWYU pragma: export

namespace barycert::locate {

using namespace index;

}  // namespace barycert::locate
