#include "barycert/verify/holders.hpp"

#include <algorithm>
#include <limits>

#include "barycert/verify/errors.hpp"

namespace barycert::verify {

Result<std::vector<BestHolder>> best_holders(const Sampler& sampler, const ClaimedRows& claimed,
                                             std::span<const std::size_t> which, std::span<const double> ranges) {
    std::vector<BestHolder> best(which.size());
    if (which.empty()) return best;
    const auto d = static_cast<std::size_t>(sampler.locator().mesh().dimension);
    const std::size_t columns = ranges.size();
    std::vector<double> points;
    points.reserve(d * which.size());
    for (const std::size_t row : which)
        points.insert(points.end(), claimed.points.begin() + static_cast<std::ptrdiff_t>(d * row),
                      claimed.points.begin() + static_cast<std::ptrdiff_t>(d * (row + 1)));
    Result<Table> all = sampler.locator().locate_all(points, 1);
    if (!all) return all.error();
    const std::vector<std::size_t> begin = all->point_begin;
    SampleOptions options;
    options.threads = 1;
    const std::vector<double> rows = all->points;
    if (Status done = sampler.evaluate(rows, options, *all); !done) return done.error();
    for (std::size_t i = 0; i < which.size(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t choice = begin[i];  // the owner, unless another one is nearer
        for (std::size_t row = begin[i]; row < begin[i + 1]; ++row) {
            double most = 0;
            for (std::size_t c = 0; c < columns; ++c)
                most = std::max(
                    most, compare(claimed.values[columns * which[i] + c], all->value(row, c), ranges[c]).relative);
            if (!(most < least)) continue;
            least = most;
            choice = row;
        }
        best[i].cells = begin[i + 1] - begin[i];
        best[i].other = choice != begin[i];
        const auto from = all->values.begin() + static_cast<std::ptrdiff_t>(columns * choice);
        best[i].values.assign(from, from + static_cast<std::ptrdiff_t>(columns));
    }
    return best;
}

}  // namespace barycert::verify
