#include "names.hpp"

#include "barycert/audit.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/kernels.hpp"

namespace barycert::cli {

std::vector<std::string> kernel_names() {
    return names_of(kernels_matching("*"));
}

std::vector<std::string> family_names() {
    return names_of(families_matching("*"));
}

std::vector<std::string> simplex_names() {
    return names_of(all_simplices);
}

std::vector<std::string> reason_names() {
    std::vector<std::string> names;
    for (std::size_t reason = 0; reason < witness_reasons; ++reason) names.emplace_back(reason_name(reason));
    return names;
}

std::vector<std::string> claim_rule_names() {
    return names_of(all_claim_rules);
}

std::vector<std::string> claim_fault_names() {
    std::vector<std::string> names;
    for (std::size_t fault = 0; fault < claim_fault_count; ++fault)
        names.emplace_back(name(static_cast<ClaimFault>(fault)));
    return names;
}

}  // namespace barycert::cli
