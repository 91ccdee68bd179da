/// One block of cases: make, ask, run each kernel against the clock, compare.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/audit_families.hpp"
#include "barycert/audit_findings.hpp"
#include "barycert/kernels.hpp"

namespace barycert::audit {

/// Long enough for the clock to tell, short enough to stay in the cache.
inline constexpr std::uint64_t block_size = 256;

/// What one thread has learnt of one kernel in one family.
struct BlockResult {
    KernelStatistics statistics;
    Prediction prediction;
    std::vector<float> ns;  ///< per evaluation, one a block, the first `kept_times` blocks
    static constexpr std::size_t kept_times = 1024;
};

/// Adds cases [first, last) to `results`, one entry a kernel. Precondition: last - first <= block_size.
void run_block(const Family& family, Simplex simplex, std::uint64_t seed, std::uint64_t first, std::uint64_t last,
               const MeshSource& meshes, const std::vector<Kernel>& kernels, std::vector<BlockResult>& results);

}  // namespace barycert::audit
