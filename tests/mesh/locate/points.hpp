/// Points to ask a mesh about: where answers change, one ulp from there, and elsewhere.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/random.hpp"

namespace barycert::testing {

/// A few of each, d coordinates a point: nodes; points of edges, faces and cells, as double has them (with dyadic
/// coordinates exactly on them); coordinates of different nodes together; the box of the mesh, its corners and sides;
/// each of these also one ulp off along some axes; points around the box, and far away up to the largest doubles.
std::vector<double> awkward_points(const Mesh& mesh, std::size_t of_each, base::Random& random);

/// Points inside cells alone, anywhere in any cell.
std::vector<double> inner_points(const Mesh& mesh, std::size_t count, base::Random& random);

/// Every coordinate of a point moved by one ulp up, down or not at all.
void nudge(double* point, std::size_t d, base::Random& random);

/// In hexadecimal, for messages.
std::string text_of(const double* point, int d);

}  // namespace barycert::testing
