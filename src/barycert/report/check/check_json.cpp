#include "barycert/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/check/check_words.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/not_finite.hpp"
#include "barycert/report/common/notes_json.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

Json conditions_json(const CheckReport& r, const Mesh& mesh) {
    Json list = Json::array();
    for (const ConditionRow& row : condition_rows(r, mesh)) {
        if (row.name.empty()) continue;  // what follows from the others
        // Arrays that do not make cells are no cells to look at: nothing is known of the rest.
        const bool looked_at = row.count != 0 || row.instead != "not checked";
        Json j;
        j["name"] = row.name;
        j["holds"] = looked_at ? Json(row.count == 0) : Json(nullptr);
        j["violations"] = looked_at ? Json(row.count) : Json(nullptr);
        j["at_least"] = row.at_least;
        list.push_back(std::move(j));
    }
    return list;
}

/// The entries that are in use.
Json indices(const auto& all) {
    Json j = Json::array();
    for (const Mesh::Index i : all) {
        if (i >= 0) j.push_back(i);
    }
    return j;
}

Json finding_json(const CheckReport& r, const Defect& f) {
    const DefectText& t = defect_text(f.kind);
    Json j;
    j["name"] = t.name;
    if (!t.condition.empty()) j["condition"] = t.condition;
    j["breaks"] = f.breaks();
    j["count"] = f.count;
    j["at_least"] = f.at_least;
    j["curved_cells"] = f.curved_cells;
    j["text"] = t.text;
    j["remedy"] = f.remedy();
    j["places"] = Json::array();
    for (const DefectPlace& p : f.places) {
        Json place;
        place["cells"] = indices(r.cell_number(p.cells));
        place["nodes"] = indices(p.nodes);
        if (p.other_nodes[0] >= 0) place["other_nodes"] = indices(p.other_nodes);
        if (f.kind == DefectKind::near_nodes || f.kind == DefectKind::near_hanging) {
            place["distance"] = figure(p.distance);
            place["relative"] = figure(p.relative);
        }
        if (*p.detail != '\0') place["detail"] = p.detail;
        j["places"].push_back(std::move(place));
    }
    return j;
}

Json boundary_json(const BoundaryReport& b) {
    Json j;
    j["facets"] = b.facets;
    j["pieces"] = b.pieces;
    j["closed"] = b.closed;
    j["manifold"] = b.manifold;
    j["cavities"] = b.cavities ? Json(*b.cavities) : Json(nullptr);
    j["tunnels"] = b.tunnels ? Json(*b.tunnels) : Json(nullptr);
    return j;
}

Json distribution_json(const CheckReport& r, const std::vector<double>& values) {
    const Distribution d = distribution(values);
    if (d.min_cell < 0) return nullptr;
    Json j;
    j["least"] = figure(d.min);
    j["median"] = figure(d.median);
    j["most"] = figure(d.max);
    j["least_cell"] = r.cell_number(d.min_cell);
    j["most_cell"] = r.cell_number(d.max_cell);
    return j;
}

Json measures_json(const CheckReport& r) {
    const CellMeasures& m = r.measures;
    std::vector<double> size(m.volume);
    for (double& x : size) x = std::fabs(x);
    Json j;
    j["volume"] = distribution_json(r, size);
    j["condition"] = distribution_json(r, m.condition);
    j["radius_edge"] = distribution_json(r, m.radius_edge);
    j["aspect"] = distribution_json(r, m.aspect);
    j["min_angle"] = distribution_json(r, m.min_angle);
    j["max_angle"] = distribution_json(r, m.max_angle);
    return j;
}

Json contact_json(const CheckReport& r, const CellContact& c) {
    const int d = r.dimension;
    Json j;
    j["cells"] = indices(r.cell_number(c.cells));
    j["overlap"] = c.overlap;
    j["dimension"] = std::max(c.dimension, 0);
    Json& w = j["witness"];
    w["exact"] = c.common.exact;
    for (const char* form : {"decimal", "hex", "fraction"}) w[form] = Json::array();
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        w["decimal"].push_back(base::shortest(c.common.point[k]));
        w["hex"].push_back(base::hexadecimal(c.common.point[k]));
        w["fraction"].push_back(c.common.fraction[k]);
    }
    return j;
}

Json delaunay_json(const CheckReport& r) {
    const DelaunayReport& d = *r.delaunay;
    Json j;
    j["facets"] = d.facets;
    j["violations"] = d.violations;
    j["cospherical"] = d.cospherical;
    j["worst_depth"] = figure(d.worst_depth);
    j["worst_cell"] = d.worst_cell < 0 ? Json(nullptr) : Json(r.cell_number(d.worst_cell));
    j["worst_node"] = d.worst_node < 0 ? Json(nullptr) : Json(d.worst_node);
    return j;
}

Json conformity_json(const ConformityReport& c) {
    Json j;
    j["facets"] = c.facets;
    j["exact"] = c.exact;
    j["rounded"] = c.rounded;
    j["violated"] = c.violated;
    j["missing_vertices"] = c.missing_vertices;
    j["largest_distance"] = figure(c.max_distance);
    j["relative_distance"] = figure(c.relative_distance);
    j["examples"] = Json::array();
    for (const ViolatedFacet& f : c.examples)
        j["examples"].push_back(Json{{"facet", f.facet}, {"covered", figure(f.covered)}});
    return j;
}

Json fix_json(const FixedMesh& fixed) {
    const FixReport& done = fixed.done;
    Json j;
    j["file"] = fixed.file;
    j["merged"] = Json::array();
    for (const MergedNode& m : done.merged)
        j["merged"].push_back(Json{{"node", m.node}, {"into", m.into}, {"moved", figure(m.moved)}});
    j["dropped"] = Json::array();
    for (const DroppedCell& c : done.dropped)
        j["dropped"].push_back(Json{{"cell", c.cell}, {"why", defect_text(c.why).name}});
    j["collapsed"] = done.collapsed;
    j["turned"] = done.turned;
    j["dropped_faces"] = done.dropped_faces;
    j["differing_markers"] = done.differing_markers;
    j["differing_face_markers"] = done.differing_face_markers;
    j["changed_neighbours"] = done.changed_neighbours;
    for (const auto& [name, fields] : {std::pair("fields", &done.fields), {"cell_fields", &done.cell_fields}}) {
        j[name] = Json::array();
        for (const MergedField& f : *fields)
            j[name].push_back(
                Json{{"name", f.name}, {"differ", f.differ}, {"largest_difference", figure(f.max_difference)}});
    }
    j["notes"] = notes_json(fixed.notes);
    j["verdict"] = barycert::name(fixed.after.certificate.verdict());
    j["remaining"] = Json::array();
    for (const Defect& f : fixed.after.defects) j["remaining"].push_back(finding_json(fixed.after, f));
    return j;
}

}  // namespace

std::string check_json(const CheckReport& r, const std::string& name, const Environment& environment,
                       const FixedMesh* fixed) {
    const ExactEnvironment exact;
    Json j;
    j["schema"] = check_schema;
    j["mesh"] = name;
    j["curved"] = curved_json(r.curved);
    j["verdict"] = barycert::name(r.certificate.verdict());
    j["dimension"] = r.dimension;
    j["nodes"] = r.nodes;
    j["cells"] = r.cells;
    j["notes"] = notes_json(r.notes);
    j["not_finite"] = not_finite_json(r.not_finite);
    j["conditions"] = conditions_json(r, Mesh());  // whether files came changes no count
    j["findings"] = Json::array();
    for (const Defect& f : r.defects) j["findings"].push_back(finding_json(r, f));
    j["contacts"] = Json::array();
    for (const CellContact& c : r.contacts) j["contacts"].push_back(contact_json(r, c));
    j["orientation"]["positive"] = r.positive;
    j["orientation"]["negative"] = r.negative;
    j["orientation"]["degenerate"] = r.degenerate;
    j["parts"] = r.parts;
    j["boundary"] = boundary_json(r.boundary);
    j["volume"]["cells"] = figure(r.volume.cells);
    j["volume"]["boundary"] = figure(r.volume.boundary);
    j["volume"]["equal"] = r.volume.equal;
    j["measures"] = measures_json(r);
    if (r.delaunay) j["delaunay"] = delaunay_json(r);
    if (r.conformity) j["conformity"] = conformity_json(*r.conformity);
    if (fixed != nullptr) j["fix"] = fix_json(*fixed);
    j["problem_bits"] = Json::array();
    for (const DefectText& t : defect_texts) j["problem_bits"].push_back(t.name);
    j["seconds"] = r.seconds;
    j["threads"] = r.threads;
    j["environment"] = environment_json(environment);
    return base::json_text(j, 1);
}

}  // namespace barycert
