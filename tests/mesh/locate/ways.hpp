/// Every way of asking a Locator must give what the judge says.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/random.hpp"
#include "tests/mesh/locate/judge.hpp"

namespace barycert::testing {

struct Ways {
    bool targets = true;  ///< every SIMD target, not the one in use alone
    bool threads = true;  ///< 1, 2 and 8 threads, not 1 alone
    bool single = true;   ///< one point at a time, with hints
    std::size_t max = 3;  ///< failures told
};

/// Batch, single and locate_all, with the certificate of check_mesh and without, against the judge; counts too. Returns
/// whether the mesh was certified.
bool expect_right(const Mesh& mesh, const std::vector<double>& points, base::Random& random, const std::string& what,
                  const Ways& ways = {});

}  // namespace barycert::testing
