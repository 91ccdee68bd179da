/// Asks kernels for cases, whether they run in this process or in one of their own; compares what they say with the
/// oracle's answer; has the figures of many answers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/kernels/host.hpp"
#include "barycert/environment.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "core/base/workers.hpp"

namespace barycert::audit {

using base::names_of;
using kernels::Asked;
using kernels::Statement;

constexpr bool is_inside(Region r) {
    return r == Region::interior || r == Region::boundary;
}

/// Returns the error that `word` is none of these names.
inline Error unknown_name(ErrorCode code, std::string what, std::string expected, const std::string& word,
                          const std::vector<std::string>& names, std::string_view lists = {}) {
    return file_error(code, {}, std::move(what), std::move(expected), '"' + word + '"',
                      base::did_you_mean(word, names, lists));
}

/// Float32 and the like: names with a second dot.
inline bool is_variant(const Kernel& kernel) {
    return std::ranges::count(kernel.name, '.') > 1;
}

/// Asks for cases of the kernel's simplex, at most 256 of them, and sets as many statements. Runs in the exact
/// environment, whatever the kernel leaves behind. `timed`: a kernel in a process of its own runs once more against the
/// clock; others are timed in any case.
Asked ask_kernel(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> statements, bool timed);

/// Returns, in words, what the kernel does besides answering that case; empty if nothing, or if it runs in this process
/// and raised nothing. Asks a kernel that has been given up, too.
std::string incident_of(const Kernel& kernel, const Case& c);

/// Region and value from status and weights, by the functions of a kernel that runs in this process. Requires an
/// ExactEnvironment.
void complete(Statement& statement, const Kernel& kernel, const Case& c);

/// Requires an ExactEnvironment, as predicting_condition() does. There is no measure in ulps where the exact number is
/// zero (a wrong weight is then a false_nonzero), where either is not finite, or where the simplex is degenerate. An
/// exact weight beyond the largest double is measured from there. `claimed` is always what the kernel's weights say;
/// but a kernel whose weights are all correctly rounded has no finding, even where they under- or overflow and so no
/// longer tell the region.
Comparison compare(const Kernel& kernel, const Case& c, const OracleAnswer& answer, const Statement& statement);

/// kappa of the case's cell where there is something to predict: a triangle or tetrahedron, not degenerate, without
/// perspective, with the point in it or on its boundary, and no product of differences far out in the range of double.
/// NaN elsewhere. `region` is the exact one.
double predicting_condition(const Case& c, Region region);

/// Findings that leave no error to measure. (A kernel that touched memory beside its arrays may have died of it.)
inline constexpr std::array mute_findings{Finding::not_finite, Finding::false_declaration,
                                          Finding::crashed,    Finding::raised,
                                          Finding::hung,       Finding::out_of_bounds};

/// A figure of a kernel: of many answers.
struct Figure {
    std::string name;                                      ///< as in reports and rules
    std::function<double(const KernelStatistics&)> value;  ///< -1 where there is no error to measure
};

/// wrong_cases, not_run, each class of finding; errors in ulps, residuals. Less is better of each.
const std::vector<Figure>& figures();
inline constexpr std::size_t first_finding = 2, first_error = first_finding + finding_count,
                             first_residual = first_error + 4;

/// work(i) for each i below `n`, on so many threads, in the exact environment.
template <class Work>
void on_threads(int threads, std::size_t n, const Work& work) {
    base::share_work(threads, n, [&](std::size_t i) {
        const ExactEnvironment environment;
        work(i);
        return true;
    });
}

}  // namespace barycert::audit
