#include "mesh/sample/points/chunk_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/blocks.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/lanes.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/mapped/nearest_side.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/sample/points/near_piece.hpp"
#include "mesh/sample/points/sampler_data.hpp"
#include "mesh/sample/points/value_lanes.hpp"
#include "mesh/sample/quantity/quantities.hpp"

namespace barycert::sample {
namespace {

/// The gradients of all components of a field of nodes in a cell that is straight, or taken so.
void straight_gradients(const SamplerData& data, Rounding rounding, const Field& field, const PlaceInCell& place,
                        double* out) {
    const Mesh& mesh = *data.located().mesh;
    const Simplex simplex = data.index().simplex;
    const auto d = static_cast<std::size_t>(mesh.dimension), components = static_cast<std::size_t>(field.components);
    if (mesh.mid_nodes.empty()) {
        const auto corners = std::span(mesh.cells).subspan((d + 1) * static_cast<std::size_t>(place.cell), d + 1);
        // Coordinates are finite, and sizes fit: there is no Error.
        gradients(simplex, mesh.points, corners, NodalValues<double>{field.data, field.components},
                  std::span(out, d * components))
            .value();
        return;
    }
    const CellNodes nodes(mesh, static_cast<std::size_t>(place.cell));
    std::array<double, 12> vertices{};
    for (std::size_t i = 0; i <= d; ++i) std::copy_n(mesh.point(nodes.at[i]), d, &vertices[d * i]);
    for (std::size_t k = 0; k < components; ++k) {
        std::array<double, 10> values{};
        for (std::size_t i = 0; i < nodes.count; ++i)
            values[i] = field.data[components * static_cast<std::size_t>(nodes.at[i]) + k];
        // Coordinates are finite, and the simplex has a gradient: there is no Error.
        const Gradient g = *quadratic_gradient(simplex, vertices.data(), place.point, values.data(), rounding);
        std::copy_n(g.gradient.begin(), d, out + d * k);
    }
}

/// The same in any cell.
void gradients_at(const SamplerData& data, const SampleOptions& options, const Field& field, const PlaceInCell& place,
                  std::span<double> out, SampleCounts& counts) {
    using core::isoparametric::Certainty, core::isoparametric::Evaluated;
    const locate::MappedCells* const mapped = data.located().mapped.get();
    if (mapped == nullptr || !mapped->is_mapped(place.cell))
        return straight_gradients(data, options.rounding, field, place, out.data());
    const bool beyond = options.outside.kind == Outside::extrapolate;
    const Evaluated found =
        place.on == nullptr ? mapped->gradients(place.cell, place.point, field, out.data())
                            : mapped->gradients_outside(place.cell, *place.on, place.point, beyond, field, out.data());
    counts.undecided += found.certainty == Certainty::undecided ? 1 : 0;
    counts.max_off = std::max(counts.max_off, found.off);
    if (found.certainty == Certainty::not_found) std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
}

// Points outside.

/// Component c of the point fields at a node of the mesh.
double nodal_value(const SamplerData& data, Mesh::Index node, std::size_t c) {
    for (const Field* field : data.point_fields) {
        const auto components = static_cast<std::size_t>(field->components);
        if (c < components) return field->data[components * static_cast<std::size_t>(node) + c];
        c -= components;
    }
    return 0;  // not reached
}

/// All components in plain double, or of a vertex alone, exactly: with weights that are not negative, and rounded once
/// each, what is beyond the nodal values is rounding alone.
void plain_projected(const SamplerData& data, const locate::NearFeature& feature, const std::array<double, 3>& weights,
                     double* out) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < data.point_components; ++c) {
        double value = 0, low = infinity, high = -infinity;
        bool finite = true;
        for (std::size_t i = 0; i < static_cast<std::size_t>(feature.count); ++i) {
            const double f = nodal_value(data, feature.nodes[i], c);
            finite &= std::isfinite(f);
            value += weights[i] * f;
            low = std::min(low, f);
            high = std::max(high, f);
        }
        out[c] = finite ? std::clamp(value, low, high) : std::numeric_limits<double>::quiet_NaN();
    }
}

/// All components at once, at the point of the cell that has the rounded weights of the projection.
void quadratic_projected(const SamplerData& data, Rounding rounding, std::size_t cell,
                         const locate::NearFeature& feature, const std::array<double, 3>& weights, double* out,
                         TierCounts& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const std::size_t d = static_cast<std::size_t>(mesh.dimension), corners = d + 1;
    const auto mids = static_cast<std::size_t>(mid_node_count(data.index().simplex));
    const ReferencePoint reference = reference_point(mesh, cell, feature, weights);
    std::vector<double> values;
    for (const Mesh::Index node : CellNodes(mesh, cell)) {
        const auto first = data.values.begin() + static_cast<std::ptrdiff_t>(data.point_components) * node;
        values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(data.point_components));
    }
    std::array<std::int32_t, 10> local{};
    std::iota(local.begin(), local.end(), 0);
    const std::int32_t only = 0;
    const MeshQueries query{data.index().simplex, std::span(reference.vertices).first(d * corners),
                            std::span(local).first(corners), std::span(&only, 1), std::span(reference.at).first(d)};
    const NodalValues<double> nodal{values, static_cast<int>(data.point_components)};
    interpolate_quadratic(query, std::span(local).subspan(corners, mids), nodal, std::span(out, data.point_components),
                          &tiers, rounding)
        .value();
}

/// Under the policy nearest: sets one value a column. Point fields get, correctly rounded or plain as asked for, the
/// value at the orthogonal projection to the nearest vertex, edge or face; cell fields that of the nearest cell. On
/// cells of second order the weights of the projection are rounded first, so that they remain those of a point of the
/// cell, then the quadratic is evaluated there.
void snapped_values(const SamplerData& data, const SampleOptions& options, const Nearest& nearest,
                    const std::array<double, 3>& point, double* values, SampleCounts& counts) {
    const Mesh& mesh = *data.located().mesh;
    const auto cell = static_cast<std::size_t>(nearest.cell);
    const locate::NearFeature feature = locate::near_feature(nearest.nodes, mesh.points, data.index().dimension());
    const bool correct = options.rounding == Rounding::correct, vertex = feature.count == 1;
    TierCounts used;
    if (vertex || (!data.quadratic && !correct)) {
        plain_projected(data, feature, locate::weights_of(point, feature), values);
    } else if (data.quadratic && data.point_components != 0) {
        quadratic_projected(data, options.rounding, cell, feature, locate::weights_of(point, feature), values, used);
    } else {
        for (std::size_t c = 0; c < data.point_components; ++c) {
            std::array<double, 3> f{};
            for (std::size_t i = 0; i < static_cast<std::size_t>(feature.count); ++i)
                f[i] = nodal_value(data, feature.nodes[i], c);
            // Coordinates are finite: there is no Error.
            const Value v = *interpolate(feature.simplex(), feature.vertices().data(), point.data(), f.data());
            values[c] = v.value;
            used.add(v.tier);
        }
    }
    if (correct && data.point_components != 0) {
        counts.values.add(vertex ? Tier::filter : used.exact != 0 ? Tier::exact : Tier::double_double);
        counts.values.not_finite +=
            std::any_of(values, values + data.point_components, [](double x) { return std::isnan(x); }) ? 1 : 0;
    }
    const bool asked = data.quadratic && !data.at_points.empty();
    const std::array<double, 3> at = asked ? locate::projection_on(point, feature) : point;
    set_rest_of_row(data, options, {nearest.cell, at.data()}, values, counts);
}

}  // namespace

void set_rest_of_row(const SamplerData& data, const SampleOptions& options, const PlaceInCell& place, double* row,
                     SampleCounts& counts) {
    double* to = row + data.point_components;
    for (const Field* field : data.cell_fields) {
        const auto components = static_cast<std::size_t>(field->components);
        to = std::copy_n(
            field->data.begin() + static_cast<std::ptrdiff_t>(components * static_cast<std::size_t>(place.cell)),
            components, to);
    }
    std::vector<double> numbers;
    for (const AtPoint& late : data.at_points) {
        std::span<const double> values(row + late.first, late.components);
        if (late.gradient) {
            numbers.resize(late.components);
            gradients_at(data, options, *late.field, place, numbers, counts);
            values = numbers;
        }
        if (late.component >= 0) values = values.subspan(static_cast<std::size_t>(late.component), 1);
        if (late.length) {
            *to++ = euclidean_length(values);
        } else {
            to = std::copy(values.begin(), values.end(), to);
        }
    }
}

ChunkSampler::ChunkSampler(const SamplerData& data, const SampleOptions& options, const BlockRows& rows, bool in_parts)
    : data_(data), options_(options), rows_(rows), in_parts_(in_parts) {
    if (data.located().mapped)
        lanes_.emplace(*data.located().mapped, data.point_fields, data.node_values(), UseLane{this});
}

void ChunkSampler::push(const locate::PointRecord& point, locate::Place owner, Feature feature) {
    if (!lanes_) return push_straight(point, owner, feature);
    const Location at{owner < 0 ? -1 : data_.index().original[static_cast<std::size_t>(owner)], feature};
    if (!in_parts_) return settled(point, at);
    if (!lanes_->push(at, point, owner, false)) settled(point, data_.located().settle(point.at.data(), at));
    settle_rest();
}

void ChunkSampler::settle_rest() {
    while (!not_here_.empty()) {
        const auto [point, in_parts] = not_here_.back();
        not_here_.pop_back();
        settled(point, data_.located().settle(point.at.data(), in_parts));
    }
}

void ChunkSampler::flush() {
    if (lanes_) {
        lanes_->flush();
        settle_rest();
        lanes_->flush();
    }
    flush_straight();
}

void ChunkSampler::UseLane::operator()(const locate::MappedCells::Batch& batch, std::size_t lane, bool inside,
                                       bool proved) const {
    const locate::PointRecord point = batch.record(lane);
    Location at = batch.at[lane];
    if (!batch.settled[lane]) {
        if (!inside) return static_cast<void>(sampler->not_here_.emplace_back(point, at));
        at = {batch.first[lane], Feature::interior};
    }
    if (!proved) return sampler->settled(point, at, false);
    sampler->set_row(point, at, &batch.out[lane], batch.max);
    sampler->counts_.values.add(Tier::double_double);
}

void ChunkSampler::settled(const locate::PointRecord& point, const Location& at, bool on_lanes) {
    const locate::MappedCells& mapped = *data_.located().mapped;
    Mesh::Index straight = at.cell;
    if (mapped.evaluates(at.cell, point.at.data())) {
        using core::isoparametric::Certainty;
        if (data_.point_components == 0) return set_row(point, at, nullptr, 1);
        const auto place = [&] { return data_.located().parts.places()[static_cast<std::size_t>(at.cell)]; };
        if (on_lanes && lanes_->push(at, point, place(), true)) return;
        values_.resize(std::max(values_.size(), data_.point_components));
        const auto found =
            mapped.evaluate(at.cell, at.feature, point.at.data(), data_.point_fields, scratch_, values_.data());
        counts_.undecided += found.certainty == Certainty::undecided ? 1 : 0;
        counts_.max_off = std::max(counts_.max_off, found.off);
        counts_.unmapped += found.certainty == Certainty::not_found ? 1 : 0;
        if (found.certainty != Certainty::not_found) {
            counts_.values.add(found.tier);
            return set_row(point, at, values_.data(), 1);
        }
        straight = mapped.part_at(at.cell, point.at.data());
    }
    push_straight(point, straight < 0 ? -1 : data_.located().parts.places()[static_cast<std::size_t>(straight)],
                  at.feature);
}

void ChunkSampler::set_row(const locate::PointRecord& point, const Location& at, const double* values,
                           std::size_t stride) {
    rows_.cells[point.number] = at.cell;
    rows_.features[point.number] = at.feature;
    for (std::size_t c = 0; c < data_.point_components; ++c) row(point)[c] = values[stride * c];
    if (data_.has_rest()) set_rest_of_row(data_, options_, {at.cell, point.at.data()}, row(point), counts_);
}

void ChunkSampler::straight(const locate::PointRecord* points, std::size_t count, const locate::Place* owner,
                            const Feature* feature) {
    const locate::CellIndex& index = data_.index();
    std::size_t inside = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t number = points[i].number;
        rows_.cells[number] = owner[i] < 0 ? -1 : index.original[static_cast<std::size_t>(owner[i])];
        rows_.features[number] = feature[i];
        inside_[inside] = {static_cast<std::uint32_t>(i), owner[i] < 0 ? outside(points[i]) : owner[i]};
        inside += inside_[inside].cell >= 0 ? 1 : 0;
    }
    if (data_.point_components != 0)
        data_.quadratic ? interpolate_second_order(points, inside) : interpolate_linear(points, inside);
    for (std::size_t i = 0; data_.has_rest() && i < inside; ++i) {
        const locate::PointRecord& point = points[inside_[i].point];
        set_rest_of_row(data_, options_, {index.original[static_cast<std::size_t>(inside_[i].cell)], point.at.data()},
                        row(point), counts_);
    }
}

void ChunkSampler::interpolate_linear(const locate::PointRecord* points, std::size_t count) {
    const locate::CellIndex& index = data_.index();
    const NodeValues nodes = data_.node_values();
    const std::size_t undecided = interpolate_lanes(
        {index.simplex, index.cells.data(), nodes, points, std::span(inside_).first(count), rows_.values, data_.width},
        options_.rounding, undecided_.data());
    if (options_.rounding == Rounding::plain) {
        for (std::size_t i = 0; !data_.finite && i < count; ++i) mend_plain(points[inside_[i].point], inside_[i].cell);
        return;
    }
    counts_.values.add(Tier::double_double, count - undecided);
    for (std::size_t i = 0; i < undecided; ++i) {
        const locate::Walk& item = inside_[undecided_[i]];
        interpolate_exactly(points[item.point], item.cell);
    }
}

void ChunkSampler::interpolate_exactly(const locate::PointRecord& point, locate::Place cell) {
    const locate::CellIndex& index = data_.index();
    const auto& node = index.cells[static_cast<std::size_t>(cell)].node;
    const std::array<double, 12> vertices = locate::vertices_of(index, cell);
    bool degenerate = false, finite = true;
    for (std::size_t c = 0; c < data_.point_components; ++c) {
        std::array<double, 4> f{};
        for (std::size_t i = 0; i < index.corners(); ++i) f[i] = data_.value_at(static_cast<std::size_t>(node[i]), c);
        const Value v = *interpolate(index.simplex, vertices.data(), point.at.data(), f.data());
        row(point)[c] = v.value;
        degenerate |= v.degenerate;  // an owner never is, but a caller of evaluate() may name any cell
        finite &= v.degenerate || !std::isnan(v.value);
    }
    counts_.values.add(Tier::exact);
    counts_.values.degenerate += degenerate ? 1 : 0;
    counts_.values.not_finite += finite ? 0 : 1;
}

void ChunkSampler::mend_plain(const locate::PointRecord& point, locate::Place cell) {
    const locate::CellIndex& index = data_.index();
    const auto& node = index.cells[static_cast<std::size_t>(cell)].node;
    const std::array<double, 12> vertices = locate::vertices_of(index, cell);
    const core::CaseBlock block = core::single_block(index.simplex, vertices.data(), point.at.data());
    constexpr std::uint32_t only = 0;
    for (std::size_t c = 0; c < data_.point_components; ++c) {
        double& value = row(point)[c];
        if (std::isfinite(value)) continue;
        std::array<double, 4> f{};
        std::array<const double*, 4> at{};
        for (std::size_t i = 0; i < index.corners(); ++i)
            at[i] = &(f[i] = data_.value_at(static_cast<std::size_t>(node[i]), c));
        core::mend_plain_values(index.simplex, block, {&only, 1}, at.data(), static_cast<int>(index.corners()), 1,
                                &value);
    }
}

void ChunkSampler::interpolate_second_order(const locate::PointRecord* points, std::size_t count) {
    const locate::CellIndex& index = data_.index();
    const Mesh& mesh = *data_.located().mesh;
    const std::size_t d = index.dimension();
    cells_.resize(count);
    points_.resize(d * count);
    values_.resize(data_.point_components * count);
    for (std::size_t i = 0; i < count; ++i) {
        cells_[i] = index.original[static_cast<std::size_t>(inside_[i].cell)];
        for (std::size_t k = 0; k < d; ++k) points_[d * i + k] = points[inside_[i].point].at[k];
    }
    const MeshQueries queries{index.simplex, mesh.points, mesh.cells, cells_, points_};
    const NodalValues<double> values{data_.values, static_cast<int>(data_.point_components)};
    // Sizes fit, coordinates are finite and the environment has been looked at: there is no Error.
    interpolate_quadratic(queries, mesh.mid_nodes, values, values_, &counts_.values, options_.rounding).value();
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(data_.point_components * i), data_.point_components,
                    row(points[inside_[i].point]));
}

locate::Place ChunkSampler::outside(const locate::PointRecord& point) {
    if (rows_.distances == nullptr) {
        leave_out(1, point.number);
        return -1;
    }
    const bool snap = options_.outside.kind == Outside::nearest;
    const double limit = snap ? options_.outside.limit : std::numeric_limits<double>::infinity();
    locate::NearestInMaps in_maps;
    Nearest& nearest = in_maps.nearest;
    const bool finite = base::all_finite({point.at.data(), data_.index().dimension()});
    if (finite && data_.located().mapped != nullptr) {
        in_maps = locate::nearest_in_maps(data_.located(), point.at.data(), limit);
    } else if (finite) {
        nearest = *data_.locator->nearest(point.at.data(), limit);
    }
    double& distance = rows_.distances[point.number];
    if (nearest.cell < 0) {
        distance = std::numeric_limits<double>::quiet_NaN();
        leave_out(1, point.number);
        return -1;
    }
    distance = nearest.distance;
    ++(snap ? counts_.snapped : counts_.extrapolated);
    counts_.farthest = std::max(counts_.farthest, distance);
    counts_.undecided += in_maps.off != 0 ? 1 : 0;
    counts_.max_off = std::max(counts_.max_off, in_maps.off);
    if (in_maps.on) {
        outside_maps(point, in_maps);
        return -1;
    }
    if (!snap) return data_.located().parts.places()[static_cast<std::size_t>(nearest.cell)];
    snapped_values(data_, options_, nearest, point.at, row(point), counts_);
    return -1;
}

void ChunkSampler::outside_maps(const locate::PointRecord& point, const locate::NearestInMaps& nearest) {
    using core::isoparametric::Certainty, core::isoparametric::Evaluated;
    const locate::MappedCells& mapped = *data_.located().mapped;
    double* const values = row(point);
    if (data_.point_components != 0) {
        Evaluated found;
        const bool beyond = options_.outside.kind == Outside::extrapolate;
        if (beyond)
            found = mapped.evaluate_beyond(nearest.nearest.cell, *nearest.on, point.at.data(), data_.point_fields,
                                           scratch_, values);
        if (found.certainty == Certainty::not_found) {
            counts_.unmapped += beyond ? 1 : 0;
            found = mapped.evaluate_on_side(*nearest.on, data_.point_fields, scratch_, values);
        }
        // The distance of a point that is undecided was counted before.
        counts_.undecided += found.certainty == Certainty::undecided && nearest.off == 0 ? 1 : 0;
        counts_.max_off = std::max(counts_.max_off, found.off);
        counts_.values.add(found.tier);
        const bool nan = std::any_of(values, values + data_.point_components, [](double x) { return std::isnan(x); });
        counts_.values.not_finite += nan ? 1 : 0;
    }
    set_rest_of_row(data_, options_, {nearest.nearest.cell, point.at.data(), nearest.on.get()}, values, counts_);
}

void ChunkSampler::leave_out(std::uint64_t count, std::uint32_t number) {
    if (options_.outside.kind == Outside::error) refused_ = std::min(refused_.value_or(number), number);
    const bool fill = options_.outside.kind == Outside::fill;
    std::fill_n(rows_.values + data_.width * number, data_.width,
                fill ? options_.outside.fill : std::numeric_limits<double>::quiet_NaN());
    counts_.without_value += count;
}

}  // namespace barycert::sample
