#include "barycert/io/medit/medit_file.hpp"

#include <array>

namespace barycert::io {
namespace {

using K = MeditKeyword;
using enum MeditKind;

// Codes of libMeshb's documentation. What is not named here is left out in any case. Some programs write Hexaedra.
constexpr std::array all{
    K{3, "Dimension", other, 0, 0},
    K{4, "Vertices", vertices, 0, 0},
    K{5, "Edges", cells, 1, 2},
    K{6, "Triangles", cells, 2, 3},
    K{7, "Quadrilaterals", cells, 2, 4},
    K{8, "Tetrahedra", cells, 3, 4},
    K{9, "Prisms", cells, 3, 6},
    K{9, "Wedges", cells, 3, 6},
    K{10, "Hexahedra", cells, 3, 8},
    K{10, "Hexaedra", cells, 3, 8},
    K{13, "Corners", other, 0, 0},
    K{14, "Ridges", other, 0, 0},
    K{15, "RequiredVertices", other, 0, 0},
    K{16, "RequiredEdges", other, 0, 0},
    K{17, "RequiredTriangles", other, 0, 0},
    K{18, "RequiredQuadrilaterals", other, 0, 0},
    K{20, "NormalAtVertices", other, 0, 0},
    K{24, "TrianglesP2", cells, 2, 6},
    K{25, "EdgesP2", cells, 1, 3},
    K{27, "QuadrilateralsQ2", cells, 2, 9},
    K{30, "TetrahedraP2", cells, 3, 10},
    K{33, "HexahedraQ2", cells, 3, 27},
    K{34, "ExtraVerticesAtEdges", other, 0, 0},
    K{35, "ExtraVerticesAtTriangles", other, 0, 0},
    K{37, "ExtraVerticesAtTetrahedra", other, 0, 0},
    K{49, "Pyramids", cells, 3, 5},
    K{59, "Tangents", other, 0, 0},
    K{60, "Normals", other, 0, 0},
    K{61, "TangentAtVertices", other, 0, 0},
    K{62, "SolAtVertices", solution, 0, 0},
    K{63, "SolAtEdges", other, 0, 0},
    K{64, "SolAtTriangles", solution, 2, 0},
    K{65, "SolAtQuadrilaterals", other, 0, 0},
    K{66, "SolAtTetrahedra", solution, 3, 0},
    K{67, "SolAtPrisms", other, 0, 0},
    K{68, "SolAtHexahedra", other, 0, 0},
    K{77, "Iterations", other, 0, 0},
    K{78, "Time", other, 0, 0},
    K{86, "PrismsP2", cells, 3, 18},
    K{87, "PyramidsP2", cells, 3, 14},
    K{88, "QuadrilateralsQ3", cells, 2, 16},
    K{89, "QuadrilateralsQ4", cells, 2, 25},
    K{90, "TrianglesP3", cells, 2, 10},
    K{91, "TrianglesP4", cells, 2, 15},
    K{92, "EdgesP3", cells, 1, 4},
    K{93, "EdgesP4", cells, 1, 5},
    K{96, "TetrahedraP3", cells, 3, 20},
    K{97, "TetrahedraP4", cells, 3, 35},
    K{98, "HexahedraQ3", cells, 3, 64},
    K{99, "HexahedraQ4", cells, 3, 125},
    K{100, "PyramidsP3", cells, 3, 30},
    K{101, "PyramidsP4", cells, 3, 55},
    K{102, "PrismsP3", cells, 3, 40},
    K{103, "PrismsP4", cells, 3, 75},
};

}  // namespace

const MeditKeyword* medit_keyword(std::string_view name) {
    for (const K& k : all) {
        if (same_word(k.name, name)) return &k;
    }
    return nullptr;
}

const MeditKeyword* medit_keyword(std::int64_t code) {
    for (const K& k : all) {
        if (k.code == code) return &k;
    }
    return nullptr;
}

}  // namespace barycert::io
