// Report on a verification of results.

#include "barycert/verify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/verify_job.hpp"
#include "core/base/decades.hpp"
#include "core/base/text.hpp"
#include "draw/axes.hpp"
#include "draw/histogram.hpp"
#include "draw/picture.hpp"

namespace barycert {

using namespace report;

namespace {

using namespace draw;

std::string where(const WrongRow& row) {
    if (row.exact.cell < 0) return "outside";
    if (row.exact.feature == Feature::interior) return fmt::format("inside cell {}", row.exact.cell);
    return fmt::format("on {} {} of cell {}", row.exact.feature == Feature::edge ? "an" : "a", name(row.exact.feature),
                       row.exact.cell);
}

std::string value_clause(const VerifyReport& s, const WrongRow& row) {
    if (s.columns.empty()) return "";
    return fmt::format("{} is {}, should be {}", s.columns[row.column], base::shortest(row.claimed),
                       base::shortest(row.value));
}

/// Says what is wrong with a row.
std::string example_sentence(const VerifyReport& s, const WrongRow& row) {
    std::string text = "point (" + coordinates(row.point, s.dimension, base::shortest, ",") + ") is " + where(row);
    switch (row.verdict) {
        case RowVerdict::missed:
            return text + ", and said to be outside";
        case RowVerdict::invented:
            if (!std::isnan(row.distance)) text += fmt::format(", {} from the mesh", brief(row.distance));
            return text + (s.columns.empty()
                               ? ", and said to be inside"
                               : fmt::format(", and {} is {}", s.columns[row.column], base::shortest(row.claimed)));
        case RowVerdict::wrong_cell:
            return text + fmt::format(", not in cell {}", row.claimed_cell) +
                   (row.relative > 0 ? "; " + value_clause(s, row) : "");
        default:
            return text + "; " + value_clause(s, row) +
                   (row.relative > 0 && row.relative < 1e300 ? fmt::format(": {} of the range", brief(row.relative))
                                                             : std::string());
    }
}

/// A command that shows what the exact answer is.
std::string example_command(const VerifyReport& s, const WrongRow& row) {
    return fmt::format("echo {} | {} sample {} --columns 1,2{} --on-boundary all{}{} --points - --output -",
                       coordinates(row.point, s.dimension, base::shortest, ","), s.program, shell_word(s.mesh),
                       s.dimension == 3 ? ",3" : "", std::isnan(row.distance) ? " --nonfinite-points nan" : "",
                       s.interpolation == CellInterpolation::linear ? "" : " --interpolation multilinear");
}

struct Kind {
    std::uint64_t count = 0;
    std::string_view meaning;  ///< of the verdict
    std::string what;          ///< such rows are, here
};

/// One for each RowVerdict.
std::array<Kind, 5> kinds_of(const VerifyReport& s) {
    const Verdicts& v = s.verdicts;
    const auto more = [](std::uint64_t count, std::string_view what) {
        return count == 0 ? "" : fmt::format("; {} {}", count, what);
    };
    std::string far;
    if (v.invented_measured != 0)
        far = (v.invented_measured == v.invented ? "; the farthest"
                                                 : fmt::format("; the farthest of {} of them", v.invented_measured)) +
              fmt::format(" lies {} from the mesh", brief(v.invented_distance));
    if (v.invented_measured != 0 && v.invented_near != 0)
        far += fmt::format(", {} nearer than {} of its diagonal", v.invented_near, brief(near_distance));
    const bool named = !s.cell_column.empty(), valued = !s.columns.empty();
    const std::string right = s.exact ? "the exact value, rounded once" : "values off by at most the tolerance";
    return {
        {{v.right, "right rows",
          !valued ? "" : right + more(v.by_other_cell, "by another cell that contains the point, not by the lowest")},
         {v.missed, "points in a cell that are said to be outside",
          "in a cell, and said to be outside" +
              more(v.missed_on_boundary, "on a face, an edge or a vertex of the cell")},
         {v.invented, "points in no cell that are said to be inside",
          "in no cell, and said to be inside" + more(v.invented_zero, "have the value 0") + far},
         {v.wrong_cell, "points inside that are not in the cell named",
          named ? "inside, but not in the cell that column " + base::quoted(s.cell_column) + " names"
                : "not compared: the results name no cells"},
         {v.wrong_value, "values off by more than the tolerance, or NaN where one is due",
          !valued   ? "not compared: no column of values"
          : s.exact ? "not the exact value, rounded once"
                    : fmt::format("off by more than {} of the range, or NaN", base::shortest(s.tolerance))}}};
}

void tell_verdict(Document& d, const VerifyReport& s) {
    const Verdicts& v = s.verdicts;
    const std::string_view of = for_straight_sides(s.curved);
    const std::string verdict = v.rows == 0      ? "no rows"
                                : v.wrong() != 0 ? fmt::format("WRONG{}: {} of {} rows", of, v.wrong(), v.rows)
                                : v.rows == 1    ? fmt::format("the row is right{}", of)
                                                 : fmt::format("all {} rows are right{}", v.rows, of);
    d.add(Headline{.tone = v.wrong() == 0 ? Tone::good : Tone::bad, .subject = s.results, .text = verdict});
    d.say(fmt::format("{}: {} inside the mesh, {} of them on a face, an edge or a vertex; {} outside{}",
                      counted(v.rows, "row"), v.inside, v.on_boundary, v.outside,
                      v.not_finite == 0 ? "" : fmt::format(", {} of them not finite", v.not_finite)));
    Listing table{.columns = {left("row is", 12), right("rows", 12), right("", 9), left("meaning", 0, 2)},
                  .headless = true};
    const auto kinds = kinds_of(s);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const bool bad = k != 0 && kinds[k].count != 0;
        table.rows.push_back({{std::string(name(static_cast<RowVerdict>(k))),
                               {std::to_string(kinds[k].count), {}, bad ? Tone::bad : Tone::plain},
                               percent(kinds[k].count, v.rows) + " %",
                               kinds[k].what}});
    }
    d.table(std::move(table));
}

void tell_values(Document& d, const VerifyReport& s) {
    d.part("Values");
    if (s.columns.empty()) return d.say("values       not compared");
    const std::string over = s.exact ? "over 0" : "over " + base::shortest(s.tolerance);
    Listing table{.columns = {left("values of", 20),
                              {.head = "column", .left = true, .whom = For::page},
                              right("compared", 12),
                              right("bits right %", 12),
                              right("max ulps", 12),
                              right("max error", 12),
                              right(over, 10, "wrong")}};
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        const std::uint64_t wrong = e.over + e.missing + e.spurious;
        table.rows.push_back({{s.columns[c],
                               s.found_in[c],
                               std::to_string(e.values),
                               percent(e.identical, e.values),
                               brief(e.max_ulps),
                               brief(e.max_relative),
                               {std::to_string(wrong), {}, wrong == 0 ? Tone::plain : Tone::bad}}});
    }
    d.add(std::move(table));
    d.say("max error: in parts of the range of the field (max - min)");
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        if (s.relative_to[c] == RelativeTo::magnitude)
            d.say(fmt::format("{} is constant, its range is 0: its errors are in parts of its magnitude, {}",
                              s.columns[c], base::shortest(s.ranges[c])));
        if (s.relative_to[c] == RelativeTo::one)
            d.say(fmt::format("{} is 0 throughout: its errors are absolute", s.columns[c]));
    }
}

/// Errors of a bin of ValueErrors::by_relative: from 10^(b - 19) on all are above the tolerance if that is less.
bool is_wrong(const VerifyReport& s, std::size_t b) {
    return b != 0 && (s.exact || std::pow(10.0, static_cast<double>(b) - 19) >= s.tolerance);
}

/// Draws the errors of a column in ulps, and in parts of its range; red: wrong.
std::vector<Picture> error_pictures(const VerifyReport& s, std::size_t c) {
    const ValueErrors& e = s.verdicts.columns[c];
    const std::uint64_t nan = e.missing + e.spurious;  // there, or where one is due
    const auto picture = [&](auto counts, const char* unit, const std::vector<Tick>& ticks, auto range, auto bad) {
        const auto last =
            std::find_if(counts.rbegin(), counts.rend() - 8, [](std::uint64_t n) { return n != 0; }).base();
        Axis x{.high = static_cast<double>(last - counts.begin()),
               .title = fmt::format("error of {}, {}, logarithmic{}", s.columns[c], unit,
                                    nan == 0 ? "" : fmt::format("; without {} NaN", nan))};
        std::ranges::copy_if(ticks, std::back_inserter(x.ticks), [&](const Tick& t) { return t.at <= x.high; });
        return histogram(
            {.title = x.title, .x = x, .counts = {counts.begin(), last}, .counted = "row", .range = range, .bad = bad});
    };
    std::vector<Tick> ulps{{0.5, "0"}}, parts{{0.5, "0"}};
    for (int k = 1; k < 66; k += 5) ulps.push_back({1.0 + k, "2" + superscript(k - 1)});
    for (int k = 2; k < 22; k += 4) parts.push_back({1.0 * k, "10" + superscript(k - 19)});
    const auto in_ulps = [](std::size_t b) {
        return b == 0 ? "no error" : b == 1 ? "below 1 ulp" : fmt::format("2^{} to 2^{} ulps", b - 2, b - 1);
    };
    const auto in_parts = [](std::size_t b) { return b == 0 ? "no error" : base::decade_label(b); };
    return {
        picture(e.by_ulps, "ulps", ulps, in_ulps, [&s](std::size_t b) { return s.exact && b != 0; }),
        picture(e.by_relative, "parts of its range", parts, in_parts, [&s](std::size_t b) { return is_wrong(s, b); })};
}

/// The errors of a column by powers of ten; on a terminal where there are some.
void tell_errors(Document& d, const VerifyReport& s, std::size_t c) {
    const ValueErrors& e = s.verdicts.columns[c];
    if (e.values == e.identical) return;  // one bar: the table says it
    const auto figures = [&s, c] {
        return "<div class=\"figures\">\n" + joined(error_pictures(s, c), "", svg_markup) + "</div>\n";
    };
    d.add(Pictures{figures}, For::page);
    const auto some = [](std::uint64_t n) { return n != 0; };
    const auto& counts = e.by_relative;
    const auto last = std::find_if(counts.rbegin(), counts.rend(), some).base();
    d.section(fmt::format("errors of {} in parts of its range", s.columns[c]), For::terminal, 3);
    const auto most = static_cast<double>(*std::ranges::max_element(counts));
    for (auto at = std::ranges::find_if(counts, some); at < last; ++at) {
        const std::string label =
            at == counts.begin() ? "right" : base::decade_label(static_cast<std::size_t>(at - counts.begin()));
        const auto length = static_cast<std::size_t>(std::ceil(50 * (static_cast<double>(*at) / most)));
        d.say(fmt::format("{:>14} {:>12}  {}", label, *at, std::string(length, '#')), Tone::plain, For::terminal);
    }
}

Json errors_json(const VerifyReport& s) {
    Json all = Json::array();
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        all.push_back(record("name", s.columns[c], "column", s.found_in[c], "range", s.ranges[c], "relative_to",
                             s.relative_to[c], "compared", e.values,
                             MEMBERS(e, identical, over, missing, spurious, max_ulps), "max_error", e.max_relative,
                             "by_ulps", e.by_ulps, "by_error", e.by_relative));
    }
    return all;
}

Json example_json(const VerifyReport& s, const WrongRow& row) {
    const auto number = [](std::int64_t cell) { return cell < 0 ? Json() : Json(cell); };
    Json j =
        record(MEMBERS(row, verdict, row), "point", std::vector(row.point.begin(), row.point.begin() + s.dimension),
               "cell", number(row.exact.cell), MEMBERS(row.exact, feature));
    if (row.verdict == RowVerdict::invented) put(j, MEMBERS(row, distance));
    if (!s.cell_column.empty()) put(j, "claimed_cell", number(row.claimed_cell));
    if (!s.columns.empty())
        put(j, "column", s.columns[row.column], MEMBERS(row, claimed, value, ulps), "error", row.relative);
    put(j, "command", example_command(s, row));
    return j;
}

Json verify_data(const VerifyReport& s, const Environment& environment) {
    const auto text = [](const std::string& column) { return column.empty() ? Json() : Json(column); };
    const Verdicts& v = s.verdicts;
    const JobSeconds& t = s.seconds;
    Json data = record(
        "schema", verify_schema, "command", "verify",
        MEMBERS(s, mesh, results, curved, dimension, nodes, cells, certified, contested_cells), "cell_column",
        text(s.cell_column), "mask_column", text(s.mask_column), MEMBERS(s, tolerance, exact, outside_value),
        MEMBERS(v, rows, right, missed, invented, wrong_cell, wrong_value, inside, outside, not_finite, on_boundary,
                missed_on_boundary, invented_zero, invented_measured, invented_near, invented_distance, by_other_cell),
        "values", errors_json(s), "examples",
        list(v.examples, [&](const WrongRow& row) { return example_json(s, row); }), MEMBERS(s, notes), "seconds",
        record(MEMBERS(t, mesh, build, read), "compare", t.sample, MEMBERS(t, total)), MEMBERS(s, threads),
        "environment", environment);
    if (s.simplices != 0) put(data, MEMBERS(s, simplices));
    return data;
}

Document verify_document(const VerifyReport& s, const Environment& environment) {
    Document d;
    d.title = "barycert verify: " + s.results;
    d.heading = fmt::format("barycert verify: {} on {}", s.results, s.mesh);
    d.footer = environment_line(environment);
    d.data = verify_data(s, environment);
    d.curved(s.curved);
    tell_verdict(d, s);
    tell_values(d, s);
    for (std::size_t c = 0; c < s.columns.size(); ++c)
        if (s.verdicts.columns[c].values != 0) tell_errors(d, s, c);
    if (!s.verdicts.examples.empty()) d.section("worst rows, counted from 0");
    for (const WrongRow& row : s.verdicts.examples)
        d.add(Item{.title = fmt::format("{:<12}", name(row.verdict)),
                   .text = fmt::format(" row {}: {}", row.row, example_sentence(s, row)),
                   .lines = {{example_command(s, row), true}},
                   .indent = 13});
    d.part("Mesh and files");
    const std::string of = s.certified ? fmt::format("certified{}, no two cells overlap", for_straight_sides(s.curved))
                           : s.contested_cells == 0
                               ? "cells meet in common faces"
                               : fmt::format(
                                     "{} cells may meet others beside common faces; any cell that contains a "
                                     "point counts as right",
                                     s.contested_cells);
    d.name("mesh", fmt::format("{}, {} nodes: {}", cells_text(s.cells, s.simplices, s.dimension), s.nodes, of));
    for (const Note& note : s.notes)
        d.name(std::string(name(note.kind)), note.text + (note.file.empty() ? "" : " (" + note.file + ")"));
    const JobSeconds& t = s.seconds;
    d.name("time", time_text(t.total, s.threads,
                             {{"mesh", t.mesh}, {"locator", t.build}, {"results", t.read}, {"comparing", t.sample}}));
    return d;
}

}  // namespace

std::string verify_text(const VerifyReport& report, bool colour) {
    return written_text([&] { return verify_document(report, {}); }, colour);
}

std::string verify_json(const VerifyReport& report, const Environment& environment) {
    return written_json([&] { return verify_document(report, environment); }, 2);
}

std::string verify_html(const VerifyReport& summary, const Environment& environment) {
    return written_page([&] { return verify_document(summary, environment); });
}

Result<std::string> verify_plot(const VerifyReport& summary, const std::string& path) {
    const ExactEnvironment exact;
    std::vector<Picture> all;
    for (std::size_t c = 0; c < summary.columns.size(); ++c)
        if (summary.verdicts.columns[c].values != 0)
            std::ranges::move(error_pictures(summary, c), std::back_inserter(all));
    return rows_text(path, all, summary.results);
}

CiReport verify_outcomes(const VerifyReport& s, const Environment& environment) {
    const ExactEnvironment exact;
    using State = CiOutcome::State;
    CiReport ci{"barycert verify", "resource", environment, s.seconds.total};
    const auto kinds = kinds_of(s);
    for (std::size_t k = 1; k < kinds.size(); ++k) {
        const auto verdict = static_cast<RowVerdict>(k);
        const std::string rule(handle(verdict));
        // "3 of 7 rows: what such rows are. Worst: row 5: ...".
        const auto& examples = s.verdicts.examples;
        const auto worst = std::ranges::find(examples, verdict, &WrongRow::verdict);
        std::string message = fmt::format("{} of {} rows: {}", kinds[k].count, s.verdicts.rows, kinds[k].what);
        if (worst != examples.end())
            message += fmt::format(". Worst: row {}, counted from 0: {}", worst->row, example_sentence(s, *worst));
        const auto add = [&](std::string asked, State state) {
            ci.outcomes.push_back({s.results, std::move(asked), rule, std::string(kinds[k].meaning), state,
                                   state == State::passed ? "" : message, s.results == "-" ? "" : s.results});
        };
        bool limited = false;
        for (const VerifyLimit& limit : s.limits) {
            if (limit.verdict != verdict || !s.compared(verdict)) continue;
            limited = true;
            add(fmt::format("{} <= {}", rule, limit.most),
                s.verdicts.of(verdict) > limit.most ? State::failed : State::passed);
        }
        if (!limited && kinds[k].count != 0) add(rule, State::noted);
    }
    return ci;
}

}  // namespace barycert
