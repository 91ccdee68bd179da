/// Which cells hold a point? By asking the oracle about each of them: the slow twin of Locator, which shares nothing
/// with core or locate.
#pragma once

#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert::testing {

struct Held {
    Mesh::Index cell = -1;
    Feature feature = Feature::outside;

    friend bool operator==(const Held&, const Held&) = default;
};

/// The cell with a point, as a case for the oracle; nodal values are zero.
Case case_of(const Mesh& mesh, Mesh::Index cell, const double* point);

/// The mesh must outlive it, and be consistent.
class PointJudge {
public:
    explicit PointJudge(const Mesh& mesh);

    /// Every cell that holds the point, ascending.
    std::vector<Held> holders(const double* point) const;

    const Mesh& mesh() const { return mesh_; }

private:
    const Mesh& mesh_;
    std::vector<double> low_, high_;  ///< boxes of cells: d of each
};

}  // namespace barycert::testing
