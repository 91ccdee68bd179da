#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/verify.hpp"
#include "core/base/finite.hpp"
#include "core/base/random.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/threads/arena.hpp"
#include "mesh/verify/errors.hpp"

namespace barycert {

namespace verify {
namespace {

class BlockVerifier {
public:
    BlockVerifier(const Sampler& sampler, const Verifier& verifier, const ClaimedRows& claimed)
        : sampler_(sampler), options_(verifier.options()), ranges_(verifier.ranges()), claimed_(claimed) {}

    /// There is no Error: sizes fit, and points are finite or need not be.
    Verdicts run() {
        const std::size_t rows = claimed_.points.size() / d_;
        found_.rows = rows;
        found_.columns.resize(ranges_.size());
        const SampleOptions exact{.threads = 1, .nonfinite_points = options_.nonfinite_points};
        sampler_.sample(claimed_.points, exact, table_).value();
        for (std::size_t row = 0; row < rows; ++row) look_at(row);
        look_again();
        Verdicts none;
        none.add(found_, options_.examples);  // orders examples
        return none;
    }

private:
    std::size_t columns() const { return ranges_.size(); }
    const double* point(std::size_t row) const { return claimed_.points.data() + d_ * row; }
    const double* values(std::size_t row) const { return table_.values.data() + columns() * row; }
    const double* claims(std::size_t row) const { return claimed_.values.data() + columns() * row; }

    /// Whether it is so of each of the row's values; false if there are none.
    template <class Is>
    bool all_of(const double* row, Is is) const {
        return columns() != 0 && std::all_of(row, row + columns(), is);
    }

    /// Does the row say that the point is inside?
    bool says_inside(std::size_t row) const {
        if (!claimed_.inside.empty()) return claimed_.inside[row] != 0;
        if (!claimed_.cells.empty()) return claimed_.cells[row] >= 0;
        const auto is_nan = [](double x) { return std::isnan(x); };
        const auto means_outside = [&](double x) { return x == *options_.outside_value; };
        if (!all_of(claims(row), is_nan) && !(options_.outside_value && all_of(claims(row), means_outside)))
            return true;
        // Where the exact values are NaN themselves, NaN says nothing.
        return table_.cells[row] >= 0 && all_of(values(row), is_nan);
    }

    bool names_wrong_cell(std::size_t row) {
        if (claimed_.cells.empty() || claimed_.cells[row] < 0 || claimed_.cells[row] == table_.cells[row]) return false;
        const Mesh& mesh = sampler_.locator().mesh();
        const auto cells = static_cast<std::int64_t>(mesh.cell_count()), claimed = claimed_.cells[row];
        if (claimed >= cells) return true;
        std::array<double, 3> at{};
        std::copy_n(point(row), d_, at.begin());
        const auto is_claimed = [&](std::int64_t cell) {
            return mesh.cell_number(static_cast<Mesh::Index>(cell)) ==
                   mesh.cell_number(static_cast<Mesh::Index>(claimed));
        };
        const locate::LocatorData& data = locate::LocatorData::of(sampler_.locator());
        if (data.mapped) {
            const Result<Table> held = sampler_.locator().locate_all({at.data(), d_}, 1);
            return !held || std::ranges::none_of(held->cells, is_claimed);
        }
        for (std::int64_t part = claimed; part < cells && is_claimed(part); ++part) {
            const locate::Place place = data.parts.places()[static_cast<std::size_t>(part)];
            if (locate::cell_signs(data.index, place, at.data(), tests_).contains()) return false;
        }
        return true;
    }

    void look_at(std::size_t row) {
        const bool inside = table_.cells[row] >= 0, said = says_inside(row);
        const bool boundary = table_.features[row] != Feature::interior;
        ++(inside ? found_.inside : found_.outside);
        if (!inside && !base::all_finite({point(row), d_})) ++found_.not_finite;
        found_.on_boundary += inside && boundary ? 1 : 0;
        if (!inside && !said) {
            ++found_.right;
        } else if (inside && !said) {
            ++found_.missed;
            found_.missed_on_boundary += boundary ? 1 : 0;
            found_.examples.push_back(wrong_row(row, RowVerdict::missed, boundary ? 0 : 1));
        } else if (!inside) {
            ++found_.invented;
            found_.invented_zero += all_of(claims(row), [](double x) { return x == 0; }) ? 1 : 0;
            found_.invented_rows.push_back(wrong_row(row, RowVerdict::invented, 0));
        } else if (over(row, values(row)) && (boundary || !sampler_.locator().certified())) {
            again_.push_back(row);
        } else {
            settle(row, values(row), 1);
        }
    }

    bool over(std::size_t row, const double* exact) const {
        for (std::size_t c = 0; c < columns(); ++c)
            if (compare(claims(row)[c], exact[c], ranges_[c]).over(options_)) return true;
        return false;
    }

    /// A row inside that says so, held against `exact`.
    void settle(std::size_t row, const double* exact, std::uint64_t cells) {
        ValueError worst;
        std::size_t column = 0;
        bool wrong = false;
        for (std::size_t c = 0; c < columns(); ++c) {
            const ValueError error = compare(claims(row)[c], exact[c], ranges_[c]);
            count(error, claims(row)[c], options_, found_.columns[c]);
            wrong = wrong || error.over(options_);
            if (c != 0 && !(error.relative > worst.relative)) continue;
            worst = error;
            column = c;
        }
        const RowVerdict verdict = names_wrong_cell(row) ? RowVerdict::wrong_cell
                                   : wrong               ? RowVerdict::wrong_value
                                                         : RowVerdict::right;
        ++(verdict == RowVerdict::wrong_cell    ? found_.wrong_cell
           : verdict == RowVerdict::wrong_value ? found_.wrong_value
                                                : found_.right);
        if (verdict == RowVerdict::right) return;
        WrongRow& kept = found_.examples.emplace_back(wrong_row(row, verdict, worst.relative));
        kept.cells = cells;
        if (columns() == 0) return;
        kept.column = column;
        kept.claimed = claims(row)[column];
        kept.value = exact[column];
        kept.ulps = worst.ulps;
        kept.relative = worst.relative;
    }

    /// Every cell that contains the point may be the one that a tool took: that whose largest error is least counts.
    void look_again() {
        if (again_.empty()) return;
        std::vector<double> points;
        points.reserve(d_ * again_.size());
        for (const std::size_t row : again_) points.insert(points.end(), point(row), point(row) + d_);
        Table all = sampler_.locator().locate_all(points, 1).value();
        const std::vector<std::size_t> begin = all.point_begin;
        points = all.points;
        sampler_.evaluate(points, {.threads = 1}, all).value();
        for (std::size_t i = 0; i < again_.size(); ++i) {
            double least = std::numeric_limits<double>::infinity();
            std::size_t choice = begin[i];  // the owner, unless another one is nearer
            for (std::size_t row = begin[i]; row < begin[i + 1]; ++row) {
                double most = 0;
                for (std::size_t c = 0; c < columns(); ++c)
                    most = std::max(most, compare(claims(again_[i])[c], all.value(row, c), ranges_[c]).relative);
                if (!(most < least)) continue;
                least = most;
                choice = row;
            }
            const std::uint64_t right = found_.right, cells = begin[i + 1] - begin[i];
            found_.several += cells > 1 ? 1 : 0;
            settle(again_[i], all.values.data() + columns() * choice, cells);
            found_.by_other_cell += choice != begin[i] && found_.right != right ? 1 : 0;
        }
    }

    WrongRow wrong_row(std::size_t row, RowVerdict verdict, double severity) const {
        WrongRow wrong;
        wrong.verdict = verdict;
        wrong.row = claimed_.first_row + row;
        wrong.severity = severity;
        std::copy_n(point(row), d_, wrong.point.begin());
        if (!claimed_.cells.empty()) wrong.claimed_cell = claimed_.cells[row];
        wrong.exact = {table_.cells[row], table_.features[row]};
        wrong.cells = table_.cells[row] >= 0 ? 1 : 0;
        if (columns() != 0) {
            // The first value that says something.
            const double* const told = verdict == RowVerdict::invented ? claims(row) : values(row);
            const double* const first = std::find_if(told, told + columns(), [](double x) { return !std::isnan(x); });
            wrong.column = first == told + columns() ? 0 : static_cast<std::size_t>(first - told);
            wrong.claimed = claims(row)[wrong.column];
            wrong.value = values(row)[wrong.column];
        }
        return wrong;
    }

    const Sampler& sampler_;
    const VerifyOptions& options_;
    const std::vector<double>& ranges_;
    const ClaimedRows& claimed_;
    std::size_t d_ = static_cast<std::size_t>(sampler_.locator().mesh().dimension);
    Table table_;
    TierCounts tests_;
    std::vector<std::size_t> again_;
    Verdicts found_;
};

Status wrong_size(const char* what, std::size_t expected, std::size_t found) {
    return file_error("argument.size", {}, std::string("size of ") + what, std::to_string(expected),
                      std::to_string(found));
}

Status check_claims(const Sampler& sampler, const ClaimedRows& rows, NonfinitePoints nonfinite) {
    const auto d = static_cast<std::size_t>(sampler.locator().mesh().dimension);
    if (rows.points.size() % d != 0) return wrong_size("the points", d, rows.points.size() % d);
    const std::size_t count = rows.points.size() / d, columns = sampler.columns().size();
    if (!rows.cells.empty() && rows.cells.size() != count) return wrong_size("the cells", count, rows.cells.size());
    if (!rows.inside.empty() && rows.inside.size() != count)
        return wrong_size("inside or outside", count, rows.inside.size());
    if (rows.values.size() != count * columns) return wrong_size("the values", count * columns, rows.values.size());
    return nonfinite == NonfinitePoints::nan ? Status(Done{}) : locate::check_finite(rows.points, d, rows.first_row);
}

ClaimedRows part_of(const ClaimedRows& rows, std::size_t d, std::size_t columns, std::size_t first, std::size_t size) {
    const auto part = [&](auto all, std::size_t width) {
        return all.empty() ? all : all.subspan(width * first, width * size);
    };
    return {part(rows.points, d), part(rows.cells, 1), part(rows.inside, 1), part(rows.values, columns),
            rows.first_row + first};
}

}  // namespace
}  // namespace verify

Result<Verdicts> Verifier::verify(const ClaimedRows& rows) const {
    const ExactEnvironment environment;
    if (!sampler_.locator().mesh().is_listed()) return locate::not_listed("rows to verify, of cells");
    if (Status ok = verify::check_claims(sampler_, rows, options_.nonfinite_points); !ok) return ok.error();
    const auto d = static_cast<std::size_t>(sampler_.locator().mesh().dimension);
    const std::size_t count = rows.points.size() / d, columns = sampler_.columns().size();
    constexpr std::size_t block = std::size_t{1} << 17;
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<Verdicts> parts(blocks);
    base::in_arena(options_.threads, count, [&] {
        base::parallel_for(blocks, [&](std::size_t b) {
            const ExactEnvironment of_task;
            const std::size_t first = b * block;
            const ClaimedRows part = verify::part_of(rows, d, columns, first, std::min(block, count - first));
            parts[b] = verify::BlockVerifier(sampler_, *this, part).run();
        });
    });
    Verdicts all;
    all.columns.resize(columns);
    for (const Verdicts& part : parts) all.add(part, options_.examples);
    return all;
}

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
    std::ranges::sort(examples, [](const WrongRow& x, const WrongRow& y) {
        return std::tuple(x.verdict, y.severity, x.row) < std::tuple(y.verdict, x.severity, y.row);
    });
    // The same rows, whatever the parts.
    invented_rows.insert(invented_rows.end(), other.invented_rows.begin(), other.invented_rows.end());
    std::ranges::sort(invented_rows, {}, [](const WrongRow& row) { return base::mix64(row.row); });
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
