/// Two cells that meet where they must not, with a point to prove it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "barycert/mesh/mesh.hpp"

namespace barycert::check {

/// An exact point. `point` is it, rounded; where `exact` holds, the doubles themselves are a witness, and anybody can
/// check them with weight_signs. Else only `fraction` is: "numerator/denominator", each coordinate, in lowest terms but
/// for numbers of more than 4096 bits. Where such would be needed and `exact` holds, `fraction` is of the doubles.
struct Witness {
    std::array<double, 3> point{};
    bool exact = false;
    std::array<std::string, 3> fraction;
};

struct Contact {
    std::array<Mesh::Index, 2> cells{-1, -1};
    bool overlap = false;  ///< the interiors meet, and the witness lies in both; else the closed cells touch in it
    int dimension = 0;     ///< of what they have in common: 0 a point, 1 a segment, 2 an area, 3 a volume
    Witness witness;
};

}  // namespace barycert::check
