/// Meshes to check, and what can be done to a mesh without making it another one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/random.hpp"

namespace barycert::testing {

/// Unit cubes (2D: squares) in d! cells each, all positive; nodes at the lattice points from 0 on.
Mesh box(int d, std::array<int, 3> cubes);

/// A mesh of the folder data.
Mesh own_mesh(const std::string& stem);

/// Only the cells that have 1.
Mesh only(const Mesh& mesh, const std::vector<bool>& keep);

Mesh mapped(Mesh mesh, std::array<double, 3> factor, std::array<double, 3> shift);

/// Both, with nodes of their own.
Mesh joined(Mesh a, const Mesh& b);

/// The same nodes and cells in another order; corners of each cell turned evenly, so that its orientation stays.
Mesh renumbered(const Mesh& mesh, base::Random& random);

/// Every second cell or so with two corners exchanged. Returns how many.
std::size_t flip_some(Mesh& mesh, base::Random& random);

Mesh::Index add_node(Mesh& mesh, const std::vector<double>& at);
std::vector<double> node_at(const Mesh& mesh, Mesh::Index node);

/// Weighted mean of the corners of a cell. Exact if weights and coordinates are small dyadic numbers.
std::vector<double> in_cell(const Mesh& mesh, std::size_t cell, const std::vector<double>& weights);

/// The problems found, as a set; and in words.
DefectSet found(const CheckReport& report);
std::string words(DefectSet problems);

/// On one thread, and without witnesses unless asked for: so small meshes are quick.
CheckReport quick(const Mesh& mesh, std::size_t contacts = 0);

constexpr DefectSet set_of() {
    return 0;
}
template <class... P>
constexpr DefectSet set_of(DefectKind p, P... more) {
    return defect_bit(p) | set_of(more...);
}

}  // namespace barycert::testing
