/// Shape functions of cells and their derivatives, for numbers of any type with + - *, made of integers.
///
/// Linear cells as VTK numbers their nodes (vtkCellType.h), on reference coordinates r, s, t from 0 to 1:
///   quadrilateral  (1-r)(1-s), r(1-s), rs, (1-r)s
///   hexahedron     the same times 1-t for nodes 0 to 3, times t for 4 to 7
///   wedge          1-r-s, r, s times 1-t for nodes 0 to 2, times t for 3 to 5
///   pyramid        those of the quadrilateral times 1-t; the apex t
/// Simplices of order n with nodes at a lattice: node (a, b, c, d) of the multi-index a + b + c + d = n has
///   n!/(a! b! c! d!) times the product over its indices k of n L (n L - 1) ... (n L - k + 1), over n!
/// where L are the barycentric coordinates, 1-r-s-t, r, s, t. Functions are given times `scale`, n! there, 1 of linear
/// cells: then no number need be rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace barycert::core::isoparametric {

enum class Element : std::uint8_t { quadrilateral, hexahedron, wedge, pyramid, triangle, tetrahedron };

inline constexpr std::size_t max_nodes = 35;

struct Reference {
    Element element = Element::hexahedron;
    int order = 1;  ///< of simplices: 2 to 4
    std::size_t nodes = 8;
    int scale = 1;
    std::vector<std::array<std::uint8_t, 4>> indices = {};  ///< of the nodes of a simplex

    std::size_t dimension() const { return element == Element::quadrilateral || element == Element::triangle ? 2 : 3; }
    bool is_simplex() const { return element >= Element::triangle; }
};

/// Returns the reference cell of VTK's linear types 8, 9, and 11 to 14; nullptr for others.
const Reference* linear_reference(std::uint8_t type);
/// Simplices of order 2 to 4 with nodes numbered as VTK's Lagrange cells: triangles, then tetrahedra.
const std::array<Reference, 6>& simplex_references();
/// The one of these with so many nodes; nullptr of other numbers.
const Reference* simplex_reference(int dimension, std::size_t nodes);

/// Values and derivatives, of derivatives[node][axis], at x, times reference.scale.
template <class N>
void shape_functions(const Reference& of, const std::array<N, 3>& x, std::array<N, max_nodes>& values,
                     std::type_identity_t<std::array<std::array<N, 3>, max_nodes>*> derivatives) {
    const N one(1), &r = x[0], &s = x[1], &t = x[2], r1 = one - r, s1 = one - s, t1 = one - t;
    if (of.element == Element::quadrilateral || of.element == Element::hexahedron || of.element == Element::pyramid) {
        const std::array<N, 4> flat{r1 * s1, r * s1, r * s, r1 * s}, by_r{-s1, s1, s, -s}, by_s{-r1, -r, r, r1};
        if (of.element == Element::quadrilateral) {
            for (std::size_t i = 0; i < 4; ++i) {
                values[i] = flat[i];
                if (derivatives != nullptr) (*derivatives)[i] = {by_r[i], by_s[i], N(0)};
            }
            return;
        }
        const bool pyramid = of.element == Element::pyramid;
        for (std::size_t i = 0; i < 4; ++i) {
            values[i] = flat[i] * t1;
            if (!pyramid) values[i + 4] = flat[i] * t;
            if (derivatives == nullptr) continue;
            (*derivatives)[i] = {by_r[i] * t1, by_s[i] * t1, -flat[i]};
            if (!pyramid) (*derivatives)[i + 4] = {by_r[i] * t, by_s[i] * t, flat[i]};
        }
        if (!pyramid) return;
        values[4] = t;
        if (derivatives != nullptr) (*derivatives)[4] = {N(0), N(0), one};
        return;
    }
    if (of.element == Element::wedge) {
        const std::array<N, 3> flat{r1 - s, r, s};
        constexpr std::array<int, 3> by_r{-1, 1, 0}, by_s{-1, 0, 1};
        for (std::size_t i = 0; i < 3; ++i) {
            values[i] = flat[i] * t1;
            values[i + 3] = flat[i] * t;
            if (derivatives == nullptr) continue;
            (*derivatives)[i] = {N(by_r[i]) * t1, N(by_s[i]) * t1, -flat[i]};
            (*derivatives)[i + 3] = {N(by_r[i]) * t, N(by_s[i]) * t, flat[i]};
        }
        return;
    }
    // Falling products of each barycentric coordinate, and their derivatives by it.
    const std::size_t corners = of.dimension() + 1;
    std::array<std::array<N, 5>, 4> falling, slope;
    for (std::size_t c = 0; c < corners; ++c) {
        const N l = c > 0 ? x[c - 1] : corners == 3 ? r1 - s : r1 - s - t, nl = N(of.order) * l;
        falling[c][0] = one;
        slope[c][0] = N(0);
        for (int k = 0; k < of.order; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const N factor = nl - N(k);
            falling[c][i + 1] = falling[c][i] * factor;
            slope[c][i + 1] = slope[c][i] * factor + falling[c][i] * N(of.order);
        }
    }
    constexpr std::array<int, 5> factorial{1, 1, 2, 6, 24};
    for (std::size_t node = 0; node < of.nodes; ++node) {
        const auto& index = of.indices[node];
        int share = of.scale;
        for (std::size_t c = 0; c < corners; ++c) share /= factorial[index[c]];
        values[node] = N(share);
        for (std::size_t c = 0; c < corners; ++c) values[node] = values[node] * falling[c][index[c]];
        if (derivatives == nullptr) continue;
        std::array<N, 4> by;
        for (std::size_t c = 0; c < corners; ++c) {
            by[c] = N(share) * slope[c][index[c]];
            for (std::size_t other = 0; other < corners; ++other) {
                if (other != c) by[c] = by[c] * falling[other][index[other]];
            }
        }
        for (std::size_t k = 0; k + 1 < corners; ++k) (*derivatives)[node][k] = by[k + 1] - by[0];
        if (corners == 3) (*derivatives)[node][2] = N(0);
    }
}

}  // namespace barycert::core::isoparametric
