// A worst-case search, and the mutation score of the families.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "audit/json_members.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/mutants.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

using namespace report;

namespace {

/// The case in decimal, a vertex a line, and how to see what kernels make of it.
Item plain_case(const SearchReport& report, const SearchFind& f, const TerminalStyle& style) {
    const Case& c = f.plain.c;
    Item item{.title = f.reason, .lines = {{f.plain.detail}}};
    for (int i = 0; i < vertex_count(c.simplex); ++i)
        item.lines.push_back({fmt::format("v{}  {}", i, coordinates(c.vertices.data() + c.stride() * i, c.stride()))});
    item.lines.push_back({"p   " + coordinates(c.point, space_dimension(c.simplex))});
    if (!style.witness_path.empty()) item.lines.push_back({replay_from_file(report.kernel.name, f.reason, style)});
    return item;
}

void tell_finds(Document& d, const SearchReport& r, const TerminalStyle& style) {
    d.say(fmt::format(
        "wrong: {} % of the cases met on the way (no measure of how often: the search goes where faults are)",
        percent(r.wrong_cases, r.steps)));
    Listing table{.columns = {left("\nfault", 21),
                              right("\ncases", 7),
                              right("worst:\nrelative", 9),
                              right("ulps of\na weight", 9),
                              {.head = "plainest:\nrelative", .width = 9, .gap = 3},
                              right("ulps of\na weight", 9),
                              right("\nbits", 5)}};
    for (const SearchFind& f : r.finds)
        table.rows.push_back(
            {{f.reason, brief_count(f.cases), brief(f.relative_error), brief(f.weight_ulp),
              brief(f.plain_relative_error), brief(f.plain_weight_ulp), std::to_string(f.plain_bits)}});
    d.table(std::move(table));
    d.notes(
        {"relative: error of a weight over the largest exact weight. plainest: the same fault on coordinates of the",
         "fewest significant bits (of an error: at least 1/1024 of it); bits: of all its coordinates together."});
    for (const SearchFind& f : r.finds) {
        d.part();
        d.add(plain_case(r, f, style));
    }
}

Document search_document(const SearchReport& r, const TerminalStyle& style) {
    Document d;
    d.say(environment_line(r.environment));
    d.say(fmt::format("{}: {} cases in {} walks, seed {}, exponents {} to {}, {:.1f} s", r.kernel.name, r.steps,
                      r.walks, r.seed, r.min_exponent, r.max_exponent, r.seconds));
    if (r.stopped)
        d.say(fmt::format("stopped before {} cases: another run may find something else", r.steps_asked), Tone::bad);
    if (r.given_up)
        d.say(fmt::format("given up before {} cases: it crashed or gave no answer too often", r.steps_asked),
              Tone::bad);
    if (r.finds.empty())
        d.say("no fault and no error found", Tone::good);
    else
        tell_finds(d, r, style);
    d.data = record("schema", audit_schema, MEMBERS(r, environment), "kernel", r.kernel.name,
                    MEMBERS(r, seed, steps_asked, steps, walks, plain_steps, min_exponent, max_exponent, threads,
                            seconds, stopped, given_up, wrong_cases),
                    "finds",
                    list(r.finds,
                         [](const SearchFind& f) {
                             return record(MEMBERS(f, reason, cases), "weight_ulp", magnitude(f.weight_ulp),
                                           "relative_error", magnitude(f.relative_error), "found",
                                           audit::witness_json(f.found), "plain_weight_ulp",
                                           magnitude(f.plain_weight_ulp), "plain_relative_error",
                                           magnitude(f.plain_relative_error), MEMBERS(f, plain_bits));
                         }),
                    "witnesses", list(r.finds, [](const SearchFind& f) { return audit::witness_json(f.plain); }));
    return d;
}

void tell_mutants(Document& d, const MutantReport& r) {
    const auto figure_text = [](const std::string& name, double x) {
        return name.find("ulp") == std::string::npos ? brief_count(static_cast<std::uint64_t>(std::max(x, 0.0)))
                                                     : brief(x);
    };
    Listing table{.columns = {left("mutant", 6), right("families", 8), left("most telling", 24, 2), left("by", 17),
                              right("sound", 9), right("mutant", 9)}};
    for (const MutantResult& m : r.mutants) {
        Row row{{m.mutant.kernel.name, fmt::format("{}/{}", m.catches.size(), m.families)}};
        if (m.catches.empty()) {
            row.cells.emplace_back("not caught");
            row.tone = Tone::bad;
        } else {
            const MutantCatch& c = m.catches.front();
            row.cells.insert(row.cells.end(),
                             {c.family, c.figure, figure_text(c.figure, c.sound), figure_text(c.figure, c.mutant)});
        }
        table.rows.push_back(std::move(row));
    }
    d.add(std::move(table));
    d.notes(
        {"families: in which the mutant does worse than the sound kernel on the same cases: more wrong cases, or an",
         "error more than twice as large. by: the figure that tells it, of the sound kernel and of the mutant."});
}

/// Each family and how many mutants it catches, most first; those with one alone say which.
void tell_catches(Document& d, const MutantReport& r) {
    std::map<std::string, std::vector<const MutantResult*>> by_family;
    for (const MutantResult& m : r.mutants) {
        for (const MutantCatch& c : m.catches) by_family[c.family].push_back(&m);
    }
    std::vector<std::pair<std::string, std::vector<const MutantResult*>>> all(by_family.begin(), by_family.end());
    std::ranges::stable_sort(all, std::greater<>(), [](const auto& of) { return of.second.size(); });
    Listing table{.columns = {left("family", 24), right("catches", 4), left("", 0, 2)}};
    for (const auto& [family, caught] : all) {
        std::string alone = joined(caught, ", ", [](const MutantResult* m) {
            return m->catches.size() == 1 ? m->mutant.kernel.name : std::string();
        });
        if (!alone.empty()) alone.insert(0, "alone: ");
        table.rows.push_back({{family, std::to_string(caught.size()), alone}});
    }
    d.table(std::move(table));
}

Document mutants_document(const MutantReport& r) {
    Document d;
    d.say(environment_line(r.environment));
    const std::uint64_t caught = r.caught(), all = r.mutants.size();
    d.say(fmt::format("{} of {} mutants caught; seed {}, {} cases per family and simplex, {:.1f} s", caught, all,
                      r.seed, r.count, r.seconds),
          caught == all ? Tone::good : Tone::bad);
    d.part();
    tell_mutants(d, r);
    tell_catches(d, r);
    d.data = record("schema", audit_schema, MEMBERS(r, environment, seed, count, threads, seconds), "caught", caught,
                    "mutants", list(r.mutants, [](const MutantResult& m) {
                        return record("name", m.mutant.kernel.name, "sound", m.mutant.sound.name,
                                      MEMBERS(m.mutant, fault, change), MEMBERS(m, families), "catches",
                                      list(m.catches, [](const MutantCatch& c) {
                                          return record(MEMBERS(c, family, figure), "sound_figure", magnitude(c.sound),
                                                        "mutant_figure", magnitude(c.mutant));
                                      }));
                    }));
    return d;
}

}  // namespace

std::string search_text(const SearchReport& report, const TerminalStyle& style) {
    return written_text([&] { return search_document(report, style); }, style.colour);
}

std::string search_json(const SearchReport& report) {
    return written_json([&] { return search_document(report, {}); }, 1);
}

std::string mutants_text(const MutantReport& report, const TerminalStyle& style) {
    return written_text([&] { return mutants_document(report); }, style.colour);
}

std::string mutants_json(const MutantReport& report) {
    return written_json([&] { return mutants_document(report); }, 1);
}

}  // namespace barycert
