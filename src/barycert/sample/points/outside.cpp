#include "barycert/sample/points/chunk_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
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

double linear(const SamplerData& data, Rounding rounding, const Piece& piece, const double* point, std::size_t c,
              TierCounts& tiers) {
    const auto space = static_cast<std::size_t>(space_dimension(piece.simplex));
    CaseArrays one{.simplex = piece.simplex, .count = 1};
    ValueArrays<double> values;
    std::array<double, 4> f{};
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        for (std::size_t k = 0; k < space; ++k) one.vertices[space * i + k] = &piece.vertices[space * i + k];
        f[i] = nodal_value(data, piece.corners[i], c);
        values.at[i] = &f[i];
    }
    for (std::size_t k = 0; k < space; ++k) one.point[k] = point + k;
    double value = 0;
    // One finite case, in an environment that has been looked at: there is no Error.
    static_cast<void>(interpolate(one, values, std::span(&value, 1), &tiers, rounding).has_value());
    return value;
}

/// All components in plain double, of a point projected: with weights that are not negative, and rounded once each,
/// what is beyond the nodal values is rounding alone.
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

/// All components at once, in the cell.
void quadratic(const SamplerData& data, Rounding rounding, std::size_t cell, const double* point, double* out,
               TierCounts& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const auto index = static_cast<std::int32_t>(cell);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const MeshQueries query{data.index().simplex, mesh.points, mesh.cells, std::span(&index, 1), std::span(point, d)};
    const NodalValues<double> values{data.values, static_cast<int>(data.point_components)};
    static_cast<void>(
        interpolate_quadratic(query, mesh.mid_nodes, values, std::span(out, data.point_components), &tiers, rounding)
            .has_value());
}

/// The same at the point of the cell that has the rounded weights of the projection.
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

/// The orthogonal projection of a point to what these nodes span, each coordinate correctly rounded.
std::array<double, 3> rounded_projection(const Mesh& mesh, const std::array<double, 3>& point,
                                         const std::vector<Mesh::Index>& nodes) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<double, 3> at{};
    const auto coordinate = [&](std::size_t i, std::size_t k) {
        return mesh.points[d * static_cast<std::size_t>(nodes[i]) + k];
    };
    const Piece piece = feature_piece(mesh, nodes);
    for (std::size_t k = 0; k < d; ++k) {
        std::array<double, 3> values{};
        for (std::size_t i = 0; i < nodes.size(); ++i) values[i] = coordinate(i, k);
        at[k] = nodes.size() == 1
                    ? values[0]
                    : interpolate(piece.simplex, piece.vertices.data(), point.data(), values.data())->value;
    }
    return at;
}

}  // namespace

std::optional<double> value_outside(const SamplerData& data, const SampleOptions& options, const double* point,
                                    double* values, TierCounts& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const bool snap = options.outside.kind == Outside::nearest;
    // The points are finite.
    const double limit = snap ? options.outside.limit : std::numeric_limits<double>::infinity();
    const Nearest nearest = *data.locator->nearest(point, limit);
    if (nearest.cell < 0) return std::nullopt;
    const auto cell = static_cast<std::size_t>(nearest.cell);

    std::array<double, 3> at{};
    std::copy_n(point, mesh.dimension, at.begin());
    const std::vector<Mesh::Index> nodes = nodes_of(nearest);
    TierCounts used;
    if (snap && nodes.size() == 1 && data.point_components != 0) {
        for (std::size_t c = 0; c < data.point_components; ++c) {
            const double f = nodal_value(data, nodes[0], c);
            values[c] = std::isfinite(f) ? f + 0.0 : std::numeric_limits<double>::quiet_NaN();
            if (!std::isfinite(f)) used.not_finite = 1;
        }
        if (options.rounding == Rounding::correct) tiers.add(Tier::filter);
    } else if (data.point_components != 0) {
        const Piece piece = snap ? feature_piece(mesh, nodes) : cell_piece(mesh, cell);
        const locate::NearFeature feature = snap ? feature_of(mesh, nodes) : locate::NearFeature{};
        if (data.quadratic && snap) {
            quadratic_projected(data, options.rounding, cell, feature, locate::weights_of(at, feature), values, used);
        } else if (data.quadratic) {
            quadratic(data, options.rounding, cell, at.data(), values, used);
        } else if (snap && options.rounding == Rounding::plain) {
            plain_projected(data, feature, locate::weights_of(at, feature), values);
        } else {
            for (std::size_t c = 0; c < data.point_components; ++c)
                values[c] = linear(data, options.rounding, piece, at.data(), c, used);
        }
        if (options.rounding == Rounding::correct) tiers.add(used.exact != 0 ? Tier::exact : Tier::double_double);
    }
    if (options.rounding == Rounding::correct) tiers.not_finite += used.not_finite != 0 ? 1 : 0;
    if (data.quadratic && snap && !data.at_points.empty()) at = rounded_projection(mesh, at, nodes);
    set_rest_of_row(data, options.rounding, nearest.cell, at.data(), values);
    return nearest.distance;
}

}  // namespace barycert::sample
