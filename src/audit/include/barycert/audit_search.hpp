/// Worst-case search: walks through the cases of one kernel, uphill towards its faults, and brings back the worst of
/// each kind and the plainest case that shows it.
///
/// Input: a kernel; families, from whose worst cases walks start. Each step makes one case, asks the oracle and
/// compares. Output: for each class of finding that was met, and for the errors, a witness as found and a plain one.
///
/// A walk starts from a family's worst, from the worst so far, or from a new pattern of exponents; its steps move
/// coordinates by ulps, redraw significands, shift exponents, and jump by a secant of the exact weights to where a
/// weight, or the whole determinant, is zero: beside these sets the condition number of a sign is unbounded. The idea
/// of a search led by condition numbers is that of ATOMU (Zou, Zeng, Xiong, Fu, Zhang, Su, POPL 2020).
///
/// The result depends on the kernel's answers, the options and nothing else, unless time or the user ends the search,
/// or the kernel is given up. The number of threads changes nothing. A kernel in a process of its own
/// (load_contained_kernel) may crash or hang: that is a finding, too, whose plainest case is the plainest that was met.
///
/// Example:
///
///     SearchOptions options{.kernel = kernels_matching("tetrahedron.*").front(), .steps = 10000};
///     const SearchReport report = search_worst_case(options).value();
///     const std::string witnesses = witnesses_json(report);
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

namespace barycert {

struct SearchProgress {
    std::uint64_t steps_done = 0, steps_total = 0;
    double worst_weight_ulp = -1;
    std::uint64_t wrong_cases = 0;  ///< with a finding
};

struct SearchOptions {
    Kernel kernel;                                  ///< asked on several threads at once
    std::vector<Family> families = all_families();  ///< those for other kernels or from meshes are passed over
    std::uint64_t family_count = 200;               ///< cases of each family to start with
    std::uint64_t steps = 1000000;                  ///< cases in all
    double seconds = 0;                             ///< ends the search early; 0: no limit
    std::uint64_t seed = 1;
    int threads = 0;                                      ///< 0: one per core
    int min_exponent = -1074;                             ///< of coordinates other than zero, as 2^e <= |x| < 2^(e+1)
    int max_exponent = 1023;                              ///< likewise; depths of perspective likewise
    std::function<bool(const SearchProgress&)> progress;  ///< called now and then; false ends the search
};

/// One kind of fault.
struct SearchFind {
    std::string reason;          ///< reason_name(), or "worst_relative_error"
    std::uint64_t cases = 0;     ///< that showed it; of errors: in which one could be measured
    Witness found;               ///< the worst
    double weight_ulp = -1;      ///< its largest error of a weight in ulps; -1 if undefined
    double relative_error = -1;  ///< its max |weight - exact weight| / max |exact weight|, likewise
    Witness plain;  ///< the same kind of fault on the plainest coordinates; of errors: at least 1/1024 of it
    double plain_weight_ulp = -1, plain_relative_error = -1;  ///< of `plain`
    int plain_bits = 0;                                       ///< significant bits of all its coordinates together
};

struct SearchReport : AuditRun {
    Kernel kernel;
    std::uint64_t steps_asked = 0, steps = 0, walks = 0;
    std::uint64_t plain_steps = 0;  ///< further cases, to make witnesses plain
    int min_exponent = 0, max_exponent = 0;
    bool stopped = false;  ///< by time or by the user: the same options may give another result
    /// The kernel, in a process of its own, failed to answer too often: the rest of the steps was not made, and what
    /// was found depends on threads and time.
    bool given_up = false;
    std::uint64_t wrong_cases = 0;
    std::vector<SearchFind> finds;  ///< in the order of Finding, then the errors
};

/// Errors: a floating-point environment in which results cannot be exact; no step; exponents out of range or order.
Result<SearchReport> search_worst_case(const SearchOptions& options);

/// Error: a rule that a search has no figure for. It has any, wrong_cases, the classes of finding, worst_weight_ulp and
/// worst_value_ulp.
Status check_search_rules(const std::vector<Threshold>& rules);

/// A kernel that gave no weights where there are some has an infinite error.
std::vector<Violation> violations(const SearchReport& report, const std::vector<Threshold>& rules);

/// The witness on plainer coordinates: fewer significant bits, smaller exponents, zeros and ones, as long as its reason
/// stays. A witness of an error keeps a 1024th of it at least. One that does not show its reason comes back as it is.
/// Its exponents stay within the bounds. `steps`, if given, is increased by the number of cases asked.
Witness plainest_witness(const Kernel& kernel, const Witness& witness, std::uint64_t* steps = nullptr,
                         int min_exponent = -1074, int max_exponent = 1023);

/// {"schema": 1, "witnesses": [...]} of the plain witnesses, for `barycert replay`.
std::string witnesses_json(const SearchReport& report);

}  // namespace barycert
