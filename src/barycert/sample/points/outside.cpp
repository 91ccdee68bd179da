#include "barycert/sample/points/chunk_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "barycert/base/strict_math.hpp"
#include "barycert/locate/near_feature.hpp"
#include "barycert/quadratic.hpp"
#include "barycert/sample/points/near_piece.hpp"

namespace barycert::sample {
namespace {

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
    for (const Mesh::Index node : second_order_nodes(mesh, cell)) {
        const auto first = data.values.begin() + static_cast<std::ptrdiff_t>(data.point_components) * node;
        values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(data.point_components));
    }
    std::array<std::int32_t, 10> local{};
    std::iota(local.begin(), local.end(), 0);
    const std::int32_t only = 0;
    const MeshQueries query{data.index().simplex, std::span(reference.vertices).first(d * corners),
                            std::span(local).first(corners), std::span(&only, 1), std::span(reference.at).first(d)};
    const NodalValues<double> nodal{values, static_cast<int>(data.point_components)};
    static_cast<void>(interpolate_quadratic(query, std::span(local).subspan(corners, mids), nodal,
                                            std::span(out, data.point_components), &tiers, rounding)
                          .has_value());
}

/// Of a point whose projection is no vertex; values(i) is that at node i of the feature.
template <class Values>
Value projected(const locate::NearFeature& feature, const std::array<double, 3>& point, Values values) {
    std::array<double, 3> f{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(feature.count); ++i) f[i] = values(i);
    // Coordinates are finite: there is no Error.
    return *interpolate(feature.simplex(), feature.vertices().data(), point.data(), f.data());
}

}  // namespace

void snapped_values(const SamplerData& data, Rounding rounding, const Nearest& nearest,
                    const std::array<double, 3>& point, double* values, TierCounts& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const auto cell = static_cast<std::size_t>(nearest.cell);
    const locate::NearFeature feature = feature_of(mesh, nearest);
    const bool correct = rounding == Rounding::correct, vertex = feature.count == 1;
    TierCounts used;
    if (vertex || (!data.quadratic && !correct)) {
        plain_projected(data, feature, locate::weights_of(point, feature), values);
    } else if (data.quadratic && data.point_components != 0) {
        quadratic_projected(data, rounding, cell, feature, locate::weights_of(point, feature), values, used);
    } else {
        for (std::size_t c = 0; c < data.point_components; ++c) {
            const auto nodal = [&](std::size_t i) { return nodal_value(data, feature.nodes[i], c); };
            const Value v = projected(feature, point, nodal);
            values[c] = v.value;
            used.add(v.tier);
        }
    }
    if (correct && data.point_components != 0) {
        tiers.add(vertex ? Tier::filter : used.exact != 0 ? Tier::exact : Tier::double_double);
        tiers.not_finite +=
            std::any_of(values, values + data.point_components, [](double x) { return std::isnan(x); }) ? 1 : 0;
    }
    // The projection, each coordinate correctly rounded.
    std::array<double, 3> at = point;
    const bool asked = data.quadratic && !data.at_points.empty();
    for (std::size_t k = 0; asked && k < static_cast<std::size_t>(mesh.dimension); ++k)
        at[k] = vertex ? feature.at[0][k]
                       : projected(feature, point, [&](std::size_t i) { return feature.at[i][k]; }).value;
    set_rest_of_row(data, rounding, nearest.cell, at.data(), values);
}

}  // namespace barycert::sample
