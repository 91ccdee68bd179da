#include <cmath>

#include "barycert/audit/asking.hpp"
#include "barycert/audit_search.hpp"

namespace barycert {

using namespace audit;

namespace {

/// A figure of both, and how much it tells: findings by their share of the cases, errors by the octaves between them.
struct Telling {
    MutantCatch what;
    double weight = 0;
};

/// What tells the mutant from the sound kernel in one family; no figure if nothing does.
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

const KernelResult* result_of(const AuditReport& report, const std::string& name) {
    const auto at = std::ranges::find_if(report.kernels, [&](const KernelResult& k) { return k.kernel.name == name; });
    return at == report.kernels.end() ? nullptr : &*at;
}

MutantResult judged(const Mutant& m, const AuditReport& report) {
    MutantResult r{m, 0, {}};
    const KernelResult* const mutant = result_of(report, m.kernel.name);
    const KernelResult* const sound = result_of(report, m.sound.name);
    if (mutant == nullptr || sound == nullptr) return r;
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
    const auto add = [&](const Kernel& k) {
        const auto same = [&](const Kernel& x) { return x.name == k.name; };
        if (std::ranges::none_of(options.kernels, same)) options.kernels.push_back(k);
    };
    for (const Mutant& m : mutants) {
        add(m.sound);
        add(m.kernel);
    }
    const Result<AuditReport> audit = run_audit(options, meshes);
    if (!audit) return audit.error();
    MutantReport report;
    static_cast<AuditRun&>(report) = *audit;
    for (const Mutant& m : mutants) report.mutants.push_back(judged(m, *audit));
    return report;
}

}  // namespace barycert
