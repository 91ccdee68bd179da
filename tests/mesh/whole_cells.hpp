/// Cells as users know them, simplices too, and places in them by shape functions that share no code with the
/// library's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::test {

/// Cells in VTK's words: the number of each one's type, where its nodes end, and the nodes in VTK's order.
struct CellArrays {
    std::vector<std::uint8_t> types;
    std::vector<std::int64_t> ends;
    std::vector<Mesh::Index> nodes;

    std::size_t count() const { return types.size(); }
    std::span<const Mesh::Index> of(std::size_t cell) const {
        const auto begin = static_cast<std::size_t>(cell == 0 ? 0 : ends[cell - 1]);
        return std::span(nodes).subspan(begin, static_cast<std::size_t>(ends[cell]) - begin);
    }
    void add(std::uint8_t type, std::span<const Mesh::Index> own) {
        types.push_back(type);
        nodes.insert(nodes.end(), own.begin(), own.end());
        ends.push_back(static_cast<std::int64_t>(nodes.size()));
    }
};

/// The mesh's simplices, which may be parts of other cells; those of second order with their mid-edge nodes.
inline CellArrays simplices_of(const Mesh& mesh) {
    const std::size_t corners = mesh.corners(), count = mesh.cell_count();
    const std::size_t mids = mesh.mid_nodes.size() / (count == 0 ? 1 : count);
    const int type = mesh.dimension == 3 ? (mids == 0 ? 10 : 24) : (mids == 0 ? 5 : 22);
    CellArrays cells;
    std::vector<Mesh::Index> own(corners + mids);
    for (std::size_t cell = 0; cell < count; ++cell) {
        for (std::size_t i = 0; i < corners; ++i) own[i] = mesh.cells[cell * corners + i];
        for (std::size_t i = 0; i < mids; ++i) own[corners + i] = mesh.mid_nodes[cell * mids + i];
        cells.add(static_cast<std::uint8_t>(type), own);
    }
    return cells;
}

inline CellArrays whole_cells(const Mesh& mesh) {
    if (mesh.shapes.types.empty()) return simplices_of(mesh);
    return {mesh.shapes.types, mesh.shapes.ends, mesh.shapes.nodes};
}

using ReferencePlace = std::array<long double, 3>;

/// Shape functions of VTK's types 10 to 14 and 24 at r, s, t from 0 to 1 (the apex of a pyramid: t = 1).
inline std::vector<long double> shape_functions(std::uint8_t type, const ReferencePlace& x) {
    const auto [r, s, t] = x;
    const long double a = 1 - r, b = 1 - s, c = 1 - t;
    switch (type) {
        case 11:
            return {a * b * c, r * b * c, a * s * c, r * s * c, a * b * t, r * b * t, a * s * t, r * s * t};
        case 12:
            return {a * b * c, r * b * c, r * s * c, a * s * c, a * b * t, r * b * t, r * s * t, a * s * t};
        case 13:
            return {(a - s) * c, r * c, s * c, (a - s) * t, r * t, s * t};
        case 14:
            return {a * b * c, r * b * c, r * s * c, a * s * c, t};
        default:
            break;
    }
    const long double q = a - s - t;
    if (type == 10) return {q, r, s, t};
    return {q * (2 * q - 1), r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * q * r,
            4 * r * s,       4 * q * s,       4 * q * t,       4 * r * t,       4 * s * t};
}

/// Where the corners of the reference cell are.
inline std::vector<ReferencePlace> reference_corners(std::uint8_t type) {
    switch (type) {
        case 11:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
        case 12:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        case 13:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
        case 14:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
        default:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    }
}

/// The sum of the cell's shape functions times `values`, `components` a node, rounded once to double each.
template <std::size_t components>
std::array<double, components> at_place(std::uint8_t type, std::span<const Mesh::Index> nodes,
                                        const ReferencePlace& place, const std::vector<double>& values) {
    const std::vector<long double> n = shape_functions(type, place);
    std::array<double, components> out{};
    for (std::size_t k = 0; k < components; ++k) {
        long double sum = 0;
        for (std::size_t i = 0; i < n.size(); ++i)
            sum += n[i] * values[components * static_cast<std::size_t>(nodes[i]) + k];
        out[k] = static_cast<double>(sum);
    }
    return out;
}

}  // namespace barycert::test
