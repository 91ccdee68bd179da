#include "barycert/audit_report.hpp"

#include <nlohmann/json.hpp>

#include "barycert/base/json_text.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/environment_json.hpp"

namespace barycert {

using namespace report;

std::string drift_json(const DriftReport& report) {
    const ExactEnvironment environment;
    nlohmann::ordered_json j;
    j["schema"] = audit_schema;
    j["environment"] = environment_json(measure_environment());
    j["seed"] = report.seed;
    j["count"] = report.count;
    j["kernels"] = nlohmann::ordered_json::array();
    for (const DriftCurve& curve : report.curves) {
        nlohmann::ordered_json sizes = nlohmann::ordered_json::array();
        for (const DriftPoint& p : curve.points) {
            sizes.push_back({{"size", p.size},
                             {"cases", p.cases},
                             {"not_finite", p.not_finite},
                             {"worst_ulp", p.worst_ulp},
                             {"worst_relative", p.worst_relative},
                             {"case", p.index}});
        }
        j["kernels"].push_back({{"name", curve.kernel.name}, {"sizes", std::move(sizes)}});
    }
    return base::json_text(j, 1);
}

std::string texels_json(const std::vector<TexelResult>& results) {
    const ExactEnvironment environment;
    nlohmann::ordered_json j;
    j["schema"] = audit_schema;
    j["rules"] = nlohmann::ordered_json::array();
    for (const TexelResult& r : results) {
        nlohmann::ordered_json rule;
        rule["name"] = r.rule.name;
        rule["wrap"] = name(r.rule.wrap);
        rule["formula"] = r.rule.formula;
        rule["source"] = r.rule.source;
        rule["fails"] = r.rule.fails;
        rule["cases"] = r.cases;
        nlohmann::ordered_json witnesses = nlohmann::ordered_json::array();
        for (std::size_t f = 0; f < texel_finding_names.size(); ++f) {
            rule[std::string(texel_finding_names[f])] = r.counts[f];
            const TexelWitness& w = r.witnesses[f];
            if (r.counts[f] == 0) continue;
            witnesses.push_back({{"finding", texel_finding_names[f]},
                                 {"u", base::hexadecimal(w.u)},
                                 {"size", w.size},
                                 {"texel", w.texel},
                                 {"exact", w.exact}});
        }
        rule["witnesses"] = std::move(witnesses);
        j["rules"].push_back(std::move(rule));
    }
    return base::json_text(j, 1);
}

}  // namespace barycert
