/// Internal: the cells of a mesh in the order of a space-filling curve, ready to be walked through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/core/simplex.hpp"
#include "barycert/locate/bins.hpp"
#include "barycert/locate/buffer.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert::detail {

/// A cell or node as it is numbered here: what lies near in space mostly has near numbers, so that points in the same
/// order find what they need in cache.
using Place = std::int32_t;

/// What a step of a walk reads of a cell: half of a cache line. In 2D the last corner repeats the first one.
struct alignas(32) CellRecord {
    std::array<Place, 4> node;
    std::array<Place, 4> next;  ///< the cell across the facet opposite to each corner, -1 where there is none
};

/// One aligned load: coordinates (2D: z = 0), and room for a value.
struct alignas(32) NodeRecord {
    std::array<double, 3> at;
    double value;
};

struct CellIndex {
    Simplex simplex = Simplex::tetrahedron;
    std::array<double, 3> low{}, high{};  ///< the box of all cells, exactly
    Bins bins;
    Buffer<CellRecord> cells;
    Buffer<Mesh::Index> original;  ///< cell of the mesh by place
    Buffer<NodeRecord> nodes;
    std::vector<Mesh::Index> original_node;  ///< node of the mesh by place; those of no cell have none
    std::vector<Place> first;                ///< by bin: the first cell there or later; one more at the end
    bool linked = false;                     ///< `next` is set

    std::size_t dimension() const { return static_cast<std::size_t>(space_dimension(simplex)); }
    std::size_t corners() const { return dimension() + 1; }
    std::size_t cell_count() const { return cells.size(); }
    std::size_t bytes() const;

    bool box_holds(const double* p) const {
        for (std::size_t k = 0; k < dimension(); ++k) {
            if (!(low[k] <= p[k] && p[k] <= high[k])) return false;
        }
        return true;
    }
};

/// The vertices of a cell, vertex after vertex (see Case).
std::array<double, 12> vertices_of(const CellIndex& index, Place cell);

/// `link`: find the neighbours, which is right where no facet has more than two cells. Precondition: the mesh is
/// consistent. Time O(cells).
CellIndex make_cell_index(const Mesh& mesh, bool link);

}  // namespace barycert::detail
