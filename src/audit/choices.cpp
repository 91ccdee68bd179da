// The parts of an audit, chosen by their names: kernels and families.

#include "barycert/choices.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/gaps.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/threshold.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert {

using audit::names_of;

namespace {

/// Items that match one of the globs, in the order of the catalogue.
template <class Item>
Result<std::vector<Item>> chosen(const std::vector<std::string>& globs, std::vector<Item> items, ErrorCode code,
                                 const std::string& what, std::string_view lists) {
    if (globs.empty()) return items;
    for (const std::string& glob : globs) {
        if (std::ranges::none_of(items, [&](const Item& i) { return base::glob_match(glob, i.name); }))
            return audit::unknown_name(code, "no " + what + " of that name", "", glob, names_of(items), lists);
    }
    std::erase_if(items, [&](const Item& item) {
        return std::ranges::none_of(globs, [&](const std::string& glob) { return base::glob_match(glob, item.name); });
    });
    return items;
}

/// The figure that a rule limits; nothing if a search has no such figure.
std::optional<double> figure(const SearchReport& report, const std::string& name) {
    if (name == "any" || name == "wrong_cases") return static_cast<double>(report.wrong_cases);
    const bool finding = finding_named(name).has_value();
    if (!finding && name != "worst_weight_ulp" && name != "worst_value_ulp") return std::nullopt;
    bool mute = report.given_up;
    for (const SearchFind& f : report.finds) {
        if (f.reason == name) return finding ? static_cast<double>(f.cases) : f.found.magnitude;
        mute = mute ||
               std::ranges::any_of(audit::mute_findings, [&](Finding of) { return f.reason == barycert::name(of); });
    }
    // A kernel that gave no weights where there are some has no error to measure: it is worse than any.
    return finding || !mute ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

Result<std::vector<Kernel>> choose_kernels(const KernelChoice& choice) {
    Result<std::vector<Kernel>> all = std::vector<Kernel>{};
    // With a library named and no glob, only the library's kernels are meant.
    if (!choice.names.empty() || choice.libraries.empty()) {
        all = chosen(choice.names, catalogue(), "kernel.unknown", "kernel",
                     "`barycert kernels` lists them; * and ? are wildcards");
        if (!all) return all;
    }
    for (const std::string& path : choice.libraries) {
        Result<Kernel> kernel =
            choice.in_process ? load_kernel_library(path) : load_contained_kernel(path, choice.seconds);
        if (!kernel) return kernel.error();
        if (std::ranges::find(*all, kernel->name, &Kernel::name) != all->end())
            return file_error("kernel.name", path, "two kernel libraries have the same name", "", kernel->name,
                              "set another info->name in one of them");
        all->push_back(std::move(*kernel));
    }
    for (Kernel& kernel : *all) {
        if (!choice.class_tolerance || kernel.rule != RegionRule::sign || kernel.certifies) continue;
        kernel.rule = RegionRule::tolerant;
        kernel.tolerance = *choice.class_tolerance;
    }
    return all;
}

Result<Kernel> choose_kernel(const KernelChoice& choice) {
    if (choice.names.empty() == choice.libraries.empty())
        return about("job.kernel_library",
                     file_error(choice.names.empty() ? ErrorCode("option.missing") : ErrorCode("option.conflict"), {},
                                "which kernel", "the name of one kernel, or job.kernel_library FILE",
                                choice.names.empty() ? "neither" : "both", "`barycert kernels` lists the names"));
    if (!choice.libraries.empty()) {
        const Result<std::vector<Kernel>> one = choose_kernels(choice);
        return one ? one->front() : Result<Kernel>(one.error());
    }
    const std::string& name = choice.names.front();
    const std::vector<Kernel> kernels = kernels_matching(name);
    if (kernels.size() == 1) return kernels.front();
    Error error = audit::unknown_name("kernel.unknown", "which kernel", "the name of one kernel", name,
                                      names_of(catalogue()), "`barycert kernels` lists the names");
    if (!kernels.empty()) error.found = std::to_string(kernels.size()) + " of them";
    return error;
}

Result<std::vector<Family>> choose_families(const std::vector<std::string>& names) {
    return chosen(names, all_families(), "family.unknown", "family",
                  "`barycert families` lists them; * and ? are wildcards");
}

Status check_search_rules(const std::vector<Threshold>& rules) {
    for (const Threshold& rule : rules) {
        if (!figure({}, rule.name))
            return file_error("rule.unfit", {}, "a rule on a figure that a search does not measure",
                              "any, a class of finding, worst_weight_ulp or worst_value_ulp", rule.name);
    }
    return Done{};
}

std::vector<Violation> violations(const SearchReport& report, const std::vector<Threshold>& rules) {
    std::vector<Violation> all;
    for (const Threshold& rule : rules) {
        const double value = figure(report, rule.name).value_or(0);
        if (value > rule.limit) all.push_back({report.kernel.name, rule.name, value, rule.limit});
    }
    return all;
}

Result<GapsLimit> parse_gaps_limit(std::string_view text) {
    const base::NamedLimit limit = base::named_limit(text);
    std::vector<std::string> names;
    for (std::size_t f = 0; f < claim_fault_count; ++f) names.emplace_back(name(static_cast<ClaimFault>(f)));
    const auto fault = std::ranges::find(names, limit.name) - names.begin();
    if (fault != std::ssize(names) && limit.most) return GapsLimit{static_cast<ClaimFault>(fault), *limit.most};
    return file_error("rule.unknown", {}, "unknown rule",
                      "gaps, several, wrong, wrong_first or outside_claimed, perhaps >NUMBER",
                      '"' + std::string(text) + '"', base::did_you_mean(limit.name, names));
}

}  // namespace barycert
