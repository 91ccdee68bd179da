#include "mesh/cell_types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::mesh {
namespace {

struct RowOfType {
    int number;
    std::string_view vtk_name;
    CellKind kind;
    int linear;
    std::size_t nodes = 0;
    std::string_view meshio = {};
    std::string_view faces = {};  ///< of linear types; others have those of their corners
};

// The order of the nodes of a wedge tells nothing. VTK documents one, the triangle of the first three seen from
// outside, and its own functions have the other, as Gmsh, Medit and Exodus have it; files have both. So its parts are
// turned to positive orientation.
constexpr auto rows = [] {
    using enum CellKind;
    return std::to_array<RowOfType>({
        {0, "EmptyCell", lower, 0},
        {1, "Vertex", lower, 0, 0, "vertex"},
        {2, "PolyVertex", lower, 0},
        {3, "Line", lower, 0, 0, "line"},
        {4, "PolyLine", lower, 0},
        {5, "Triangle", triangle, 5, 3, "triangle", "012"},
        {6, "TriangleStrip", surface, 6},
        {7, "Polygon", surface, 7, 0, "polygon"},
        {8, "Pixel", surface, 8, 4, {}, "0132"},
        {9, "Quad", surface, 9, 4, "quad", "0123"},
        {10, "Tetra", tetrahedron, 10, 4, "tetra", "013 123 203 021"},
        {11, "Voxel", solid, 11, 8, {}, "0462 1375 0154 2673 0231 4576"},
        {12, "Hexahedron", solid, 12, 8, "hexahedron", "0473 1265 0154 3762 0321 4567"},
        {13, "Wedge", solid, 13, 6, "wedge", "012 354 0341 1452 2530"},
        {14, "Pyramid", solid, 14, 5, "pyramid", "0321 014 124 234 304"},
        {15, "PentagonalPrism", solid, 15, 10, {}, "04321 56789 0165 1276 2387 3498 4059"},
        {16, "HexagonalPrism", solid, 16, 12, {}, "054321 6789ab 0176 1287 2398 34a9 45ba 506b"},
        {21, "QuadraticEdge", lower, 0, 0, "line3"},
        {22, "QuadraticTriangle", triangle, 5, 6, "triangle6"},
        {23, "QuadraticQuad", surface, 9, 8, "quad8"},
        {24, "QuadraticTetra", tetrahedron, 10, 10, "tetra10"},
        {25, "QuadraticHexahedron", solid, 12, 20, "hexahedron20"},
        {26, "QuadraticWedge", solid, 13, 15, "wedge15"},
        {27, "QuadraticPyramid", solid, 14, 13, "pyramid13"},
        {28, "BiQuadraticQuad", surface, 9, 9, "quad9"},
        {29, "TriQuadraticHexahedron", solid, 12, 27, "hexahedron27"},
        {30, "QuadraticLinearQuad", surface, 9, 6},
        {31, "QuadraticLinearWedge", solid, 13, 12},
        {32, "BiQuadraticQuadraticWedge", solid, 13, 18},
        {33, "BiQuadraticQuadraticHexahedron", solid, 12, 24},
        {34, "BiQuadraticTriangle", surface, 5, 7, "triangle7"},
        {35, "CubicLine", lower, 0, 0, "line4"},
        {36, "QuadraticPolygon", surface, 7},
        {37, "TriQuadraticPyramid", solid, 14, 19},
        {41, "ConvexPointSet", other, 0},
        {42, "Polyhedron", solid, 42, 0, "polyhedron"},
        {51, "ParametricCurve", other, 0},
        {52, "ParametricSurface", other, 0},
        {53, "ParametricTriSurface", other, 0},
        {54, "ParametricQuadSurface", other, 0},
        {55, "ParametricTetraRegion", other, 0},
        {56, "ParametricHexRegion", other, 0},
        {60, "HigherOrderEdge", other, 0},
        {61, "HigherOrderTriangle", surface, 5},
        {62, "HigherOrderQuad", surface, 9},
        {63, "HigherOrderPolygon", other, 0},
        {64, "HigherOrderTetrahedron", solid, 10},
        {68, "LagrangeCurve", lower, 0},
        {69, "LagrangeTriangle", surface, 5},
        {70, "LagrangeQuadrilateral", surface, 9},
        {71, "LagrangeTetra", solid, 10},
        {72, "LagrangeHexahedron", solid, 12},
        {73, "LagrangeWedge", solid, 13},
        {74, "LagrangePyramid", solid, 14},
        {75, "BezierCurve", other, 0},
        {76, "BezierTriangle", surface, 5},
        {77, "BezierQuadrilateral", surface, 9},
        {78, "BezierTetra", solid, 10},
        {79, "BezierHexahedron", solid, 12},
        {80, "BezierWedge", solid, 13},
    });
}();

constexpr auto types = [] {
    std::array<CellType, 256> all{};
    for (std::size_t number = 0; number < all.size(); ++number) all[number].number = static_cast<std::uint8_t>(number);
    for (const RowOfType& row : rows) {
        CellType& type = all[static_cast<std::size_t>(row.number)];
        type.kind = row.kind;
        type.linear = static_cast<std::uint8_t>(row.linear);
        type.nodes = row.nodes;
        type.vtk_name = row.vtk_name;
        type.meshio = row.meshio;
        for (const RowOfType& linear : rows) {
            if (linear.number != row.linear || type.dimension() == 0) continue;
            type.corners = linear.nodes;
            type.faces = linear.faces;
        }
        type.in_shapes = type.dimension() != 0 && (type.linear == type.number || is_curved_simplex(type.number));
    }
    return all;
}();

}  // namespace

std::string CellType::name() const {
    return vtk_name.empty() ? "unknown type " + std::to_string(number) : "vtk" + std::string(vtk_name);
}

const std::array<CellType, 256>& cell_types() {
    return types;
}

const std::vector<std::vector<Mesh::Index>>& rings_of(std::uint8_t type) {
    using Rings = std::vector<std::vector<Mesh::Index>>;
    static const auto all = [] {
        std::array<Rings, types.size()> made;
        for (const CellType& one : types) {
            if (!one.in_shapes || one.faces.empty()) continue;
            Rings& rings = made[one.number];
            rings.emplace_back();
            for (const char c : one.faces) {
                if (c == ' ')
                    rings.emplace_back();
                else
                    rings.back().push_back(c <= '9' ? c - '0' : c - 'a' + 10);
            }
        }
        return made;
    }();
    return all[type];
}

std::span<const Mesh::Index> corners_of(const CellType& type, std::span<const Mesh::Index> nodes) {
    if (type.corners != 0) return nodes.first(type.corners);
    return nodes.first(type.number == vtk_quadratic_polygon ? nodes.size() / 2 : nodes.size());
}

void add_rings(const CellType& type, std::span<const Mesh::Index> nodes, std::vector<std::vector<Mesh::Index>>& rings) {
    const auto c = corners_of(type, nodes);
    if (type.linear == vtk_triangle_strip) {
        for (std::size_t i = 0; i + 2 < c.size(); ++i) rings.push_back({c[i + i % 2], c[i + 1 - i % 2], c[i + 2]});
        return;
    }
    rings.emplace_back(c.begin(), c.end());
    if (type.linear == vtk_pixel) std::swap(rings.back()[2], rings.back()[3]);
}

bool add_shape(Mesh& mesh, std::uint8_t type, std::span<const Mesh::Index> nodes) {
    const bool whole = is_curved_simplex(type) && simplex_order(mesh.dimension, nodes.size()) != 0;
    const std::span kept = whole ? nodes : corners_of(cell_type(type), nodes);
    Mesh::Shapes& shapes = mesh.shapes;
    shapes.types.push_back(whole ? type : cell_type(type).linear);
    shapes.nodes.insert(shapes.nodes.end(), kept.begin(), kept.end());
    if (type == vtk_lagrange_wedge || type == vtk_bezier_wedge) {  // VTK has their base seen from inside
        Mesh::Index* const own = &shapes.nodes[shapes.nodes.size() - 6];
        std::swap(own[1], own[2]);
        std::swap(own[4], own[5]);
    }
    shapes.ends.push_back(static_cast<std::int64_t>(shapes.nodes.size()));
    return kept.size() == nodes.size();
}

}  // namespace barycert::mesh
