#include "barycert/io/medit/medit_file.hpp"

#include <strings.h>

#include <algorithm>
#include <array>

namespace barycert::io {
namespace {

using K = MeditKeyword;
constexpr MeditKind cells = MeditKind::cells, solution = MeditKind::solution;

// Codes of libMeshb's documentation. What is not named here is left out in any case.
constexpr std::array all{
    K{3, "Dimension"},
    K{4, "Vertices", MeditKind::vertices},
    K{5, "Edges", cells, 1, 2},
    K{6, "Triangles", cells, 2, 3},
    K{7, "Quadrilaterals", cells, 2, 4},
    K{8, "Tetrahedra", cells, 3, 4},
    K{9, "Prisms", cells, 3, 6},
    K{9, "Wedges", cells, 3, 6},
    K{10, "Hexahedra", cells, 3, 8},
    K{10, "Hexaedra", cells, 3, 8},  // as some programs spell it
    K{13, "Corners"},
    K{14, "Ridges"},
    K{15, "RequiredVertices"},
    K{16, "RequiredEdges"},
    K{17, "RequiredTriangles"},
    K{18, "RequiredQuadrilaterals"},
    K{20, "NormalAtVertices"},
    K{24, "TrianglesP2", cells, 2, 6},
    K{25, "EdgesP2", cells, 1, 3},
    K{27, "QuadrilateralsQ2", cells, 2, 9},
    K{30, "TetrahedraP2", cells, 3, 10},
    K{33, "HexahedraQ2", cells, 3, 27},
    K{34, "ExtraVerticesAtEdges"},
    K{35, "ExtraVerticesAtTriangles"},
    K{37, "ExtraVerticesAtTetrahedra"},
    K{49, "Pyramids", cells, 3, 5},
    K{59, "Tangents"},
    K{60, "Normals"},
    K{61, "TangentAtVertices"},
    K{62, "SolAtVertices", solution, 0},
    K{63, "SolAtEdges"},
    K{64, "SolAtTriangles", solution, 2},
    K{65, "SolAtQuadrilaterals"},
    K{66, "SolAtTetrahedra", solution, 3},
    K{67, "SolAtPrisms"},
    K{68, "SolAtHexahedra"},
    K{77, "Iterations"},
    K{78, "Time"},
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

template <class IsOne>
const MeditKeyword* find(IsOne is_one) {
    const auto* const found = std::find_if(all.begin(), all.end(), is_one);
    return found == all.end() ? nullptr : found;
}

}  // namespace

const MeditKeyword* medit_keyword(std::string_view name) {
    return find([&](const K& k) {
        return k.name.size() == name.size() && strncasecmp(k.name.data(), name.data(), name.size()) == 0;
    });
}

const MeditKeyword* medit_keyword(std::int64_t code) {
    return find([&](const K& k) { return k.code == code; });
}

}  // namespace barycert::io
