/// Values of fields that are NaN or infinite.
///
/// Example:
///
///     #include <cmath>
///     Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     mesh.point_fields = {{"T", 1, {20, NAN, 22}}};
///     const std::uint64_t missing = not_finite_values(mesh).front().count;  // 1
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert {

/// A field with values that are NaN or infinite.
struct NotFinite {
    std::string field;
    bool of_cells = false;
    std::uint64_t count = 0;   ///< of such numbers
    std::uint64_t values = 0;  ///< in all; each component is one
};

/// Adds the field to `to` if it has such values, and is not there yet.
void count_not_finite(const Field& field, bool of_cells, std::vector<NotFinite>& to);

/// The fields of nodes that have such values, then those of cells.
std::vector<NotFinite> not_finite_values(const Mesh& mesh);

}  // namespace barycert
