#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "barycert/audit_findings.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

/// Of the bins up to the last but two, the first aside.
constexpr std::array<double, 20> error_edges{1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                             1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1,     10,   100};

}  // namespace

void ErrorSizes::add(double error, std::uint64_t index) {
    const ExactEnvironment environment;
    error = held(error);
    if (!(error >= 0)) return;
    std::size_t bin = 0;
    if (std::isinf(error)) {
        bin = bins - 1;
    } else if (error > 0) {
        bin = 1 + static_cast<std::size_t>(std::upper_bound(error_edges.begin(), error_edges.end(), error) -
                                           error_edges.begin());
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
    const auto wanted = static_cast<std::uint64_t>(std::ceil(held(share) * static_cast<double>(all)));
    std::uint64_t seen = counts[0];
    if (seen >= wanted) return 0;
    for (std::size_t i = 1; i <= error_edges.size(); ++i) {
        seen += counts[i];
        if (seen >= wanted) return error_edges[i - 1];
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace barycert
