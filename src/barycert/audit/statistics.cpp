#include "barycert/audit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "barycert/base/decades.hpp"
#include "barycert/base/held.hpp"
#include "barycert/environment.hpp"

namespace barycert {

// Bin 0 holds 0; bin k > 0 holds (edge(k-1), edge(k)], where edge(k) = 2^((k-1)/8) with the mantissa in steps of 1/8:
// 1, 1.125, ...
std::size_t LogHistogram::bin(double x) {
    if (!(x > 0)) return 0;
    if (x <= 1) return 1;
    // The exponent and, of the mantissa, steps of 1/8, begun ones counted.
    const auto word = std::bit_cast<std::uint64_t>(x);
    constexpr std::uint64_t step = std::uint64_t{1} << 49, fraction = (std::uint64_t{1} << 52) - 1;
    const std::uint64_t index = 1 + 8 * ((word >> 52) - 1023) + ((word & fraction) + step - 1) / step;
    return static_cast<std::size_t>(std::min<std::uint64_t>(index, bin_count - 1));
}

double LogHistogram::upper_edge(std::size_t bin) {
    if (bin == 0) return 0;
    const auto k = static_cast<int>(bin - 1);
    return std::ldexp(1 + (k % 8) / 8.0, k / 8);
}

void LogHistogram::merge(const LogHistogram& other) {
    for (std::size_t i = 0; i < bin_count; ++i) bins_[i] += other.bins_[i];
}

std::uint64_t LogHistogram::total() const {
    return std::accumulate(bins_.begin(), bins_.end(), std::uint64_t{0});
}

double LogHistogram::quantile(double fraction) const {
    const ExactEnvironment environment;
    const std::uint64_t all = total();
    if (all == 0) return -1;
    const auto wanted = static_cast<std::uint64_t>(std::ceil(base::held(fraction) * static_cast<double>(all)));
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < bin_count; ++i) {
        seen += bins_[i];
        if (seen >= wanted) return base::held(upper_edge(i));
    }
    return base::held(upper_edge(bin_count - 1));
}

static_assert(ErrorSizes::bins == base::decade_bins + 1, "the last is for those without an answer");

void ErrorSizes::add(double error, std::uint64_t index) {
    const ExactEnvironment environment;
    error = base::held(error);
    if (!(error >= 0)) return;
    std::size_t bin = 0;
    if (std::isinf(error)) {
        bin = bins - 1;
    } else if (error > 0) {
        bin = base::decade_bin(error);
    }
    ++counts[bin];
    if (!std::isinf(error)) worst.include(error, index);
}

void ErrorSizes::merge(const ErrorSizes& other) {
    for (std::size_t i = 0; i < bins; ++i) counts[i] += other.counts[i];
    worst.include(other.worst.value, other.worst.index);
}

std::uint64_t ErrorSizes::total() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double ErrorSizes::within(double share) const {
    const ExactEnvironment environment;
    const std::uint64_t all = total() - unanswered();
    if (all == 0) return -1;
    const auto wanted = static_cast<std::uint64_t>(std::ceil(base::held(share) * static_cast<double>(all)));
    std::uint64_t seen = counts[0];
    if (seen >= wanted) return 0;
    for (std::size_t i = 1; i <= base::decade_edges.size(); ++i) {
        seen += counts[i];
        if (seen >= wanted) return base::decade_edges[i - 1];
    }
    return std::numeric_limits<double>::infinity();
}

void KernelStatistics::add(const Comparison& r, Region exact, std::uint64_t index) {
    const ExactEnvironment environment;
    ++cases;
    ++confusion[static_cast<std::size_t>(exact)][static_cast<std::size_t>(r.claimed)];
    if (r.wrong()) {
        ++wrong_cases;
        for (std::size_t f = 0; f < finding_count; ++f) {
            counts[f] += r.counts[f];
            if (r.counts[f] != 0) witnesses[f].include(r.weight_error, index);
        }
    }
    errors.add(r.relative_error, index);
    for (const double ulps : r.weight_ulps) {
        if (ulps < 0) continue;
        weight_ulps.add(ulps);
        weight_ulp.include(ulps, index);
        witnesses[finding_count].include(ulps, index);
    }
    if (r.value_ulp >= 0) {
        value_ulps.add(r.value_ulp);
        value_ulp.include(r.value_ulp, index);
        witnesses[finding_count + 1].include(r.value_ulp, index);
    }
}

void KernelStatistics::merge(const KernelStatistics& other) {
    const ExactEnvironment environment;
    cases += other.cases;
    wrong_cases += other.wrong_cases;
    not_run += other.not_run;
    for (std::size_t f = 0; f < finding_count; ++f) counts[f] += other.counts[f];
    for (std::size_t e = 0; e < 4; ++e) {
        for (std::size_t c = 0; c < 4; ++c) confusion[e][c] += other.confusion[e][c];
    }
    weight_ulps.merge(other.weight_ulps);
    value_ulps.merge(other.value_ulps);
    errors.merge(other.errors);
    const auto include = [](WorstCase& mine, const WorstCase& theirs) { mine.include(theirs.value, theirs.index); };
    include(weight_ulp, other.weight_ulp);
    include(value_ulp, other.value_ulp);
    include(partition_residual, other.partition_residual);
    include(reproduction_residual, other.reproduction_residual);
    for (std::size_t i = 0; i < witness_reasons; ++i) include(witnesses[i], other.witnesses[i]);
}

}  // namespace barycert
