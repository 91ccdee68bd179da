#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "barycert/base/arena.hpp"
#include "barycert/base/finite.hpp"
#include "barycert/environment.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/locate/cell_signs.hpp"
#include "barycert/sample/points/sampler_data.hpp"
#include "barycert/sample/quantity/quantities.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify/errors.hpp"

namespace barycert {
namespace {

using verify::ValueError;

/// What errors of a component are relative to.
std::pair<double, RelativeTo> range_of(const Field& field, std::size_t component) {
    const auto components = static_cast<std::size_t>(field.components);
    double low = std::numeric_limits<double>::infinity(), high = -low, size = 0;
    for (std::size_t i = component; i < field.data.size(); i += components) {
        const double x = field.data[i];
        if (!std::isfinite(x)) continue;
        low = std::min(low, x);
        high = std::max(high, x);
        size = std::max(size, std::fabs(x));
    }
    const double range = std::min(high - low, std::numeric_limits<double>::max());
    if (range > 0) return {range, RelativeTo::range};
    return size > 0 ? std::pair(size, RelativeTo::magnitude) : std::pair(1.0, RelativeTo::one);
}

/// What ranges of lengths are those of. Gradients on cells of second order have no numbers at nodes: none.
Field lengths_at_nodes(const sample::AtPoint& late) {
    Field lengths;
    const auto n = static_cast<std::size_t>(late.field->components);
    const std::size_t first = late.component < 0 ? 0 : static_cast<std::size_t>(late.component);
    for (std::size_t i = 0; !late.gradient && i < late.field->data.size(); i += n)
        lengths.data.push_back(
            sample::euclidean_length(std::span(late.field->data).subspan(i + first, late.component < 0 ? n : 1)));
    return lengths;
}

Status wrong_size(const char* what, std::size_t expected, std::size_t found) {
    return Error{
        .what = std::string("size of ") + what, .expected = std::to_string(expected), .found = std::to_string(found)};
}

/// One block of rows.
class BlockVerifier {
public:
    BlockVerifier(const Sampler& sampler, const Verifier& verifier, const ClaimedRows& claimed)
        : sampler_(sampler), options_(verifier.options()), ranges_(verifier.ranges()), claimed_(claimed) {}

    Result<Verdicts> run() {
        const std::size_t rows = claimed_.points.size() / d_;
        found_.rows = rows;
        found_.columns.resize(ranges_.size());
        SampleOptions exact;
        exact.threads = 1;
        exact.nonfinite_points = options_.nonfinite_points;
        if (Status done = sampler_.sample(claimed_.points, exact, table_, claimed_.first_row); !done)
            return done.error();
        for (std::size_t row = 0; row < rows; ++row) look_at(row);
        if (Status done = look_again(); !done) return done.error();
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
        if (static_cast<std::uint64_t>(claimed_.cells[row]) >= sampler_.locator().mesh().cell_count()) return true;
        std::array<double, 3> at{};
        std::copy_n(point(row), d_, at.begin());
        const locate::LocatorData& data = locate::LocatorData::of(sampler_.locator());
        const locate::Place place = data.places()[static_cast<std::size_t>(claimed_.cells[row])];
        return !locate::cell_signs(data.index, place, at.data(), tests_).contains();
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
            keep(row, RowVerdict::missed, boundary ? 0 : 1);
        } else if (!inside) {
            invent(row);
        } else if (over(row, values(row)) && (boundary || !sampler_.locator().certified())) {
            again_.push_back(row);
        } else {
            settle(row, values(row), 1);
        }
    }

    void invent(std::size_t row) {
        ++found_.invented;
        found_.invented_zero += all_of(claims(row), [](double x) { return x == 0; }) ? 1 : 0;
        found_.invented_rows.push_back(wrong_row(row, RowVerdict::invented, 0));
    }

    bool over(std::size_t row, const double* exact) const {
        for (std::size_t c = 0; c < columns(); ++c) {
            if (verify::compare(claims(row)[c], exact[c], ranges_[c]).over(options_)) return true;
        }
        return false;
    }

    /// A row inside that says so, held against `exact`.
    void settle(std::size_t row, const double* exact, std::uint64_t cells) {
        ValueError worst;
        std::size_t column = 0;
        bool wrong = false;
        for (std::size_t c = 0; c < columns(); ++c) {
            const ValueError error = verify::compare(claims(row)[c], exact[c], ranges_[c]);
            verify::count(error, claims(row)[c], options_, found_.columns[c]);
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
        WrongRow& kept = keep(row, verdict, worst.relative);
        kept.cells = cells;
        if (columns() == 0) return;
        kept.column = column;
        kept.claimed = claims(row)[column];
        kept.value = exact[column];
        kept.ulps = worst.ulps;
        kept.relative = worst.relative;
    }

    Status look_again() {
        const auto best = verify::best_holders(sampler_, claimed_, again_, ranges_);
        if (!best) return best.error();
        for (std::size_t i = 0; i < again_.size(); ++i) {
            const verify::BestHolder& holder = (*best)[i];
            found_.several += holder.cells > 1 ? 1 : 0;
            const std::uint64_t right = found_.right;
            settle(again_[i], holder.values.data(), holder.cells);
            found_.by_other_cell += holder.other && found_.right != right ? 1 : 0;
        }
        return Done{};
    }

    WrongRow& keep(std::size_t row, RowVerdict verdict, double severity) {
        return found_.examples.emplace_back(wrong_row(row, verdict, severity));
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
    ClaimedRows part;
    part.points = rows.points.subspan(d * first, d * size);
    if (!rows.cells.empty()) part.cells = rows.cells.subspan(first, size);
    if (!rows.inside.empty()) part.inside = rows.inside.subspan(first, size);
    part.values = rows.values.subspan(columns * first, columns * size);
    part.first_row = rows.first_row + first;
    return part;
}

}  // namespace

Verifier::Verifier(const Sampler& sampler, const VerifyOptions& options) : sampler_(sampler), options_(options) {
    const ExactEnvironment environment;
    const sample::SamplerData& data = sample::SamplerData::of(sampler);
    const locate::CellIndex& index = data.index();
    near_ = near_distance *
            std::hypot(index.high[0] - index.low[0], index.high[1] - index.low[1], index.high[2] - index.low[2]);
    const auto add = [&](const Field& field, std::size_t component, std::size_t columns) {
        const auto [range, relative_to] = range_of(field, component);
        ranges_.insert(ranges_.end(), columns, range);
        relative_to_.insert(relative_to_.end(), columns, relative_to);
    };
    std::size_t hidden = data.hidden;
    for (const auto* fields : {&data.point_fields, &data.cell_fields}) {
        for (const Field* field : *fields) {
            for (std::size_t c = 0; c < static_cast<std::size_t>(field->components); ++c) {
                if (hidden == 0) add(*field, c, 1);
                hidden -= hidden == 0 ? 0 : 1;
            }
        }
    }
    for (const sample::AtPoint& late : data.at_points)
        add(lengths_at_nodes(late), 0, late.length || late.component >= 0 ? 1 : late.components);
}

Result<Verdicts> Verifier::verify(const ClaimedRows& rows) const {
    const ExactEnvironment environment;
    if (Status ok = check_claims(sampler_, rows, options_.nonfinite_points); !ok) return ok.error();
    const auto d = static_cast<std::size_t>(sampler_.locator().mesh().dimension);
    const std::size_t count = rows.points.size() / d, columns = sampler_.columns().size();
    constexpr std::size_t block = std::size_t{1} << 17;
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<std::optional<Result<Verdicts>>> parts(blocks);
    base::in_arena(options_.threads, count, [&] {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
            const ExactEnvironment of_task;
            const std::size_t first = b * block;
            const ClaimedRows part = part_of(rows, d, columns, first, std::min(block, count - first));
            parts[b].emplace(BlockVerifier(sampler_, *this, part).run());
        });
    });
    Verdicts all;
    all.columns.resize(columns);
    for (auto& part : parts) {
        if (!*part) return part->error();
        all.add(**part, options_.examples);
    }
    return all;
}

Status Verifier::measure(Verdicts& verdicts) const {
    const ExactEnvironment environment;
    std::vector<WrongRow>& rows = verdicts.invented_rows;
    std::vector<std::optional<Error>> errors(rows.size());
    base::in_arena(options_.threads, 1024 * rows.size(), [&] {
        tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
            const ExactEnvironment of_task;
            constexpr double anywhere = std::numeric_limits<double>::infinity();
            const auto d = static_cast<std::size_t>(sampler_.locator().mesh().dimension);
            if (!base::all_finite({rows[i].point.data(), d})) {
                rows[i].severity = anywhere;
                rows[i].distance = std::numeric_limits<double>::quiet_NaN();
                return;
            }
            const auto nearest = sampler_.locator().nearest(rows[i].point.data(), anywhere);
            if (!nearest) {
                errors[i] = nearest.error();
            } else {
                rows[i].severity = rows[i].distance = nearest->distance;
            }
        });
    });
    for (const std::optional<Error>& error : errors) {
        if (error) return *error;
    }
    for (const WrongRow& row : rows) {
        verdicts.invented_measured += std::isnan(row.distance) ? 0 : 1;
        verdicts.invented_near += row.distance <= near_ ? 1 : 0;
        verdicts.invented_distance = std::max(verdicts.invented_distance, row.distance);
    }
    Verdicts measured;
    measured.examples = std::exchange(rows, {});
    verdicts.add(measured, options_.examples);
    return Done{};
}

}  // namespace barycert
