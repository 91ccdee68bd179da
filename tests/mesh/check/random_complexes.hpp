/// Small random meshes, good and bad ones, on a small lattice so that degeneracies abound.
#pragma once

#include "barycert/mesh.hpp"
#include "core/base/random.hpp"

namespace barycert::testing {

/// Cells of any nodes.
Mesh random_soup(int d, base::Random& random);

/// Random cells, each kept if the judge finds nothing against it; in half of the cases one more that was not asked.
Mesh grown_complex(int d, base::Random& random);

/// Some cells of a box, its nodes moved; then perhaps a node moved again, split in two, or two nodes made one.
Mesh damaged_box(int d, base::Random& random);

}  // namespace barycert::testing
