#include <tbb/parallel_pipeline.h>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "mesh/sample/grid/fill_lanes.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"

namespace barycert {
namespace sample {
namespace {

/// Slabs of a cell, the last one included; none: first > last.
struct SlabRange {
    std::uint32_t first, last;
};
constexpr SlabRange no_slab{~std::uint32_t{0}, 0};

/// The slabs of so many layers each that a cell from low to high along the last axis may lie in.
SlabRange slabs_between(const Raster& raster, std::size_t axis, std::uint32_t depth, double low, double high) {
    const std::vector<double>& layers = raster.at[axis];
    const double last_layer = static_cast<double>(layers.size() - 1);
    const auto slab_of = [&](auto layer) { return static_cast<std::uint32_t>(layer) / depth; };
    if (!raster.precise) {
        const auto first = std::lower_bound(layers.begin(), layers.end(), low);
        const auto end = std::upper_bound(first, layers.end(), high);
        if (first == end) return no_slab;
        return {slab_of(first - layers.begin()), slab_of(end - layers.begin() - 1)};
    }
    // Rounded down both: a layer more than there are is no matter.
    const double origin = raster.origin[axis], scale = raster.scale[axis], slack = raster.slack;
    const double from = (low - origin) * scale - slack, to = (high - origin) * scale + slack;
    if (!(from <= last_layer && to >= 0)) return no_slab;
    return {slab_of(std::max(from, 0.0)), slab_of(std::min(to, last_layer))};
}

std::size_t parts_of(std::size_t all, std::size_t size) {
    return (all + size - 1) / size;
}

/// For each slab of `depth` layers (the last may have fewer) all cells that may hold points of it, as the index goes.
class SlabCells {
public:
    SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth) {
        const std::size_t axis = index.dimension() - 1, cells = index.cell_count();
        constexpr std::size_t at_once = 32768;
        parts_.resize(parts_of(cells, at_once));
        base::parallel_for(parts_.size(), [&](std::size_t p) {
            const std::size_t first = p * at_once, count = std::min(at_once, cells - first);
            std::vector<SlabRange> ranges(count);
            SlabRange all = no_slab;
            for (std::size_t i = 0; i < count; ++i) {
                __builtin_prefetch(index.cells.data() + std::min(first + i + 64, cells - 1));
                const auto& node = index.cells[first + i].node;
                const auto at = [&](std::size_t n) { return index.nodes[static_cast<std::size_t>(node[n])].at[axis]; };
                // In 2D the last corner repeats the first one.
                const double a = at(0), b = at(1), c = at(2), d = at(3);
                const SlabRange r =
                    slabs_between(raster, axis, static_cast<std::uint32_t>(depth),
                                  std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)));
                ranges[i] = r;
                all = {std::min(all.first, r.first), std::max(all.last, r.last)};
            }
            if (all.first > all.last) return;
            const auto each = [&](const auto& add) {
                for (std::size_t i = 0; i < count; ++i) {
                    for (std::size_t s = ranges[i].first; s <= ranges[i].last; ++s)
                        add(s - all.first, static_cast<locate::Place>(first + i));
                }
            };
            parts_[p] = {all.first, {all.last - all.first + 1, each}};
        });
    }

    /// Calls work(cells), one part of them after the other.
    template <class Work>
    void for_parts(std::size_t slab, Work work) const {
        for (const RunOfCells& part : parts_) {
            if (slab < part.first_slab || slab - part.first_slab >= part.cells.size()) continue;
            const std::span<const locate::Place> cells = part.cells[slab - part.first_slab];
            if (!cells.empty()) work(cells);
        }
    }

private:
    /// The cells of each slab, from the first slab on, among cells that follow one another.
    struct RunOfCells {
        std::size_t first_slab = 0;
        base::Lists<locate::Place> cells;
    };
    std::vector<RunOfCells> parts_;
};

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
                    set_rest_of_row(data_, options_.rounding, found_.cells[point], nullptr,
                                    found_.values.data() + data_.width * point);
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

Raster raster_of(const Grid& grid, const locate::CellIndex& index) {
    Raster raster;
    raster.precise = true;
    double worst = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double>& at = raster.at[k];
        at.reserve(static_cast<std::size_t>(grid.counts[k]));
        for (std::int64_t i = 0; i < grid.counts[k]; ++i) at.push_back(grid.coordinate(k, i));
        if (k >= index.dimension()) break;
        double max = 0;
        for (const double x : {at.front(), at.back(), index.low[k], index.high[k]}) max = std::max(max, std::abs(x));
        // One point alone stands at place 0, whatever the scale: one in which the slack is nothing beside the mesh.
        const double extent = index.high[k] - index.low[k];
        raster.origin[k] = grid.origin[k];
        raster.spacing[k] = grid.spacing[k];
        raster.scale[k] = grid.counts[k] > 1 ? 1 / grid.spacing[k] : extent > 0 ? 0x1p16 / extent : 1;
        // Ends of intervals: some roundings of numbers up to `largest`; the same for coordinates of the grid. In
        // places: these times the scale, the roundings of that, and how far the last point is off the spacing.
        const double count = static_cast<double>(grid.counts[k]);
        const double regular_last = grid.origin[k] + (count - 1) * grid.spacing[k];
        const double error =
            (48 * 0x1p-53 * max + 2 * std::abs(at.back() - regular_last)) * raster.scale[k] + 16 * 0x1p-53 * count;
        worst = std::max(worst, error);
        raster.precise = raster.precise && error <= 0x1p-9 && raster.scale[k] <= 0x1p300 &&
                         raster.scale[k] >= 0x1p-300 && max <= 0x1p300;
    }
    raster.slack = std::clamp(64 * worst, 0x1p-30, 0x1p-8);
    return raster;
}

/// Layers a slab. Few slabs, for a cell that lies in two of them is looked at twice; of `room` points or one layer
/// each; as many for each thread.
std::size_t slab_depth(std::size_t layers, std::size_t layer_size, std::size_t room, std::size_t threads) {
    const std::size_t fewest = parts_of(layers, std::max<std::size_t>(room / layer_size, 1));
    return parts_of(layers, std::min(parts_of(fewest, threads) * threads, layers));
}

Status check_grid(const SamplerData& data, const Grid& grid) {
    const int dimension = data.located().mesh->dimension;
    if (grid.dimension != dimension)
        return Error{.code = "point.dimension",
                     .what = "dimension of the grid",
                     .expected = std::to_string(dimension) + ", that of the mesh",
                     .found = std::to_string(grid.dimension)};
    for (std::size_t k = 0; k < 3; ++k) {
        const bool several = grid.counts[k] > 1;
        const bool good = grid.counts[k] >= 1 && grid.counts[k] <= Grid::max_on_axis && std::isfinite(grid.origin[k]) &&
                          std::isfinite(grid.last[k]) && grid.spacing[k] >= 0 && std::isfinite(grid.spacing[k]) &&
                          (!several || grid.spacing[k] > 0) &&
                          (!several || grid.coordinate(k, grid.counts[k] - 2) <= grid.last[k]) &&
                          (grid.dimension == 3 || k < 2 || !several);
        if (!good)
            return Error{
                .code = "argument.value", .what = "invalid grid", .remedy = "make it by grid_over or grid_spaced"};
    }
    const std::int64_t layer = grid.counts[0] * (grid.dimension == 3 ? grid.counts[1] : 1);
    if (layer > 0x7fffffff)
        return Error{.code = "argument.value",
                     .what = "points of one layer of the grid",
                     .expected = "at most 2147483647",
                     .found = std::to_string(layer),
                     .remedy = "resample in several grids"};
    return Done{};
}

/// Point by point, some layers at a time: cells that have maps, or are not listed, are not filled.
Result<SampleCounts> resample_points(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                                     const GridSink& sink) {
    SampleCounts all;
    Table rows;
    std::vector<double> points;
    const std::int64_t count = grid.point_count(), width = grid.counts[0], height = grid.counts[1];
    constexpr std::int64_t step = std::int64_t{1} << 18;
    for (std::int64_t first = 0; first < count; first += step) {
        points.clear();
        for (std::int64_t i = first; i < std::min(count, first + step); ++i) {
            points.push_back(grid.coordinate(0, i % width));
            points.push_back(grid.coordinate(1, i / width % height));
            if (grid.dimension == 3) points.push_back(grid.coordinate(2, i / width / height));
        }
        Status done = sampler.sample(points, options, rows, static_cast<std::size_t>(first));
        TableView block = rows.view();
        block.points = {};
        block.first_row = static_cast<std::uint64_t>(first);
        if (done) done = sink(block);
        if (!done) return done.error();
        ExactEnvironment::renew();
        rows.counts.locations.ways = {};
        all.add(rows.counts);
    }
    return all;
}

}  // namespace

}  // namespace sample

Result<SampleCounts> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                              const GridSink& sink) {
    const ExactEnvironment environment;
    const sample::SamplerData& data = sample::SamplerData::of(sampler);
    if (Status status = sample::check_grid(data, grid); !status) return status.error();
    if (data.located().mapped || data.located().grid) return sample::resample_points(sampler, grid, options, sink);
    const sample::Raster raster = sample::raster_of(grid, data.index());
    const std::vector<double>& layers = raster.at[data.index().dimension() - 1];
    const std::size_t layer = static_cast<std::size_t>(grid.point_count()) / layers.size();
    // Points of 64 MiB or so.
    const std::size_t room = (std::size_t{1} << 26) / (16 + 8 * data.width);

    Status status = Done{};
    SampleCounts all;
    base::in_arena(options.threads, data.index().cell_count() + layer * layers.size(), [&] {
        const auto threads = static_cast<std::size_t>(base::arena_threads());
        const std::size_t depth = sample::slab_depth(layers.size(), layer, room, threads);
        const std::size_t slabs = sample::parts_of(layers.size(), depth);
        const sample::SlabCells cells(data.index(), raster, depth);
        // A slab may wait for its turn while others are filled. As they are begun and end in order, those under way
        // are consecutive.
        const std::size_t at_once = std::min(threads == 1 ? 1 : threads + 1, slabs);
        std::vector<sample::SlabSampler> samplers;
        samplers.reserve(at_once);
        for (std::size_t i = 0; i < at_once; ++i) samplers.emplace_back(data, grid, raster, options);
        std::atomic<bool> stopped = false;
        std::size_t next = 0;
        const auto begin = [&](tbb::flow_control& control) {
            if (next == slabs || stopped) control.stop();
            return next++;
        };
        const auto fill = [&](std::size_t s) {
            samplers[s % at_once].run(static_cast<std::int32_t>(s * depth),
                                      static_cast<std::int32_t>(std::min(layers.size(), (s + 1) * depth)), cells, s);
            return s;
        };
        const auto pass_on = [&](std::size_t s) {
            if (!status) return;
            const sample::SlabSampler& slab = samplers[s % at_once];
            if (const auto refused = slab.refused()) {
                status = sample::outside_error("point " + std::to_string(*refused) + " of the grid");
            } else {
                status = sink(slab.block());
                ExactEnvironment::renew();
                all.add(slab.counts());
            }
            if (!status) stopped = true;
        };
        using tbb::filter_mode;
        tbb::parallel_pipeline(at_once, tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, begin) &
                                            tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, fill) &
                                            tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, pass_on));
    });
    if (!status) return status.error();
    return all;
}

Result<Table> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options) {
    Table all;
    all.dimension = grid.dimension;
    all.columns = sampler.columns();
    const auto append = [&](const TableView& rows) -> Status {
        all.cells.insert(all.cells.end(), rows.cells.begin(), rows.cells.end());
        all.features.insert(all.features.end(), rows.features.begin(), rows.features.end());
        all.values.insert(all.values.end(), rows.values.begin(), rows.values.end());
        all.distances.insert(all.distances.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    };
    Result<SampleCounts> counts = resample(sampler, grid, options, append);
    if (!counts) return counts.error();
    all.counts = *counts;
    return all;
}

}  // namespace barycert
