/// Gmsh's types of elements.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace barycert::io {

enum class ElementFamily : std::uint8_t { point, line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid };

struct ElementType {
    int number;  ///< Gmsh's
    ElementFamily family;
    int order;
    std::size_t nodes;

    int dimension() const;
    /// "tetrahedra of order 3"; with a count of one, "tetrahedron of order 3".
    std::string counted(std::size_t count) const;
};

/// nullptr if the type is not known.
const ElementType* element_type(std::int64_t number);

/// All types that are known, by number.
std::span<const ElementType> element_types();

inline constexpr std::int64_t max_element_type = 140;

/// How many elements there are of each type.
using TypeCounts = std::array<std::size_t, max_element_type + 1>;

/// "8 points, 120 lines": of types whose dimension is at least `low` and at most `high`.
std::string counted_types(const TypeCounts& counts, int low, int high);

}  // namespace barycert::io
