#include <fmt/format.h>

#include <algorithm>

#include "barycert/audit_report.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

using State = CiOutcome::State;

std::string meaning_of(const std::string& rule) {
    if (const auto finding = finding_named(rule))
        return std::string(finding_texts[static_cast<std::size_t>(*finding)].meaning);
    return rule + " of a kernel, over the cases of its families";
}

/// Outcomes of one kernel.
class KernelOutcomes {
public:
    KernelOutcomes(const AuditReport& report, const KernelResult& kernel, std::string artifact)
        : report_(report), kernel_(kernel), artifact_(std::move(artifact)) {}

    void findings() {
        const KernelStatistics& s = kernel_.total;
        for (std::size_t f = 0; f < finding_count; ++f) {
            if (s.counts[f] == 0) continue;
            const FindingText& text = finding_texts[f];
            add(std::string(text.name), std::string(text.name), State::noted,
                fmt::format("{} times in {} cases: {}", s.counts[f], s.cases, text.meaning));
        }
        if (s.not_run != 0)
            add("not run", "not_run", State::noted,
                fmt::format("{} cases were not run: the kernel had been given up", s.not_run));
        else if (s.wrong_cases == 0)
            add("no finding", "wrong_cases", State::passed, "");
    }

    void rules(const std::vector<Threshold>& all) {
        for (const Threshold& rule : all) {
            AuditReport one;
            one.kernels.push_back(kernel_);
            const std::vector<Violation> broken = violations(one, {rule});
            const std::string asked = fmt::format("{} <= {}", rule.name, base::shortest(rule.limit));
            add(asked, rule.name, broken.empty() ? State::passed : State::failed,
                broken.empty() ? ""
                               : fmt::format("{} = {}, limit {}", rule.name, base::shortest(broken[0].value),
                                             base::shortest(rule.limit)));
        }
    }

    void baseline(const BaselineComparison& comparison) {
        for (const FamilyResult& f : kernel_.families) {
            const std::string& family = report_.families[f.family].name;
            std::string message, first;
            for (const BaselineChange& c : comparison.worse) {
                if (c.kernel != kernel_.kernel.name || c.family != family) continue;
                if (first.empty()) first = c.figure;
                message += fmt::format("{}{} {} -> {}", message.empty() ? "worse than the baseline: " : ", ", c.figure,
                                       base::shortest(c.before), base::shortest(c.after));
            }
            add("baseline, " + family, first.empty() ? "wrong_cases" : first,
                first.empty() ? State::passed : State::failed, message);
        }
    }

    std::vector<CiOutcome> take() { return std::move(all_); }

private:
    void add(std::string name, const std::string& rule, State state, std::string message) {
        all_.push_back(
            {kernel_.kernel.name, std::move(name), rule, meaning_of(rule), state, std::move(message), artifact_});
    }

    const AuditReport& report_;
    const KernelResult& kernel_;
    std::string artifact_;
    std::vector<CiOutcome> all_;
};

}  // namespace

CiReport audit_outcomes(const AuditReport& report, const std::vector<Threshold>& rules,
                        const BaselineComparison* comparison, const std::map<std::string, std::string>& artifacts) {
    const ExactEnvironment environment;
    CiReport ci{"barycert audit", "function", report.environment, report.seconds};
    for (const KernelResult& k : report.kernels) {
        const auto artifact = artifacts.find(k.kernel.name);
        KernelOutcomes of(report, k, artifact == artifacts.end() ? "" : artifact->second);
        of.findings();
        of.rules(rules);
        if (comparison != nullptr) of.baseline(*comparison);
        for (CiOutcome& o : of.take()) ci.outcomes.push_back(std::move(o));
    }
    return ci;
}

std::string baseline_text(const BaselineComparison& comparison, const std::string& path) {
    const ExactEnvironment environment;
    constexpr std::size_t most = 20;
    std::string out;
    const auto changes = [&](const char* word, const std::vector<BaselineChange>& list) {
        for (std::size_t i = 0; i < std::min(most, list.size()); ++i) {
            const BaselineChange& c = list[i];
            out += fmt::format("{}: {} in {}: {} {} -> {}\n", word, c.kernel, c.family, c.figure,
                               base::shortest(c.before), base::shortest(c.after));
        }
        if (list.size() > most) out += fmt::format("{}: and {} more\n", word, list.size() - most);
    };
    changes("worse", comparison.worse);
    changes("better", comparison.better);
    out += fmt::format("baseline {}: {} figures worse, {} better, in {} pairs of kernel and family",
                       base::printable(path), comparison.worse.size(), comparison.better.size(), comparison.compared);
    if (comparison.given_up != 0)
        out += fmt::format("; in {} pairs the kernel was given up, and no figure but not_run is compared",
                           comparison.given_up);
    if (comparison.not_now != 0)
        out += fmt::format("; {} pairs of the baseline are not in this audit", comparison.not_now);
    if (comparison.not_before != 0)
        out += fmt::format("; {} pairs of this audit are not in the baseline", comparison.not_before);
    return out + "\n";
}

}  // namespace barycert
