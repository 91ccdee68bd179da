#include "barycert/gaps.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "audit/gap_points.hpp"
#include "audit/judge.hpp"
#include "audit/kernels/channel.hpp"
#include "barycert/audit.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/workers.hpp"

namespace barycert {

using namespace audit;

namespace {

/// A kernel, or exact arithmetic, under a rule.
struct Claimant {
    const Kernel* kernel = nullptr;
    ClaimRule rule = ClaimRule::exact;
};

/// Results of one thread.
struct ThreadTally {
    std::vector<ClaimResult> results;
    OracleCounts oracles;
    std::optional<Disagreement> disagreement;
};

/// Keeps the first of two witnesses: faces, then edges, then vertices; in each by number.
void keep_first(ClaimResult& result, ClaimFault fault, const ClaimWitness& witness) {
    ClaimWitness& kept = result.witnesses.try_emplace(fault, witness).first->second;
    if (std::pair(witness.feature, witness.index) < std::pair(kept.feature, kept.index)) kept = witness;
}

class Finder {
public:
    Finder(const GapsOptions& options, const Mesh& mesh, const std::vector<Claimant>& claimants)
        : options_(options),
          mesh_(mesh),
          points_(mesh),
          claimants_(claimants),
          judge_(OracleChoice::automatic, std::ranges::none_of(claimants, [](const Claimant& c) {
                     return c.kernel != nullptr && (c.kernel->core || c.kernel->certifies);
                 })) {}

    void run(std::size_t feature, std::uint64_t index, ThreadTally& found) const {
        const GapPoint p = points_.make(claim_features[feature], options_.seed, index);
        ClaimWitness witness{claim_features[feature], index, p.nodes, p.point, {}, {}};
        std::vector<Case> cases;
        std::vector<OracleAnswer> answers;
        for (const Mesh::Index cell : p.cells) {
            cases.push_back(points_.case_of(cell, p.point));
            answers.push_back(judge_.decide(cases.back(), index, found.oracles, found.disagreement));
            if (is_inside(answers.back().region)) witness.holders.push_back(mesh_.cell_number(cell));
        }
        std::vector<Statement> said(cases.size());
        const Kernel* asked = nullptr;
        for (std::size_t k = 0; k < claimants_.size(); ++k) {
            const Claimant& who = claimants_[k];
            if (who.kernel != nullptr && who.kernel != asked) {
                ask(*who.kernel, cases, said);
                asked = who.kernel;
            }
            witness.claimants.clear();
            for (std::size_t i = 0; i < cases.size(); ++i) {
                if (who.kernel != nullptr && !said[i].answered) ++found.results[k].unanswered;
                if (claims(who, answers[i], said[i])) witness.claimants.push_back(mesh_.cell_number(p.cells[i]));
            }
            judge(found.results[k], feature, witness);
        }
    }

private:
    static void ask(const Kernel& kernel, std::span<const Case> cases, std::span<Statement> said) {
        for (std::size_t i = 0; i < cases.size(); i += kernels::batch_size) {
            const std::size_t count = std::min(kernels::batch_size, cases.size() - i);
            ask_kernel(kernel, cases.subspan(i, count), said.subspan(i, count), false);
        }
    }

    bool claims(const Claimant& who, const OracleAnswer& exact, const Statement& s) const {
        const auto by_weights = [&](const std::array<double, 4>& weights) {
            return std::all_of(weights.begin(), weights.begin() + mesh_.dimension + 1, [&](double w) {
                if (!std::isfinite(w)) return false;
                return who.rule == ClaimRule::strict  ? w > 0
                       : who.rule == ClaimRule::exact ? w >= 0
                                                      : w >= -options_.tolerance;
            });
        };
        if (who.kernel != nullptr)
            return s.answered && s.status == 0 &&
                   (who.rule == ClaimRule::own ? is_inside(s.claimed) : by_weights(s.weights));
        // Takes the exact signs, because a rounded weight may be zero where the exact one is not.
        return who.rule == ClaimRule::strict  ? exact.region == Region::interior
               : who.rule == ClaimRule::exact ? is_inside(exact.region)
                                              : by_weights(exact.weights);
    }

    static void judge(ClaimResult& result, std::size_t feature, const ClaimWitness& witness) {
        ClaimCounts& counts = result.by_feature[feature];
        const auto fault = [&](ClaimFault f) {
            ++counts.faults[static_cast<std::size_t>(f)];
            keep_first(result, f, witness);
        };
        const auto& holders = witness.holders;
        const auto& claimants = witness.claimants;
        if (holders.empty()) {
            ++counts.outside;
            if (!claimants.empty()) fault(ClaimFault::outside_claimed);
            return;
        }
        ++counts.inside;
        const auto holds = [&](Mesh::Index cell) { return std::ranges::find(holders, cell) != holders.end(); };
        if (claimants.empty()) return fault(ClaimFault::gap);
        if (claimants.size() > 1) fault(ClaimFault::several);
        if (!std::ranges::all_of(claimants, holds)) fault(ClaimFault::wrong);
        if (!holds(claimants.front())) fault(ClaimFault::wrong_first);
    }

    const GapsOptions& options_;
    const Mesh& mesh_;
    GapPoints points_;
    const std::vector<Claimant>& claimants_;
    Judge judge_;
};

void merge(ClaimResult& to, const ClaimResult& from) {
    for (std::size_t f = 0; f < 3; ++f) to.by_feature[f].add(from.by_feature[f]);
    to.unanswered += from.unanswered;
    for (const auto& [fault, witness] : from.witnesses) keep_first(to, fault, witness);
}

/// Exact arithmetic first, then the kernels, under each of the rules.
Result<std::vector<Claimant>> claimants_of(const GapsOptions& options, Simplex simplex, const std::string& mesh) {
    std::vector<Claimant> all;
    const auto wanted = [&](ClaimRule rule) {
        return options.rules.empty() || std::ranges::find(options.rules, rule) != options.rules.end();
    };
    for (const ClaimRule rule : {ClaimRule::strict, ClaimRule::exact, ClaimRule::tolerant}) {
        if (wanted(rule)) all.push_back({nullptr, rule});
    }
    bool any = false, own = false;
    for (const Kernel& kernel : options.kernels) {
        if (kernel.simplex != simplex || kernel.perspective) continue;
        any = true;
        own = own || kernel.rule != RegionRule::sign;
        for (const ClaimRule rule : all_claim_rules) {
            if (wanted(rule) && (rule != ClaimRule::own || kernel.rule != RegionRule::sign))
                all.push_back({&kernel, rule});
        }
    }
    if (!any)
        return file_error("kernel.unfit", mesh, "no kernel for the cells of the mesh",
                          "a kernel for a " + std::string(barycert::name(simplex)), "",
                          "`barycert kernels` lists them");
    if (!options.rules.empty() && wanted(ClaimRule::own) && !own)
        return Error{.code = "rule.unfit",
                     .what = "no kernel has a rule of its own",
                     .expected = "one that classifies points or has a tolerance",
                     .remedy = "leave out the rule own, or name such a kernel"};
    return all;
}

}  // namespace

void ClaimCounts::add(const ClaimCounts& other) {
    inside += other.inside;
    outside += other.outside;
    for (std::size_t k = 0; k < claim_fault_count; ++k) faults[k] += other.faults[k];
}

ClaimCounts ClaimResult::total() const {
    ClaimCounts sum;
    for (const ClaimCounts& c : by_feature) sum.add(c);
    return sum;
}

Result<GapsReport> find_gaps(const GapsOptions& options, const Mesh& mesh, const std::string& name, Verdict verdict) {
    const ExactEnvironment exact;
    GapsReport report;
    report.environment = measure_environment();
    if (const Status ok = check_environment(report.environment); !ok) return ok.error();
    if (mesh.cell_count() == 0) return Error{.code = "mesh.empty", .what = "the mesh has no cells", .file = name};
    const Simplex simplex = mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    const Result<std::vector<Claimant>> claimants = claimants_of(options, simplex, name);
    if (!claimants) return claimants.error();
    report.mesh = name;
    report.dimension = mesh.dimension;
    report.verdict = verdict;
    report.curved = curved_cells(mesh);
    report.seed = options.seed;
    report.count = options.count;
    report.tolerance = options.tolerance;
    report.threads = base::threads_for(options.threads);
    for (const Claimant& c : *claimants)
        report.results.push_back({c.kernel == nullptr ? "" : c.kernel->name, c.rule, {}, 0, {}});

    const auto start = std::chrono::steady_clock::now();
    const Finder finder(options, mesh, *claimants);
    tbb::enumerable_thread_specific<ThreadTally> found([&] { return ThreadTally{report.results, {}, {}}; });
    const std::size_t first = mesh.dimension == 2 ? 1 : 0;  // in the plane no cells share a face
    for (std::size_t feature = first; feature < 3; ++feature)
        on_threads(report.threads, options.count, [&](std::size_t i) { finder.run(feature, i, found.local()); });
    std::optional<Disagreement> disagreement;
    for (const ThreadTally& local : found) {
        report.oracles.add(local.oracles);
        for (std::size_t k = 0; k < report.results.size(); ++k) merge(report.results[k], local.results[k]);
        keep_first(disagreement, local.disagreement);
    }
    if (disagreement) return error_of(*disagreement, "gaps", options.seed);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace barycert
