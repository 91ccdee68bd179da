#include "barycert/sample/points/row_rest.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "barycert/quadratic.hpp"
#include "barycert/sample/quantity/length.hpp"

namespace barycert::sample {
namespace {

/// The gradients of all components of a field of nodes, in a cell of second order.
void gradients_at(const SamplerData& data, Rounding rounding, const Field& field, Mesh::Index cell, const double* point,
                  double* out) {
    const Mesh& mesh = *data.located().mesh;
    const Simplex simplex = data.index().simplex;
    const std::size_t d = static_cast<std::size_t>(mesh.dimension), corners = d + 1;
    const auto mids = static_cast<std::size_t>(mid_node_count(simplex)), c = static_cast<std::size_t>(cell);
    const auto components = static_cast<std::size_t>(field.components);
    std::array<double, 12> vertices{};
    for (std::size_t i = 0; i < corners; ++i)
        std::copy_n(&mesh.points[d * static_cast<std::size_t>(mesh.cells[corners * c + i])], d, &vertices[d * i]);
    for (std::size_t k = 0; k < components; ++k) {
        std::array<double, 10> values{};
        for (std::size_t i = 0; i < corners + mids; ++i) {
            const Mesh::Index node =
                i < corners ? mesh.cells[corners * c + i] : mesh.mid_nodes[mids * c + (i - corners)];
            values[i] = field.data[components * static_cast<std::size_t>(node) + k];
        }
        // Coordinates are finite, and the simplex has a gradient: there is no Error.
        const Gradient g = *quadratic_gradient(simplex, vertices.data(), point, values.data(), rounding);
        std::copy_n(g.gradient.begin(), d, out + d * k);
    }
}

}  // namespace

void set_rest_of_row(const SamplerData& data, Rounding rounding, Mesh::Index cell, const double* point, double* row) {
    double* to = row + data.point_components;
    for (const Field* field : data.cell_fields) {
        const auto components = static_cast<std::size_t>(field->components);
        to = std::copy_n(field->data.begin() + static_cast<std::ptrdiff_t>(components * static_cast<std::size_t>(cell)),
                         components, to);
    }
    std::vector<double> numbers;
    for (const AtPoint& late : data.at_points) {
        std::span<const double> values(row + late.first, late.components);
        if (late.gradient) {
            numbers.resize(late.components);
            gradients_at(data, rounding, *late.field, cell, point, numbers.data());
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

}  // namespace barycert::sample
