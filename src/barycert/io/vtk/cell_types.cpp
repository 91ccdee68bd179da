#include "barycert/io/vtk/cell_types.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace barycert::io {

std::string vtk_class_name(std::uint8_t type) {
    static constexpr std::array<std::pair<std::uint8_t, std::string_view>, 60> names{{
        {0, "EmptyCell"},
        {1, "Vertex"},
        {2, "PolyVertex"},
        {3, "Line"},
        {4, "PolyLine"},
        {5, "Triangle"},
        {6, "TriangleStrip"},
        {7, "Polygon"},
        {8, "Pixel"},
        {9, "Quad"},
        {10, "Tetra"},
        {11, "Voxel"},
        {12, "Hexahedron"},
        {13, "Wedge"},
        {14, "Pyramid"},
        {15, "PentagonalPrism"},
        {16, "HexagonalPrism"},
        {21, "QuadraticEdge"},
        {22, "QuadraticTriangle"},
        {23, "QuadraticQuad"},
        {24, "QuadraticTetra"},
        {25, "QuadraticHexahedron"},
        {26, "QuadraticWedge"},
        {27, "QuadraticPyramid"},
        {28, "BiQuadraticQuad"},
        {29, "TriQuadraticHexahedron"},
        {30, "QuadraticLinearQuad"},
        {31, "QuadraticLinearWedge"},
        {32, "BiQuadraticQuadraticWedge"},
        {33, "BiQuadraticQuadraticHexahedron"},
        {34, "BiQuadraticTriangle"},
        {35, "CubicLine"},
        {36, "QuadraticPolygon"},
        {37, "TriQuadraticPyramid"},
        {41, "ConvexPointSet"},
        {42, "Polyhedron"},
        {51, "ParametricCurve"},
        {52, "ParametricSurface"},
        {53, "ParametricTriSurface"},
        {54, "ParametricQuadSurface"},
        {55, "ParametricTetraRegion"},
        {56, "ParametricHexRegion"},
        {60, "HigherOrderEdge"},
        {61, "HigherOrderTriangle"},
        {62, "HigherOrderQuad"},
        {63, "HigherOrderPolygon"},
        {64, "HigherOrderTetrahedron"},
        {68, "LagrangeCurve"},
        {69, "LagrangeTriangle"},
        {70, "LagrangeQuadrilateral"},
        {71, "LagrangeTetra"},
        {72, "LagrangeHexahedron"},
        {73, "LagrangeWedge"},
        {74, "LagrangePyramid"},
        {75, "BezierCurve"},
        {76, "BezierTriangle"},
        {77, "BezierQuadrilateral"},
        {78, "BezierTetra"},
        {79, "BezierHexahedron"},
        {80, "BezierWedge"},
    }};
    for (const auto& [number, name] : names) {
        if (number == type) return "vtk" + std::string(name);
    }
    return "unknown type " + std::to_string(type);
}

}  // namespace barycert::io
