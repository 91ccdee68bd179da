#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/check/check_words.hpp"

namespace barycert {

using namespace report;

namespace {

using State = CiOutcome::State;
constexpr std::size_t most_places = 10;

/// "40: text: place; place; and 38 more. remedy".
std::string defect_message(const CheckReport& r, const Defect& d) {
    const DefectText& t = defect_text(d.kind);
    std::string places;
    std::size_t shown = 0;
    for (const DefectPlace& place : d.places) {
        const std::string text = place_text(r, d.kind, place);
        if (text.empty() || shown == most_places) continue;
        places += (shown++ == 0 ? ": " : "; ") + text;
    }
    if (shown != 0 && d.count > shown) places += fmt::format("; and {} more", d.count - shown);
    const CheckWords words(r, CheckWords::Digits::plain);
    return fmt::format("{} {}{}{}{}", words.count_of(d), t.text, places,
                       d.curved_cells == 0 ? "" : ". " + words.curved(d),
                       d.remedy().empty() ? "" : fmt::format(". Remedy: {}", d.remedy()));
}

std::string joined(const std::vector<std::string>& sentences) {
    return fmt::format("{}", fmt::join(sentences, "; "));
}

}  // namespace

CiReport check_outcomes(const CheckReport& r, const Mesh& mesh, const std::string& name, const std::string& artifact,
                        const Environment& environment) {
    const ExactEnvironment exact;
    CiReport ci{"barycert check", "resource", environment, r.seconds};
    const auto add = [&](std::string_view what, std::string_view rule, std::string_view meaning, State state,
                         std::string message) {
        ci.outcomes.push_back(
            {name, std::string(what), std::string(rule), std::string(meaning), state, std::move(message), artifact});
    };
    for (const ConditionRow& row : condition_rows(r, mesh)) {
        if (row.count != 0 || row.instead != "ok") continue;  // its defects stand below; or it was not looked at
        add(row.name.empty() ? std::string(row.text) : fmt::format("{}: {}", row.name, row.text),
            row.name.empty() ? defect_text(DefectKind::overlapping_cells).name : row.name, row.text, State::passed, "");
    }
    for (const Defect& d : r.defects) {
        const DefectText& t = defect_text(d.kind);
        add(t.name, t.name, t.text, d.breaks() ? State::failed : State::noted, defect_message(r, d));
    }
    if (r.curved.cells != 0)
        add("curved_cells", "curved_cells", "cells whose sides are not straight", State::noted, message(r.curved));
    const CheckWords words(r, CheckWords::Digits::plain);
    if (r.delaunay && r.delaunay->violations != 0)
        add("not_delaunay", "not_delaunay", "interior facets that are not locally Delaunay", State::noted,
            joined(words.delaunay()));
    if (r.conformity && r.conformity->violated != 0)
        add("violated_facet", "violated_facet", "facets of the PLC that are no union of faces of cells", State::noted,
            joined(words.conformity(80)));
    if (!r.certified() && !ci.failed())
        add("certified", "certified", "the mesh is certified to be a partition", State::failed, "it is not certified");
    return ci;
}

}  // namespace barycert
