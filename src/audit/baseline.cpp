#include "barycert/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "audit/json_members.hpp"
#include "audit/recipes.hpp"  // IWYU pragma: keep: the meshes of a source
#include "barycert/audit.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"

namespace barycert {

using namespace audit;

namespace {

using Json = nlohmann::json;
using Regions = std::array<std::uint64_t, 4>;

/// As the JSON has it: the largest double stands for what is beyond.
std::vector<double> figures_of(const KernelStatistics& s) {
    std::vector<double> values;
    for (const Figure& figure : figures()) {
        const double x = figure.value(s);
        values.push_back(x >= 0 ? std::min(x, 0x1.fffffffffffffp+1023) : -1);
    }
    return values;
}

Regions regions_of(const KernelStatistics& s) {
    Regions r{};
    for (std::size_t e = 0; e < 4; ++e) r[e] = std::accumulate(s.confusion[e].begin(), s.confusion[e].end(), r[e]);
    return r;
}

BaselineEntry entry_from(const Json& j, const std::string& kernel) {
    BaselineEntry e;
    e.kernel = kernel;
    e.family = text_in(j, "name", "a family of " + kernel);
    const std::string where = kernel + " in " + e.family;
    e.cases = count_in(j, "cases", where);
    count_in(j, baseline_figures().front(), where);
    if (j.contains("not_run")) e.not_run = count_in(j, "not_run", where);
    // A figure that an older report does not have yet is none.
    for (const std::string& figure : baseline_figures())
        e.figures.push_back(j.contains(figure) ? figure_in(j, figure, where).value_or(-1) : -1);
    const Json& confusion = member(j, "confusion", where);
    for (const Region exact : all_regions) {
        const Json& row = member(confusion, std::string(name(exact)), where + ", confusion");
        for (const Region claimed : all_regions)
            e.regions[static_cast<std::size_t>(exact)] +=
                count_in(row, std::string(name(claimed)), where + ", confusion");
    }
    return e;
}

std::string in_words(std::uint64_t seed, std::uint64_t count) {
    return fmt::format("seed {} and {} cases per family and simplex", seed, count);
}

Error not_comparable(const Baseline& b, std::string expected, std::string found, std::string remedy) {
    return file_error("baseline.unfit", b.path, "the baseline is not comparable: it has other cases",
                      std::move(expected), std::move(found), std::move(remedy));
}

bool given_up(const KernelResult& k) {
    return std::ranges::any_of(k.families, [](const FamilyResult& f) { return f.statistics.not_run != 0; });
}

std::string joined(const std::vector<std::string>& words) {
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

void BaselineComparison::add(BaselineChange change) {
    if (change.after != change.before) (change.after > change.before ? worse : better).push_back(std::move(change));
}

const std::vector<std::string>& baseline_figures() {
    static const std::vector<std::string> names = names_of(figures());
    return names;
}

Result<Baseline> read_baseline(const std::string& path) {
    const ExactEnvironment environment;
    constexpr const char* remedy = "make one with `barycert audit --json FILE`";
    const JsonFile file{"cannot read the baseline", "not a baseline", "the baseline", remedy, "", remedy};
    return made_of_json(path, file, [&](const Json& all) {
        Baseline b;
        b.path = path;
        b.seed = count_in(all, "seed", "the baseline");
        b.count = count_in(all, "count", "the baseline");
        for (const Json& mesh : list_in(all, "meshes", "the baseline"))
            b.meshes.push_back(mesh.is_string() ? mesh.get<std::string>() : mesh.dump());
        for (const Json& kernel : list_in(all, "kernels", "the baseline")) {
            const std::string name = text_in(kernel, "name", "a kernel of the baseline");
            for (const Json& family : list_in(kernel, "families", name)) b.entries.push_back(entry_from(family, name));
        }
        return b;
    });
}

Status check_comparable(const Baseline& b, const AuditOptions& options, const MeshSource& meshes) {
    if (b.seed != options.seed || b.count != options.count)
        return about("job.seed", not_comparable(b, in_words(options.seed, options.count), in_words(b.seed, b.count),
                                                fmt::format("give job.seed {} job.count {}, or make a new baseline",
                                                            b.seed, b.count)));
    if (std::ranges::any_of(options.families, &Family::needs_mesh)) {
        std::vector<std::string> names;
        for (const auto& m : meshes.meshes()) names.push_back(m->name);
        // A baseline without meshes has no families from meshes: there is nothing to compare them with.
        if (!b.meshes.empty() && names != b.meshes)
            return not_comparable(b, "the meshes " + joined(names), joined(b.meshes),
                                  "name the same meshes in the same order");
    }
    return Done{};
}

Result<BaselineComparison> compare_with_baseline(const AuditReport& report, const Baseline& b) {
    const ExactEnvironment environment;
    std::map<std::pair<std::string, std::string>, const BaselineEntry*> earlier;
    for (const BaselineEntry& e : b.entries) earlier[{e.kernel, e.family}] = &e;
    BaselineComparison result;
    for (const KernelResult& k : report.kernels) {
        const bool twice = given_up(k) && std::ranges::any_of(b.entries, [&](const BaselineEntry& e) {
                               return e.kernel == k.kernel.name && e.not_run != 0;
                           });
        for (const FamilyResult& f : k.families) {
            const std::string& family = report.families[f.family].name;
            const auto at = earlier.find({k.kernel.name, family});
            if (at == earlier.end()) {
                ++result.not_before;
                continue;
            }
            const BaselineEntry& before = *at->second;
            ++result.compared;
            if (before.not_run != 0 || f.statistics.not_run != 0) {
                // Which cases it was asked is then another matter on each side. Given up on both, it depends on
                // threads.
                ++result.given_up;
                if (!twice)
                    result.add({k.kernel.name, family, "not_run", static_cast<double>(before.not_run),
                                static_cast<double>(f.statistics.not_run)});
                continue;
            }
            if (before.cases != f.statistics.cases || before.regions != regions_of(f.statistics))
                return not_comparable(b, "the same exact regions in " + family, "others",
                                      "a mesh, or barycert's families, have changed: make a new baseline");
            const std::vector<double> after = figures_of(f.statistics);
            for (std::size_t i = 0; i < after.size(); ++i) {
                // Where nothing could be measured, the findings tell why.
                if (before.figures[i] < 0 || after[i] < 0) continue;
                result.add({k.kernel.name, family, baseline_figures()[i], before.figures[i], after[i]});
            }
        }
    }
    if (result.compared == 0)
        return file_error("baseline.unfit", b.path,
                          "the baseline is not comparable: it has no kernel and family in common with this audit");
    result.not_now = b.entries.size() - result.compared;
    return result;
}

}  // namespace barycert
