#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "audit/asking.hpp"
#include "audit/block.hpp"
#include "audit/judge.hpp"
#include "audit/recipes.hpp"  // IWYU pragma: keep: the meshes of a source
#include "barycert/audit.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"
#include "core/base/workers.hpp"

namespace barycert {

using namespace audit;

namespace {

/// The work for one family and simplex: which kernels take part.
struct FamilyOnSimplex {
    std::size_t family;
    Simplex simplex;
    std::vector<std::size_t> kernels;
};

std::vector<FamilyOnSimplex> plan(const AuditOptions& options, const MeshSource& meshes) {
    std::vector<FamilyOnSimplex> parts;
    for (std::size_t f = 0; f < options.families.size(); ++f) {
        for (const Simplex s : all_simplices) {
            const Family& family = options.families[f];
            if (!family.applies_to(s) || (family.needs_mesh && !meshes.supplies(s))) continue;
            FamilyOnSimplex part{f, s, {}};
            for (std::size_t k = 0; k < options.kernels.size(); ++k) {
                const Kernel& kernel = options.kernels[k];
                if (kernel.simplex == s && kernel.perspective == family.perspective) part.kernels.push_back(k);
            }
            if (!part.kernels.empty()) parts.push_back(std::move(part));
        }
    }
    return parts;
}

double median(std::vector<float> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Largest first among the witnesses' sources: the family whose worst case is worst overall.
void collect_witnesses(KernelResult& result, const AuditOptions& options, const MeshSource& meshes) {
    for (std::size_t reason = 0; reason < witness_reasons; ++reason) {
        const auto value = [&](const FamilyResult& f) { return f.statistics.witnesses[reason].value; };
        const auto from = std::ranges::max_element(result.families, {}, value);
        if (from == result.families.end() || value(*from) < 0) continue;
        const WorstCase& worst = from->statistics.witnesses[reason];
        if (reason >= finding_count && worst.value == 0) continue;
        Witness w;
        make_case(options.families[from->family], result.kernel.simplex, options.seed, worst.index, meshes, &w);
        w.kernel = result.kernel.name;
        w.reason = reason_name(reason);
        w.magnitude = worst.value;
        if (reason <= static_cast<std::size_t>(Finding::printed)) w.detail = incident_of(result.kernel, w.c);
        result.witnesses.push_back(std::move(w));
    }
}

/// False certificates first, then by the share of wrong cases, then by the worst error.
auto how_bad(const KernelResult& k) {
    const KernelStatistics& s = k.total;
    const double share = s.cases == 0 ? 0.0 : static_cast<double>(s.wrong_cases) / static_cast<double>(s.cases);
    return std::tuple(s.counts[static_cast<std::size_t>(Finding::false_certificate)] != 0, share, s.weight_ulp.value);
}

/// An audit on its way: one family and simplex after the other.
class FamilyRuns {
public:
    FamilyRuns(const AuditOptions& options, const MeshSource& meshes, AuditReport& report, std::size_t parts)
        : options_(options),
          meshes_(meshes),
          report_(report),
          total_(options.count * parts),
          times_(options.kernels.size()) {}

    /// Throws Exception where oracles disagree.
    void run(const FamilyOnSimplex& part) {
        const Family& family = options_.families[part.family];
        std::vector<Kernel> kernels;
        for (const std::size_t k : part.kernels) kernels.push_back(options_.kernels[k]);
        // The core is no judge of itself, nor of a kernel that claims to be as good.
        const bool core_may_decide =
            std::ranges::none_of(kernels, [](const Kernel& k) { return k.core || k.certifies; });
        const Job job{family,  part.simplex, options_.seed,
                      meshes_, kernels,      Judge(options_.oracle, core_may_decide, options_.cgal)};
        Results results([&] { return JobResult(kernels.size()); });
        const std::uint64_t blocks = (options_.count + block_size - 1) / block_size;
        on_threads(report_.threads, blocks, [&](std::size_t b) {
            const std::uint64_t first = b * block_size, last = std::min(first + block_size, options_.count);
            run_block(job, first, last, results.local());
            tell(last - first, family.name);
        });
        collect(results, part);
        report_.cases += options_.count;
    }

    /// After all parts.
    void finish() {
        for (std::size_t k = 0; k < report_.kernels.size(); ++k) {
            report_.kernels[k].ns = median(times_[k]);
            collect_witnesses(report_.kernels[k], options_, meshes_);
        }
        // Kernels that no family applied to say nothing.
        std::erase_if(report_.kernels, [](const KernelResult& r) { return r.total.cases + r.total.not_run == 0; });
        std::ranges::stable_sort(report_.kernels, std::greater<>(), how_bad);
    }

private:
    using Results = tbb::enumerable_thread_specific<JobResult>;

    /// From any thread.
    void tell(std::uint64_t cases, const std::string& family) {
        const std::uint64_t now = done_ += cases;
        const std::unique_lock turn(telling_, std::try_to_lock);
        if (options_.progress && turn) {
            options_.progress({now, total_, family});
            ExactEnvironment::renew();
        }
    }

    void collect(const Results& results, const FamilyOnSimplex& part) {
        std::optional<Disagreement> first;
        for (const JobResult& local : results) {
            keep_first(first, local.disagreement);
            report_.oracles.add(local.oracles);
            for (std::size_t r = 0; r < 4; ++r) report_.regions[r] += local.regions[r];
        }
        if (first) throw Exception(error_of(*first, options_.families[part.family].name, options_.seed));
        for (std::size_t k = 0; k < part.kernels.size(); ++k) {
            KernelResult& result = report_.kernels[part.kernels[k]];
            result.families.push_back({part.family, {}});
            for (const JobResult& local : results) {
                result.families.back().statistics.merge(local.kernels[k].statistics);
                result.prediction.merge(local.kernels[k].prediction);
                auto& all = times_[part.kernels[k]];
                all.insert(all.end(), local.kernels[k].ns.begin(), local.kernels[k].ns.end());
            }
            result.total.merge(result.families.back().statistics);
        }
    }

    const AuditOptions& options_;
    const MeshSource& meshes_;
    AuditReport& report_;
    std::uint64_t total_;
    std::vector<std::vector<float>> times_;
    std::atomic<std::uint64_t> done_ = 0;
    std::mutex telling_;
};

}  // namespace

Result<AuditReport> run_audit(const AuditOptions& options, const MeshSource& meshes) try {
    const ExactEnvironment exact;
    AuditReport report;
    report.environment = measure_environment();
    report.seed = options.seed;
    report.count = options.count;
    report.threads = base::threads_for(options.threads);
    if (const Status ok = check_environment(report.environment); !ok) return ok.error();
    const std::vector<FamilyOnSimplex> parts = plan(options, meshes);
    if (parts.empty())
        return Error{
            .code = "audit.nothing",
            .what = "nothing to audit: no family applies to a kernel",
            .remedy = "see `barycert kernels` and `barycert families`; mesh families of triangles need a 2D mesh"};
    report.oracle = options.oracle;
    report.families = options.families;
    for (const auto& m : meshes.meshes()) {
        report.meshes.push_back(m->name);
        report.verdicts.push_back(m->certificate.verdict_on(m->mesh));
        report.curved.push_back(curved_cells(m->mesh));
    }
    for (const Kernel& k : options.kernels) report.kernels.emplace_back().kernel = k;
    const auto start = std::chrono::steady_clock::now();
    FamilyRuns runs(options, meshes, report, parts.size());
    for (const FamilyOnSimplex& part : parts) runs.run(part);
    runs.finish();
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
} catch (const Exception& e) {
    return e.error();
}

const Witness* worst_witness(const KernelResult& result) {
    return result.witnesses.empty() ? nullptr : &result.witnesses.front();
}

}  // namespace barycert
