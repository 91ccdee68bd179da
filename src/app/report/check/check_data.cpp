// The report on a mesh as programs read it, and what systems that run checks are told.
#include "app/report/check/check_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/check/check_words.hpp"
#include "app/report/common/json.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/report.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

JSON_OF(BoundaryReport, facets, pieces, closed, manifold, cavities, tunnels)
JSON_OF(VolumeReport, cells, boundary, equal)
JSON_OF(ViolatedFacet, facet, covered)
JSON_OF(MergedNode, node, into, moved)
JSON_OF(SurfaceRegion, volume, shell, hole)

inline Json index_or_null(std::int64_t i) {
    return i < 0 ? Json() : Json(i);
}
inline void to_json(Json& j, const PlcSeed& s) {
    put(j, MEMBERS(s, hole, number), "region", index_or_null(s.region), "facet", index_or_null(s.facet));
}
inline void to_json(Json& j, const SurfaceShell& s) {
    put(j, MEMBERS(s, triangles, closed, volume, area), "inside", index_or_null(s.inside), MEMBERS(s, first));
}

inline void to_json(Json& j, const DroppedCell& c) {
    put(j, MEMBERS(c, cell), "why", defect_text(c.why).name);
}

inline void to_json(Json& j, const MergedField& f) {
    put(j, MEMBERS(f, name, differ), "largest_difference", f.max_difference);
}

namespace {

Json conditions_json(const CheckReport& r) {
    Json all = Json::array();
    for (const ConditionRow& row : condition_rows(r, Mesh())) {  // whether files came changes no count
        if (row.name.empty()) continue;                          // what follows from the others
        // Arrays that do not make cells are no cells to look at: nothing is known of the rest.
        const bool looked_at = row.count != 0 || row.instead != "not checked";
        all.push_back(record("name", row.name, "holds", looked_at ? Json(row.count == 0) : Json(), "violations",
                             looked_at ? Json(row.count) : Json(), "at_least", row.at_least));
    }
    return all;
}

/// The entries that are in use.
Json indices(const auto& all) {
    Json j = Json::array();
    for (const Mesh::Index i : all) {
        if (i >= 0) j.push_back(i);
    }
    return j;
}

Json place_json(const CheckReport& r, DefectKind kind, const DefectPlace& p) {
    Json j = record("cells", indices(r.cell_number(p.cells)), "nodes", indices(p.nodes));
    if (p.other_nodes[0] >= 0) put(j, "other_nodes", indices(p.other_nodes));
    if (kind == DefectKind::near_nodes || kind == DefectKind::near_hanging) put(j, MEMBERS(p, distance, relative));
    if (*p.detail != '\0') put(j, "detail", p.detail);
    if (p.point) put(j, "point", *p.point);
    return j;
}

Json defects_json(const CheckReport& r) {
    return list(r.defects, [&](const Defect& f) {
        const DefectText& t = defect_text(f.kind);
        Json j = record("name", t.name);
        if (!t.condition.empty()) put(j, "condition", t.condition);
        put(j, "breaks", f.breaks(), "severity", severity(f), MEMBERS(f, count, at_least, curved_cells), "text", t.text,
            "remedy", f.remedy(), "places",
            list(f.places, [&](const DefectPlace& p) { return place_json(r, f.kind, p); }));
        return j;
    });
}

Json contact_json(const CheckReport& r, const CellContact& c) {
    const auto point = std::span(c.common.point).first(static_cast<std::size_t>(r.dimension));
    const std::vector fraction(c.common.fraction.begin(), c.common.fraction.begin() + r.dimension);
    return record("cells", indices(r.cell_number(c.cells)), "overlap", c.overlap, "dimension", std::max(c.dimension, 0),
                  "witness",
                  record("exact", c.common.exact, "decimal", list(point, base::shortest), "hex",
                         list(point, base::hexadecimal), "fraction", fraction));
}

Json measures_json(const CheckReport& r, const MeasureDistributions& measures) {
    Json all;
    for (const auto& [name, of] : cell_measures) {
        const Distribution& d = measures.of(of);
        put(all, name,
            d.min_cell < 0 ? Json()
                           : record("least", d.min, "median", d.median, "most", d.max, "least_cell",
                                    r.cell_number(d.min_cell), "most_cell", r.cell_number(d.max_cell)));
    }
    return all;
}

Json fix_json(const FixedMesh& fixed) {
    const FixReport& done = fixed.done;
    return record(MEMBERS(fixed, file),
                  MEMBERS(done, merged, dropped, collapsed, turned, dropped_faces, differing_markers,
                          differing_face_markers, changed_neighbours, fields, cell_fields),
                  MEMBERS(fixed, notes), "verdict", fixed.after.certificate.verdict(), "remaining",
                  defects_json(fixed.after));
}

/// "40 text: place; place; and 38 more. Remedy: remedy".
std::string defect_message(const CheckReport& r, const Defect& d) {
    constexpr std::size_t most_places = 10;
    std::vector<std::string> places;
    for (const DefectPlace& place : std::span(d.places).first(std::min(d.places.size(), most_places)))
        places.push_back(place_text(r, d.kind, place));
    if (!places.empty() && d.count > places.size())
        places.push_back(fmt::format("and {} more", d.count - places.size()));
    return fmt::format("{}{} {}{}{}{}{}", d.at_least ? "at least " : "", d.count, defect_text(d.kind).text,
                       places.empty() ? "" : ": ", fmt::join(places, "; "),
                       d.curved_cells == 0 ? "" : ". " + curved_text(d),
                       d.remedy().empty() ? "" : fmt::format(". Remedy: {}", d.remedy()));
}

}  // namespace

report::MeasureDistributions::MeasureDistributions(const CheckReport& r) {
    if (r.surface) return;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        std::vector<double> values(r.measures.*cell_measures[i].second);
        for (double& x : values) x = std::fabs(x);  // only volumes have a sign
        all_[i] = distribution(values);
    }
}

const Distribution& report::MeasureDistributions::of(std::vector<double> CellMeasures::*measure) const {
    std::size_t i = 0;
    while (cell_measures[i].second != measure) ++i;
    return all_[i];
}

Json report::check_data(const CheckReport& r, const MeasureDistributions& measures, const std::string& name,
                        const Environment& environment, const FixedMesh* fixed) {
    Json j =
        record("schema", check_schema, "mesh", name, MEMBERS(r, curved), "verdict", r.certificate.verdict(),
               MEMBERS(r, dimension, nodes, cells, notes, not_finite), "conditions", conditions_json(r), "findings",
               defects_json(r), "contacts", list(r.contacts, [&](const CellContact& c) { return contact_json(r, c); }),
               "orientation", record(MEMBERS(r, positive, negative, degenerate)), MEMBERS(r, parts, boundary, volume),
               "measures", measures_json(r, measures));
    if (r.shapes != 0) put(j, MEMBERS(r, shapes));
    if (r.maps) {
        const MapReport& m = *r.maps;
        put(j, "maps",
            record(MEMBERS(m, cells, positive, negative, changing, unknown), "examples",
                   list(m.examples, [&](Mesh::Index cell) { return Json(r.cell_number(cell)); }),
                   MEMBERS(m, curved_facets, split_facets, max_gap, warped_sides, split_sides), "split",
                   list(m.split, [&](const auto& cells) { return Json(r.cell_number(cells)); }), "split_at_sides",
                   list(m.split_at_sides, [&](const auto& cells) { return Json(r.cell_number(cells)); })));
    }
    if (const auto& s = r.surface) {
        for (const char* of_cells : {"orientation", "parts", "boundary", "volume", "measures"}) j.erase(of_cells);
        put(j, "surface",
            record("kind", s->plc ? "plc" : "triangles",
                   MEMBERS(*s, facets, edges, places, closed, manifold, oriented, outward, shell_count, shells, regions,
                           seeds, off_plane, max_off_plane, relative_off_plane),
                   "tetgen", tetgen_sentence(r)));
    }
    if (const auto& d = r.delaunay) {
        put(j, "delaunay",
            record(MEMBERS(*d, facets, violations, cospherical, worst_depth), "worst_cell",
                   index_or_null(r.cell_number(d->worst_cell)), "worst_node", index_or_null(d->worst_node)));
    }
    if (const auto& c = r.conformity)
        put(j, "conformity",
            record(MEMBERS(*c, facets, exact, rounded, violated, missing_vertices), "largest_distance", c->max_distance,
                   MEMBERS(*c, relative_distance, examples)));
    if (fixed != nullptr) put(j, "fix", fix_json(*fixed));
    put(j, "problem_bits", list(defect_texts, [](const DefectText& t) { return t.name; }), MEMBERS(r, seconds, threads),
        "environment", environment);
    return j;
}

CiReport check_outcomes(const CheckReport& r, const Mesh& mesh, const std::string& name, const std::string& artifact,
                        const Environment& environment) {
    const ExactEnvironment exact;
    using State = CiOutcome::State;
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
    if (r.delaunay && r.delaunay->violations != 0)
        add("not_delaunay", "not_delaunay", "interior facets that are not locally Delaunay", State::noted,
            fmt::format("{}", fmt::join(delaunay_sentences(r), "; ")));
    if (r.conformity && r.conformity->violated != 0)
        add("violated_facet", "violated_facet", "facets of the PLC that are no union of faces of cells", State::noted,
            fmt::format("{}", fmt::join(conformity_sentences(r, 80), "; ")));
    if (!r.certified() && !ci.failed())
        add("certified", "certified", "the mesh is certified to be a partition", State::failed, "it is not certified");
    return ci;
}

}  // namespace barycert
