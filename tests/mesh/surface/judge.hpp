/// Whether a cut is what it says, in GMP's rationals and by definitions alone; shares nothing with what made it.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"

namespace barycert::testing {

/// g at each node; nothing where it is not finite.
using Heights = std::vector<std::optional<mpq_class>>;

/// field - value.
Heights heights_of(const Mesh& mesh, const Field& field, double value, int component = 0);

/// offset - normal.x.
Heights heights_of(const Mesh& mesh, const Plane& plane);

/// Faults that the mesh may have.
struct Allowed {
    bool flat_cells = false;   ///< of zero volume: their triangles have no side
    bool any_complex = false;  ///< facets with more than two cells, or two on one side: nothing is said of K2
};

/// Holds the cut against laws K1 to K4, with failures of the test for what is wrong. `options` as given.
void expect_cut(const Mesh& mesh, const Heights& heights, const Cut& cut, const CutOptions& options = {},
                const Allowed& allowed = {});

/// The same bits throughout.
void expect_same(const Surface& a, const Surface& b);

}  // namespace barycert::testing
