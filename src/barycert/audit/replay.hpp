/// A witness asked again: the exact answer, and what each kernel says today.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "barycert/audit/comparison.hpp"
#include "barycert/audit/runner.hpp"
#include "barycert/exact/identities.hpp"
#include "barycert/exact/oracle.hpp"

namespace barycert::audit {

struct KernelAnswer {
    std::string kernel;
    int status = 0;  ///< 1: declared degenerate
    std::array<double, 4> weights{};
    Comparison comparison;
    double worst_weight_ulp = -1;
};

struct Replay {
    Witness witness;
    exact::Answer exact;
    int affine_dimension = 0;  ///< of the simplex

    /// Interpolation along auxiliary lines against ratios of areas or volumes, in rational numbers; `undefined` for
    /// segments and triangle3d.
    exact::Identity identity = exact::Identity::undefined;
    std::vector<KernelAnswer> answers;  ///< of the kernels on this simplex

    /// Why the witness no longer shows what it says of its kernel; empty if it does, or says nothing.
    std::string not_reproduced;
};

Replay replay(const Witness& witness, const std::vector<Kernel>& kernels);

}  // namespace barycert::audit
