#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/verify.hpp"
#include "core/base/finite.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/sample/points/sampler_data.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace {

/// The number that errors of a component are relative to, and its kind.
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

/// The lengths at nodes, whose range is that of the field of lengths. Gradients on cells of second order have no
/// numbers at nodes: none.
Field lengths_at_nodes(const sample::AtPoint& late) {
    Field lengths;
    const auto n = static_cast<std::size_t>(late.field->components);
    const std::size_t first = late.component < 0 ? 0 : static_cast<std::size_t>(late.component);
    for (std::size_t i = 0; !late.gradient && i < late.field->data.size(); i += n)
        lengths.data.push_back(
            sample::euclidean_length(std::span(late.field->data).subspan(i + first, late.component < 0 ? n : 1)));
    return lengths;
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

Status Verifier::measure(Verdicts& verdicts) const {
    const ExactEnvironment environment;
    if (!sampler_.locator().mesh().is_listed()) return locate::not_listed("rows to measure");
    std::vector<WrongRow>& rows = verdicts.invented_rows;
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
            // The point is finite, and the mesh lists its cells: there is no Error.
            const Nearest nearest = sampler_.locator().nearest(rows[i].point.data(), anywhere).value();
            rows[i].severity = rows[i].distance = nearest.distance;
        });
    });
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
