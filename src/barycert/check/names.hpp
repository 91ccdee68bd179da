/// What meets what, by its names in the room index.
#pragma once

#include "barycert/index/overlap.hpp"

namespace barycert::check {

using namespace index;

}  // namespace barycert::check
