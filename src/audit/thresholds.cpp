#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/audit.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/result.hpp"
#include "barycert/statistics.hpp"
#include "barycert/threshold.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace audit;

namespace {

/// The figure that a rule of this name is about: any figure but not_run.
std::optional<std::size_t> figure_named(std::string_view name) {
    if (name == "any") name = figures().front().name;
    const auto f = static_cast<std::size_t>(std::ranges::find(figures(), name, &Figure::name) - figures().begin());
    return f == 0 || (f >= first_finding && f < figures().size()) ? std::optional(f) : std::nullopt;
}

double as_rules_have_it(std::size_t figure, const KernelStatistics& s) {
    const auto seen = [&](Finding x) { return s.counts[static_cast<std::size_t>(x)] != 0; };
    const double value = figures()[figure].value(s);
    // A kernel that was given up before it was wrong, for want of a process, has not passed. One that gives no finite
    // weight where there is one to give has no error to measure: it is worse than any.
    const bool mute = figure == 0 ? value == 0 && s.not_run != 0
                                  : value < 0 && (std::ranges::any_of(mute_findings, seen) || s.not_run != 0);
    return mute ? std::numeric_limits<double>::infinity() : value;
}

}  // namespace

const std::vector<Figure>& audit::figures() {
    using S = KernelStatistics;
    static const std::vector<Figure> all = [] {
        std::vector<Figure> f{{"wrong_cases", [](const S& s) { return static_cast<double>(s.wrong_cases); }},
                              {"not_run", [](const S& s) { return static_cast<double>(s.not_run); }}};
        for (std::size_t i = 0; i < finding_count; ++i)
            f.push_back(
                {std::string(finding_texts[i].name), [i](const S& s) { return static_cast<double>(s.counts[i]); }});
        f.insert(f.end(), {{"worst_weight_ulp", [](const S& s) { return s.weight_ulp.value; }},
                           {"p999_weight_ulp", [](const S& s) { return s.p999_weight_ulp(); }},
                           {"worst_value_ulp", [](const S& s) { return s.value_ulp.value; }},
                           {"p999_value_ulp", [](const S& s) { return s.p999_value_ulp(); }},
                           {"worst_partition_residual", [](const S& s) { return s.partition_residual.value; }},
                           {"worst_reproduction_residual", [](const S& s) { return s.reproduction_residual.value; }}});
        return f;
    }();
    return all;
}

Result<Threshold> parse_threshold(std::string_view text) {
    const ExactEnvironment environment;
    const base::NamedLimit limit = base::named_limit(text);
    if (!figure_named(limit.name))
        return file_error(
            "rule.unknown", {}, "unknown rule",
            "NAME or NAME>NUMBER with NAME one of " + base::joined(threshold_names(), ", ", std::identity()),
            '"' + std::string(text) + '"', base::did_you_mean(limit.name, threshold_names()));
    if (!limit.most)
        return file_error("option.value", {}, "bad limit in a rule", "a number >= 0 after >",
                          '"' + std::string(text) + '"');
    return Threshold{std::string(limit.name), *limit.most};
}

std::vector<Violation> violations(const AuditReport& report, const std::vector<Threshold>& rules) {
    const ExactEnvironment environment;
    std::vector<Violation> all;
    for (const KernelResult& k : report.kernels) {
        for (const Threshold& rule : rules) {
            const double value = as_rules_have_it(*figure_named(rule.name), k.total);
            if (value > rule.limit) all.push_back({k.kernel.name, rule.name, value, rule.limit});
        }
    }
    return all;
}

std::vector<std::string> threshold_names() {
    std::vector<std::string> names;
    for (std::size_t f = first_finding; f < figures().size(); ++f) {
        if (f == first_error) names.insert(names.end(), {"any", "wrong_cases"});
        names.push_back(figures()[f].name);
    }
    return names;
}

}  // namespace barycert
