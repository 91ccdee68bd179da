/// Orientations of cells, those without volume included.
#pragma once

#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"

namespace barycert::surface {

/// Of the cell with these corners: exact.
inline Sign orientation(const Mesh& mesh, const Mesh::Index* corners) {
    const auto at = [&](int i) {
        return mesh.points.data() + static_cast<std::size_t>(mesh.dimension) * static_cast<std::size_t>(corners[i]);
    };
    return mesh.dimension == 2 ? orient2d(at(0), at(1), at(2)) : orient3d(at(0), at(1), at(2), at(3));
}

/// Orientations that cells of zero volume take from their neighbours: cells on both sides of a facet see its corners
/// turn in opposite ways. It is made only where there are such cells, for it needs the neighbours of all.
class FlatCells {
public:
    explicit FlatCells(const Mesh& mesh);

    /// 1 or -1; 0 if a corner is there twice: then its facets come in equal pairs, turned in opposite ways, and the
    /// surface is whole without it. Cells of zero volume that are connected take the orientation of the first cell with
    /// volume that is met from the first of them that was asked for; if there is none, that one is taken for positive.
    int sign(Mesh::Index cell);

private:
    void settle(Mesh::Index cell);

    const Mesh& mesh_;
    std::vector<Mesh::Index> neighbours_;
    std::vector<std::int8_t> sign_;  ///< of each cell; `not_asked` at first
};

}  // namespace barycert::surface
