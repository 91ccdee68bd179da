#include "barycert/sample/grid/slab_sampler.hpp"

#include <algorithm>

#include "barycert/locate/cell_signs.hpp"
#include "barycert/sample/grid/fill_lanes.hpp"

namespace barycert::sample {
namespace {

constexpr std::size_t cells_at_once = 256;

/// Values that fill_cells finds.
bool can_fill(const SamplerData& data, const Raster& raster, const SampleOptions& options) {
    return raster.precise && options.rounding == Rounding::correct && !data.quadratic && data.point_components != 0;
}

}  // namespace

void SlabSampler::run(std::int32_t first, std::int32_t last, std::span<const locate::Place> cells) {
    first_ = first;
    last_ = last;
    const std::size_t layer = grid_.dimension == 3 ? grid_.layer_size() : static_cast<std::size_t>(grid_.counts[0]);
    points_ = layer * static_cast<std::size_t>(last - first);
    constexpr std::size_t more = 8;  // FillTarget
    rows_.cells.assign(points_ + more, -1);
    rows_.features.assign(points_ + more, Feature::outside);
    rows_.values.resize((points_ + more) * data_.columns.size());
    const bool distances = options_.outside.kind == Outside::nearest || options_.outside.kind == Outside::extrapolate;
    rows_.distances.assign(distances ? points_ : 0, 0);
    counts_ = {};
    sampler_.emplace(data_, options_,
                     BlockRows{rows_.cells.data(), rows_.features.data(), rows_.values.data(),
                               distances ? rows_.distances.data() : nullptr});
    can_fill(data_, raster_, options_) ? fill(cells) : raster(cells);
    evaluate_rest();
    for (std::size_t point = 0; point < points_; ++point) counts_.locations.add(rows_.features[point]);
    counts_.add(sampler_->counts());
}

void SlabSampler::fill(std::span<const locate::Place> cells) {
    const NodeValues nodes = data_.node_values();
    const FillSource source{data_.index(), nodes, raster_};
    const FillTarget target{rows_.cells.data(),
                            rows_.features.data(),
                            rows_.values.data(),
                            data_.columns.size(),
                            static_cast<std::size_t>(grid_.counts[0]),
                            static_cast<std::size_t>(grid_.counts[1]),
                            first_,
                            last_,
                            !data_.located().proof.partition};
    for (std::size_t c = 0; c < cells.size(); c += cells_at_once) {
        undecided_.clear();
        fill_cells(source, cells.subspan(c, std::min(cells_at_once, cells.size() - c)), target, undecided_);
        for (const Span& span : undecided_.spans) take(span);
        raster(undecided_.cells);
    }
}

void SlabSampler::raster(std::span<const locate::Place> cells) {
    for (std::size_t c = 0; c < cells.size(); c += cells_at_once) {
        spans_.clear();
        find_spans(data_.index(), raster_, cells.data() + c, std::min(cells_at_once, cells.size() - c), first_, last_,
                   spans_);
        for (const Span& span : spans_) {
            take(span);
            const std::size_t line = line_of(span.row, span.layer);
            const Mesh::Index cell = data_.index().original[static_cast<std::size_t>(span.cell)];
            for (std::int32_t i = span.inner_first; i < span.inner_last; ++i)
                own(line + static_cast<std::size_t>(i), cell, interior_without_value);
        }
    }
}

/// Where the points of a row begin.
std::size_t SlabSampler::line_of(std::int32_t row, std::int32_t layer) const {
    const auto columns = static_cast<std::size_t>(grid_.counts[0]), rows = static_cast<std::size_t>(grid_.counts[1]);
    if (grid_.dimension == 2) return static_cast<std::size_t>(row - first_) * columns;
    return (static_cast<std::size_t>(layer - first_) * rows + static_cast<std::size_t>(row)) * columns;
}

/// The points of a span of which it is not certain whether they are in the cell.
void SlabSampler::take(const Span& span) {
    const std::size_t line = line_of(span.row, span.layer);
    for (std::int32_t i = span.first; i < span.inner_first; ++i) test(span, i, line + static_cast<std::size_t>(i));
    for (std::int32_t i = span.inner_last; i < span.last; ++i) test(span, i, line + static_cast<std::size_t>(i));
}

void SlabSampler::test(const Span& span, std::int32_t column, std::size_t point) {
    const locate::CellIndex& index = data_.index();
    const Mesh::Index cell = index.original[static_cast<std::size_t>(span.cell)];
    if (rows_.cells[point] >= 0 && rows_.cells[point] < cell) return;
    const std::array<double, 3> at{raster_.at[0][static_cast<std::size_t>(column)],
                                   raster_.at[1][static_cast<std::size_t>(span.row)],
                                   raster_.at[2][static_cast<std::size_t>(span.layer)]};
    const WeightSigns signs = locate::cell_signs(index, span.cell, at.data(), counts_.locations.tests);
    if (!signs.contains()) return;
    const Feature feature = signs.feature(index.simplex);
    own(point, cell, feature == Feature::interior ? interior_without_value : feature);
}

void SlabSampler::own(std::size_t point, Mesh::Index cell, Feature feature) {
    if (rows_.cells[point] >= 0 && rows_.cells[point] < cell) return;
    rows_.cells[point] = cell;
    rows_.features[point] = feature;
}

void SlabSampler::evaluate_rest() {
    std::uint64_t found = 0;
    for (std::size_t point = 0; point < points_; ++point) {
        if (rows_.features[point] == Feature::interior) {
            ++found;
            if (!data_.cell_fields.empty())
                copy_cell_values(data_, rows_.cells[point], rows_.values.data() + data_.columns.size() * point);
        } else {
            push(point);
        }
    }
    flush();
    counts_.values.add(Tier::double_double, found);
}

void SlabSampler::push(std::size_t point) {
    const auto nx = static_cast<std::size_t>(grid_.counts[0]), ny = static_cast<std::size_t>(grid_.counts[1]);
    const std::size_t line = point / nx;
    const std::size_t row = grid_.dimension == 3 ? line % ny : line + static_cast<std::size_t>(first_);
    const std::size_t layer = grid_.dimension == 3 ? line / ny + static_cast<std::size_t>(first_) : 0;
    records_[pending_].at = {raster_.at[0][point % nx], raster_.at[1][row], raster_.at[2][layer]};
    records_[pending_].number = static_cast<std::uint32_t>(point);
    const Mesh::Index cell = rows_.cells[point];
    cells_[pending_] = cell < 0 ? -1 : data_.located().places()[static_cast<std::size_t>(cell)];
    const Feature feature = rows_.features[point];
    features_[pending_] = feature == interior_without_value ? Feature::interior : feature;
    if (++pending_ == locate::chunk_size) flush();
}

void SlabSampler::flush() {
    (*sampler_)(records_.data(), pending_, cells_.data(), features_.data());
    pending_ = 0;
}

TableView SlabSampler::block() const {
    const std::size_t layer = grid_.dimension == 3 ? grid_.layer_size() : static_cast<std::size_t>(grid_.counts[0]);
    return {.dimension = grid_.dimension,
            .first_row = layer * static_cast<std::size_t>(first_),
            .cells = std::span(rows_.cells).first(points_),
            .features = std::span(rows_.features).first(points_),
            .values = std::span(rows_.values).first(points_ * data_.columns.size()),
            .distances = rows_.distances};
}

std::optional<std::uint64_t> SlabSampler::refused() const {
    if (!sampler_->refused()) return std::nullopt;
    return block().first_row + *sampler_->refused();
}

}  // namespace barycert::sample
