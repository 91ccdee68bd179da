/// Rows of the points of some layers of a grid, by the cells that hold them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/sample/grid/fill_lanes.hpp"
#include "mesh/sample/grid/slab_cells.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"
#include "mesh/sample/points/sampler_data.hpp"
#include "mesh/sample/points/value_lanes.hpp"

namespace barycert::sample {

/// Layers [first, last) of the third axis (2D: of the second), and the rows of their points. Keeps its memory from slab
/// to slab.
class SlabSampler {  // NOLINT(clang-analyzer-optin.performance.Padding): one a thread
public:
    SlabSampler(const SamplerData& data, const Grid& grid, const Raster& raster, const SampleOptions& options)
        : data_(data), grid_(grid), raster_(raster), options_(options) {}

    /// By the cells of slab `slab`, which has these layers.
    void run(std::int32_t first, std::int32_t last, const SlabCells& cells, std::size_t slab) {
        const auto columns = static_cast<std::size_t>(grid_.counts[0]);
        const auto rows = static_cast<std::size_t>(grid_.dimension == 3 ? grid_.counts[1] : 1);
        points_ = columns * rows * static_cast<std::size_t>(last - first);
        constexpr std::size_t more = 8;  // FillTarget
        const BlockRows to = make_room(found_, points_ + more, data_.width, options_.outside);
        std::fill_n(to.cells, points_ + more, -1);
        std::fill_n(to.features, points_ + more, Feature::outside);
        if (value_missing_.size() < points_ + more) value_missing_.resize(points_ + more);
        target_ = {to.cells, to.features, value_missing_.data(), to.values, data_.width, columns, rows, first, last};
        counts_ = {};
        sampler_.emplace(data_, options_, to);
        // With plain values, fill_cells does not see which cells have a node that is not finite.
        filled_ =
            !data_.quadratic && data_.point_components != 0 && (data_.finite || options_.rounding == Rounding::correct);
        cells.for_parts(slab, [&](std::span<const locate::Place> some) {
            if (raster_.precise) return fill(some);
            for (const locate::Place cell : some) take(cell);
        });
        finish();
        counts_.add(sampler_->counts());
    }

    TableView block() const {
        return {.dimension = grid_.dimension,
                .first_row = target_.columns * target_.rows * static_cast<std::size_t>(target_.first_layer),
                .cells = {found_.cells.data(), points_},
                .features = {found_.features.data(), points_},
                .values = {found_.values.data(), points_ * data_.columns.size()},
                .distances = std::span(found_.distances).first(found_.distances.empty() ? 0 : points_)};
    }

    const SampleCounts& counts() const { return counts_; }
    /// The first point outside, if the policy refuses such.
    std::optional<std::uint64_t> refused() const {
        if (!sampler_->refused()) return std::nullopt;
        return block().first_row + *sampler_->refused();
    }

private:
    void fill(std::span<const locate::Place> cells) {
        constexpr std::size_t at_once = 4096;
        NodeValues nodes = data_.node_values();
        if (!filled_) nodes.components = 0;
        const FillSource source{data_.index(), nodes, raster_, options_.rounding};
        for (std::size_t c = 0; c < cells.size(); c += at_once) {
            undecided_.clear();
            fill_cells(source, cells.subspan(c, std::min(at_once, cells.size() - c)), target_, undecided_);
            for (const Span& span : undecided_.spans) take(span);
            for (const UndecidedPoint& point : undecided_.points) take(point);
            for (const locate::Place cell : undecided_.cells) take(cell);
        }
    }

    /// All points in the box of a cell.
    void take(locate::Place cell) {
        const locate::CellIndex& index = data_.index();
        std::array<PlaceRange, 3> box{{{0, 1}, {0, 1}, {0, 1}}};
        for (std::size_t k = 0; k < index.dimension(); ++k) {
            const auto at = [&](locate::Place node) { return index.nodes[static_cast<std::size_t>(node)].at[k]; };
            const auto [low, high] = std::ranges::minmax(index.cells[static_cast<std::size_t>(cell)].node, {}, at);
            const std::vector<double>& places = raster_.at[k];
            const auto first = std::lower_bound(places.begin(), places.end(), at(low));
            box[k] = {static_cast<std::int32_t>(first - places.begin()),
                      static_cast<std::int32_t>(std::upper_bound(first, places.end(), at(high)) - places.begin())};
        }
        PlaceRange& cut = box[index.dimension() - 1];
        cut = {std::max(cut.first, target_.first_layer), std::min(cut.last, target_.last_layer)};
        const std::int32_t first = box[0].first, last = box[0].last;
        for (std::int32_t layer = box[2].first; layer < box[2].last; ++layer) {
            for (std::int32_t row = box[1].first; row < box[1].last; ++row)
                take(Span{cell, row, layer, first, first, first, last});
        }
    }

    /// The points of a span of which it is not certain whether they are in the cell.
    void take(const Span& span) {
        for (std::int32_t i = span.first; i < span.inner_first; ++i) own(span.cell, {i, span.row, span.layer}, false);
        for (std::int32_t i = span.inner_last; i < span.last; ++i) own(span.cell, {i, span.row, span.layer}, false);
    }

    void take(const UndecidedPoint& one) {
        const auto point = own(one.cell, {one.column, one.row, one.layer}, one.certain);
        if (point) found_.values[*point] = one.value;
    }

    /// Gives a point to a cell that holds it, exactly, unless a lower one has it, and returns it; else nothing.
    std::optional<std::size_t> own(locate::Place cell, const std::array<std::int32_t, 3>& places, bool with_value) {
        const Mesh::Index number = data_.index().original[static_cast<std::size_t>(cell)];
        const std::size_t point =
            target_.columns * target_.line_of(places[1], places[2]) + static_cast<std::size_t>(places[0]);
        if (target_.kept(point, number)) return std::nullopt;
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = raster_.at[k][static_cast<std::size_t>(places[k])];
        const WeightSigns signs = locate::cell_signs(data_.index(), cell, at.data(), counts_.locations.tests);
        if (!signs.contains()) return std::nullopt;
        const Feature feature = locate::feature_of(data_.index(), cell, signs);
        found_.cells[point] = number;
        target_.set_feature(point, feature, with_value);
        return point;
    }

    /// Some points at a time, while they are in cache: features and numbers of those outside, then what takes longer.
    void finish() {
        constexpr std::size_t step = 4096;
        const double fill =
            options_.outside.kind == Outside::fill ? options_.outside.fill : std::numeric_limits<double>::quiet_NaN();
        const bool same = options_.outside.kind == Outside::nan || options_.outside.kind == Outside::fill;
        finished_ = {};
        for (std::size_t first = 0; first < points_; first += step) {
            const std::size_t last = std::min(first + step, points_);
            finished_.others.clear();
            finish_points(target_, first, last, same ? &fill : nullptr, finished_);
            for (const std::uint32_t point : finished_.others) {
                counts_.locations.add(found_.features[point]);
                push(point);
            }
            // Points that are pushed get a whole row; where cells fill in values, they are linear.
            for (std::size_t point = first; filled_ && data_.has_rest() && point < last; ++point) {
                if (found_.cells[point] >= 0)
                    set_rest_of_row(data_, options_, {found_.cells[point], nullptr},
                                    found_.values.data() + data_.width * point, counts_);
            }
        }
        sampler_->flush();
        leave_out_hidden(data_, found_.values.data(), points_);
        counts_.locations.add(finished_.locations);
        counts_.locations.add(Feature::outside, finished_.outside);
        counts_.without_value += finished_.outside;
        if (options_.rounding == Rounding::correct) counts_.values.add(Tier::double_double, finished_.with_value);
    }

    void push(std::size_t point) {
        const std::size_t line = point / target_.columns, row = line % target_.rows;
        const std::size_t layer = line / target_.rows + static_cast<std::size_t>(target_.first_layer);
        const bool space = grid_.dimension == 3;
        const Mesh::Index cell = found_.cells[point];
        sampler_->push({{raster_.at[0][point % target_.columns], raster_.at[1][space ? row : layer],
                         raster_.at[2][space ? layer : 0]},
                        static_cast<std::uint32_t>(point)},
                       cell < 0 ? -1 : data_.located().parts.places()[static_cast<std::size_t>(cell)],
                       found_.features[point]);
    }

    const SamplerData& data_;
    const Grid& grid_;
    const Raster& raster_;
    const SampleOptions& options_;
    FillTarget target_;
    std::size_t points_ = 0;
    bool filled_ = false;  ///< cells fill in values
    FoundRows found_;
    std::vector<std::uint8_t> value_missing_;
    SampleCounts counts_;
    std::optional<ChunkSampler> sampler_;
    UndecidedFill undecided_;
    FinishedPoints finished_;
};

}  // namespace barycert::sample
