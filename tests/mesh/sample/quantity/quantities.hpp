/// Quantities made of fields, in GMP's rationals.
#pragma once

#include <gmpxx.h>

#include <cmath>
#include <optional>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/oracle.hpp"
#include "tests/audit/exact/second_path.hpp"
#include "tests/core/field_cases.hpp"
#include "tests/core/rational.hpp"
#include "tests/mesh/locate/judge.hpp"

namespace barycert::testing {

using Rational = mpq_class;

/// The cell with the values of component c at its corners, and the point.
inline Case case_with_values(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell,
                             const double* point) {
    Case question = case_of(mesh, cell, point);
    const auto components = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        const auto node = static_cast<std::size_t>(mesh.cells[mesh.corners() * static_cast<std::size_t>(cell) + i]);
        question.values[i] = field.data[components * node + c];
    }
    return question;
}

/// The same with the values at mid-edge nodes, where there are some.
inline testing_fields::QuadraticCase quadratic_case(const Mesh& mesh, const Field& field, std::size_t c,
                                                    Mesh::Index cell, const double* point) {
    testing_fields::QuadraticCase q{case_with_values(mesh, field, c, cell, point), {}};
    const std::size_t edges = mesh.dimension == 2 ? 3 : 6, components = static_cast<std::size_t>(field.components);
    for (std::size_t e = 0; e < edges && !mesh.mid_nodes.empty(); ++e) {
        const auto node = static_cast<std::size_t>(mesh.mid_nodes[edges * static_cast<std::size_t>(cell) + e]);
        q.mids.push_back(field.data[components * node + c]);
    }
    return q;
}

/// The exact value; nothing if the cell is degenerate. Values must be finite.
inline std::optional<Rational> exact_value(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell,
                                           const double* point) {
    const auto q = quadratic_case(mesh, field, c, cell, point);
    if (!q.mids.empty()) return testing_fields::exact_quadratic(q);
    const auto l = second_path::weights(q.linear);
    if (!l) return std::nullopt;
    Rational sum(0);
    for (std::size_t i = 0; i < l->size(); ++i) sum += (*l)[i] * Rational(q.linear.values[i]);
    return sum;
}

/// The determinant of the edges of a cell.
inline Rational exact_determinant(const Mesh& mesh, Mesh::Index cell) {
    const double nowhere[3] = {};
    auto e = second_path::edges(case_of(mesh, cell, nowhere));
    if (e.size() == 2) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// The mean of a cell field at a node; nothing if no cell there has a volume.
inline std::optional<Rational> exact_mean(const Mesh& mesh, const Field& of_cells, std::size_t c, Mesh::Index node) {
    Rational sum(0), volume(0);
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh.mid_nodes.size() / mesh.cell_count();
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        bool has = false;
        for (std::size_t i = 0; i < mesh.corners(); ++i) has |= mesh.cells[mesh.corners() * cell + i] == node;
        for (std::size_t i = 0; i < mids; ++i) has |= mesh.mid_nodes[mids * cell + i] == node;
        if (!has) continue;
        const Rational weight = abs(exact_determinant(mesh, static_cast<Mesh::Index>(cell)));
        volume += weight;
        sum += weight * Rational(of_cells.data[static_cast<std::size_t>(of_cells.components) * cell + c]);
    }
    if (volume == 0) return std::nullopt;
    return Rational(sum / volume);
}

/// Whether |found - sqrt(square)| <= units * (the unit in the last place of found).
inline bool is_near_root(double found, const Rational& square, double units) {
    if (!(found >= 0) || std::isinf(found)) return false;
    const double above = std::nextafter(found, HUGE_VAL);
    const Rational unit =
        std::isinf(above) ? Rational(found) - Rational(std::nextafter(found, 0)) : Rational(above) - Rational(found);
    const Rational low = Rational(found) - Rational(units) * unit, high = Rational(found) + Rational(units) * unit;
    return (low <= 0 || low * low <= square) && square <= high * high;
}

}  // namespace barycert::testing
