/// One block of cases: make, ask, run each kernel against the clock, compare.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "audit/judge.hpp"
#include "barycert/audit.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"

namespace barycert::audit {

/// Long enough for the clock to tell, short enough to stay in the cache.
inline constexpr std::uint64_t block_size = 256;

/// Results of one thread on one kernel in one family.
struct BlockResult {
    KernelStatistics statistics;
    Prediction prediction;
    std::vector<float> ns;  ///< per evaluation, one a block, the first `kept_times` blocks
    static constexpr std::size_t kept_times = 1024;
};

/// The cases that all kernels of a job meet.
struct Job {
    const Family& family;
    Simplex simplex;
    std::uint64_t seed;
    const MeshSource& meshes;
    const std::vector<Kernel>& kernels;
    Judge judge;
};

/// Results of one thread in one job.
struct JobResult {
    explicit JobResult(std::size_t count) : kernels(count) {}

    std::vector<BlockResult> kernels;
    std::array<std::uint64_t, 4> regions{};  ///< cases by exact region
    OracleCounts oracles;
    std::optional<Disagreement> disagreement;  ///< the first of two oracles
};

/// Adds cases [first, last). After a disagreement the kernels are not asked. Requires: last - first <= block_size.
void run_block(const Job& job, std::uint64_t first, std::uint64_t last, JobResult& result);

}  // namespace barycert::audit
