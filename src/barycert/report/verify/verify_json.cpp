#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/notes_json.hpp"
#include "barycert/report/verify/verify_words.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

Json errors_json(const VerifyReport& s, std::size_t c) {
    const ValueErrors& e = s.verdicts.columns[c];
    Json j;
    j["name"] = s.columns[c];
    j["column"] = s.found_in[c];
    j["range"] = s.ranges[c];
    j["relative_to"] = name(s.relative_to[c]);
    j["compared"] = e.values;
    j["identical"] = e.identical;
    j["over"] = e.over;
    j["missing"] = e.missing;
    j["spurious"] = e.spurious;
    j["max_ulps"] = figure(e.max_ulps);
    j["max_error"] = figure(e.max_relative);
    j["by_ulps"] = e.by_ulps;
    j["by_error"] = e.by_relative;
    return j;
}

Json example_json(const VerifyReport& s, const WrongRow& row) {
    Json j;
    j["verdict"] = name(row.verdict);
    j["row"] = row.row;
    j["point"] = std::vector<double>(row.point.begin(), row.point.begin() + s.dimension);
    j["cell"] = row.exact.cell < 0 ? Json() : Json(row.exact.cell);
    j["feature"] = name(row.exact.feature);
    if (row.verdict == RowVerdict::invented) j["distance"] = figure(row.distance);
    if (!s.cell_column.empty()) j["claimed_cell"] = row.claimed_cell < 0 ? Json() : Json(row.claimed_cell);
    if (!s.columns.empty()) {
        j["column"] = s.columns[row.column];
        j["claimed"] = figure(row.claimed);
        j["value"] = figure(row.value);
        j["ulps"] = figure(row.ulps);
        j["error"] = figure(row.relative);
    }
    j["command"] = example_command(s, row);
    return j;
}

}  // namespace

std::string verify_json(const VerifyReport& s, const Environment& environment) {
    const ExactEnvironment exact;
    const Verdicts& v = s.verdicts;
    Json j;
    j["schema"] = verify_schema;
    j["command"] = "verify";
    j["mesh"] = s.mesh;
    j["results"] = s.results;
    j["curved"] = curved_json(s.curved);
    j["dimension"] = s.dimension;
    j["nodes"] = s.nodes;
    j["cells"] = s.cells;
    j["certified"] = s.certified;
    j["contested_cells"] = s.contested_cells;
    j["cell_column"] = s.cell_column.empty() ? Json() : Json(s.cell_column);
    j["mask_column"] = s.mask_column.empty() ? Json() : Json(s.mask_column);
    j["tolerance"] = s.tolerance;
    j["exact"] = s.exact;
    j["outside_value"] = s.outside_value ? Json(*s.outside_value) : Json();
    j["rows"] = v.rows;
    j["right"] = v.right;
    j["missed"] = v.missed;
    j["invented"] = v.invented;
    j["wrong_cell"] = v.wrong_cell;
    j["wrong_value"] = v.wrong_value;
    j["inside"] = v.inside;
    j["outside"] = v.outside;
    j["not_finite"] = v.not_finite;
    j["on_boundary"] = v.on_boundary;
    j["missed_on_boundary"] = v.missed_on_boundary;
    j["invented_zero"] = v.invented_zero;
    j["invented_measured"] = v.invented_measured;
    j["invented_near"] = v.invented_near;
    j["invented_distance"] = figure(v.invented_distance);
    j["by_other_cell"] = v.by_other_cell;
    j["values"] = Json::array();
    for (std::size_t c = 0; c < s.columns.size(); ++c) j["values"].push_back(errors_json(s, c));
    j["examples"] = Json::array();
    for (const WrongRow& row : v.examples) j["examples"].push_back(example_json(s, row));
    j["notes"] = notes_json(s.notes);
    Json seconds;
    seconds["mesh"] = s.seconds.mesh;
    seconds["build"] = s.seconds.build;
    seconds["read"] = s.seconds.read;
    seconds["compare"] = s.seconds.sample;
    seconds["total"] = s.seconds.total;
    j["seconds"] = seconds;
    j["threads"] = s.threads;
    j["environment"] = environment_json(environment);
    return base::json_text(j, 2);
}

}  // namespace barycert
