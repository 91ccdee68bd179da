/// Names that options take, of kernels, families and what else the audit knows by name.
#pragma once

#include <string>
#include <vector>

namespace barycert::cli {

/// All of the catalogue, in its order.
std::vector<std::string> kernel_names();
std::vector<std::string> family_names();

std::vector<std::string> simplex_names();
std::vector<std::string> reason_names();      ///< of witnesses
std::vector<std::string> claim_rule_names();  ///< of `barycert gaps`
std::vector<std::string> claim_fault_names();

}  // namespace barycert::cli
