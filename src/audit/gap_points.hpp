/// Points on what cells share, and the cells around them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/lists.hpp"

namespace barycert::audit {

struct GapPoint {
    std::vector<Mesh::Index> nodes;  ///< of the face, edge or vertex
    std::array<double, 3> point{};
    std::vector<Mesh::Index> cells;  ///< all that have one of these nodes, ascending
};

class GapPoints {
public:
    explicit GapPoints(const Mesh& mesh);

    /// Point number `index` on a face (dimension 3 only; shared by two cells where the mesh has such), an edge or a
    /// vertex; every other one is then moved by 1 to 4 ulps along an axis.
    GapPoint make(Feature feature, std::uint64_t seed, std::uint64_t index) const;

    /// The cell with the point; nodal values are 0.
    Case case_of(Mesh::Index cell, const std::array<double, 3>& point) const;

private:
    const Mesh& mesh_;
    std::vector<Mesh::Index> neighbours_;
    base::Lists<Mesh::Index> cells_;  ///< of each node
};

}  // namespace barycert::audit
