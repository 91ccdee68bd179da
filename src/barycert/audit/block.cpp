#include "barycert/audit/block.hpp"

#include <array>
#include <chrono>
#include <cmath>

#include "barycert/exact/oracle.hpp"

namespace barycert::audit {
namespace {

/// An upper bound of both residuals, in terms of the weights' errors: with w the kernel's weights, l the exact ones, L
/// those rounded, |sum w - 1| <= sum |w - l| and |sum w v - p'| <= sum |w - l| |v|_1, where |w - l| <= |w - L| + 2^-53
/// |L| + 2^-1075. The factor covers the roundings of evaluating the bound itself (fewer than 30 operations, none
/// cancelling).
struct ResidualBound {
    double partition = 0;
    double reproduction = 0;

    ResidualBound(const Case& c, const exact::Answer& answer, const double* weights) {
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            const auto k = static_cast<std::size_t>(i);
            const double error =
                std::fabs(weights[k] - answer.weights[k]) + 0x1p-53 * std::fabs(answer.weights[k]) + 0x1p-1074;
            double size = 0x1p-1022;
            for (int axis = 0; axis < space_dimension(c.simplex); ++axis) size += std::fabs(c.vertex(i, axis));
            partition += error;
            reproduction += error * size + 0x1p-1074;
        }
        partition *= 1 + 0x1p-40;
        reproduction *= 1 + 0x1p-40;
    }
};

/// The exact residuals are only asked for where they could exceed the worst so far: the worst is all that is kept.
void add_residuals(Statistics& s, const Case& c, const exact::Answer& answer, const double* weights,
                   std::uint64_t index) {
    const auto n = static_cast<std::size_t>(vertex_count(c.simplex));
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(weights[i])) return;
    }
    const ResidualBound bound(c, answer, weights);
    const std::span<const double> w(weights, n);
    if (!(bound.partition < s.partition_residual.value)) {
        s.partition_residual.include(std::fabs(exact::partition_residual(w)), index);
    }
    if (!(bound.reproduction < s.reproduction_residual.value)) {
        s.reproduction_residual.include(exact::reproduction_residual(c, w), index);
    }
}

}  // namespace

void run_block(const Family& family, Simplex simplex, std::uint64_t seed, std::uint64_t first, std::uint64_t last,
               const MeshSource& meshes, const std::vector<Kernel>& kernels, std::vector<BlockResult>& results) {
    using Clock = std::chrono::steady_clock;
    thread_local std::vector<Case> cases(block_size);
    thread_local std::vector<exact::Answer> answers(block_size);
    const auto count = static_cast<std::size_t>(last - first);
    for (std::size_t i = 0; i < count; ++i) {
        cases[i] = make_case(family, simplex, seed, first + i, meshes);
        answers[i] = exact::ask(cases[i]);
    }
    std::array<std::array<double, 4>, block_size> weights{};
    std::array<int, block_size> status{};
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const WeightsFunction function = kernels[k].weights;
        const auto start = Clock::now();
        for (std::size_t i = 0; i < count; ++i) {
            status[i] = function(cases[i].vertices.data(), cases[i].point.data(), weights[i].data());
        }
        const auto stop = Clock::now();
        BlockResult& result = results[k];
        if (result.ns.size() < BlockResult::kept_times) {
            const double ns = std::chrono::duration<double, std::nano>(stop - start).count();
            result.ns.push_back(static_cast<float>(ns / static_cast<double>(count)));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Comparison r = compare(kernels[k], cases[i], answers[i], status[i], weights[i]);
            result.statistics.add(r, answers[i].region, first + i);
            if (status[i] == 0 && answers[i].region != Region::degenerate) {
                add_residuals(result.statistics, cases[i], answers[i], weights[i].data(), first + i);
            }
        }
    }
}

}  // namespace barycert::audit
