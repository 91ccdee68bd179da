#include "barycert/io/gmsh/msh_parts.hpp"

#include <algorithm>

namespace barycert::io {
namespace {

using F = ElementFamily;

// Numbers, orders and node counts of Gmsh's documentation ("MSH file format") and of GmshDefines.h. The serendipity
// types of higher order have fewer nodes than the complete ones of the same order.
constexpr std::array all{
    ElementType{1, F::line, 1, 2},           ElementType{2, F::triangle, 1, 3},
    ElementType{3, F::quadrangle, 1, 4},     ElementType{4, F::tetrahedron, 1, 4},
    ElementType{5, F::hexahedron, 1, 8},     ElementType{6, F::prism, 1, 6},
    ElementType{7, F::pyramid, 1, 5},        ElementType{8, F::line, 2, 3},
    ElementType{9, F::triangle, 2, 6},       ElementType{10, F::quadrangle, 2, 9},
    ElementType{11, F::tetrahedron, 2, 10},  ElementType{12, F::hexahedron, 2, 27},
    ElementType{13, F::prism, 2, 18},        ElementType{14, F::pyramid, 2, 14},
    ElementType{15, F::point, 1, 1},         ElementType{16, F::quadrangle, 2, 8},
    ElementType{17, F::hexahedron, 2, 20},   ElementType{18, F::prism, 2, 15},
    ElementType{19, F::pyramid, 2, 13},      ElementType{20, F::triangle, 3, 9},
    ElementType{21, F::triangle, 3, 10},     ElementType{22, F::triangle, 4, 12},
    ElementType{23, F::triangle, 4, 15},     ElementType{24, F::triangle, 5, 15},
    ElementType{25, F::triangle, 5, 21},     ElementType{26, F::line, 3, 4},
    ElementType{27, F::line, 4, 5},          ElementType{28, F::line, 5, 6},
    ElementType{29, F::tetrahedron, 3, 20},  ElementType{30, F::tetrahedron, 4, 35},
    ElementType{31, F::tetrahedron, 5, 56},  ElementType{36, F::quadrangle, 3, 16},
    ElementType{37, F::quadrangle, 4, 25},   ElementType{38, F::quadrangle, 5, 36},
    ElementType{42, F::triangle, 6, 28},     ElementType{43, F::triangle, 7, 36},
    ElementType{44, F::triangle, 8, 45},     ElementType{45, F::triangle, 9, 55},
    ElementType{46, F::triangle, 10, 66},    ElementType{47, F::quadrangle, 6, 49},
    ElementType{48, F::quadrangle, 7, 64},   ElementType{49, F::quadrangle, 8, 81},
    ElementType{50, F::quadrangle, 9, 100},  ElementType{51, F::quadrangle, 10, 121},
    ElementType{62, F::line, 6, 7},          ElementType{63, F::line, 7, 8},
    ElementType{64, F::line, 8, 9},          ElementType{65, F::line, 9, 10},
    ElementType{66, F::line, 10, 11},        ElementType{71, F::tetrahedron, 6, 84},
    ElementType{72, F::tetrahedron, 7, 120}, ElementType{73, F::tetrahedron, 8, 165},
    ElementType{74, F::tetrahedron, 9, 220}, ElementType{75, F::tetrahedron, 10, 286},
    ElementType{90, F::prism, 3, 40},        ElementType{91, F::prism, 4, 75},
    ElementType{92, F::hexahedron, 3, 64},   ElementType{93, F::hexahedron, 4, 125},
    ElementType{94, F::hexahedron, 5, 216},  ElementType{118, F::pyramid, 3, 30},
    ElementType{119, F::pyramid, 4, 55},
};

constexpr std::array<std::array<const char*, 2>, 8> names{{{"point", "points"},
                                                           {"line", "lines"},
                                                           {"triangle", "triangles"},
                                                           {"quadrangle", "quadrangles"},
                                                           {"tetrahedron", "tetrahedra"},
                                                           {"hexahedron", "hexahedra"},
                                                           {"prism", "prisms"},
                                                           {"pyramid", "pyramids"}}};

}  // namespace

int ElementType::dimension() const {
    return family == F::point ? 0 : family == F::line ? 1 : family <= F::quadrangle ? 2 : 3;
}

std::string ElementType::counted(std::size_t count) const {
    std::string text = std::to_string(count) + " " + names[static_cast<std::size_t>(family)][count == 1 ? 0 : 1];
    if (order > 1) text += " of order " + std::to_string(order);
    return text;
}

const ElementType* element_type(std::int64_t number) {
    const auto* const found = std::lower_bound(all.begin(), all.end(), number,
                                               [](const ElementType& type, std::int64_t n) { return type.number < n; });
    return found == all.end() || found->number != number ? nullptr : found;
}

std::span<const ElementType> element_types() {
    return all;
}

std::string counted_types(const TypeCounts& counts, int low, int high) {
    std::string text;
    for (const ElementType& type : all) {
        const std::size_t count = counts[static_cast<std::size_t>(type.number)];
        if (count == 0 || type.dimension() < low || type.dimension() > high) continue;
        text += (text.empty() ? "" : ", ") + type.counted(count);
    }
    return text;
}

}  // namespace barycert::io
