#include "barycert/sampler.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "mesh/consistency.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/sorted_points.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"
#include "mesh/sample/points/sampler_data.hpp"
#include "mesh/sample/points/value_lanes.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace sample {
namespace {

/// The rows of a block of points, from the order in which they are found into that of the caller.
class SortedRows {
public:
    SortedRows(const SamplerData& data, const SampleOptions& options, std::size_t size)
        : data_(data),
          rows_(data.rows.take()),
          sampler_(data, options, make_room(*rows_, size + 1, data.width, options.outside)) {}  // one for all left out

    void operator()(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                    const Feature* feature) {
        sampler_(points, count, owner, feature);
    }

    /// The rows, and what was counted. Once, in the end.
    SampleCounts write(const locate::SortedPoints& sorted, std::size_t first, Table& out) {
        sampler_.flush();
        const std::size_t last = sorted.size(), left_out = sorted.left_out();
        // Points left out one by one: by their distances, or in a cell that bulges out of its part.
        const bool alone = !out.distances.empty() || data_.located().mapped != nullptr;
        if (left_out != 0 && !alone) {
            rows_->cells[last] = -1;
            rows_->features[last] = Feature::outside;
            std::fill_n(values(last), data_.width, 0);
            sampler_.leave_out(left_out, static_cast<std::uint32_t>(last));
        }
        const auto ahead = [&](std::size_t place) {
            __builtin_prefetch(&rows_->cells[place]);
            __builtin_prefetch(&rows_->features[place]);
            __builtin_prefetch(values(place));
        };
        sorted.for_each_in_callers_order(ahead, [&](std::size_t i, std::size_t place) {
            if (place == last && alone) {  // the row of all points left out serves for one after the other
                if (!out.distances.empty()) rows_->distances[last] = 0;
                sampler_.push(sorted.record(i, last), -1, Feature::outside);
                sampler_.flush();
            }
            const double* const from = values(place) + data_.hidden;
            out.cells[first + i] = rows_->cells[place];
            out.features[first + i] = rows_->features[place];
            for (std::size_t c = 0; c < columns_; ++c) out.values[columns_ * (first + i) + c] = from[c];
            if (!out.distances.empty()) out.distances[first + i] = rows_->distances[place];
        });
        data_.rows.put(std::move(rows_));
        return sampler_.counts();
    }

private:
    double* values(std::size_t row) const { return rows_->values.data() + data_.width * row; }

    const SamplerData& data_;
    std::unique_ptr<FoundRows> rows_;
    std::size_t columns_ = data_.columns.size();
    ChunkSampler sampler_;
};

std::size_t components_of(const Field* field) {
    return static_cast<std::size_t>(field->components);
}

void arrange_by_place(SamplerData& data) {
    const locate::CellIndex& index = data.index();
    const std::size_t nodes = index.original_node.size();
    data.nodes = locate::Buffer<locate::NodeRecord>(nodes);
    std::copy_n(index.nodes.data(), nodes, data.nodes.data());
    const std::size_t groups = (data.point_components + 2) / 4;
    data.more = locate::Buffer<ValueRecord>(groups * nodes);
    std::fill_n(data.more.data(), groups * nodes, ValueRecord{});
    std::size_t first = 0;
    for (const Field* field : data.point_fields) {
        const std::size_t components = components_of(field);
        for (std::size_t place = 0; place < nodes; ++place) {
            const double* const from = &field->data[components * static_cast<std::size_t>(index.original_node[place])];
            for (std::size_t i = 0; i < components; ++i) {
                const std::size_t c = first + i;
                (c == 0 ? data.nodes[place].value : data.more[(c - 1) / 4 * nodes + place].value[(c - 1) % 4]) =
                    from[i];
            }
        }
        first += components;
    }
}

void arrange_by_node(SamplerData& data) {
    const std::size_t all = data.point_components, nodes = data.located().mesh->point_count();
    data.values.resize(all * nodes);
    std::size_t first = 0;
    for (const Field* field : data.point_fields) {
        const std::size_t components = components_of(field);
        for (std::size_t node = 0; node < nodes; ++node)
            std::copy_n(&field->data[components * node], components, &data.values[all * node + first]);
        first += components;
    }
}

/// The quantity to compute for each point: the steps of a choice that no field has.
AtPoint at_points(const Mesh& mesh, const FieldChoice& choice) {
    using Kind = QuantityStep::Kind;
    AtPoint late{choice.field, 0, components_of(choice.field)};
    for (const QuantityStep& step : choice.steps) {
        if (step.kind == Kind::gradient) {
            late.gradient = true;
            late.components *= static_cast<std::size_t>(mesh.dimension);
        }
        // Keeps the first: after one component is selected, a later step can only select that one.
        if (step.kind == Kind::component && late.component < 0) late.component = step.component;
        if (step.kind == Kind::length) late.length = true;
    }
    return late;
}

/// Makes the fields that are to be made, and tells each number its place in a row.
Status arrange_columns(const Mesh& mesh, const std::vector<FieldChoice>& fields, SamplerData& data) {
    std::vector<TableField> of_points, of_cells, late;
    for (const FieldChoice& asked : fields) {
        const auto is_gradient = [](const QuantityStep& step) { return step.kind == QuantityStep::Kind::gradient; };
        // In mapped cells a gradient differs from point to point.
        const auto gradient = std::ranges::find_if(asked.steps, is_gradient);
        const bool varies = data.located().mapped != nullptr && gradient != asked.steps.end();
        const auto asks_for_cells = [&](const QuantityStep& step) {
            return is_gradient(step) || step.kind == QuantityStep::Kind::mean;
        };
        if (!mesh.is_listed() && std::ranges::any_of(asked.steps, asks_for_cells))
            return locate::not_listed("gradients and means");
        const std::size_t rows = asked.of_cells ? mesh.cell_count() : mesh.point_count();
        if (Status fits = mesh::check_field(asked.field, rows, asked.of_cells ? "cell" : "node"); !fits) return fits;
        const Result<QuantityShape> shape = shape_of(mesh, asked);
        if (!shape) return shape.error();
        FieldChoice choice = asked;
        const auto before = static_cast<std::size_t>(gradient - asked.steps.begin());
        make_fields(mesh, choice, varies ? before : choice.steps.size(), data.made);
        const TableField column{name_of(asked), static_cast<int>(shape->components)};
        if (shape->at_points || varies) {
            late.push_back(column);
            data.at_points.push_back(at_points(mesh, choice));
        } else {
            (choice.of_cells ? of_cells : of_points).push_back(column);
            (choice.of_cells ? data.cell_fields : data.point_fields).push_back(choice.field);
        }
    }
    // Fields that nobody asked for but by their lengths come first, where they can be left out.
    std::vector<const Field*> hidden;
    for (const AtPoint& one : data.at_points) {
        const bool known = std::count(data.point_fields.begin(), data.point_fields.end(), one.field) != 0 ||
                           std::count(hidden.begin(), hidden.end(), one.field) != 0;
        if (one.gradient || known) continue;
        hidden.push_back(one.field);
        data.hidden += components_of(one.field);
    }
    data.point_fields.insert(data.point_fields.begin(), hidden.begin(), hidden.end());
    for (const Field* field : data.point_fields) {
        for (AtPoint& one : data.at_points) {
            if (one.field == field) one.first = data.point_components;
        }
        data.point_components += components_of(field);
        data.finite = data.finite && base::all_finite(field->data);
    }
    for (const auto* group : {&of_points, &of_cells, &late})
        data.fields.insert(data.fields.end(), group->begin(), group->end());
    data.columns = column_names(data.fields);
    data.width = data.hidden + data.columns.size();
    return Done{};
}

void resize(const SamplerData& data, const SampleOptions& options, std::size_t rows, Table& out) {
    out.dimension = data.located().mesh->dimension;
    out.columns = data.columns;
    out.cells.resize(rows);
    out.features.resize(rows);
    out.values.resize(rows * data.columns.size());
    out.distances.assign(gives_distances(options.outside) ? rows : 0, 0);
}

/// Applies the policies to the rows: returns an Error, or sets NaN where a point is not finite. `finite`: all points
/// are.
Status apply_policies(std::span<const double> points, bool finite, const SampleOptions& options,
                      std::size_t first_point, Table& out) {
    const auto d = static_cast<std::size_t>(out.dimension);
    const std::size_t width = out.columns.size();
    if (!finite && options.nonfinite_points == NonfinitePoints::error)
        return locate::check_finite(points, d, first_point);
    for (std::size_t row = 0; !finite && row < out.row_count(); ++row) {
        if (base::all_finite({&points[d * row], d})) continue;
        std::fill_n(out.values.data() + width * row, width, std::numeric_limits<double>::quiet_NaN());
        ++out.counts.locations.not_finite;
    }
    if (options.outside.kind != Outside::error) return Done{};
    const std::optional<std::size_t> refused = locate::first_outside(out.cells, points, d);
    if (!refused) return Done{};
    return outside_error("point " + std::to_string(first_point + *refused));
}

}  // namespace
}  // namespace sample

Result<std::vector<FieldChoice>> choose_fields(const Mesh& mesh, const std::vector<std::string>& names) {
    return sample::quantities_named(mesh, names);
}

Sampler::Sampler(std::unique_ptr<sample::SamplerData> data)
    : data_(data.release(), [](sample::SamplerData* d) { delete d; }) {}

Result<Sampler> Sampler::build(const Locator& locator, const std::vector<FieldChoice>& fields) {
    const ExactEnvironment environment;
    auto data = std::make_unique<sample::SamplerData>();
    data->locator = &locator;
    data->quadratic = !locator.mesh().mid_nodes.empty();
    if (Status arranged = sample::arrange_columns(locator.mesh(), fields, *data); !arranged) return arranged.error();
    if (data->point_components != 0 && locator.mesh().is_listed())
        data->quadratic ? sample::arrange_by_node(*data) : sample::arrange_by_place(*data);
    return Sampler(std::move(data));
}

Result<Sampler> Sampler::build(const Mesh& mesh, const std::vector<std::string>& fields, const BuildOptions& options) {
    Result<std::vector<FieldChoice>> chosen = choose_fields(mesh, fields);
    if (!chosen) return chosen.error();
    Result<Locator> locator = Locator::build(mesh, options);
    if (!locator) return locator.error();
    auto own = std::make_unique<const Locator>(std::move(*locator));
    Result<Sampler> sampler = build(*own, *chosen);
    if (sampler) sampler->data_->own_locator = std::move(own);
    return sampler;
}

const Locator& Sampler::locator() const {
    return *data_->locator;
}

const std::vector<TableField>& Sampler::fields() const {
    return data_->fields;
}

const std::vector<std::string>& Sampler::columns() const {
    return data_->columns;
}

Result<Table> Sampler::sample(std::span<const double> points, const SampleOptions& options) const {
    Table rows;
    if (Status done = sample(points, options, rows); !done) return done.error();
    return rows;
}

Status Sampler::sample(std::span<const double> points, const SampleOptions& options, Table& out,
                       std::size_t first_point) const {
    const ExactEnvironment environment;
    out.counts = {};
    if (Status status = locate::check_size(points, data_->index().dimension()); !status) return status;
    sample::resize(*data_, options, points.size() / data_->index().dimension(), out);
    out.point_begin.clear();
    if (data_->located().grid) {
        if (Status done = sample::sample_on_grid(*data_, points, options, out); !done) return done;
        const bool finite = out.counts.locations.outside == 0 || base::all_finite(points);
        return sample::apply_policies(points, finite, options, first_point, out);
    }
    bool finite = true;
    base::in_arena(options.threads, data_->index().cell_count() + out.cells.size(), [&] {
        const std::size_t count = out.cells.size(), block = locate::block_of(count, data_->index().cell_count());
        std::vector<SampleCounts> counts((count + block - 1) / block);
        const auto make = [&](std::size_t, std::size_t size) { return sample::SortedRows(*data_, options, size); };
        const auto keep = [&](std::size_t first, const locate::SortedPoints& sorted, sample::SortedRows& rows) {
            counts[first / block] = rows.write(sorted, first, out);
        };
        finite =
            locate::for_chunks(data_->located(), data_->node_values().first, points, out.counts.locations, make, keep);
        for (const SampleCounts& part : counts) out.counts.add(part);
    });
    if (data_->located().mapped) locate::count_anew(out.features, out.counts.locations);
    Status status = sample::apply_policies(points, finite, options, first_point, out);
    if (!status) out.counts = {};
    return status;
}

Status Sampler::evaluate(std::span<const double> points, const SampleOptions& options, Table& out,
                         std::size_t first_point) const {
    const ExactEnvironment environment;
    out.counts = {};
    if (data_->located().grid) return locate::not_listed("points in known cells");
    if (Status status = locate::check_size(points, data_->index().dimension()); !status) return status;
    Status finite = locate::check_finite(points, data_->index().dimension(), first_point);
    if (!finite && options.nonfinite_points == NonfinitePoints::error) return finite;
    const std::size_t d = data_->index().dimension(), count = points.size() / d;
    const std::vector<Mesh::Index>& cells = out.cells;
    if (cells.size() != count || out.features.size() != count)
        return Error{.code = "argument.size",
                     .what = "size of the locations",
                     .expected = "one cell and one feature for each of " + std::to_string(count) + " points",
                     .found = std::to_string(cells.size()) + " and " + std::to_string(out.features.size())};
    if (Status good = locate::check_cells(cells, data_->index().cell_count()); !good) return good;
    for (std::size_t row = 0; !finite && row < count; ++row) {
        if (cells[row] >= 0 && !base::all_finite({&points[d * row], d}))
            return Error{.code = "argument.value",
                         .what = "a cell of a point that is not finite",
                         .expected = "-1",
                         .found = std::to_string(cells[row])};
    }
    sample::resize(*data_, options, count, out);
    const std::vector<locate::Place>& places = data_->located().parts.places();
    const locate::CellIndex& index = data_->index();
    constexpr std::size_t grain = std::size_t{1} << 13;
    const auto evaluate_rows = [&](std::size_t first, std::size_t last, SampleCounts& counts) {
        const sample::BlockRows rows{out.cells.data(), out.features.data(), out.values.data(),
                                     out.distances.empty() ? nullptr : out.distances.data()};
        sample::ChunkSampler sampler(*data_, options, rows, false);
        for (std::size_t row = first; row < last; ++row) {
            locate::PointRecord record{};
            std::copy_n(&points[d * row], d, record.at.begin());
            record.number = static_cast<std::uint32_t>(row);
            // Cells come in any order: where they are is asked for ahead, and so are they.
            constexpr std::size_t ahead = 64;
            if (row + ahead < last && cells[row + ahead] >= 0)
                __builtin_prefetch(&places[static_cast<std::size_t>(cells[row + ahead])]);
            const locate::Place owner = cells[row] < 0 ? -1 : places[static_cast<std::size_t>(cells[row])];
            if (owner >= 0) __builtin_prefetch(&index.cells[static_cast<std::size_t>(owner)]);
            sampler.push(record, owner, out.features[row]);
        }
        sampler.flush();
        counts = sampler.counts();
    };
    const SampleCounts counts = sample::set_values(*data_, options.threads, grain, out, evaluate_rows);
    if (Status status = sample::apply_policies(points, finite.has_value(), options, first_point, out); !status)
        return status;
    out.counts.add(counts);
    for (const Feature feature : out.features) out.counts.locations.add(feature);
    return Done{};
}

}  // namespace barycert
