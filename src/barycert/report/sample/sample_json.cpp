#include "barycert/report.hpp"

#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/not_finite.hpp"
#include "barycert/report/common/notes_json.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

Json grid_json(const Grid& g) {
    Json j;
    const auto axes = [&](const auto& all) {
        Json list = Json::array();
        for (std::size_t k = 0; k < static_cast<std::size_t>(g.dimension); ++k) list.push_back(all[k]);
        return list;
    };
    j["counts"] = axes(g.counts);
    j["origin"] = axes(g.origin);
    j["spacing"] = axes(g.spacing);
    j["last"] = axes(g.last);
    return j;
}

Json inside_json(const LocationCounts& n) {
    Json j;
    j["count"] = n.inside();
    j["interior"] = n.interior;
    j["face"] = n.face;
    j["edge"] = n.edge;
    j["vertex"] = n.vertex;
    return j;
}

Json ways_json(const WayCounts& n) {
    Json j;
    j["no_cell_near"] = n.no_cell_near;
    j["walk"] = n.walk;
    j["contested"] = n.contested;
    j["candidates"] = n.candidates;
    return j;
}

Json outside_json(const SampleReport& summary) {
    const SampleCounts& n = summary.counts;
    Json j;
    j["count"] = n.locations.outside;
    j["policy"] = policy_text(summary.outside);
    j["snapped"] = n.snapped;
    j["extrapolated"] = n.extrapolated;
    j["without_value"] = n.without_value;
    j["not_finite"] = n.locations.not_finite;
    j["farthest"] = figure(n.farthest);
    return j;
}

Json values_json(const SampleReport& summary) {
    const TierCounts& t = summary.counts.values;
    Json j;
    j["rounding"] = summary.rounding == Rounding::correct ? "correct" : "plain";
    j["filter"] = t.filter;
    j["double_double"] = t.double_double;
    j["exact"] = t.exact;
    j["nan"] = summary.nan_values;
    return j;
}

Json picture_json(const SliceCounts& n) {
    Json j;
    j["low"] = figure(n.low);
    j["high"] = figure(n.high);
    j["drawn"] = n.drawn;
    j["below"] = n.below;
    j["above"] = n.above;
    return j;
}

Json integrals_json(const std::vector<FieldIntegral>& all) {
    Json list = Json::array();
    for (const FieldIntegral& of : all) {
        Json j;
        j["column"] = of.column;
        j["source"] = figure(of.source);
        j["target"] = figure(of.target);
        j["source_left_out"] = of.source_left_out;
        j["target_left_out"] = of.target_left_out;
        list.push_back(std::move(j));
    }
    return list;
}

Json seconds_json(const SampleSeconds& s) {
    Json j;
    j["mesh"] = s.mesh;
    j["build"] = s.build;
    j["read"] = s.read;
    j["sample"] = s.sample;
    j["write"] = s.write;
    j["total"] = s.total;
    return j;
}

}  // namespace

std::string sample_json(const SampleReport& summary, const Environment& environment) {
    const ExactEnvironment exact;
    Json j;
    j["schema"] = sample_schema;
    j["command"] = summary.command;
    j["mesh"] = summary.mesh;
    j["curved"] = curved_json(summary.curved);
    if (summary.from == PointsFrom::mesh) j["onto_curved"] = curved_json(summary.onto_curved);
    j["dimension"] = summary.dimension;
    j["nodes"] = summary.nodes;
    j["cells"] = summary.cells;
    j["degenerate_cells"] = summary.degenerate_cells;
    j["contested_cells"] = summary.contested_cells;
    j["verdict"] = name(summary.verdict);
    j["from"] = name(summary.from);
    if (summary.grid) {
        j["grid"] = grid_json(*summary.grid);
    } else {
        j["file"] = summary.points;
    }
    j["output"] = summary.output;
    if (!summary.weights.empty()) j["weights"] = summary.weights;
    if (!summary.steps.empty()) j["steps"] = summary.steps;
    if (!summary.times.empty()) {
        j["times"] = summary.times;
        j["meshes"] = summary.meshes;
    }
    j["columns"] = summary.columns;
    j["carried"] = summary.carried;
    j["points"] = summary.counts.locations.points();
    j["rows"] = summary.rows;
    j["on_boundary"] = summary.all ? "all" : "lowest";
    j["inside"] = inside_json(summary.counts.locations);
    j["outside"] = outside_json(summary);
    j["values"] = values_json(summary);
    if (summary.picture) j["picture"] = picture_json(*summary.picture);
    if (!summary.integrals.empty()) j["integrals"] = integrals_json(summary.integrals);
    j["method"] = name(summary.method);
    j["reason"] = summary.reason;
    if (summary.counts.locations.ways.points() != 0) j["ways"] = ways_json(summary.counts.locations.ways);
    j["notes"] = notes_json(summary.notes);
    j["not_finite"] = not_finite_json(summary.not_finite);
    j["seconds"] = seconds_json(summary.seconds);
    j["threads"] = summary.threads;
    j["environment"] = environment_json(environment);
    return base::json_text(j, 2);
}

}  // namespace barycert
