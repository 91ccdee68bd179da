/// Which cells share a facet: edges between triangles, faces between tetrahedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// The cell across the facet opposite to each corner, dimension + 1 a cell; -1 where there is none. Facets are the same
/// if they have the same nodes; positions do not matter. Where more than two cells hold a facet, the two lowest are
/// neighbours and the others have none. Requires: the indices of the cells are in range. Time and memory O(cells +
/// nodes) where the number of cells at a node is bounded; on all threads of the calling arena.
std::vector<Mesh::Index> compute_neighbours(const Mesh& mesh);

/// The facets without a neighbour, each as cell * (dimension + 1) + corner, ascending. `neighbours` as above.
std::vector<std::int64_t> hull_facets(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours);

/// The corners of the facet opposite to a corner of a positive cell, normals outward (2D: two, the cell to their left).
inline std::array<std::size_t, 3> outward_corners(int dimension, std::size_t corner) {
    constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    return dimension == 3 ? faces[corner] : std::array{(corner + 1) % 3, (corner + 2) % 3, std::size_t{0}};
}

/// A facet of a cell without its lowest node, by which facets are gathered; in 2D that stands for the middle one.
struct CellFacet {
    Mesh::Index middle = 0;
    Mesh::Index highest = 0;
    Mesh::Index cell = 0;
    std::int32_t corner = 0;  ///< opposite to the facet

    std::uint64_t key() const {  // indices are not negative
        return static_cast<std::uint64_t>(middle) << 32 | static_cast<std::uint64_t>(highest);
    }
};

/// Time and memory O(cells + nodes) where cells at a node are bounded; on all threads, whose number does not show.
class FacetTable {
public:
    /// Makes the table of the cells for which use[cell] is not 0; of all cells if `use` is empty. Requires: their
    /// indices are in range.
    explicit FacetTable(const Mesh& mesh, std::span<const std::uint8_t> use = {});

    std::size_t node_count() const { return begin_.size() - 1; }

    /// group(facets) for each set of equal ones whose lowest node is in [first, last), by cell, then corner.
    template <class F>
    void for_each_group(std::size_t first, std::size_t last, F&& group) const {
        for (std::size_t node = first; node < last; ++node) {
            const CellFacet* const end = facets_.data() + begin_[node + 1];
            for (const CellFacet* f = facets_.data() + begin_[node]; f != end;) {
                const CellFacet* next = f + 1;
                while (next != end && next->key() == f->key()) ++next;
                group(std::span<const CellFacet>(f, next));
                f = next;
            }
        }
    }

private:
    std::vector<std::size_t> begin_;  ///< of the list of each lowest node, and the end of all
    std::vector<CellFacet> facets_;
};

/// Makes the cells of the two lowest of equal facets neighbours. Requires: one entry a corner of a cell.
void pair_facets(std::span<const CellFacet> equal, std::size_t corners, std::vector<Mesh::Index>& neighbours);

}  // namespace barycert::mesh
