#include "audit/block.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "barycert/witness.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"

namespace barycert::audit {
namespace {

/// Upper bounds of both residuals. Exact ones are only asked for where they could exceed the worst so far, which is all
/// that is kept: the closer the bound, the rarer that is.
struct ResidualBound {
    double partition = 0;
    double reproduction = 0;
};

using Long = long double;
constexpr Long long_ulp = std::numeric_limits<Long>::epsilon();

/// Rounded to a double that is not below it. A number that is a double already stays as it is.
double up(double x) {
    return x;
}
double up(Long x) {
    const auto y = static_cast<double>(x);
    return y < x ? std::nextafter(y, std::numeric_limits<double>::infinity()) : y;
}

/// A sum of at most five numbers, of products of doubles perhaps, that knows how far off it can be: each product and
/// each of four additions is off by less than long_ulp times the sum of magnitudes, twice over for what those of the
/// magnitudes are off. It also sees where every operation was exact, and is then not off at all.
class WatchedSum {
public:
    void add(Long x) {
        const Long sum = sum_ + x, back = sum - sum_;
        exact_ = exact_ && (sum_ - (sum - back)) + (x - back) == 0;
        sum_ = sum;
        size_ += std::fabs(x);
    }
    void add_product(double a, double b) {
        add(static_cast<Long>(a) * b);
        // A factor of at most 11 bits, such as 0 or 1 or 1/4, and one of 53 make a product of 64.
        exact_ = exact_ && std::numeric_limits<Long>::digits >= 64 &&
                 (std::bit_cast<std::uint64_t>(a) & ((std::uint64_t{1} << 42) - 1)) == 0;
    }
    /// An upper bound of the magnitude of the sum, as a double. Numbers below the range of normal ones add to it.
    double bound() const {
        if (exact_) return up(std::fabs(sum_));
        return up(std::fabs(sum_) + 16 * long_ulp * size_ + 0x1p-1070);
    }

private:
    Long sum_ = 0, size_ = 0;
    bool exact_ = true;
};

/// The length of a vector whose components are at most these, rounded up: scaled by the largest, so that squares
/// neither over- nor underflow. Infinite if the sums of a component overflowed, to infinity or to none.
double length_bound(const std::array<double, 3>& components) {
    constexpr double u = 0x1p-53;
    if (!base::all_finite(components)) return std::numeric_limits<double>::infinity();
    const double max = std::max({components[0], components[1], components[2]});
    if (!(max > 0)) return 0;
    double squares = 0;
    for (const double x : components) squares += (x / max) * (x / max);
    return max * std::sqrt(squares) * (1 + 32 * u) + 0x1p-1070;
}

/// Where the weights belong to the point itself: sum w - 1 and sum w v - p, as they are defined, in double or in long
/// double. The sums are of at most five numbers or products, off by less than 4 epsilon times the sum of magnitudes.
template <class Real>
ResidualBound plain_bound(const Case& c, const double* weights) {
    constexpr Real slack = 8 * std::numeric_limits<Real>::epsilon(), tiny = 0x1p-1070;
    const int n = vertex_count(c.simplex);
    Real sum = -1, size = 1, reproduction = 0;
    for (int i = 0; i < n; ++i) {
        sum += weights[i];
        size += std::fabs(weights[i]);
    }
    // The sum of magnitudes of the components is no less than the length.
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        Real r = -c.point[static_cast<std::size_t>(axis)], of = std::fabs(r);
        for (int i = 0; i < n; ++i) {
            const Real product = static_cast<Real>(weights[i]) * c.vertex(i, axis);
            r += product;
            of += std::fabs(product);
        }
        reproduction += std::fabs(r) + slack * of + tiny;
    }
    return {up(std::fabs(sum) + slack * size), up(reproduction * (1 + slack))};
}

/// The same, as close as can be.
ResidualBound direct_bound(const Case& c, const double* weights) {
    const int n = vertex_count(c.simplex);
    WatchedSum sum;
    sum.add(-1);
    for (int i = 0; i < n; ++i) sum.add(weights[i]);
    std::array<double, 3> components{};
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        WatchedSum r;
        r.add(-c.point[k]);
        for (int i = 0; i < n; ++i) r.add_product(weights[i], c.vertex(i, axis));
        components[k] = r.bound();
    }
    return {sum.bound(), length_bound(components)};
}

/// Where they belong to its projection, which is known by its exact weights: from the weights' errors. With w the
/// kernel's weights, l the exact ones, L those rounded, d = fl(w - L) and u = 2^-53: |w - l - d| <= e = u |d| + u |L| +
/// 2^-1074, so that
///     |sum w - 1|       = |sum (w - l)|   <= |sum d| + sum e,
///     |sum w v - p'|_k  = |sum (w - l) v| <= |sum d v| + sum e |v|     for each axis k.
/// The sums are evaluated in double: of at most four products each, so off by less than 5u sum |d v| + 4 * 2^-1074. The
/// factors below cover that and the few roundings of the bounds themselves.
ResidualBound projected_bound(const Case& c, const OracleAnswer& answer, const double* weights) {
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
    std::array<double, 3> components{};
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        double r = 0, slack = tiny;
        for (std::size_t i = 0; i < n; ++i) {
            const double x = c.vertex(static_cast<int>(i), axis);
            r += d[i] * x;
            slack += e[i] * std::fabs(x);
        }
        components[static_cast<std::size_t>(axis)] = std::fabs(r) + slack;
    }
    return {(std::fabs(sum) + error) * (1 + 16 * u), length_bound(components)};
}

/// The worst so far cannot be exceeded, nor equalled by an earlier case.
bool settled(double bound, const WorstCase& worst, std::uint64_t index) {
    return bound < worst.value || (bound == worst.value && index > worst.index);
}

void add_residuals(KernelStatistics& s, const Case& c, const OracleAnswer& answer, const double* weights,
                   std::uint64_t index) {
    const std::span w(weights, static_cast<std::size_t>(vertex_count(c.simplex)));
    if (!base::all_finite(w)) return;
    const bool direct = c.simplex == Simplex::tetrahedron || c.simplex == Simplex::triangle;
    if (direct && !c.perspective) {  // ever closer, and slower
        const auto both_settled = [&](const ResidualBound& bound) {
            return settled(bound.partition, s.partition_residual, index) &&
                   settled(bound.reproduction, s.reproduction_residual, index);
        };
        if (both_settled(plain_bound<double>(c, weights)) || both_settled(plain_bound<Long>(c, weights))) return;
    }
    const ResidualBound bound = direct ? direct_bound(c, weights) : projected_bound(c, answer, weights);
    if (!settled(bound.partition, s.partition_residual, index))
        s.partition_residual.include(std::fabs(partition_residual(w)), index);
    // Perspective divides by a sum of weights and depths, for which there is no bound.
    if (c.perspective || !settled(bound.reproduction, s.reproduction_residual, index))
        s.reproduction_residual.include(reproduction_residual(c, w), index);
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
        answers[i] = job.judge.decide(cases[i], first + i, result.oracles, result.disagreement);
        ++result.regions[static_cast<std::size_t>(answers[i].region)];
        kappa[i] = predicting_condition(cases[i], answers[i].region);
    }
    if (result.disagreement) return;
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
