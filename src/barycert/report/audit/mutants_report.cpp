// The mutation score, as text and as JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string figure_text(const std::string& name, double x) {
    return name.find("ulp") == std::string::npos ? brief_count(static_cast<std::uint64_t>(std::max(x, 0.0))) : brief(x);
}

/// Each family and how many mutants it catches, most first; those with one alone say which.
std::string families_of(const MutantReport& report) {
    std::map<std::string, std::vector<const MutantResult*>> by_family;
    for (const MutantResult& r : report.mutants) {
        for (const MutantCatch& c : r.catches) by_family[c.family].push_back(&r);
    }
    std::vector<std::pair<std::string, std::vector<const MutantResult*>>> list(by_family.begin(), by_family.end());
    std::stable_sort(list.begin(), list.end(),
                     [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
    std::string out;
    for (const auto& [family, caught] : list) {
        std::string alone;
        for (const MutantResult* r : caught) {
            if (r->catches.size() == 1) alone += (alone.empty() ? "  alone: " : ", ") + r->mutant.kernel.name;
        }
        out += fmt::format("{:<24} {:>4}{}\n", family, caught.size(), alone);
    }
    return out;
}

}  // namespace

std::string mutants_text(const MutantReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out = environment_line(report.environment) + "\n";
    const std::uint64_t caught = report.caught(), all = report.mutants.size();
    const std::string score = fmt::format("{} of {} mutants caught", caught, all);
    out += (caught == all ? paint.good(score) : paint.bad(score)) +
           fmt::format("; seed {}, {} cases per family and simplex, {:.1f} s\n\n", report.seed, report.count,
                       report.seconds);
    std::size_t width = 6;
    for (const MutantResult& r : report.mutants) width = std::max(width, r.mutant.kernel.name.size());
    const auto row = [&](const auto&... cells) {
        return fmt::format("{:<{}} {:>8}  {:<24} {:<17} {:>9} {:>9}\n", cells...);
    };
    out += paint.bold(row("mutant", width, "families", "most telling", "by", "sound", "mutant"));
    for (const MutantResult& r : report.mutants) {
        const std::string count = fmt::format("{}/{}", r.catches.size(), r.families);
        if (r.catches.empty()) {
            out += paint.bad(row(r.mutant.kernel.name, width, count, "not caught", "", "", ""));
            continue;
        }
        const MutantCatch& c = r.catches.front();
        out += row(r.mutant.kernel.name, width, count, c.family, c.figure, figure_text(c.figure, c.sound),
                   figure_text(c.figure, c.mutant));
    }
    out += paint.dim(
        "families: in which the mutant does worse than the sound kernel on the same cases: more wrong cases, or an\n"
        "error more than twice as large. by: the figure that tells it, of the sound kernel and of the mutant.\n");
    return out + "\n" + paint.bold(fmt::format("{:<24} {:>4}\n", "family", "catches")) + families_of(report);
}

std::string mutants_json(const MutantReport& report) {
    using Json = nlohmann::ordered_json;
    const ExactEnvironment environment;
    Json j;
    j["schema"] = audit_schema;
    j["environment"] = environment_json(report.environment);
    j["seed"] = report.seed;
    j["count"] = report.count;
    j["threads"] = report.threads;
    j["seconds"] = report.seconds;
    j["caught"] = report.caught();
    j["mutants"] = Json::array();
    for (const MutantResult& r : report.mutants) {
        Json m;
        m["name"] = r.mutant.kernel.name;
        m["sound"] = r.mutant.sound.name;
        m["fault"] = r.mutant.fault;
        m["change"] = r.mutant.change;
        m["families"] = r.families;
        m["catches"] = Json::array();
        for (const MutantCatch& c : r.catches) {
            Json one;
            one["family"] = c.family;
            one["figure"] = c.figure;
            one["sound_figure"] = magnitude(c.sound);
            one["mutant_figure"] = magnitude(c.mutant);
            m["catches"].push_back(std::move(one));
        }
        j["mutants"].push_back(std::move(m));
    }
    return base::json_text(j, 1);
}

}  // namespace barycert
