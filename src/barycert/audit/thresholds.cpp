#include "barycert/audit.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "barycert/audit/figures.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

using Figure = std::pair<std::string, std::function<double(const KernelStatistics&)>>;

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = [] {
        std::vector<Figure> f;
        for (std::size_t i = 0; i < finding_count; ++i) {
            f.emplace_back(std::string(finding_texts[i].name),
                           [i](const KernelStatistics& s) { return static_cast<double>(s.counts[i]); });
        }
        // A kernel that was given up before it was wrong, for want of a process, has not passed.
        const auto wrong = [](const KernelStatistics& s) {
            return s.wrong_cases == 0 && s.not_run != 0 ? std::numeric_limits<double>::infinity()
                                                        : static_cast<double>(s.wrong_cases);
        };
        f.emplace_back("any", wrong);
        f.emplace_back("wrong_cases", wrong);
        // A kernel that gives no finite weight where there is one to give has no error to measure: it is worse than
        // any. (One that touched memory beside its arrays may have died of it.)
        for (const audit::ErrorFigure& figure : audit::error_figures) {
            f.emplace_back(figure.name, [figure](const KernelStatistics& s) {
                const auto seen = [&](Finding x) { return s.counts[static_cast<std::size_t>(x)] != 0; };
                const double value = figure.of(s);
                const bool mute = value < 0 && (seen(Finding::not_finite) || seen(Finding::false_declaration) ||
                                                seen(Finding::crashed) || seen(Finding::raised) ||
                                                seen(Finding::hung) || seen(Finding::out_of_bounds) || s.not_run != 0);
                return mute ? std::numeric_limits<double>::infinity() : value;
            });
        }
        return f;
    }();
    return all;
}

const Figure* figure_named(std::string_view name) {
    const auto found =
        std::find_if(figures().begin(), figures().end(), [&](const Figure& f) { return f.first == name; });
    return found == figures().end() ? nullptr : &*found;
}

}  // namespace

Result<Threshold> parse_threshold(std::string_view text) {
    const ExactEnvironment environment;
    const base::NamedLimit limit = base::named_limit(text);
    Threshold rule{std::string(limit.name), 0};
    if (figure_named(rule.name) == nullptr) {
        std::string names;
        for (const std::string& name : threshold_names()) names += (names.empty() ? "" : ", ") + name;
        return Error{.what = "unknown rule",
                     .expected = "NAME or NAME>NUMBER with NAME one of " + names,
                     .found = '"' + std::string(text) + '"',
                     .remedy = base::did_you_mean(rule.name, threshold_names())};
    }
    if (!limit.most)
        return Error{
            .what = "bad limit in a rule", .expected = "a number >= 0 after >", .found = '"' + std::string(text) + '"'};
    rule.limit = *limit.most;
    return rule;
}

std::vector<Violation> violations(const AuditReport& report, const std::vector<Threshold>& rules) {
    const ExactEnvironment environment;
    std::vector<Violation> all;
    for (const KernelResult& k : report.kernels) {
        for (const Threshold& rule : rules) {
            const double value = figure_named(rule.name)->second(k.total);
            if (value > rule.limit) all.push_back({k.kernel.name, rule.name, value, rule.limit});
        }
    }
    return all;
}

std::vector<std::string> threshold_names() {
    std::vector<std::string> names;
    for (const auto& [name, value] : figures()) names.push_back(name);
    return names;
}

}  // namespace barycert
