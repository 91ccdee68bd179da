#include "barycert/audit_report.hpp"

#include <nlohmann/json.hpp>

#include "barycert/audit/witness_json.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"
#include "barycert/report/common/notes_json.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

void add_statistics(Json& j, const KernelStatistics& s) {
    j["cases"] = s.cases;
    j["wrong_cases"] = s.wrong_cases;
    j["not_run"] = s.not_run;
    for (std::size_t f = 0; f < finding_count; ++f) j[std::string(finding_texts[f].name)] = s.counts[f];
    j["worst_error"] = magnitude(s.errors.worst.value);
    j["by_error"] = s.errors.counts;
    j["worst_weight_ulp"] = magnitude(s.weight_ulp.value);
    j["p999_weight_ulp"] = magnitude(s.p999_weight_ulp());
    j["worst_value_ulp"] = magnitude(s.value_ulp.value);
    j["p999_value_ulp"] = magnitude(s.p999_value_ulp());
    j["worst_partition_residual"] = magnitude(s.partition_residual.value);
    j["worst_reproduction_residual"] = magnitude(s.reproduction_residual.value);
    Json& confusion = j["confusion"];
    for (const Region exact : all_regions) {
        for (const Region claimed : all_regions) {
            confusion[std::string(name(exact))][std::string(name(claimed))] =
                s.confusion[static_cast<std::size_t>(exact)][static_cast<std::size_t>(claimed)];
        }
    }
}

Json prediction_json(const Prediction& p) {
    Json j;
    j["cases"] = p.cases();
    j["worst_factor"] = magnitude(p.worst_factor());
    j["bins"] = Json::array();
    for (const Prediction::Bin& bin : p.bins()) {
        Json b;
        b["bits"] = bin.bits;
        b["cases"] = bin.cases;
        b["median_error"] = magnitude(bin.median);
        b["worst_error"] = magnitude(bin.worst);
        j["bins"].push_back(std::move(b));
    }
    return j;
}

Json kernel_json(const Kernel& k) {
    Json j;
    j["name"] = k.name;
    j["simplex"] = name(k.simplex);
    j["perspective"] = k.perspective;
    j["formula"] = k.formula;
    j["source"] = k.source;
    j["fails"] = k.fails;
    j["declares_degenerate"] = k.declares_degenerate;
    j["certifies"] = k.certifies;
    j["contained"] = k.host != nullptr;
    j["region_rule"] = k.rule == RegionRule::sign ? "sign" : k.rule == RegionRule::own ? "own" : "tolerant";
    if (k.rule == RegionRule::tolerant) j["tolerance"] = k.tolerance;
    return j;
}

Json family_json(const Family& f) {
    Json j;
    j["name"] = f.name;
    j["after"] = f.tests;
    j["parameters"] = f.parameters;
    j["needs_mesh"] = f.needs_mesh;
    j["simplices"] = Json::array();
    for (const Simplex s : f.simplices) j["simplices"].push_back(name(s));
    j["perspective"] = f.perspective;
    return j;
}

Json list(const auto& items, auto convert) {
    Json j = Json::array();
    for (const auto& item : items) j.push_back(convert(item));
    return j;
}

}  // namespace

std::string audit_json(const AuditReport& r) {
    const ExactEnvironment environment;
    Json j;
    j["schema"] = audit_schema;
    j["environment"] = environment_json(r.environment);
    j["seed"] = r.seed;
    j["count"] = r.count;
    j["threads"] = r.threads;
    j["meshes"] = r.meshes;
    j["verdicts"] = list(r.verdicts, [](Verdict v) { return Json(name(v)); });
    j["curved"] = list(r.curved, curved_json);
    j["cases"] = r.cases;
    for (const Region region : all_regions)
        j["regions"][std::string(name(region))] = r.regions[static_cast<std::size_t>(region)];
    j["oracles"] = oracles_json(r.oracle, r.oracles);
    j["seconds"] = r.seconds;
    j["families"] = list(r.families, family_json);
    j["kernels"] = Json::array();
    Json witnesses = Json::array();
    for (const KernelResult& k : r.kernels) {
        Json entry = kernel_json(k.kernel);
        add_statistics(entry, k.total);
        entry["ns"] = magnitude(k.ns);
        entry["prediction"] = prediction_json(k.prediction);
        entry["families"] = Json::array();
        for (const FamilyResult& f : k.families) {
            Json part;
            part["name"] = r.families[f.family].name;
            add_statistics(part, f.statistics);
            entry["families"].push_back(std::move(part));
        }
        j["kernels"].push_back(std::move(entry));
        for (const Witness& w : k.witnesses) witnesses.push_back(audit::witness_json(w));
    }
    j["witnesses"] = std::move(witnesses);
    return base::json_text(j, 1);
}

std::string kernels_json(const std::vector<Kernel>& kernels) {
    Json j;
    j["schema"] = audit_schema;
    j["kernels"] = list(kernels, kernel_json);
    return base::json_text(j, 1);
}

std::string families_json(const std::vector<Family>& families) {
    Json j;
    j["schema"] = audit_schema;
    j["families"] = list(families, family_json);
    return base::json_text(j, 1);
}

}  // namespace barycert
