#include "barycert/audit/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "barycert/audit/asking.hpp"
#include "barycert/audit/comparison.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"

namespace barycert::audit {
namespace {

/// Upper bounds of both residuals, from the weights' errors. With w the kernel's weights, l the exact ones, L those
/// rounded, d = fl(w - L) and u = 2^-53: |w - l - d| <= e = u |d| + u |L| + 2^-1074, so that
///     |sum w - 1|       = |sum (w - l)|   <= |sum d| + sum e,
///     |sum w v - p'|_k  = |sum (w - l) v| <= |sum d v| + sum e |v|     for each axis k.
/// The sums are evaluated in double: of at most four products each, so off by less than 5u sum |d v| + 4 * 2^-1074. The
/// factors below cover that and the few roundings of the bounds themselves.
struct ResidualBound {
    double partition = 0;
    double reproduction = 0;

    ResidualBound(const Case& c, const OracleAnswer& answer, const double* weights) {
        constexpr double u = 0x1p-53, tiny = 0x1p-1070;
        const auto n = static_cast<std::size_t>(vertex_count(c.simplex));
        std::array<double, 4> d{}, e{};
        double sum = 0, error = tiny;
        for (std::size_t i = 0; i < n; ++i) {
            d[i] = weights[i] - answer.weights[i];
            e[i] = 8 * u * std::fabs(d[i]) + u * std::fabs(answer.weights[i]) + 0x1p-1074;
            sum += d[i];
            error += e[i];
        }
        partition = (std::fabs(sum) + error) * (1 + 16 * u);
        std::array<double, 3> bound{};
        double max = 0;
        for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
            double r = 0, slack = tiny;
            for (std::size_t i = 0; i < n; ++i) {
                const double x = c.vertex(static_cast<int>(i), axis);
                r += d[i] * x;
                slack += e[i] * std::fabs(x);
            }
            bound[static_cast<std::size_t>(axis)] = std::fabs(r) + slack;
            max = std::max(max, std::fabs(r) + slack);
        }
        double squares = 0;  // scaled by the largest: neither overflow nor underflow
        for (const double x : bound) squares += (x / max) * (x / max);
        reproduction = max * std::sqrt(squares) * (1 + 32 * u) + tiny;
    }
};

/// The exact residuals are only asked for where they could exceed the worst so far: the worst is all that is kept.
void add_residuals(KernelStatistics& s, const Case& c, const OracleAnswer& answer, const double* weights,
                   std::uint64_t index) {
    const auto n = static_cast<std::size_t>(vertex_count(c.simplex));
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(weights[i])) return;
    }
    const ResidualBound bound(c, answer, weights);
    const std::span<const double> w(weights, n);
    if (!(bound.partition < s.partition_residual.value)) {
        s.partition_residual.include(std::fabs(partition_residual(w)), index);
    }
    // Perspective divides by a sum of weights and depths, for which there is no bound.
    if (c.perspective || !(bound.reproduction < s.reproduction_residual.value)) {
        s.reproduction_residual.include(reproduction_residual(c, w), index);
    }
}

}  // namespace

void run_block(const Job& job, std::uint64_t first, std::uint64_t last, JobResult& result) {
    const ExactEnvironment environment;
    thread_local std::vector<Case> cases(block_size);
    thread_local std::vector<OracleAnswer> answers(block_size);
    thread_local std::vector<Statement> statements(block_size);
    std::array<double, block_size> kappa{};
    const auto count = static_cast<std::size_t>(last - first);
    for (std::size_t i = 0; i < count; ++i) {
        cases[i] = make_case(job.family, job.simplex, job.seed, first + i, job.meshes);
        std::optional<Disagreement> disagreement;
        answers[i] = job.judge.decide(cases[i], first + i, result.oracles, disagreement);
        if (disagreement && (!result.quarrel || first + i < result.quarrel->index))
            result.quarrel = Quarrel{first + i, *disagreement};
        ++result.regions[static_cast<std::size_t>(answers[i].region)];
        kappa[i] = predicting_condition(cases[i], answers[i].region);
    }
    if (result.quarrel) return;
    for (std::size_t k = 0; k < job.kernels.size(); ++k) {
        const Kernel& kernel = job.kernels[k];
        BlockResult& learnt = result.kernels[k];
        const bool timed = learnt.ns.size() < BlockResult::kept_times;
        const Asked asked =
            ask_kernel(kernel, std::span(cases).first(count), std::span(statements).first(count), timed);
        if (timed && asked.ns >= 0) learnt.ns.push_back(static_cast<float>(asked.ns));
        for (std::size_t i = 0; i < count; ++i) {
            const Statement& said = statements[i];
            if (!said.ran) {
                ++learnt.statistics.not_run;
                continue;
            }
            const Comparison r = compare(kernel, cases[i], answers[i], said);
            learnt.statistics.add(r, answers[i].region, first + i);
            if (kappa[i] >= 1 && std::isfinite(r.weight_error)) learnt.prediction.add(kappa[i], r.weight_error);
            if (said.answered && said.status == 0 && answers[i].region != Region::degenerate)
                add_residuals(learnt.statistics, cases[i], answers[i], said.weights.data(), first + i);
        }
    }
}

}  // namespace barycert::audit
