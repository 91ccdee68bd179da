/// The audit: kernels x families x cases, each case asked of the oracle once.
///
/// Cases are made, asked and compared in blocks, on all threads. Memory does not grow with their number, and the
/// result (times aside) does not depend on the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "barycert/audit/families.hpp"
#include "barycert/audit/mesh_source.hpp"
#include "barycert/audit/prediction.hpp"
#include "barycert/audit/statistics.hpp"
#include "barycert/check/certificate.hpp"
#include "barycert/core/environment.hpp"
#include "barycert/core/result.hpp"
#include "barycert/kernels/kernel.hpp"

namespace barycert::audit {

struct Progress {
    std::uint64_t cases_done = 0;
    std::uint64_t cases_total = 0;
    std::string family;
};

struct Options {
    std::vector<Kernel> kernels;
    std::vector<Family> families;
    std::uint64_t count = 10000;  ///< cases per family and simplex
    std::uint64_t seed = 1;
    int threads = 0;                                ///< 0: as many as the machine has
    std::function<void(const Progress&)> progress;  ///< called now and then, from one thread at a time
};

/// One family's part of a kernel's result.
struct FamilyResult {
    std::size_t family = 0;  ///< index into Report::families
    Statistics statistics;
};

/// A case that shows a finding, and how to make it again.
struct Witness {
    std::string kernel;
    std::string reason;  ///< class of finding, or "worst_weight_ulp"
    std::string family;
    std::uint64_t seed = 0;
    std::uint64_t index = 0;
    double magnitude = 0;  ///< |weight - exact weight|, or ulps
    Case c;
};

struct KernelResult {
    Kernel kernel;
    Statistics total;  ///< indices in it are meaningless: ask the families
    std::vector<FamilyResult> families;
    Prediction prediction;           ///< over all families
    double ns = 0;                   ///< median over blocks of the time per evaluation, call through a pointer included
    std::vector<Witness> witnesses;  ///< the worst of each reason, in the order of Finding, worst_weight_ulp last
};

struct Report {
    Environment environment;
    std::uint64_t seed = 0;
    std::uint64_t count = 0;
    int threads = 0;
    std::vector<std::string> meshes;
    std::vector<check::Verdict>
        verdicts;  ///< one a mesh: whether it is certified to be a partition, or was not checked
    std::vector<Family> families;
    std::uint64_t cases = 0;                 ///< asked of the oracle
    std::array<std::uint64_t, 4> regions{};  ///< how many of them were what, exactly; by Region
    double seconds = 0;
    std::vector<KernelResult> kernels;  ///< worst first
};

/// Errors: an environment in which results could not be exact; nothing to audit (no kernel, no family that applies).
Result<Report> run(const Options& options, const MeshSource& meshes);

/// The most telling witness of a kernel, or null if it has none.
const Witness* worst_witness(const KernelResult& result);

}  // namespace barycert::audit
