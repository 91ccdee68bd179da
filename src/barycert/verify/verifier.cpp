#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "barycert/base/arena.hpp"
#include "barycert/base/finite.hpp"
#include "barycert/environment.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/sample/points/sampler_data.hpp"
#include "barycert/sample/quantity/quantities.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify/errors.hpp"

namespace barycert {
namespace {

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
        base::parallel_for(blocks, [&](std::size_t b) {
            const ExactEnvironment of_task;
            const std::size_t first = b * block;
            const ClaimedRows part = part_of(rows, d, columns, first, std::min(block, count - first));
            parts[b].emplace(verify::verdicts_of(sampler_, *this, part));
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
        base::parallel_for(rows.size(), [&](std::size_t i) {
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
    for (const std::optional<Error>& error : errors)
        if (error) return *error;
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
