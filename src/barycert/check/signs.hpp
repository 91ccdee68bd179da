/// Internal: signs as numbers, to be multiplied.
#pragma once

#include "barycert/predicates.hpp"

namespace barycert::check {

/// Precondition: not an Error, for the coordinates are finite.
inline int sign(const Result<Sign>& s) {
    return static_cast<int>(*s);
}

}  // namespace barycert::check
