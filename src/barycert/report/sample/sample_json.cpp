#include "barycert/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "barycert/environment.hpp"
#include "barycert/report/common/environment_json.hpp"

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

Json outside_json(const SampleRun& run) {
    const SampleCounts& n = run.counts;
    Json j;
    j["count"] = n.locations.outside;
    j["policy"] = policy_text(run.outside);
    j["snapped"] = n.snapped;
    j["extrapolated"] = n.extrapolated;
    j["without_value"] = n.without_value;
    j["farthest"] = std::min(n.farthest, std::numeric_limits<double>::max());
    return j;
}

Json values_json(const SampleRun& run) {
    const Tiers& t = run.counts.values;
    Json j;
    j["rounding"] = run.rounding == Rounding::correct ? "correct" : "plain";
    j["filter"] = t.filter;
    j["double_double"] = t.double_double;
    j["exact"] = t.exact;
    j["nan"] = run.nan_values;
    return j;
}

Json picture_json(const SliceCounts& n) {
    const auto figure = [](double x) { return std::isnan(x) ? Json(nullptr) : Json(x); };
    Json j;
    j["low"] = figure(n.low);
    j["high"] = figure(n.high);
    j["drawn"] = n.drawn;
    j["below"] = n.below;
    j["above"] = n.above;
    return j;
}

Json seconds_json(const SampleSeconds& s) {
    Json j;
    j["mesh"] = s.mesh;
    j["certify"] = s.certify;
    j["build"] = s.build;
    j["read"] = s.read;
    j["sample"] = s.sample;
    j["write"] = s.write;
    j["total"] = s.total;
    return j;
}

}  // namespace

std::string sample_json(const SampleRun& run, const Environment& environment) {
    const ExactEnvironment exact;
    Json j;
    j["schema"] = sample_schema;
    j["command"] = run.command;
    j["mesh"] = run.mesh;
    j["dimension"] = run.dimension;
    j["nodes"] = run.nodes;
    j["cells"] = run.cells;
    j["degenerate_cells"] = run.degenerate_cells;
    j["verdict"] = name(run.verdict);
    j["from"] = name(run.from);
    if (run.grid) {
        j["grid"] = grid_json(*run.grid);
    } else {
        j["file"] = run.points;
    }
    j["output"] = run.output;
    j["columns"] = run.columns;
    j["points"] = run.counts.locations.points();
    j["rows"] = run.rows;
    j["on_boundary"] = run.all ? "all" : "lowest";
    j["inside"] = inside_json(run.counts.locations);
    j["outside"] = outside_json(run);
    j["values"] = values_json(run);
    if (run.picture) j["picture"] = picture_json(*run.picture);
    j["method"] = name(run.method);
    j["reason"] = run.reason;
    j["seconds"] = seconds_json(run.seconds);
    j["threads"] = run.threads;
    j["environment"] = environment_json(environment);
    // Names of fields and files may hold any bytes: JSON is UTF-8.
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace barycert
