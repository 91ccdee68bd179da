#include "core/shape_functions.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/vtk_cell.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Multi-indices of the nodes as VTK's vtkLagrangeTriangle and vtkLagrangeTetra number them.
constexpr std::array<std::string_view, 6> node_orders{
    "200 020 002 110 011 101",
    "300 030 003 210 120 021 012 102 201 111",
    "400 040 004 310 220 130 031 022 013 103 202 301 211 121 112",
    "2000 0200 0020 0002 1100 0110 1010 1001 0101 0011",
    "3000 0300 0030 0003 2100 1200 0210 0120 1020 2010 2001 1002 0201 0102 0021 0012 1101 0111 1011 1110",
    "4000 0400 0040 0004 3100 2200 1300 0310 0220 0130 1030 2020 3010 3001 2002 1003 0301 0202 0103 0031 0022 0013 "
    "2101 1201 1102 0121 0112 0211 2011 1012 1021 2110 1120 1210 1111"};

Reference reference_of(std::size_t which) {
    const bool flat = which < 3;
    Reference r{flat ? Element::triangle : Element::tetrahedron, static_cast<int>(which % 3) + 2, 0, 1, {}};
    for (int k = 2; k <= r.order; ++k) r.scale *= k;
    const std::string_view text = node_orders[which];
    for (std::size_t at = 0; at < text.size(); at += flat ? 4 : 5) {
        auto& index = r.indices.emplace_back();
        for (std::size_t c = 0; c < (flat ? 3U : 4U); ++c) index[c] = static_cast<std::uint8_t>(text[at + c] - '0');
    }
    r.nodes = r.indices.size();
    return r;
}

}  // namespace

const Reference* linear_reference(std::uint8_t type) {
    static const Reference quadrilateral{Element::quadrilateral, 1, 4}, hexahedron{Element::hexahedron, 1, 8},
        wedge{Element::wedge, 1, 6}, pyramid{Element::pyramid, 1, 5};
    if (type == vtk_pixel || type == vtk_quad) return &quadrilateral;
    if (type == vtk_voxel || type == vtk_hexahedron) return &hexahedron;
    return type == vtk_wedge ? &wedge : type == vtk_pyramid ? &pyramid : nullptr;
}

const std::array<Reference, 6>& simplex_references() {
    static const std::array<Reference, 6> all{reference_of(0), reference_of(1), reference_of(2),
                                              reference_of(3), reference_of(4), reference_of(5)};
    return all;
}

const Reference* simplex_reference(int dimension, std::size_t nodes) {
    for (const Reference& reference : simplex_references()) {
        if (reference.nodes == nodes && reference.dimension() == static_cast<std::size_t>(dimension)) return &reference;
    }
    return nullptr;
}

}  // namespace barycert::core::isoparametric
