/// The audit: runs kernels over families of cases and compares each answer with the oracle's.
///
/// Memory does not grow with the number of cases; the result, times aside, does not depend on the number of threads.
///
/// Example:
///
///     AuditOptions options{.kernels = kernels_matching("triangle.*"), .families = all_families(), .count = 1000};
///     const AuditReport report = run_audit(options, {}).value();
///     const KernelResult& worst = report.kernels.front();
///     const Witness* witness = worst_witness(worst);  // null: no finding
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"

namespace barycert {

/// Who says what is right.
enum class OracleChoice : std::uint8_t {
    /// The core where its error bounds decide, unless a kernel of the same cases computes with it; else the integers. A
    /// sample of what the core decided is put to the integers as well, and to CGAL a sample of all, and all that took
    /// integers wider than the machine's.
    automatic,
    integers,  ///< ask_oracle() alone
    cgal,      ///< ask_cgal() alone
    both,      ///< the integers, and CGAL besides, in every case
};

constexpr std::string_view name(OracleChoice o) {
    constexpr std::array<std::string_view, 4> names{"automatic", "integers", "cgal", "both"};
    return names[static_cast<std::size_t>(o)];
}

/// How many cases each oracle decided, and how many it confirmed. A disagreement is an error of run_audit().
struct OracleCounts {
    std::uint64_t core = 0, integers = 0, cgal = 0;
    std::uint64_t wide = 0;                          ///< of the integers: wider ones than the machine's
    std::uint64_t also_integers = 0, also_cgal = 0;  ///< confirmed by

    void add(const OracleCounts& other) {
        using O = OracleCounts;
        for (const auto count : {&O::core, &O::integers, &O::wide, &O::cgal, &O::also_integers, &O::also_cgal})
            this->*count += other.*count;
    }
    friend bool operator==(const OracleCounts&, const OracleCounts&) = default;
};

struct AuditProgress {
    std::uint64_t cases_done = 0, cases_total = 0;
    std::string family;
};

struct AuditOptions {
    std::vector<Kernel> kernels;
    std::vector<Family> families;
    std::uint64_t count = 10000;  ///< cases per family and simplex
    std::uint64_t seed = 1;
    int threads = 0;  ///< 0: one per core
    OracleChoice oracle = OracleChoice::automatic;
    OracleAnswer (*cgal)(const Case&) = ask_cgal;        ///< for tests: who is asked as CGAL
    std::function<void(const AuditProgress&)> progress;  ///< called from one thread at a time
};

/// One family's part of a kernel's result.
struct FamilyResult {
    std::size_t family = 0;  ///< index into AuditReport::families
    KernelStatistics statistics;
};

struct KernelResult {
    Kernel kernel;
    KernelStatistics total;  ///< over all families; case indices are valid in `families` only
    std::vector<FamilyResult> families;
    Prediction prediction;           ///< over all families
    double ns = 0;                   ///< time per evaluation, median over blocks, with the call through a pointer
    std::vector<Witness> witnesses;  ///< the worst of each reason, in the order of Finding, worst_weight_ulp last
};

/// Facts that each kind of run reports about itself.
struct AuditRun {
    Environment environment;
    std::uint64_t seed = 0, count = 0;
    int threads = 0;
    double seconds = 0;
};

struct AuditReport : AuditRun {
    std::vector<std::string> meshes;
    std::vector<Verdict> verdicts;    ///< one per mesh
    std::vector<CurvedCells> curved;  ///< likewise: their cells were taken with straight sides
    std::vector<Family> families;
    std::uint64_t cases = 0;  ///< asked of the oracle
    OracleChoice oracle = OracleChoice::automatic;
    OracleCounts oracles;                    ///< who decided these cases
    std::array<std::uint64_t, 4> regions{};  ///< number of cases per exact Region
    std::vector<KernelResult> kernels;       ///< worst first
};

/// Errors: a floating-point environment in which results cannot be exact; no kernel; no family that applies; two
/// oracles that disagree, with the case.
Result<AuditReport> run_audit(const AuditOptions& options, const MeshSource& meshes);

/// The witness of the kernel's worst class of finding; null if it has none.
const Witness* worst_witness(const KernelResult& result);

/// {"schema": 1, "witnesses": [...]} of all kernels of a report, one witness a line of finding.
std::string witnesses_json(const AuditReport& report);

}  // namespace barycert
