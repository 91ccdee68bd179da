#include <cmath>
#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/notes_json.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

Json pixels_json(const ContourReport& s) {
    Json j;
    j["width"] = s.pixels->width;
    j["height"] = s.pixels->height;
    j["pixel"] = s.pixels->pixel;
    j["origin"] = s.pixels->origin;
    j["right"] = s.pixels->step_right;
    j["up"] = s.pixels->step_up;
    j["low"] = figure(s.picture.low);
    j["high"] = figure(s.picture.high);
    j["drawn"] = s.picture.drawn;
    j["below"] = s.picture.below;
    j["above"] = s.picture.above;
    j["outside"] = s.picture.outside;
    j["not_finite"] = s.picture.not_finite;
    return j;
}

Json view_json(const ContourReport& s) {
    Json j;
    j["width"] = s.view->width;
    j["height"] = s.view->height;
    j["colours"] = s.colours;
    j["low"] = s.colours.empty() ? Json(nullptr) : figure(s.drawn.low);
    j["high"] = s.colours.empty() ? Json(nullptr) : figure(s.drawn.high);
    j["without_value"] = s.drawn.without_value;
    return j;
}

Json cut_json(const CutCounts& n) {
    Json j;
    j["cells"] = n.cells;
    j["not_finite"] = n.not_finite;
    j["degenerate"] = n.degenerate;
    j["second_order"] = n.second_order;
    j["at_nodes"] = n.at_nodes;
    j["on_edges"] = n.on_edges;
    j["double_double"] = n.tiers.double_double;
    j["exact"] = n.tiers.exact;
    j["nan"] = n.tiers.not_finite;
    return j;
}

Json seconds_json(const ContourSeconds& s) {
    Json j;
    j["mesh"] = s.mesh;
    j["cut"] = s.cut;
    j["sample"] = s.sample;
    j["write"] = s.write;
    j["total"] = s.total;
    return j;
}

}  // namespace

std::string contour_json(const ContourReport& s, const Environment& environment) {
    const ExactEnvironment exact;
    Json j;
    j["schema"] = contour_schema;
    j["command"] = s.value ? "render iso" : "render slice";
    j["mesh"] = s.mesh;
    j["curved"] = curved_json(s.curved);
    j["dimension"] = s.dimension;
    j["nodes"] = s.nodes;
    j["cells"] = s.cells;
    j["field"] = s.field;
    j["value"] = s.value ? Json(*s.value) : Json(nullptr);
    if (s.plane) {
        j["normal"] = s.plane->normal;
        j["offset"] = s.plane->offset;
    }
    j["low"] = figure(s.low);
    j["high"] = figure(s.high);
    j["output"] = s.output;
    j["points"] = s.points;
    j["parts"] = s.parts;
    j["cut"] = cut_json(s.counts);
    j["fields"] = s.fields;
    j["left_out"] = s.file.left_out;
    j["renamed"] = s.file.renamed;
    j["notes"] = notes_json(s.notes);
    if (s.pixels) j["picture"] = pixels_json(s);
    if (s.view) j["view"] = view_json(s);
    j["seconds"] = seconds_json(s.seconds);
    j["threads"] = s.threads;
    j["environment"] = environment_json(environment);
    return base::json_text(j, 2);
}

}  // namespace barycert
