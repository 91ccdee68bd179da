#include "barycert/sample/slab_sampler.hpp"

#include <algorithm>

#include "barycert/locate/cell_signs.hpp"

namespace barycert::detail {

void SlabSampler::run(std::int32_t first, std::int32_t last, std::span<const Place> cells) {
    first_ = first;
    const std::size_t layer = grid_.dimension == 3 ? grid_.layer_size() : static_cast<std::size_t>(grid_.counts[0]);
    points_ = layer * static_cast<std::size_t>(last - first);
    owner_.assign(points_, -1);
    left_.assign(points_, 1);
    rows_.cells.resize(points_);
    rows_.features.assign(points_, Feature::outside);
    rows_.values.resize(points_ * data_.columns.size());
    const bool distances = options_.outside.kind == Outside::nearest || options_.outside.kind == Outside::extrapolate;
    rows_.distances.assign(distances ? points_ : 0, 0);
    counts_ = {};
    sampler_.emplace(data_, options_, BlockRows{rows_.cells.data(), rows_.features.data(), rows_.values.data(),
                                                distances ? rows_.distances.data() : nullptr});
    constexpr std::size_t cells_at_once = 256;
    for (std::size_t c = 0; c < cells.size(); c += cells_at_once) {
        spans_.clear();
        find_spans(data_.index(), raster_, cells.data() + c, std::min(cells_at_once, cells.size() - c), first, last,
                   spans_);
        for (const Span& span : spans_) {
            const auto line = static_cast<std::size_t>(grid_.dimension == 3 ? span.layer - first : 0) *
                                  static_cast<std::size_t>(grid_.counts[1]) +
                              static_cast<std::size_t>(grid_.dimension == 3 ? span.row : span.row - first);
            take(span, line * static_cast<std::size_t>(grid_.counts[0]));
        }
    }
    flush();
    evaluate_rest();
    for (const Feature f : rows_.features) counts_.locations.add(f);
    counts_.add(sampler_->counts());
}

void SlabSampler::take(const Span& span, std::size_t row) {
    const auto point = [&](std::int32_t column) { return row + static_cast<std::size_t>(column); };
    const CellIndex& index = data_.index();
    for (std::int32_t i = span.first; i < span.inner_first; ++i) test(span.cell, i, span.row, span.layer, point(i));
    for (std::int32_t i = span.inner_last; i < span.last; ++i) test(span.cell, i, span.row, span.layer, point(i));
    if (data_.located().method == Method::walk) {
        // Cells of a complex: no other one holds a point in the interior of this one.
        for (std::int32_t i = span.inner_first; i < span.inner_last; ++i) {
            owner_[point(i)] = span.cell;
            left_[point(i)] = 0;
            push(point(i), span.cell, Feature::interior, i, span.row, span.layer);
        }
        return;
    }
    const Mesh::Index original = index.original[static_cast<std::size_t>(span.cell)];
    for (std::int32_t i = span.inner_first; i < span.inner_last; ++i) {
        Place& owner = owner_[point(i)];
        if (owner >= 0 && index.original[static_cast<std::size_t>(owner)] < original) continue;
        owner = span.cell;
        rows_.features[point(i)] = Feature::interior;
    }
}

void SlabSampler::test(Place cell, std::int32_t column, std::int32_t row, std::int32_t layer, std::size_t point) {
    const CellIndex& index = data_.index();
    const Mesh::Index original = index.original[static_cast<std::size_t>(cell)];
    Place& owner = owner_[point];
    if (owner >= 0 && index.original[static_cast<std::size_t>(owner)] < original) return;
    const std::array<double, 3> at{raster_.at[0][static_cast<std::size_t>(column)],
                                   raster_.at[1][static_cast<std::size_t>(row)],
                                   raster_.at[2][static_cast<std::size_t>(layer)]};
    const WeightSigns signs = cell_signs(index, cell, at.data(), counts_.locations.tests);
    if (!signs.contains()) return;
    owner = cell;
    rows_.features[point] = signs.feature(index.simplex);
}

void SlabSampler::push(std::size_t point, Place cell, Feature feature, std::int32_t column, std::int32_t row,
                       std::int32_t layer) {
    records_[pending_].at = {raster_.at[0][static_cast<std::size_t>(column)],
                             raster_.at[1][static_cast<std::size_t>(row)],
                             raster_.at[2][static_cast<std::size_t>(layer)]};
    records_[pending_].number = static_cast<std::uint32_t>(point);
    cells_[pending_] = cell;
    features_[pending_] = feature;
    if (++pending_ == chunk_size) flush();
}

void SlabSampler::flush() {
    (*sampler_)(records_.data(), pending_, cells_.data(), features_.data());
    pending_ = 0;
}

void SlabSampler::evaluate_rest() {
    const auto nx = static_cast<std::size_t>(grid_.counts[0]), ny = static_cast<std::size_t>(grid_.counts[1]);
    for (std::size_t point = 0; point < points_; ++point) {
        if (left_[point] == 0) continue;
        const auto column = static_cast<std::int32_t>(point % nx);
        auto row = static_cast<std::int32_t>(point / nx), layer = 0;
        if (grid_.dimension == 3) {
            layer = first_ + static_cast<std::int32_t>(point / nx / ny);
            row = static_cast<std::int32_t>(point / nx % ny);
        } else {
            row += first_;
        }
        push(point, owner_[point], rows_.features[point], column, row, layer);
    }
    flush();
}

GridBlock SlabSampler::block() const {
    const std::size_t layer = grid_.dimension == 3 ? grid_.layer_size() : static_cast<std::size_t>(grid_.counts[0]);
    return {layer * static_cast<std::size_t>(first_), rows_.cells, rows_.features, rows_.values, rows_.distances};
}

std::optional<std::uint64_t> SlabSampler::refused() const {
    if (!sampler_->refused()) return std::nullopt;
    return block().first_point + *sampler_->refused();
}

}  // namespace barycert::detail
