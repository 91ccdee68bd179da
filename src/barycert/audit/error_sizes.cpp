#include <cmath>
#include <limits>
#include <numeric>

#include "barycert/audit.hpp"
#include "barycert/base/decades.hpp"
#include "barycert/base/held.hpp"
#include "barycert/environment.hpp"

namespace barycert {

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

}  // namespace barycert
