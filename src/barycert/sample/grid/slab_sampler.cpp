#include "barycert/sample/grid/slab_sampler.hpp"

#include <algorithm>
#include <limits>

#include "barycert/locate/cell_signs.hpp"
#include "barycert/sample/grid/fill_lanes.hpp"

namespace barycert::sample {
namespace {

constexpr std::size_t cells_at_once = 256, cells_to_fill = 4096;

/// Values that fill_cells finds. Of plain ones it does not see which have a node that is not finite.
bool can_fill(const SamplerData& data, const Raster& raster, Rounding rounding) {
    return raster.precise && !data.quadratic && data.point_components != 0 &&
           (data.finite || rounding == Rounding::correct);
}

}  // namespace

void SlabSampler::run(std::int32_t first, std::int32_t last, const SlabCells& cells, std::size_t slab) {
    first_ = first;
    last_ = last;
    const std::size_t layer = grid_.dimension == 3 ? grid_.layer_size() : static_cast<std::size_t>(grid_.counts[0]);
    points_ = layer * static_cast<std::size_t>(last - first);
    constexpr std::size_t more = 8;  // FillTarget
    if (owners_.size() < points_ + more) {
        owners_ = locate::Buffer<Mesh::Index>(points_ + more);
        found_ = locate::Buffer<Feature>(points_ + more);
        values_ = locate::Buffer<double>((points_ + more) * data_.width);
    }
    std::fill_n(owners_.data(), points_ + more, -1);
    std::fill_n(found_.data(), points_ + more, Feature::outside);
    const bool distances = options_.outside.kind == Outside::nearest || options_.outside.kind == Outside::extrapolate;
    distances_.assign(distances ? points_ : 0, 0);
    counts_ = {};
    sampler_.emplace(data_, options_,
                     BlockRows{owners_.data(), found_.data(), values_.data(), distances ? distances_.data() : nullptr});
    filled_ = can_fill(data_, raster_, options_.rounding);
    cells.for_parts(slab, [&](std::span<const locate::Place> some) { filled_ ? fill(some) : raster(some); });
    finish();
    counts_.add(sampler_->counts());
}

FillTarget SlabSampler::target() {
    return {owners_.data(),
            found_.data(),
            values_.data(),
            data_.width,
            static_cast<std::size_t>(grid_.counts[0]),
            static_cast<std::size_t>(grid_.counts[1]),
            first_,
            last_};
}

void SlabSampler::fill(std::span<const locate::Place> cells) {
    const NodeValues nodes = data_.node_values();
    const FillSource source{data_.index(), nodes, raster_, options_.rounding};
    const FillTarget target = this->target();
    for (std::size_t c = 0; c < cells.size(); c += cells_to_fill) {
        undecided_.clear();
        fill_cells(source, cells.subspan(c, std::min(cells_to_fill, cells.size() - c)), target, undecided_);
        for (const Span& span : undecided_.spans) take(span);
        for (const UndecidedPoint& point : undecided_.points) take(point);
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
            const Mesh::Index cell = original(span.cell);
            for (std::int32_t i = span.inner_first; i < span.inner_last; ++i)
                own(line + static_cast<std::size_t>(i), cell, without_value(Feature::interior));
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
    const auto test = [&](std::int32_t column) {
        const std::size_t point = line + static_cast<std::size_t>(column);
        const auto feature = tested(span.cell, {column, span.row, span.layer}, point);
        if (feature) own(point, original(span.cell), without_value(*feature));
    };
    for (std::int32_t i = span.first; i < span.inner_first; ++i) test(i);
    for (std::int32_t i = span.inner_last; i < span.last; ++i) test(i);
}

void SlabSampler::take(const UndecidedPoint& one) {
    const std::size_t point = line_of(one.row, one.layer) + static_cast<std::size_t>(one.column);
    const auto feature = tested(one.cell, {one.column, one.row, one.layer}, point);
    if (!feature) return;
    own(point, original(one.cell), one.certain ? *feature : without_value(*feature));
    values_[point] = one.value;
}

/// Where the point lies in the cell, exactly; nothing outside of it, or if a lower cell has the point.
std::optional<Feature> SlabSampler::tested(locate::Place cell, const std::array<std::int32_t, 3>& places,
                                           std::size_t point) {
    if (owners_[point] >= 0 && owners_[point] < original(cell)) return std::nullopt;
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = raster_.at[k][static_cast<std::size_t>(places[k])];
    const WeightSigns signs = locate::cell_signs(data_.index(), cell, at.data(), counts_.locations.tests);
    if (!signs.contains()) return std::nullopt;
    return signs.feature(data_.index().simplex);
}

/// Unless a lower cell has the point.
void SlabSampler::own(std::size_t point, Mesh::Index cell, Feature feature) {
    if (owners_[point] >= 0 && owners_[point] < cell) return;
    owners_[point] = cell;
    found_[point] = feature;
}

/// Some points at a time, while they are in cache: features and numbers of those outside, then what takes longer.
void SlabSampler::finish() {
    constexpr std::size_t step = 4096;
    const FillTarget target = this->target();
    const double fill =
        options_.outside.kind == Outside::fill ? options_.outside.fill : std::numeric_limits<double>::quiet_NaN();
    const bool same = options_.outside.kind == Outside::nan || options_.outside.kind == Outside::fill;
    finished_ = {};
    for (std::size_t first = 0; first < points_; first += step) {
        const std::size_t last = std::min(first + step, points_);
        finished_.others.clear();
        finish_points(target, first, last, same ? &fill : nullptr, finished_);
        for (const std::uint32_t point : finished_.others) {
            counts_.locations.add(feature_of(point));
            push(point);
        }
        // Points that are pushed get a whole row; where cells fill in values, they are linear.
        for (std::size_t point = first; filled_ && data_.has_rest() && point < last; ++point) {
            if (owners_[point] >= 0)
                set_rest_of_row(data_, options_.rounding, owners_[point], nullptr,
                                values_.data() + data_.width * point);
        }
    }
    flush();
    if (data_.hidden != 0) leave_out_hidden(data_, values_.data(), points_, values_.data());
    counts_.locations.add(finished_.locations);
    counts_.locations.add(Feature::outside, finished_.outside);
    counts_.without_value += finished_.outside;
    if (options_.rounding == Rounding::correct) counts_.values.add(Tier::double_double, finished_.with_value);
}

void SlabSampler::push(std::size_t point) {
    const auto nx = static_cast<std::size_t>(grid_.counts[0]), ny = static_cast<std::size_t>(grid_.counts[1]);
    const std::size_t line = point / nx;
    const std::size_t row = grid_.dimension == 3 ? line % ny : line + static_cast<std::size_t>(first_);
    const std::size_t layer = grid_.dimension == 3 ? line / ny + static_cast<std::size_t>(first_) : 0;
    records_[pending_].at = {raster_.at[0][point % nx], raster_.at[1][row], raster_.at[2][layer]};
    records_[pending_].number = static_cast<std::uint32_t>(point);
    const Mesh::Index cell = owners_[point];
    cells_[pending_] = cell < 0 ? -1 : data_.located().places()[static_cast<std::size_t>(cell)];
    features_[pending_] = feature_of(point);
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
            .cells = {owners_.data(), points_},
            .features = {found_.data(), points_},
            .values = {values_.data(), points_ * data_.columns.size()},
            .distances = distances_};
}

std::optional<std::uint64_t> SlabSampler::refused() const {
    if (!sampler_->refused()) return std::nullopt;
    return block().first_row + *sampler_->refused();
}

}  // namespace barycert::sample
