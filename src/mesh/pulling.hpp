/// Cells of other shapes cut into simplices, without new nodes.
///
/// A face of a cell, or a polygon, is cut into triangles by a rule that depends on its nodes alone (face_cut.hpp); a
/// solid from its node of lowest number that sees all triangles of its faces, and where there is none by a search
/// (solid_cut.hpp). So both cells at a face cut it alike, all nodes of a cell are used, and its parts fill it, concave
/// or not; of a convex one they are those at its node of lowest number ("pulling"). A cell that cannot be cut, because
/// its faces are no simple polygons or because no tetrahedra between its own nodes are found, owns nothing, and is
/// told.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert::mesh {

/// Makes cells of mesh.shapes, which has all but `parts` and `inside`. A cell that is flat, or cannot be cut,
/// has one part, a degenerate one. `otherwise`, if given, gets the number of cells that are cut, but not at the lowest
/// node of the cell and of each face. `numbers`: for each node, the number that orders nodes; empty: its index.
/// Returns the first polyhedron whose faces do not close, if there is one: two faces must share each edge.
/// Requires: nodes in range, as many as the types have.
std::optional<std::size_t> pull(Mesh& mesh, std::span<const Mesh::Index> numbers = {},
                                std::size_t* otherwise = nullptr);

/// The same; cell numbers, fields and labels have a row for each shape before, for each cell then.
std::optional<std::size_t> cut_into_simplices(Mesh& mesh, std::span<const Mesh::Index> numbers = {},
                                              std::size_t* otherwise = nullptr);

/// In Shapes::inside, the part that stands for a cell that cannot be cut: it is degenerate, so no point lies in it.
inline constexpr std::uint16_t uncut_part = 0xffff;

/// Returns those parts; ascending.
std::vector<Mesh::Index> uncut_parts(const Mesh& mesh);

/// Which cells cannot be cut, in words; empty if all can.
std::string told_uncut(const Mesh& mesh);

/// The shape that each cell is a part of; empty without shapes.
std::vector<Mesh::Index> whole_of_parts(const Mesh& mesh);

/// Cell fields and labels of a mesh with shapes, a row for each of these; nothing else.
Mesh rows_of_wholes(const Mesh& mesh);

/// Bits of Shapes::inside. In space: bit k, the facet opposite to corner k lies inside the cell; from bit 4 on two bits
/// an edge, in the order 01 02 03 12 13 23: 0 an edge of the cell, 1 on a face, 2 inside. In the plane: bit k, the edge
/// opposite to corner k lies inside.
///
/// The feature of the whole cell on which a point of a part lies, by the corners with weight zero: not all of them.
inline Feature feature_of_whole(std::uint16_t inside, unsigned zeros, int dimension) {
    const int count = std::popcount(zeros);
    if (count == dimension) return Feature::vertex;
    if (count == 0) return Feature::interior;
    if (count == 1) return (inside & zeros) != 0 ? Feature::interior : dimension == 3 ? Feature::face : Feature::edge;
    constexpr std::array<unsigned, 6> others{0b1100, 0b1010, 0b0110, 0b1001, 0b0101, 0b0011};
    unsigned edge = 0;
    while (others[edge] != zeros) ++edge;
    constexpr std::array kinds{Feature::edge, Feature::face, Feature::interior, Feature::interior};
    return kinds[inside >> (4 + 2 * edge) & 3U];
}

}  // namespace barycert::mesh
