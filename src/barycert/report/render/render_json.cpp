#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/notes_json.hpp"
#include "barycert/report/render/render_words.hpp"

namespace barycert {
namespace {

using Json = nlohmann::ordered_json;

Json triangles_json(const RenderCounts& n) {
    Json j;
    j["count"] = n.triangles;
    j["drawn"] = n.drawn;
    j["outside"] = n.outside;
    j["degenerate"] = n.degenerate;
    j["between_pixels"] = n.between_pixels;
    j["clipped"] = n.clipped;
    return j;
}

Json pixels_json(const RenderCounts& n) {
    Json j;
    j["count"] = n.pixels;
    j["covered"] = n.covered;
    j["hidden"] = n.hidden;
    return j;
}

Json colours_json(const ColourRange& c) {
    Json j;
    j["field"] = c.field;
    j["low"] = report::figure(c.low);
    j["high"] = report::figure(c.high);
    j["without_value"] = c.without_value;
    return j;
}

Json texel_error_json(const TexelError& e) {
    Json j;
    j["texels"] = report::figure(e.texels);
    j["column"] = e.column;
    j["row"] = e.row;
    return j;
}

}  // namespace

std::string render_json(const RenderReport& summary, const Environment& environment) {
    const ExactEnvironment exact;
    Json j;
    j["schema"] = render_schema;
    j["picture"] = summary.picture;
    j["input"] = summary.input;
    if (summary.picture == "mesh") j["curved"] = report::curved_json(summary.curved);
    j["output"] = summary.output;
    j["width"] = summary.size.width;
    j["height"] = summary.size.height;
    j["method"] = report::word(summary.method);
    j["interpolation"] = report::word(summary.interpolation);
    j["rounding"] = report::word(summary.rounding);
    j["triangles"] = triangles_json(summary.counts);
    j["pixels"] = pixels_json(summary.counts);
    if (summary.colours) j["colours"] = colours_json(*summary.colours);
    if (summary.texel_error) j["texel_error"] = texel_error_json(*summary.texel_error);
    j["notes"] = report::notes_json(summary.notes);
    j["seconds"] = summary.seconds;
    j["environment"] = report::environment_json(environment);
    return base::json_text(j, 2);
}

}  // namespace barycert
