// JSON of audits, of the catalogue and of the families, for programs; reports for systems that run audits.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "audit/asking.hpp"
#include "audit/json_members.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

namespace {

void put_statistics(Json& j, const KernelStatistics& s) {
    put(j, MEMBERS(s, cases));
    for (std::size_t f = 0; f < audit::figures().size(); ++f) {
        const auto& [name, value] = audit::figures()[f];
        if (f == audit::first_error)
            put(j, "worst_error", magnitude(s.errors.worst.value), "by_error", s.errors.counts);
        put(j, name, f < audit::first_error ? Json(static_cast<std::uint64_t>(value(s))) : magnitude(value(s)));
    }
    Json& confusion = j["confusion"];
    for (const Region exact : all_regions) {
        for (const Region claimed : all_regions)
            confusion[std::string(name(exact))][std::string(name(claimed))] =
                s.confusion[static_cast<std::size_t>(exact)][static_cast<std::size_t>(claimed)];
    }
}

Json prediction_json(const Prediction& p) {
    return record("cases", p.cases(), "worst_factor", magnitude(p.worst_factor()), "bins",
                  list(p.bins(), [](const Prediction::Bin& bin) {
                      return record("bits", bin.bits, "cases", bin.cases, "median_error", magnitude(bin.median),
                                    "worst_error", magnitude(bin.worst));
                  }));
}

Json result_json(const AuditReport& r, const KernelResult& k) {
    Json j = kernel_json(k.kernel);
    put_statistics(j, k.total);
    put(j, "ns", magnitude(k.ns), "prediction", prediction_json(k.prediction), "families",
        list(k.families, [&](const FamilyResult& f) {
            Json part = record("name", r.families[f.family].name);
            put_statistics(part, f.statistics);
            return part;
        }));
    return j;
}

using State = CiOutcome::State;

std::string meaning_of(const std::string& rule) {
    if (const auto finding = finding_named(rule))
        return std::string(finding_texts[static_cast<std::size_t>(*finding)].meaning);
    return rule + " of a kernel, over the cases of its families";
}

/// "wrong_cases 3 -> 5".
std::string change_text(const BaselineChange& c) {
    return fmt::format("{} {} -> {}", c.figure, base::shortest(c.before), base::shortest(c.after));
}

/// The classes of findings, worst first.
Json classes_json() {
    Json classes = Json::array();
    for (std::size_t f = 0; f < finding_count; ++f) {
        const auto finding = static_cast<Finding>(f);
        classes.push_back(
            record("name", name(finding), "severity", severity(finding), "meaning", finding_texts[f].meaning));
    }
    return classes;
}

}  // namespace

Json report::audit_data(const AuditReport& r) {
    Json regions, witnesses = Json::array();
    for (const Region region : all_regions) put(regions, name(region), r.regions[static_cast<std::size_t>(region)]);
    for (const KernelResult& k : r.kernels) {
        for (const Witness& w : k.witnesses) witnesses.push_back(audit::witness_json(w));
    }
    return record("schema", audit_schema, MEMBERS(r, environment, seed, count, threads, meshes), "verdicts",
                  list(r.verdicts, [](Verdict v) { return name(v); }), MEMBERS(r, curved, cases), "regions", regions,
                  "oracles", oracles_json(r.oracle, r.oracles), MEMBERS(r, seconds), "families",
                  list(r.families, family_json), "kernels",
                  list(r.kernels, [&](const KernelResult& k) { return result_json(r, k); }), "witnesses", witnesses,
                  "classes", classes_json());
}

CiReport audit_outcomes(const AuditReport& report, const std::vector<Threshold>& rules,
                        const BaselineComparison* comparison, const std::map<std::string, std::string>& artifacts) {
    const ExactEnvironment environment;
    CiReport ci{"barycert audit", "function", report.environment, report.seconds};
    for (const KernelResult& k : report.kernels) {
        const auto artifact = artifacts.find(k.kernel.name);
        const auto add = [&](std::string what, const std::string& rule, State state, std::string message) {
            ci.outcomes.push_back({k.kernel.name, std::move(what), rule, meaning_of(rule), state, std::move(message),
                                   artifact == artifacts.end() ? "" : artifact->second});
        };
        const KernelStatistics& s = k.total;
        for (std::size_t f = 0; f < finding_count; ++f) {
            const FindingText& text = finding_texts[f];
            if (s.counts[f] != 0)
                add(std::string(text.name), std::string(text.name), State::noted,
                    fmt::format("{} times in {} cases: {}", s.counts[f], s.cases, text.meaning));
        }
        if (s.not_run != 0)
            add("not run", "not_run", State::noted,
                fmt::format("{} cases were not run: the kernel had been given up", s.not_run));
        else if (s.wrong_cases == 0)
            add("no finding", "wrong_cases", State::passed, "");
        AuditReport one;
        one.kernels.push_back(k);
        for (const Threshold& rule : rules) {
            const std::vector<Violation> broken = violations(one, {rule});
            const std::string limit = base::shortest(rule.limit);
            add(fmt::format("{} <= {}", rule.name, limit), rule.name, broken.empty() ? State::passed : State::failed,
                broken.empty() ? ""
                               : fmt::format("{} = {}, limit {}", rule.name, base::shortest(broken[0].value), limit));
        }
        for (std::size_t i = 0; comparison != nullptr && i < k.families.size(); ++i) {
            const std::string& family = report.families[k.families[i].family].name;
            std::vector<BaselineChange> worse;
            std::ranges::copy_if(comparison->worse, std::back_inserter(worse), [&](const BaselineChange& c) {
                return c.kernel == k.kernel.name && c.family == family;
            });
            if (worse.empty())
                add("baseline, " + family, "wrong_cases", State::passed, "");
            else
                add("baseline, " + family, worse.front().figure, State::failed,
                    "worse than the baseline: " + joined(worse, ", ", change_text));
        }
    }
    return ci;
}

std::string baseline_text(const BaselineComparison& comparison, const std::string& path) {
    const ExactEnvironment environment;
    constexpr std::size_t most = 20;
    std::string out;
    const auto changes = [&](const char* word, const std::vector<BaselineChange>& list) {
        for (const BaselineChange& c : std::span(list).first(std::min(most, list.size())))
            out += fmt::format("{}: {} in {}: {}\n", word, c.kernel, c.family, change_text(c));
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
