#include "barycert/audit_search.hpp"

#include <nlohmann/json.hpp>

#include "barycert/audit/witness_json.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/environment.hpp"

namespace barycert {

std::string witnesses_json(const SearchReport& report) {
    const ExactEnvironment environment;
    nlohmann::ordered_json out;
    out["schema"] = witness_schema;
    out["witnesses"] = nlohmann::ordered_json::array();
    for (const SearchFind& f : report.finds) out["witnesses"].push_back(audit::witness_json(f.plain));
    return base::json_text(out, 1);
}

}  // namespace barycert
