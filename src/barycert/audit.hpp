/// The audit: runs kernels over families of cases and compares each answer with the oracle's.
///
/// Memory does not grow with the number of cases; the result, times aside, does not depend on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit_families.hpp"
#include "barycert/audit_findings.hpp"
#include "barycert/audit_witness.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// Who says what is right.
enum class OracleChoice : std::uint8_t {
    /// The integers; before them, where no kernel of the same cases computes with it, barycert's own core where its
    /// error bounds decide. A sample of what the core decided is put to the integers as well, and to CGAL a sample of
    /// all, and all that took integers wider than the machine's.
    automatic,
    integers,  ///< ask_oracle() alone
    cgal,      ///< ask_cgal() alone
    both,      ///< the integers, and CGAL besides, in every case
};

constexpr std::string_view name(OracleChoice o) {
    constexpr std::array<std::string_view, 4> names{"automatic", "integers", "cgal", "both"};
    return names[static_cast<std::size_t>(o)];
}

/// By whom cases were decided, and who was asked besides and said the same. A disagreement is an error of run_audit().
struct OracleCounts {
    std::uint64_t core = 0;           ///< cases decided by barycert's own core
    std::uint64_t integers = 0;       ///< by the integers
    std::uint64_t wide = 0;           ///< of these, with integers wider than the machine's
    std::uint64_t cgal = 0;           ///< by CGAL
    std::uint64_t also_integers = 0;  ///< cases decided by the core and confirmed by the integers
    std::uint64_t also_cgal = 0;      ///< cases decided by the core or the integers and confirmed by CGAL

    void add(const OracleCounts& other) {
        core += other.core;
        integers += other.integers;
        wide += other.wide;
        cgal += other.cgal;
        also_integers += other.also_integers;
        also_cgal += other.also_cgal;
    }
    friend bool operator==(const OracleCounts&, const OracleCounts&) = default;
};

struct AuditProgress {
    std::uint64_t cases_done = 0;
    std::uint64_t cases_total = 0;
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

struct AuditReport {
    Environment environment;
    std::uint64_t seed = 0;
    std::uint64_t count = 0;
    int threads = 0;
    std::vector<std::string> meshes;
    std::vector<Verdict> verdicts;    ///< one per mesh
    std::vector<CurvedCells> curved;  ///< likewise: their cells were taken with straight sides
    std::vector<Family> families;
    std::uint64_t cases = 0;  ///< asked of the oracle
    OracleChoice oracle = OracleChoice::automatic;
    OracleCounts oracles;                    ///< who decided these cases
    std::array<std::uint64_t, 4> regions{};  ///< number of cases per exact Region
    double seconds = 0;
    std::vector<KernelResult> kernels;  ///< worst first
};

/// Errors: a floating-point environment in which results cannot be exact; no kernel; no family that applies; two
/// oracles that disagree, with the case.
Result<AuditReport> run_audit(const AuditOptions& options, const MeshSource& meshes);

/// The witness of the kernel's worst class of finding; null if it has none.
const Witness* worst_witness(const KernelResult& result);

/// A kernel fails if its figure `name` exceeds `limit`.
struct Threshold {
    std::string name;
    double limit = 0;
};

/// A figure of a kernel that exceeds its threshold.
struct Violation {
    std::string kernel;
    std::string figure;
    double value = 0;
    double limit = 0;
};

/// NAME is a class of finding (counts), `wrong_cases` or `any` (cases with any finding), `worst_weight_ulp`,
/// `p999_weight_ulp`, `worst_value_ulp`, `p999_value_ulp`, `worst_partition_residual` or `worst_reproduction_residual`.
/// NUMBER defaults to 0. Error sizes are taken over the cases that have one; if there are none because weights were not
/// finite or the simplex was wrongly declared degenerate, they are infinite. Use them together with `any`.
Result<Threshold> parse_threshold(std::string_view text);

std::vector<Violation> violations(const AuditReport& report, const std::vector<Threshold>& rules);

/// The names that parse_threshold() accepts.
std::vector<std::string> threshold_names();

}  // namespace barycert
