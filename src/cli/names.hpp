/// Names that options take, of kernels, families and what else the audit knows by name.
#pragma once

#include <string>
#include <vector>

namespace barycert::cli {

/// Of each item its name, a member or name(item).
template <class Items>
std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const auto& item : items) {
        if constexpr (requires { item.name; })
            names.push_back(item.name);
        else
            names.emplace_back(name(item));
    }
    return names;
}

/// All of the catalogue, in its order.
std::vector<std::string> kernel_names();
std::vector<std::string> family_names();

std::vector<std::string> simplex_names();
std::vector<std::string> reason_names();      ///< of witnesses
std::vector<std::string> claim_rule_names();  ///< of `barycert gaps`
std::vector<std::string> claim_fault_names();

}  // namespace barycert::cli
