/// Baselines: an audit compared with an earlier one.
///
/// The same seed, count, families and meshes give the same cases, so that figures are compared exactly: one wrong case
/// more is one more. Audits of different cases are not compared.
///
/// Example:
///
///     const AuditOptions options{.kernels = kernels_matching("*"), .families = all_families()};
///     const Baseline before = read_baseline("before.json").value();
///     check_comparable(before, options, {}).value();
///     const BaselineComparison now = compare_with_baseline(run_audit(options, {}).value(), before).value();
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/family.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// The figures of one kernel in one family.
struct BaselineEntry {
    std::string kernel, family;
    std::uint64_t cases = 0;
    std::uint64_t not_run = 0;               ///< of the others: cases left out, as the kernel had been given up
    std::array<std::uint64_t, 4> regions{};  ///< cases by exact region: tells the same cases from others
    std::vector<double> figures;             ///< in the order of baseline_figures(); -1: none
};

struct Baseline {
    std::string path;
    std::uint64_t seed = 0, count = 0;
    std::vector<std::string> meshes;
    std::vector<BaselineEntry> entries;
};

/// The figures that are compared: wrong_cases, not_run, classes of finding, errors, residuals. Less is better of each.
const std::vector<std::string>& baseline_figures();

/// Reads what `barycert audit --json` wrote. Errors: the file cannot be read, is not JSON or of another schema, or a
/// member is missing or malformed.
Result<Baseline> read_baseline(const std::string& path);

/// An Error if an audit with these options would not meet the cases of the baseline.
Status check_comparable(const Baseline& baseline, const AuditOptions& options, const MeshSource& meshes);

struct BaselineChange {
    std::string kernel, family, figure;
    double before = 0, after = 0;
};

struct BaselineComparison {
    std::uint64_t compared = 0;  ///< pairs of kernel and family
    /// Pairs, among those compared, whose kernel was given up: in one audit, so that not_run alone is compared, or in
    /// both, so that nothing is.
    std::uint64_t given_up = 0;
    std::uint64_t not_now = 0;           ///< pairs of the baseline that this audit does not have
    std::uint64_t not_before = 0;        ///< pairs of this audit that the baseline does not have
    std::vector<BaselineChange> worse;   ///< in the order of the report
    std::vector<BaselineChange> better;  ///< likewise

    void add(BaselineChange change);  ///< to the one or the other, if it is one
};

/// Errors: other cases, told by their exact regions (a mesh has changed, or barycert's families); nothing in common.
Result<BaselineComparison> compare_with_baseline(const AuditReport& report, const Baseline& baseline);

}  // namespace barycert
