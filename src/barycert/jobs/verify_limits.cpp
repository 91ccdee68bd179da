// Which wrong rows fail.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "barycert/base/named_limit.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/environment.hpp"
#include "barycert/jobs.hpp"

namespace barycert {
namespace {

constexpr std::array<RowVerdict, 4> kinds_of_wrong{RowVerdict::missed, RowVerdict::invented, RowVerdict::wrong_cell,
                                                   RowVerdict::wrong_value};

}  // namespace

std::vector<std::string> verify_limit_names() {
    std::vector<std::string> names;
    names.reserve(kinds_of_wrong.size());
    for (const RowVerdict v : kinds_of_wrong) names.emplace_back(handle(v));
    return names;
}

Result<VerifyLimit> parse_verify_limit(std::string_view text) {
    const ExactEnvironment environment;
    const base::NamedLimit limit = base::named_limit(text);
    const auto* const kind = std::find_if(kinds_of_wrong.begin(), kinds_of_wrong.end(),
                                          [&](RowVerdict v) { return handle(v) == limit.name; });
    if (kind == kinds_of_wrong.end() || !limit.most || std::floor(*limit.most) != *limit.most || *limit.most > 0x1p53)
        return Error{.what = "unknown rule",
                     .expected = "missed, invented, wrong_cell or wrong_value, perhaps >COUNT",
                     .found = '"' + std::string(text) + '"',
                     .remedy = base::did_you_mean(limit.name, verify_limit_names())};
    return VerifyLimit{*kind, static_cast<std::uint64_t>(*limit.most)};
}

std::vector<VerifyLimit> strict_limits() {
    std::vector<VerifyLimit> all;
    all.reserve(kinds_of_wrong.size());
    for (const RowVerdict v : kinds_of_wrong) all.push_back({v, 0});
    return all;
}

bool compared(const VerifyReport& summary, RowVerdict verdict) {
    if (verdict == RowVerdict::wrong_cell) return !summary.cell_column.empty();
    return verdict != RowVerdict::wrong_value || !summary.columns.empty();
}

Status check_limits(const VerifyReport& summary, const std::vector<VerifyLimit>& limits) {
    for (const VerifyLimit& limit : limits) {
        const bool cells = limit.verdict == RowVerdict::wrong_cell;
        if (!compared(summary, limit.verdict))
            return Error{.what = "a rule that nothing could break: " + std::string(handle(limit.verdict)),
                         .file = summary.results,
                         .expected = cells ? "a column that names cells" : "a column of values of a field",
                         .found = "none",
                         .remedy = cells ? "name it with job.cell_column, or leave the rule out"
                                         : "name it with job.values, or leave the rule out"};
    }
    return Done{};
}

std::vector<VerifyLimit> exceeded(const Verdicts& verdicts, const std::vector<VerifyLimit>& limits) {
    std::vector<VerifyLimit> all;
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(all),
                 [&](const VerifyLimit& l) { return verdicts.of(l.verdict) > l.most; });
    return all;
}

}  // namespace barycert
