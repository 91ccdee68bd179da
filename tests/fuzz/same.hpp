/// Compares what was read with what was read of what was written.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::fuzz {

enum class Payload { kept, lost };  ///< of NaNs: text has one NaN

bool same_numbers(const std::vector<double>& a, const std::vector<double>& b, Payload payload);

/// Requires: the caller has set what a format cannot keep to the same in both. Does not compare notes and cell numbers.
void expect_same(const Mesh& a, const Mesh& b, Payload payload = Payload::kept);

void expect_same(const std::vector<Column>& a, const std::vector<Column>& b);

/// The arrays of a mesh that a reader has made fit together: sizes, indices, coordinates.
void expect_whole(const Mesh& mesh);

}  // namespace barycert::fuzz
