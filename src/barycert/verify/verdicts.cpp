#include <algorithm>
#include <cstddef>

#include "barycert/base/random.hpp"
#include "barycert/verify.hpp"

namespace barycert {

void ValueErrors::add(const ValueErrors& other) {
    values += other.values;
    identical += other.identical;
    over += other.over;
    missing += other.missing;
    spurious += other.spurious;
    floats += other.floats;
    max_ulps = std::max(max_ulps, other.max_ulps);
    max_relative = std::max(max_relative, other.max_relative);
    for (std::size_t i = 0; i < by_ulps.size(); ++i) by_ulps[i] += other.by_ulps[i];
    for (std::size_t i = 0; i < by_relative.size(); ++i) by_relative[i] += other.by_relative[i];
}

void Verdicts::add(const Verdicts& other, std::size_t examples_of_each) {
    rows += other.rows;
    right += other.right;
    missed += other.missed;
    invented += other.invented;
    wrong_cell += other.wrong_cell;
    wrong_value += other.wrong_value;
    inside += other.inside;
    outside += other.outside;
    not_finite += other.not_finite;
    on_boundary += other.on_boundary;
    missed_on_boundary += other.missed_on_boundary;
    invented_zero += other.invented_zero;
    several += other.several;
    by_other_cell += other.by_other_cell;
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
