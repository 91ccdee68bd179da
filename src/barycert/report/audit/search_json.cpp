#include <nlohmann/json.hpp>

#include "barycert/audit/witness_json.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/json_figure.hpp"

namespace barycert {

using namespace report;

std::string search_json(const SearchReport& r) {
    using Json = nlohmann::ordered_json;
    const ExactEnvironment environment;
    Json j;
    j["schema"] = audit_schema;
    j["environment"] = environment_json(r.environment);
    j["kernel"] = r.kernel.name;
    j["seed"] = r.seed;
    j["steps_asked"] = r.steps_asked;
    j["steps"] = r.steps;
    j["walks"] = r.walks;
    j["plain_steps"] = r.plain_steps;
    j["min_exponent"] = r.min_exponent;
    j["max_exponent"] = r.max_exponent;
    j["threads"] = r.threads;
    j["seconds"] = r.seconds;
    j["stopped"] = r.stopped;
    j["given_up"] = r.given_up;
    j["wrong_cases"] = r.wrong_cases;
    j["finds"] = Json::array();
    j["witnesses"] = Json::array();
    for (const SearchFind& f : r.finds) {
        Json find;
        find["reason"] = f.reason;
        find["cases"] = f.cases;
        find["weight_ulp"] = magnitude(f.weight_ulp);
        find["relative_error"] = magnitude(f.relative_error);
        find["found"] = audit::witness_json(f.found);
        find["plain_weight_ulp"] = magnitude(f.plain_weight_ulp);
        find["plain_relative_error"] = magnitude(f.plain_relative_error);
        find["plain_bits"] = f.plain_bits;
        j["finds"].push_back(std::move(find));
        j["witnesses"].push_back(audit::witness_json(f.plain));
    }
    return base::json_text(j, 1);
}

}  // namespace barycert
