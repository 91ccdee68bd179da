/// Cases that the killer checks, with exact answers, made once by `prepare` and stored as they lie in memory.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"

namespace barycert::mutants {

enum class Group : std::uint8_t { family, climbed, ties, near_ties, scaled, ends, quotients, environment };
inline constexpr const char* group_names[] = {"families", "climbed", "ties",      "near-ties",
                                              "scaled",   "ends",    "quotients", "environment"};
inline constexpr int group_count = 8;

struct Record {
    Case c;
    OracleAnswer answer;
    Group group = Group::family;
    std::int8_t orientation = 1;  ///< of the simplex, as WeightSigns has it
};
static_assert(std::is_trivially_copyable_v<Record>);

/// Input and answer of weights.hpp. kind 0: point_from_weights (12 coordinates, 4 weights); 1: point_of_value (a, b, 3
/// attribute values), whose answer has t as the fourth.
struct Inverse {
    int kind = 0;
    double in[16] = {};
    double out[4] = {};
};

/// Points and the signs of orient2d and orient3d; 2 for the one that is not meant.
struct Orientation {
    double p[12] = {};
    int flat = 0, solid = 0;
};

/// Adds cases in which a determinant in double is wrong by as much as climbing in this rounding mode can find.
enum class Quantity : std::uint8_t { numerator, denominator };
void climb(Simplex s, Quantity q, int mode, base::Random& random, std::vector<Record>& records);

/// Adds cases of which a weight or the value lies within 2^-30 to 2^-112 of a midpoint between doubles (relatively).
void add_near_ties(Simplex s, std::vector<Record>& records);

}  // namespace barycert::mutants
