// What programs read of audits, of the catalogue and of the families.

#include "barycert/audit/json_members.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/audit_words.hpp"

namespace barycert {

using namespace report;

namespace {

void put_statistics(Json& j, const KernelStatistics& s) {
    put(j, "cases", s.cases, "wrong_cases", s.wrong_cases, "not_run", s.not_run);
    for (std::size_t f = 0; f < finding_count; ++f) put(j, finding_texts[f].name, s.counts[f]);
    put(j, "worst_error", magnitude(s.errors.worst.value), "by_error", s.errors.counts, "worst_weight_ulp",
        magnitude(s.weight_ulp.value), "p999_weight_ulp", magnitude(s.p999_weight_ulp()), "worst_value_ulp",
        magnitude(s.value_ulp.value), "p999_value_ulp", magnitude(s.p999_value_ulp()), "worst_partition_residual",
        magnitude(s.partition_residual.value), "worst_reproduction_residual", magnitude(s.reproduction_residual.value));
    Json& confusion = j["confusion"];
    for (const Region exact : all_regions) {
        for (const Region claimed : all_regions) {
            confusion[std::string(name(exact))][std::string(name(claimed))] =
                s.confusion[static_cast<std::size_t>(exact)][static_cast<std::size_t>(claimed)];
        }
    }
}

Json prediction_json(const Prediction& p) {
    return record("cases", p.cases(), "worst_factor", magnitude(p.worst_factor()), "bins",
                  list(p.bins(), [](const Prediction::Bin& bin) {
                      return record("bits", bin.bits, "cases", bin.cases, "median_error", magnitude(bin.median),
                                    "worst_error", magnitude(bin.worst));
                  }));
}

Json kernel_json(const Kernel& k) {
    Json j = record("name", k.name, "simplex", name(k.simplex), "perspective", k.perspective, "formula", k.formula,
                    "source", k.source, "fails", k.fails, "declares_degenerate", k.declares_degenerate, "certifies",
                    k.certifies, "contained", k.host != nullptr, "region_rule",
                    k.rule == RegionRule::sign  ? "sign"
                    : k.rule == RegionRule::own ? "own"
                                                : "tolerant");
    if (k.rule == RegionRule::tolerant) put(j, "tolerance", k.tolerance);
    return j;
}

Json family_json(const Family& f) {
    return record("name", f.name, "after", f.tests, "parameters", f.parameters, "needs_mesh", f.needs_mesh, "simplices",
                  list(f.simplices, [](Simplex s) { return Json(name(s)); }), "perspective", f.perspective);
}

Json result_json(const AuditReport& r, const KernelResult& k) {
    Json j = kernel_json(k.kernel);
    put_statistics(j, k.total);
    put(j, "ns", magnitude(k.ns), "prediction", prediction_json(k.prediction), "families",
        list(k.families, [&](const FamilyResult& f) {
            Json part = record("name", r.families[f.family].name);
            put_statistics(part, f.statistics);
            return part;
        }));
    return j;
}

}  // namespace

std::string audit_json(const AuditReport& r) {
    const ExactEnvironment environment;
    Json regions, witnesses = Json::array();
    for (const Region region : all_regions) put(regions, name(region), r.regions[static_cast<std::size_t>(region)]);
    for (const KernelResult& k : r.kernels) {
        for (const Witness& w : k.witnesses) witnesses.push_back(audit::witness_json(w));
    }
    const Json j = record(
        "schema", audit_schema, "environment", environment_json(r.environment), "seed", r.seed, "count", r.count,
        "threads", r.threads, "meshes", r.meshes, "verdicts", list(r.verdicts, [](Verdict v) { return Json(name(v)); }),
        "curved", list(r.curved, curved_json), "cases", r.cases, "regions", regions, "oracles",
        oracles_json(r.oracle, r.oracles), "seconds", r.seconds, "families", list(r.families, family_json), "kernels",
        list(r.kernels, [&](const KernelResult& k) { return result_json(r, k); }), "witnesses", witnesses);
    return base::json_text(j, 1);
}

std::string kernels_json(const std::vector<Kernel>& kernels) {
    const Json j = record("schema", audit_schema, "kernels", list(kernels, kernel_json));
    return base::json_text(j, 1);
}

std::string families_json(const std::vector<Family>& families) {
    const Json j = record("schema", audit_schema, "families", list(families, family_json));
    return base::json_text(j, 1);
}

}  // namespace barycert
