#include "barycert/mutants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/audit.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"
#include "barycert/statistics.hpp"

namespace barycert {

using namespace audit;

namespace {

/// A figure of both, and how much it tells: findings by their share of the cases, errors by the octaves between them.
struct Telling {
    MutantCatch what;
    double weight = 0;
};

/// Finds the figure that best tells the mutant from the sound kernel in one family; no figure if none does.
Telling compare_figures(const KernelStatistics& sound, const KernelStatistics& mutant) {
    Telling best;
    const auto consider = [&](std::string_view figure, double s, double m, double weight) {
        if (weight > best.weight) best = {{"", std::string(figure), s, m}, weight};
    };
    const auto cases = static_cast<double>(mutant.cases);
    for (std::size_t f = 0; f < first_residual; ++f) {
        const auto& [name, value] = figures()[f];
        const double s = value(sound), m = value(mutant);
        // Findings go before errors, which are at most 2^1024 ulps. More of one class alone may be fewer of another:
        // more wrong cases are asked for.
        if (f >= first_error) {
            if (m > 2 * std::max(s, 0.0)) consider(name, s, m, std::log2(m) - std::log2(std::max(s, 0.5)));
        } else if (name != "not_run" && m > s && mutant.wrong_cases > sound.wrong_cases) {
            consider(name, s, m, 1e6 * (1 + (m - s) / cases));
        }
    }
    return best;
}

MutantResult judged(const Mutant& m, const AuditReport& report) {
    MutantResult r{m, 0, {}};
    const auto result_of = [&](const Kernel& of) {
        return std::ranges::find(report.kernels, of.name,
                                 [](const KernelResult& k) -> const std::string& { return k.kernel.name; });
    };
    const auto mutant = result_of(m.kernel), sound = result_of(m.sound), none = report.kernels.end();
    if (mutant == none || sound == none) return r;
    std::vector<Telling> telling;
    for (std::size_t i = 0; i < mutant->families.size(); ++i) {
        ++r.families;
        Telling t = compare_figures(sound->families[i].statistics, mutant->families[i].statistics);
        if (t.weight <= 0) continue;
        t.what.family = report.families[mutant->families[i].family].name;
        telling.push_back(std::move(t));
    }
    std::ranges::stable_sort(telling, [](const Telling& a, const Telling& b) { return a.weight > b.weight; });
    for (Telling& t : telling) r.catches.push_back(std::move(t.what));
    return r;
}

}  // namespace

std::uint64_t MutantReport::caught() const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(mutants, [](const MutantResult& r) { return !r.catches.empty(); }));
}

Result<MutantReport> audit_mutants(AuditOptions options, const MeshSource& meshes, const std::vector<Mutant>& mutants) {
    const ExactEnvironment environment;
    options.kernels.clear();
    for (const Mutant& m : mutants) {
        for (const Kernel* const k : {&m.sound, &m.kernel})
            if (std::ranges::count(options.kernels, k->name, &Kernel::name) == 0) options.kernels.push_back(*k);
    }
    const Result<AuditReport> audit = run_audit(options, meshes);
    if (!audit) return audit.error();
    MutantReport report;
    static_cast<AuditRun&>(report) = *audit;
    for (const Mutant& m : mutants) report.mutants.push_back(judged(m, *audit));
    return report;
}

}  // namespace barycert
