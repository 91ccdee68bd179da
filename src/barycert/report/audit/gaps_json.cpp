#include <nlohmann/json.hpp>

#include "barycert/audit_report.hpp"
#include "barycert/base/json_text.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/oracle_words.hpp"
#include "barycert/report/common/environment_json.hpp"
#include "barycert/report/common/notes_json.hpp"

namespace barycert {

using namespace report;

namespace {

using Json = nlohmann::ordered_json;

void add_claims(Json& j, const ClaimCounts& c) {
    j["inside"] = c.inside;
    for (std::size_t f = 0; f + 1 < claim_fault_count; ++f) {
        const auto fault = static_cast<ClaimFault>(f);
        j[std::string(name(fault))] = c.of(fault);
    }
    j["outside"] = c.outside;
    j[std::string(name(ClaimFault::outside_claimed))] = c.of(ClaimFault::outside_claimed);
}

Json claim_witness_json(ClaimFault fault, const ClaimWitness& w, int dimension) {
    Json j;
    j["fault"] = name(fault);
    j["feature"] = name(w.feature);
    j["index"] = w.index;
    j["nodes"] = w.nodes;
    j["point"] = Json::array();
    for (int axis = 0; axis < dimension; ++axis)
        j["point"].push_back(base::hexadecimal(w.point[static_cast<std::size_t>(axis)]));
    j["holders"] = w.holders;
    j["claimants"] = w.claimants;
    return j;
}

Json claims_json(const ClaimResult& r, int dimension) {
    Json j;
    j["kernel"] = r.kernel.empty() ? Json(nullptr) : Json(r.kernel);
    j["rule"] = name(r.rule);
    j["unanswered"] = r.unanswered;
    add_claims(j, r.total());
    j["features"] = Json::array();
    for (std::size_t f = 0; f < 3; ++f) {
        if (dimension == 2 && claim_features[f] == Feature::face) continue;
        Json part;
        part["feature"] = name(claim_features[f]);
        add_claims(part, r.by_feature[f]);
        j["features"].push_back(std::move(part));
    }
    j["witnesses"] = Json::array();
    for (const auto& [fault, witness] : r.witnesses)
        j["witnesses"].push_back(claim_witness_json(fault, witness, dimension));
    return j;
}

}  // namespace

std::string gaps_json(const GapsReport& r) {
    const ExactEnvironment environment;
    Json j;
    j["schema"] = audit_schema;
    j["environment"] = environment_json(r.environment);
    j["mesh"] = r.mesh;
    j["curved"] = curved_json(r.curved);
    j["verdict"] = name(r.verdict);
    j["dimension"] = r.dimension;
    j["seed"] = r.seed;
    j["count"] = r.count;
    j["threads"] = r.threads;
    j["tolerance"] = r.tolerance;
    j["oracles"] = oracles_json(OracleChoice::automatic, r.oracles);
    j["seconds"] = r.seconds;
    j["results"] = Json::array();
    for (const ClaimResult& result : r.results) j["results"].push_back(claims_json(result, r.dimension));
    return base::json_text(j, 1);
}

}  // namespace barycert
