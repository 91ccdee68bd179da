#include <algorithm>
#include <cstddef>
#include <limits>

#include "barycert/base/random.hpp"
#include "barycert/verify.hpp"
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

namespace barycert {

void ValueErrors::add(const ValueErrors& other) {
    using E = ValueErrors;
    for (const auto count : {&E::values, &E::identical, &E::over, &E::missing, &E::spurious, &E::floats})
        this->*count += other.*count;
    max_ulps = std::max(max_ulps, other.max_ulps);
    max_relative = std::max(max_relative, other.max_relative);
    for (std::size_t i = 0; i < by_ulps.size(); ++i) by_ulps[i] += other.by_ulps[i];
    for (std::size_t i = 0; i < by_relative.size(); ++i) by_relative[i] += other.by_relative[i];
}

void Verdicts::add(const Verdicts& other, std::size_t examples_of_each) {
    using V = Verdicts;
    for (const auto count :
         {&V::rows, &V::right, &V::missed, &V::invented, &V::wrong_cell, &V::wrong_value, &V::inside, &V::outside,
          &V::not_finite, &V::on_boundary, &V::missed_on_boundary, &V::invented_zero, &V::several, &V::by_other_cell})
        this->*count += other.*count;
    if (columns.size() < other.columns.size()) columns.resize(other.columns.size());
    for (std::size_t c = 0; c < other.columns.size(); ++c) columns[c].add(other.columns[c]);
    examples.insert(examples.end(), other.examples.begin(), other.examples.end());
    std::sort(examples.begin(), examples.end(), [](const WrongRow& x, const WrongRow& y) {
        if (x.verdict != y.verdict) return x.verdict < y.verdict;
        if (x.severity != y.severity) return x.severity > y.severity;
        return x.row < y.row;
    });
    // The same rows, whatever the parts.
    invented_rows.insert(invented_rows.end(), other.invented_rows.begin(), other.invented_rows.end());
    const auto before = [](const WrongRow& x, const WrongRow& y) { return base::mix64(x.row) < base::mix64(y.row); };
    std::sort(invented_rows.begin(), invented_rows.end(), before);
    if (invented_rows.size() > max_measured) invented_rows.resize(max_measured);
    std::size_t of_kind = 0;
    RowVerdict kind = RowVerdict::right;
    std::erase_if(examples, [&](const WrongRow& row) {
        of_kind = row.verdict == kind ? of_kind + 1 : 1;
        kind = row.verdict;
        return of_kind > examples_of_each;
    });
}

}  // namespace barycert
