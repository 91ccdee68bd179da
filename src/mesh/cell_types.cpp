#include "mesh/cell_types.hpp"

#include <sstream>

namespace barycert::mesh {

const std::array<CellType, 256>& cell_types() {
    /// Numbers and names in vtkCellType.h, by the type of their corners; a number behind a name: of nodes.
    struct Known {
        CellKind kind;
        std::uint8_t linear;
        std::string_view text;
    };
    constexpr std::array<Known, 17> known{
        {{CellKind::tetrahedron, vtk_tetra, "10 Tetra 4 24 QuadraticTetra 10"},
         {CellKind::triangle, vtk_triangle, "5 Triangle 3 22 QuadraticTriangle 6"},
         {CellKind::lower, 0,
          "0 EmptyCell 0 1 Vertex 0 2 PolyVertex 0 3 Line 0 4 PolyLine 0 21 QuadraticEdge 0 35 CubicLine 0 "
          "68 LagrangeCurve 0"},
         {CellKind::surface, vtk_triangle_strip, "6 TriangleStrip 0"},
         {CellKind::surface, vtk_polygon, "7 Polygon 0 36 QuadraticPolygon 0"},
         {CellKind::surface, 8, "8 Pixel 4"},
         {CellKind::surface, vtk_quad,
          "9 Quad 4 23 QuadraticQuad 8 28 BiQuadraticQuad 9 30 QuadraticLinearQuad 6 62 HigherOrderQuad 0 "
          "70 LagrangeQuadrilateral 0 77 BezierQuadrilateral 0"},
         {CellKind::surface, vtk_triangle,
          "34 BiQuadraticTriangle 7 61 HigherOrderTriangle 0 69 LagrangeTriangle 0 76 BezierTriangle 0"},
         {CellKind::solid, vtk_tetra, "64 HigherOrderTetrahedron 0 71 LagrangeTetra 0 78 BezierTetra 0"},
         {CellKind::solid, 11, "11 Voxel 8"},
         {CellKind::solid, 12,
          "12 Hexahedron 8 25 QuadraticHexahedron 20 29 TriQuadraticHexahedron 27 "
          "33 BiQuadraticQuadraticHexahedron 24 72 LagrangeHexahedron 0 79 BezierHexahedron 0"},
         {CellKind::solid, 13,
          "13 Wedge 6 26 QuadraticWedge 15 31 QuadraticLinearWedge 12 32 BiQuadraticQuadraticWedge 18 "
          "73 LagrangeWedge 0 80 BezierWedge 0"},
         {CellKind::solid, 14, "14 Pyramid 5 27 QuadraticPyramid 13 37 TriQuadraticPyramid 19 74 LagrangePyramid 0"},
         {CellKind::solid, 15, "15 PentagonalPrism 10"},
         {CellKind::solid, 16, "16 HexagonalPrism 12"},
         {CellKind::solid, vtk_polyhedron, "42 Polyhedron 0"},
         {CellKind::other, 0,
          "41 ConvexPointSet 0 51 ParametricCurve 0 52 ParametricSurface 0 53 ParametricTriSurface 0 "
          "54 ParametricQuadSurface 0 55 ParametricTetraRegion 0 56 ParametricHexRegion 0 60 HigherOrderEdge 0 "
          "63 HigherOrderPolygon 0 75 BezierCurve 0"}}};
    static const std::array<CellType, 256> types = [&] {
        std::array<CellType, 256> all{};
        for (std::size_t type = 0; type < all.size(); ++type) all[type].name = "unknown type " + std::to_string(type);
        for (auto [kind, linear, text] : known) {
            std::istringstream words{std::string(text)};
            std::size_t number = 0;
            CellType type{kind, linear, 0, {}};
            while (words >> number >> type.name >> type.nodes) {
                type.name = "vtk" + type.name;
                all[number] = type;
            }
        }
        return all;
    }();
    return types;
}

std::span<const Mesh::Index> corners_of(const CellType& type, std::span<const Mesh::Index> nodes) {
    const std::size_t fixed = shape_of(type.linear).corners;
    return nodes.first(fixed != 0 ? fixed : type.name == "vtkQuadraticPolygon" ? nodes.size() / 2 : nodes.size());
}

void add_rings(const CellType& type, std::span<const Mesh::Index> nodes, std::vector<std::vector<Mesh::Index>>& rings) {
    const auto c = corners_of(type, nodes);
    if (type.linear == vtk_triangle_strip) {
        for (std::size_t i = 0; i + 2 < c.size(); ++i) rings.push_back({c[i + i % 2], c[i + 1 - i % 2], c[i + 2]});
        return;
    }
    rings.emplace_back(c.begin(), c.end());
    if (type.linear == 8) std::swap(rings.back()[2], rings.back()[3]);
}

bool add_shape(Mesh& mesh, std::uint8_t type, std::span<const Mesh::Index> nodes) {
    const bool whole = is_curved_simplex(type) && simplex_order(mesh.dimension, nodes.size()) != 0;
    const std::span kept = whole ? nodes : corners_of(cell_types()[type], nodes);
    Mesh::Shapes& shapes = mesh.shapes;
    shapes.types.push_back(whole ? type : cell_types()[type].linear);
    shapes.nodes.insert(shapes.nodes.end(), kept.begin(), kept.end());
    if (type == 73 || type == 80) {  // VTK's wedges of Lagrange and Bezier have their base seen from inside
        Mesh::Index* const own = &shapes.nodes[shapes.nodes.size() - 6];
        std::swap(own[1], own[2]);
        std::swap(own[4], own[5]);
    }
    shapes.ends.push_back(static_cast<std::int64_t>(shapes.nodes.size()));
    return kept.size() == nodes.size();
}

}  // namespace barycert::mesh
