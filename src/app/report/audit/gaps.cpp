// Gaps and overlaps between the cells of a mesh; drift over the size of a triangle, and rules of texel addressing.

#include "barycert/gaps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "barycert/simplex.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string number_list(const std::vector<Mesh::Index>& numbers) {
    constexpr std::size_t most = 8;
    if (numbers.empty()) return "none";
    return fmt::format("{}{}", fmt::join(std::span(numbers).first(std::min(most, numbers.size())), " "),
                       numbers.size() > most ? fmt::format(" and {} more", numbers.size() - most) : "");
}

void tell_table(Document& d, const GapsReport& r) {
    Listing table{.columns = {left("kernel", 16), left("rule", 8, 2), right("inside", 6), right("gaps", 6),
                              right("several", 7), right("wrong", 6), right("first", 6), right("outside", 7),
                              right("claimed", 7)}};
    for (const ClaimResult& of : r.results) {
        const ClaimCounts c = of.total();
        const auto n = [&](ClaimFault f) { return brief_count(c.of(f)); };
        table.rows.push_back({{of.kernel.empty() ? "exact arithmetic" : of.kernel, std::string(name(of.rule)),
                               brief_count(c.inside), n(ClaimFault::gap), n(ClaimFault::several), n(ClaimFault::wrong),
                               n(ClaimFault::wrong_first), brief_count(c.outside), n(ClaimFault::outside_claimed)}});
    }
    d.table(std::move(table));
    d.notes(
        {fmt::format(
             "rule: a cell claims a point if all weights are > 0 (strict), >= 0 (exact), >= -{} (tolerant), or by the",
             base::shortest(r.tolerance)),
         "kernel's own rule. inside: points that a cell holds, exactly; of these gaps: no cell claims it; several:",
         "more than one does (right where it lies on what they share: see exact arithmetic); wrong: one that does not",
         "hold it; first: the lowest of those that claim it does not hold it. outside: points that no cell holds, of",
         "these claimed: by a cell."});
}

void tell_points(Document& d, const GapsReport& r) {
    bool first = true;
    for (const ClaimResult& of : r.results) {
        // The other rules have such points by their nature; the JSON names them.
        if (of.kernel.empty() || of.rule == ClaimRule::strict || of.rule == ClaimRule::tolerant) continue;
        Item item{.title = of.kernel, .text = fmt::format(", {}", name(of.rule))};
        for (const auto& [fault, w] : of.witnesses) {
            if (fault == ClaimFault::several || fault == ClaimFault::wrong_first) continue;
            item.lines.push_back(
                {fmt::format("{}: ({}), made on the {} of nodes {}", name(fault), coordinates(w.point, r.dimension),
                             name(w.feature), number_list(w.nodes))});
            item.lines.push_back(
                {fmt::format("    held by {}, claimed by {}", number_list(w.holders), number_list(w.claimants))});
        }
        if (item.lines.empty()) continue;
        if (std::exchange(first, false)) d.section("The first point of each fault:");
        d.add(std::move(item));
    }
}

void put_claims(Json& j, const ClaimCounts& c) {
    put(j, "inside", c.inside);
    for (std::size_t f = 0; f + 1 < claim_fault_count; ++f)
        put(j, name(static_cast<ClaimFault>(f)), c.of(static_cast<ClaimFault>(f)));
    put(j, "outside", c.outside, name(ClaimFault::outside_claimed), c.of(ClaimFault::outside_claimed));
}

Json claims_json(const ClaimResult& r, int dimension) {
    Json j =
        record("kernel", r.kernel.empty() ? Json() : Json(r.kernel), "rule", name(r.rule), "unanswered", r.unanswered);
    put_claims(j, r.total());
    j["features"] = Json::array();
    for (std::size_t f = 0; f < 3; ++f) {
        if (dimension == 2 && claim_features[f] == Feature::face) continue;
        Json part = record("feature", name(claim_features[f]));
        put_claims(part, r.by_feature[f]);
        j["features"].push_back(std::move(part));
    }
    put(j, "witnesses", list(r.witnesses, [&](const auto& of) {
            const ClaimWitness& w = of.second;
            const auto point = std::span(w.point).first(static_cast<std::size_t>(dimension));
            return record("fault", name(of.first), MEMBERS(w, feature, index, nodes), "point",
                          list(point, base::hexadecimal), MEMBERS(w, holders, claimants));
        }));
    return j;
}

Document gaps_document(const GapsReport& r) {
    Document d;
    d.curved(r.curved);
    d.say(environment_line(r.environment));
    const char* const known = r.verdict == Verdict::certified       ? "certified to be a partition"
                              : r.verdict == Verdict::not_certified ? "NOT certified to be a partition"
                                                                    : "not checked";
    d.say(fmt::format("{}, {}{}; seed {}, {} points on {} each, {} threads, {:.1f} s", r.mesh, known,
                      for_straight_sides(r.curved), r.seed, r.count,
                      r.dimension == 2 ? "edges and vertices" : "faces, edges and vertices", r.threads, r.seconds));
    d.say(oracle_line(r.oracles));
    tell_table(d, r);
    for (const ClaimResult& of : r.results) {
        if (of.unanswered == 0 || of.rule != ClaimRule::exact) continue;  // the same under each rule
        d.say(
            fmt::format("{} gave no answer to {} pairs of point and cell (it ended, took too long, or was no longer "
                        "asked for",
                        of.kernel, of.unanswered));
        d.say("that): the cell does not claim the point then.");
    }
    tell_points(d, r);
    d.data = record("schema", audit_schema,
                    MEMBERS(r, environment, mesh, curved, verdict, dimension, seed, count, threads, tolerance),
                    "oracles", oracles_json(OracleChoice::automatic, r.oracles), "seconds", r.seconds, "results",
                    list(r.results, [&](const ClaimResult& of) { return claims_json(of, r.dimension); }));
    return d;
}

Document drift_document(const DriftReport& r) {
    Document d;
    d.say(
        fmt::format("seed {}, {} cases per size. Largest error of the value, in ulps of the exact one, by the size of "
                    "the triangle in pixels.",
                    r.seed, r.count));
    Listing table{.columns = {left("kernel", 6)}};
    if (!r.curves.empty()) {
        for (const DriftPoint& p : r.curves.front().points) table.columns.push_back(right(std::to_string(p.size), 9));
    }
    table.columns.push_back(left("", 0, 2));
    for (const DriftCurve& curve : r.curves) {
        Row row{{curve.kernel.name}};
        std::uint64_t not_finite = 0;
        for (const DriftPoint& p : curve.points) {
            row.cells.emplace_back(p.cases == 0 ? "-" : brief(p.worst_ulp));
            not_finite += p.not_finite;
        }
        row.cells.emplace_back(not_finite == 0 ? "" : fmt::format("and {} cases without a finite value", not_finite));
        table.rows.push_back(std::move(row));
    }
    d.table(std::move(table));
    d.data = record("schema", audit_schema, "environment", measure_environment(), MEMBERS(r, seed, count), "kernels",
                    list(r.curves, [](const DriftCurve& curve) {
                        return record("name", curve.kernel.name, "sizes", list(curve.points, [](const DriftPoint& p) {
                                          return record(MEMBERS(p, size, cases, not_finite, worst_ulp, worst_relative),
                                                        "case", p.index);
                                      }));
                    }));
    return d;
}

Document texels_document(const std::vector<TexelResult>& results) {
    Document d;
    Listing table{.columns = {left("rule", 22), left("wrap", 7), right("cases", 7), right("past\nthe end", 9),
                              right("before\nthe start", 9), right("wrong\ntexel", 9)}};
    std::vector<Item> items;
    Json rules = Json::array();
    for (const TexelResult& r : results) {
        const bool clean = r.counts[0] + r.counts[1] + r.counts[2] == 0;
        table.rows.push_back({{r.rule.name, std::string(name(r.rule.wrap)), brief_count(r.cases),
                               brief_count(r.counts[0]), brief_count(r.counts[1]), brief_count(r.counts[2])},
                              clean                            ? Tone::good
                              : r.counts[0] + r.counts[1] != 0 ? Tone::bad
                                                               : Tone::plain});
        Item item{.title = r.rule.name, .text = ": " + r.rule.formula};
        Json rule = record(MEMBERS(r.rule, name, wrap, formula, source, fails), "cases", r.cases);
        Json witnesses = Json::array();
        for (std::size_t f = 0; f < r.counts.size(); ++f) {
            const TexelWitness& w = r.witnesses[f];
            put(rule, texel_finding_names[f], r.counts[f]);
            if (r.counts[f] == 0) continue;
            item.lines.push_back(
                {fmt::format("{}: u = {} ({}) in a row of {}: texel {}, exactly {}", texel_finding_names[f],
                             base::shortest(w.u), base::hexadecimal(w.u), w.size, w.texel, w.exact)});
            witnesses.push_back(
                record("finding", texel_finding_names[f], "u", base::hexadecimal(w.u), MEMBERS(w, size, texel, exact)));
        }
        if (clean) item.lines.push_back({"no finding"});
        items.push_back(std::move(item));
        put(rule, "witnesses", witnesses);
        rules.push_back(std::move(rule));
    }
    d.add(std::move(table));
    d.part();
    for (Item& item : items) d.add(std::move(item));
    d.data = record("schema", audit_schema, "rules", rules);
    return d;
}

}  // namespace

std::string gaps_text(const GapsReport& report, const TerminalStyle& style) {
    return written_text([&] { return gaps_document(report); }, style.colour);
}

std::string gaps_json(const GapsReport& report) {
    return written_json([&] { return gaps_document(report); }, 1);
}

std::string drift_text(const DriftReport& report, const TerminalStyle& style) {
    return written_text([&] { return drift_document(report); }, style.colour);
}

std::string drift_json(const DriftReport& report) {
    return written_json([&] { return drift_document(report); }, 1);
}

std::string texels_text(const std::vector<TexelResult>& results, const TerminalStyle& style) {
    return written_text([&] { return texels_document(results); }, style.colour);
}

std::string texels_json(const std::vector<TexelResult>& results) {
    return written_json([&] { return texels_document(results); }, 1);
}

}  // namespace barycert
