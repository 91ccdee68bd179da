#include "barycert/audit.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "barycert/audit/block.hpp"
#include "barycert/audit/mesh_draws.hpp"
#include "barycert/environment.hpp"

namespace barycert {

using namespace audit;

namespace {

/// The work for one family and simplex: which kernels take part.
struct Job {
    std::size_t family;
    Simplex simplex;
    std::vector<std::size_t> kernels;
};

std::vector<Job> plan(const AuditOptions& options, const MeshSource& meshes) {
    std::vector<Job> jobs;
    for (std::size_t f = 0; f < options.families.size(); ++f) {
        for (const Simplex s : all_simplices) {
            const Family& family = options.families[f];
            if (!family.applies_to(s) || (family.needs_mesh && !meshes.supplies(s))) continue;
            Job job{f, s, {}};
            for (std::size_t k = 0; k < options.kernels.size(); ++k) {
                const Kernel& kernel = options.kernels[k];
                if (kernel.simplex == s && kernel.perspective == family.perspective) job.kernels.push_back(k);
            }
            if (!job.kernels.empty()) jobs.push_back(std::move(job));
        }
    }
    return jobs;
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
        const FamilyResult* from = nullptr;
        for (const FamilyResult& f : result.families) {
            const double value = f.statistics.witnesses[reason].value;
            if (value >= 0 && (from == nullptr || value > from->statistics.witnesses[reason].value)) from = &f;
        }
        if (from == nullptr) continue;
        const WorstCase& worst = from->statistics.witnesses[reason];
        if (reason >= finding_count && worst.value == 0) continue;
        const Family& family = options.families[from->family];
        Witness w;
        w.kernel = result.kernel.name;
        w.reason = reason_name(reason);
        w.family = family.name;
        w.seed = options.seed;
        w.index = worst.index;
        w.magnitude = worst.value;
        w.c = make_case(family, result.kernel.simplex, options.seed, worst.index, meshes);
        result.witnesses.push_back(std::move(w));
    }
}

/// False certificates first, then by the share of wrong cases, then by the worst error.
bool worse(const KernelResult& a, const KernelResult& b) {
    const auto share = [](const KernelResult& r, double n) {
        return r.total.cases == 0 ? 0.0 : n / static_cast<double>(r.total.cases);
    };
    const auto certificates = [](const KernelResult& r) {
        return r.total.counts[static_cast<std::size_t>(Finding::false_certificate)];
    };
    if ((certificates(a) != 0) != (certificates(b) != 0)) return certificates(a) != 0;
    const double wrong_a = share(a, static_cast<double>(a.total.wrong_cases)),
                 wrong_b = share(b, static_cast<double>(b.total.wrong_cases));
    if (wrong_a != wrong_b) return wrong_a > wrong_b;
    return a.total.weight_ulp.value > b.total.weight_ulp.value;
}

}  // namespace

Result<AuditReport> run_audit(const AuditOptions& options, const MeshSource& meshes) {
    const ExactEnvironment exact;
    AuditReport report;
    report.environment = measure_environment();
    if (const Status ok = check_environment(report.environment); !ok) return ok.error();
    const std::vector<Job> jobs = plan(options, meshes);
    if (jobs.empty()) {
        return Error{
            .what = "nothing to audit: no family applies to a kernel",
            .remedy = "see `barycert kernels` and `barycert families`; mesh families of triangles need a 2D mesh"};
    }
    report.seed = options.seed;
    report.count = options.count;
    report.threads =
        options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    report.families = options.families;
    for (const auto& m : meshes.meshes()) {
        report.meshes.push_back(m->name);
        report.verdicts.push_back(m->certificate.verdict_on(m->mesh));
    }
    for (const Kernel& k : options.kernels)
        report.kernels.push_back(
            {.kernel = k, .total = {}, .families = {}, .prediction = {}, .ns = 0, .witnesses = {}});

    const auto start = std::chrono::steady_clock::now();
    std::vector<std::vector<float>> times(options.kernels.size());
    std::atomic<std::uint64_t> done{0};
    std::mutex telling;
    const std::uint64_t total = options.count * jobs.size();
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(report.threads));
    tbb::task_arena arena(report.threads);
    for (const Job& job : jobs) {
        const Family& family = options.families[job.family];
        std::vector<Kernel> kernels;
        for (const std::size_t k : job.kernels) kernels.push_back(options.kernels[k]);
        tbb::enumerable_thread_specific<std::vector<BlockResult>> results(
            [&] { return std::vector<BlockResult>(kernels.size()); });
        const std::uint64_t blocks = (options.count + block_size - 1) / block_size;
        arena.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, blocks, 1), [&](const auto& range) {
                for (std::uint64_t b = range.begin(); b != range.end(); ++b) {
                    const std::uint64_t first = b * block_size;
                    const std::uint64_t last = std::min(first + block_size, options.count);
                    run_block(family, job.simplex, options.seed, first, last, meshes, kernels, results.local());
                    const std::uint64_t now = done += last - first;
                    if (options.progress && telling.try_lock()) {
                        options.progress({now, total, family.name});
                        ExactEnvironment::renew();
                        telling.unlock();
                    }
                }
            });
        });
        for (std::size_t k = 0; k < kernels.size(); ++k) {
            KernelResult& result = report.kernels[job.kernels[k]];
            result.families.push_back({job.family, {}});
            for (const std::vector<BlockResult>& local : results) {
                result.families.back().statistics.merge(local[k].statistics);
                result.prediction.merge(local[k].prediction);
                auto& all = times[job.kernels[k]];
                all.insert(all.end(), local[k].ns.begin(), local[k].ns.end());
            }
            result.total.merge(result.families.back().statistics);
        }
        report.cases += options.count;
        // Every kernel of the job met the same cases: one of them tells what they were.
        const KernelStatistics& met = report.kernels[job.kernels.front()].families.back().statistics;
        for (std::size_t r = 0; r < 4; ++r) {
            for (const std::uint64_t n : met.confusion[r]) report.regions[r] += n;
        }
    }
    for (std::size_t k = 0; k < report.kernels.size(); ++k) {
        report.kernels[k].ns = median(times[k]);
        collect_witnesses(report.kernels[k], options, meshes);
    }
    // Kernels that no family applied to say nothing.
    std::erase_if(report.kernels, [](const KernelResult& r) { return r.total.cases == 0; });
    std::stable_sort(report.kernels.begin(), report.kernels.end(), worse);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

const Witness* worst_witness(const KernelResult& result) {
    return result.witnesses.empty() ? nullptr : &result.witnesses.front();
}

}  // namespace barycert
