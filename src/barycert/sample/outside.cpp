#include "barycert/sample/outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "barycert/core/quadratic.hpp"
#include "barycert/core/strict_math.hpp"
#include "barycert/sample/chunk_sampler.hpp"

namespace barycert::detail {
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

/// Some nodes of the mesh, in the space of their simplex: a segment lies in 3-space, also that of a triangle in the
/// plane.
struct Piece {
    Simplex simplex;
    std::vector<Mesh::Index> corners;
    std::array<double, 12> vertices{};

    Piece(const Mesh& mesh, Simplex s, std::vector<Mesh::Index> nodes) : simplex(s), corners(std::move(nodes)) {
        const auto d = static_cast<std::size_t>(mesh.dimension), space = static_cast<std::size_t>(space_dimension(s));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t k = 0; k < d; ++k)
                vertices[space * i + k] = mesh.points[d * static_cast<std::size_t>(corners[i]) + k];
        }
    }
};

Piece cell_piece(const SamplerData& data, std::size_t cell) {
    const Mesh& mesh = *data.located().mesh;
    const auto begin = mesh.cells.begin() + static_cast<std::ptrdiff_t>(mesh.corners() * cell);
    return {mesh, data.index().simplex, {begin, begin + static_cast<std::ptrdiff_t>(mesh.corners())}};
}

double linear(const SamplerData& data, Rounding rounding, const Piece& piece, const double* point, std::size_t c,
              Tiers& tiers) {
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

/// All components at once, in the cell.
void quadratic(const SamplerData& data, Rounding rounding, std::size_t cell, const double* point, double* out,
               Tiers& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const auto index = static_cast<std::int32_t>(cell);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const MeshQueries query{data.index().simplex, mesh.points, mesh.cells, std::span(&index, 1), std::span(point, d)};
    const NodalValues<double> values{data.values, static_cast<int>(data.point_components)};
    static_cast<void>(
        interpolate_quadratic(query, mesh.mid_nodes, values, std::span(out, data.point_components), &tiers, rounding)
            .has_value());
}

/// The orthogonal projection of the point to what the piece spans, rounded.
std::array<double, 3> projection(const Piece& piece, const double* point) {
    std::array<double, 3> at{};
    const Result<Weights> w = barycentric_weights(piece.simplex, piece.vertices.data(), point);
    for (std::size_t k = 0; w && k < 3; ++k) {
        for (std::size_t i = 0; i < piece.corners.size(); ++i) at[k] += w->weights[i] * piece.vertices[3 * i + k];
    }
    return at;
}

}  // namespace

std::optional<double> value_outside(const SamplerData& data, const SampleOptions& options, const double* point,
                                    double* values, Tiers& tiers) {
    const Mesh& mesh = *data.located().mesh;
    const bool snap = options.outside.kind == Outside::nearest;
    // The points are finite.
    const double limit = snap ? options.outside.limit : std::numeric_limits<double>::infinity();
    const Nearest nearest = *data.locator->nearest(point, limit);
    if (nearest.cell < 0) return std::nullopt;
    const auto cell = static_cast<std::size_t>(nearest.cell);

    std::array<double, 3> at{};
    std::copy_n(point, mesh.dimension, at.begin());
    std::vector<Mesh::Index> nodes;
    for (const Mesh::Index node : nearest.nodes) {
        if (node >= 0) nodes.push_back(node);
    }
    Tiers used;
    if (snap && nodes.size() == 1 && data.point_components != 0) {
        bool finite = true;
        for (std::size_t c = 0; c < data.point_components; ++c) {
            const double value = nodal_value(data, nodes[0], c);
            finite &= std::isfinite(value);
            values[c] = std::isfinite(value) ? value + 0.0 : std::numeric_limits<double>::quiet_NaN();
        }
        if (options.rounding == Rounding::correct) {
            tiers.add(Tier::filter);
            tiers.not_finite += finite ? 0 : 1;
        }
    } else if (data.point_components != 0) {
        const Piece piece = snap ? Piece(mesh, nodes.size() == 3 ? Simplex::triangle3d : Simplex::segment, nodes)
                                 : cell_piece(data, cell);
        if (data.quadratic) {
            if (snap) at = projection(piece, at.data());
            quadratic(data, options.rounding, cell, at.data(), values, used);
        } else {
            for (std::size_t c = 0; c < data.point_components; ++c)
                values[c] = linear(data, options.rounding, piece, at.data(), c, used);
        }
        if (options.rounding == Rounding::correct) {
            tiers.add(used.exact != 0 ? Tier::exact : Tier::double_double);
            tiers.not_finite += used.not_finite != 0 ? 1 : 0;
        }
    }
    copy_cell_values(data, nearest.cell, values);
    return nearest.distance;
}

}  // namespace barycert::detail
