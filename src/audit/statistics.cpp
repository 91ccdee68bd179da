#include "barycert/statistics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/environment.hpp"
#include "barycert/finding.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/decades.hpp"
#include "core/base/range.hpp"
#include "core/base/strict_math.hpp"

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
    return static_cast<std::size_t>(std::min<std::uint64_t>(index, bins - 1));
}

double LogHistogram::upper_edge(std::size_t bin) {
    if (bin == 0) return 0;
    const auto k = static_cast<int>(bin - 1);
    return std::ldexp(1 + (k % 8) / 8.0, k / 8);
}

double LogHistogram::quantile(double fraction) const {
    const ExactEnvironment environment;
    const std::uint64_t all = total();
    if (all == 0) return -1;
    const auto wanted = static_cast<std::uint64_t>(std::ceil(base::held(fraction) * static_cast<double>(all)));
    return base::held(upper_edge(bin_reaching(wanted)));
}

static_assert(ErrorSizes::bins == base::decade_bins + 1, "the last is for those without an answer");

void ErrorSizes::add(double error, std::uint64_t index) {
    const ExactEnvironment environment;
    error = base::held(error);
    if (!(error >= 0)) return;
    ++counts[std::isinf(error) ? bins - 1 : error > 0 ? base::decade_bin(error) : 0];
    if (!std::isinf(error)) worst.include(error, index);
}

void ErrorSizes::merge(const ErrorSizes& other) {
    BinCounts::merge(other);
    worst.include(other.worst.value, other.worst.index);
}

double ErrorSizes::within(double share) const {
    const ExactEnvironment environment;
    const std::uint64_t all = total() - unanswered();
    if (all == 0) return -1;
    const auto wanted = static_cast<std::uint64_t>(std::ceil(base::held(share) * static_cast<double>(all)));
    const std::size_t bin = bin_reaching(wanted);
    if (bin == 0) return 0;
    return bin <= base::decade_edges.size() ? base::decade_edges[bin - 1] : std::numeric_limits<double>::infinity();
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
    using S = KernelStatistics;
    for (const auto worst : {&S::weight_ulp, &S::value_ulp, &S::partition_residual, &S::reproduction_residual})
        include(this->*worst, other.*worst);
    for (std::size_t i = 0; i < witness_reasons; ++i) include(witnesses[i], other.witnesses[i]);
}

namespace {

constexpr double unit = 0x1p-53;

/// From here on 8 * 2^-53 kappa exceeds 1/8 and so may the relative error of a denominator: no longer first order.
constexpr double beyond_first_order = 0x1p47;

// Bin 0 holds errors up to half a unit, which is how far the exact weight is itself rounded; bin k > 0 holds
// [edge(k), edge(k+1)) with edges 1/2, 3/4, 1, 3/2, 2, ...: exponent and leading bit of the mantissa. The last bin,
// from 2^200 on, takes all that is above.
constexpr std::uint64_t half_unit = std::bit_cast<std::uint64_t>(0.5) >> 51;
constexpr std::size_t last_error = 2 * 201 + 1;

std::size_t error_bin(double units) {
    const std::uint64_t k = std::bit_cast<std::uint64_t>(units) >> 51;
    return units <= 0.5 ? 0 : std::min(static_cast<std::size_t>(k - half_unit) + 1, last_error);
}

double upper_edge(std::size_t bin) {
    return std::bit_cast<double>((half_unit + bin) << 51);
}

/// Products of three differences stay clear of both ends of the range: those of an axis between 2^-300 and 2^300. The
/// point is in the cell, so that its differences are no longer than the cell.
bool in_range(const Case& c) {
    for (int axis = 0; axis < space_dimension(c.simplex); ++axis) {
        base::Range on_axis;
        for (int i = 0; i < vertex_count(c.simplex); ++i) on_axis.add(c.vertex(i, axis));
        const double length = on_axis.high - on_axis.low;
        if (!(length >= 0x1p-300 && length <= 0x1p300)) return false;
    }
    return true;
}

}  // namespace

double audit::predicting_condition(const Case& c, Region region) {
    const bool fills_space = c.simplex == Simplex::triangle || c.simplex == Simplex::tetrahedron;
    if (!is_inside(region) || !fills_space || c.perspective || !in_range(c))
        return std::numeric_limits<double>::quiet_NaN();
    return condition_number(c.simplex, c.vertices.data());
}

void Prediction::add(double kappa, double error) {
    const ExactEnvironment environment;
    kappa = base::held(kappa);
    const auto bits = static_cast<std::size_t>(std::clamp(std::ilogb(kappa), 0, last_bits));
    const double units = base::held(error) / unit;
    const std::size_t bin = error_bin(units);
    if (bits >= rows_.size()) rows_.resize(bits + 1);
    ErrorsOfBits& row = rows_[bits];
    if (bin >= row.errors.size()) row.errors.resize(bin + 1);
    ++row.errors[bin];
    row.worst = std::max(row.worst, units);
    if (kappa < beyond_first_order) worst_factor_ = std::max(worst_factor_, units / kappa);
}

void Prediction::merge(const Prediction& other) {
    const ExactEnvironment environment;
    if (other.rows_.size() > rows_.size()) rows_.resize(other.rows_.size());
    for (std::size_t bits = 0; bits < other.rows_.size(); ++bits) {
        const ErrorsOfBits& theirs = other.rows_[bits];
        ErrorsOfBits& mine = rows_[bits];
        if (theirs.errors.size() > mine.errors.size()) mine.errors.resize(theirs.errors.size());
        for (std::size_t k = 0; k < theirs.errors.size(); ++k) mine.errors[k] += theirs.errors[k];
        mine.worst = std::max(mine.worst, theirs.worst);
    }
    worst_factor_ = std::max(worst_factor_, other.worst_factor_);
}

std::uint64_t Prediction::cases() const {
    std::uint64_t sum = 0;
    for (const ErrorsOfBits& row : rows_) sum = std::accumulate(row.errors.begin(), row.errors.end(), sum);
    return sum;
}

std::vector<Prediction::Bin> Prediction::bins() const {
    const ExactEnvironment environment;
    std::vector<Bin> out;
    for (std::size_t bits = 0; bits < rows_.size(); ++bits) {
        const ErrorsOfBits& row = rows_[bits];
        const std::uint64_t cases = std::accumulate(row.errors.begin(), row.errors.end(), std::uint64_t{0});
        if (cases == 0) continue;
        std::size_t k = 0;
        for (std::uint64_t seen = row.errors[0]; seen < cases - cases / 2;) seen += row.errors[++k];
        // The edge never stands above the worst, nor above the half unit for errors below it.
        out.push_back({static_cast<int>(bits), cases, std::min(upper_edge(k), row.worst), row.worst});
    }
    return out;
}

}  // namespace barycert
