#include "barycert/audit/comparison.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "barycert/base/held.hpp"
#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"
#include "barycert/weights.hpp"

namespace barycert {
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
        double low = c.vertex(0, axis), high = low;
        for (int i = 1; i < vertex_count(c.simplex); ++i) {
            low = std::min(low, c.vertex(i, axis));
            high = std::max(high, c.vertex(i, axis));
        }
        if (!(high - low >= 0x1p-300 && high - low <= 0x1p300)) return false;
    }
    return true;
}

}  // namespace

double audit::predicting_condition(const Case& c, Region region) {
    const ExactEnvironment environment;
    const bool inside = region == Region::interior || region == Region::boundary;
    const bool fills_space = c.simplex == Simplex::triangle || c.simplex == Simplex::tetrahedron;
    if (!inside || !fills_space || c.perspective || !in_range(c)) return std::numeric_limits<double>::quiet_NaN();
    return condition_number(c.simplex, c.vertices.data());
}

void Prediction::add(double kappa, double error) {
    const ExactEnvironment environment;
    kappa = base::held(kappa);
    const auto bits = static_cast<std::size_t>(std::clamp(std::ilogb(kappa), 0, last_bits));
    const double units = base::held(error) / unit;
    const std::size_t bin = error_bin(units);
    if (bits >= rows_.size()) rows_.resize(bits + 1);
    Row& row = rows_[bits];
    if (bin >= row.errors.size()) row.errors.resize(bin + 1);
    ++row.errors[bin];
    row.worst = std::max(row.worst, units);
    if (kappa < beyond_first_order) worst_factor_ = std::max(worst_factor_, units / kappa);
}

void Prediction::merge(const Prediction& other) {
    const ExactEnvironment environment;
    if (other.rows_.size() > rows_.size()) rows_.resize(other.rows_.size());
    for (std::size_t bits = 0; bits < other.rows_.size(); ++bits) {
        const Row& theirs = other.rows_[bits];
        Row& mine = rows_[bits];
        if (theirs.errors.size() > mine.errors.size()) mine.errors.resize(theirs.errors.size());
        for (std::size_t k = 0; k < theirs.errors.size(); ++k) mine.errors[k] += theirs.errors[k];
        mine.worst = std::max(mine.worst, theirs.worst);
    }
    worst_factor_ = std::max(worst_factor_, other.worst_factor_);
}

std::uint64_t Prediction::cases() const {
    std::uint64_t sum = 0;
    for (const Row& row : rows_) sum = std::accumulate(row.errors.begin(), row.errors.end(), sum);
    return sum;
}

std::vector<Prediction::Bin> Prediction::bins() const {
    const ExactEnvironment environment;
    std::vector<Bin> out;
    for (std::size_t bits = 0; bits < rows_.size(); ++bits) {
        const Row& row = rows_[bits];
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
