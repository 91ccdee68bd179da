#include "tests/mesh/locate/judge.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "barycert/oracle.hpp"

namespace barycert::testing {

Case case_of(const Mesh& mesh, Mesh::Index cell, const double* point) {
    Case c{.simplex = mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron};
    const auto d = static_cast<std::size_t>(mesh.dimension), first = static_cast<std::size_t>(cell) * (d + 1);
    for (std::size_t i = 0; i <= d; ++i) {
        for (std::size_t k = 0; k < d; ++k)
            c.vertices[d * i + k] = mesh.points[d * static_cast<std::size_t>(mesh.cells[first + i]) + k];
    }
    for (std::size_t k = 0; k < d; ++k) c.point[k] = point[k];
    return c;
}

PointJudge::PointJudge(const Mesh& mesh) : mesh_(mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    low_.assign(d * mesh.cell_count(), infinity);
    high_.assign(d * mesh.cell_count(), -infinity);
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        for (std::size_t k = 0; k < d; ++k) {
            const double x = mesh.points[d * static_cast<std::size_t>(mesh.cells[i]) + k];
            const std::size_t to = i / (d + 1) * d + k;
            low_[to] = std::min(low_[to], x);
            high_[to] = std::max(high_[to], x);
        }
    }
}

std::vector<Held> PointJudge::holders(const double* point) const {
    std::vector<Held> all;
    const auto d = static_cast<std::size_t>(mesh_.dimension);
    for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
        // A point beyond the box of a cell is beyond the cell: comparisons of doubles are exact.
        const double *const low = low_.data() + d * c, *const high = high_.data() + d * c;
        bool beyond = false;
        for (std::size_t k = 0; k < d; ++k) beyond |= point[k] < low[k] || point[k] > high[k];
        if (beyond) continue;
        const OracleAnswer a = ask_oracle(case_of(mesh_, static_cast<Mesh::Index>(c), point));
        if (a.region == Region::interior || a.region == Region::boundary)
            all.push_back({static_cast<Mesh::Index>(c), a.feature});
    }
    return all;
}

}  // namespace barycert::testing
