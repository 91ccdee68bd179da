#include "names.hpp"

#include "barycert/audit.hpp"
#include "barycert/audit_findings.hpp"
#include "barycert/audit_gaps.hpp"
#include "barycert/kernels.hpp"

namespace barycert::cli {

std::vector<std::string> kernel_names() {
    std::vector<std::string> names;
    for (const Kernel& kernel : kernels_matching("*")) names.push_back(kernel.name);
    return names;
}

std::vector<std::string> family_names() {
    std::vector<std::string> names;
    for (const Family& family : families_matching("*")) names.push_back(family.name);
    return names;
}

std::vector<std::string> simplex_names() {
    std::vector<std::string> names;
    names.reserve(all_simplices.size());
    for (const Simplex simplex : all_simplices) names.emplace_back(name(simplex));
    return names;
}

std::vector<std::string> reason_names() {
    std::vector<std::string> names;
    for (std::size_t reason = 0; reason < witness_reasons; ++reason) names.emplace_back(reason_name(reason));
    return names;
}

std::vector<std::string> claim_rule_names() {
    std::vector<std::string> names;
    names.reserve(all_claim_rules.size());
    for (const ClaimRule rule : all_claim_rules) names.emplace_back(name(rule));
    return names;
}

std::vector<std::string> claim_fault_names() {
    std::vector<std::string> names;
    for (std::size_t fault = 0; fault < claim_fault_count; ++fault)
        names.emplace_back(name(static_cast<ClaimFault>(fault)));
    return names;
}

}  // namespace barycert::cli
