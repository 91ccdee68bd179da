#include "audit/gap_points.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "audit/recipes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/ulp.hpp"
#include "mesh/adjacency.hpp"

namespace barycert::audit {

GapPoints::GapPoints(const Mesh& mesh)
    : mesh_(mesh), neighbours_(mesh::compute_neighbours(mesh)), cells_(mesh.point_count(), [&](const auto& add) {
          for (std::size_t k = 0; k < mesh.cells.size(); ++k)
              add(static_cast<std::size_t>(mesh.cells[k]), static_cast<Mesh::Index>(k / mesh.corners()));
      }) {}

Case GapPoints::case_of(Mesh::Index cell, const std::array<double, 3>& point) const {
    Case c{.simplex = mesh_.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron, .point = point};
    double* to = c.vertices.data();
    for (const Mesh::Index node : mesh_.corners_of(static_cast<std::size_t>(cell)))
        to = std::copy_n(mesh_.point(node), mesh_.dimension, to);
    return c;
}

GapPoint GapPoints::make(Feature feature, std::uint64_t seed, std::uint64_t index) const {
    base::Random random = base::Random::stream(seed, base::hash64("gaps") + static_cast<std::uint64_t>(feature), index);
    const auto corners = mesh_.corners();
    const std::size_t used = feature == Feature::face ? 3 : feature == Feature::edge ? 2 : 1;
    std::size_t cell = 0;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    // A facet at the hull has one cell: draw again, but not for ever.
    for (int attempt = 0; attempt < 16; ++attempt) {
        cell = random.below(mesh_.cell_count());
        for (std::size_t i = corners - 1; i > 0; --i) std::swap(order[random.below(i + 1)], order[i]);
        if (used + 1 != corners || neighbours_[cell * corners + order[corners - 1]] >= 0) break;
    }
    GapPoint p;
    Case c = case_of(static_cast<Mesh::Index>(cell), {});
    const Case whole = c;
    for (std::size_t i = 0; i < used; ++i) {
        p.nodes.push_back(mesh_.cells[cell * corners + order[i]]);
        set_vertex(c, static_cast<int>(i), vertex_at(whole, static_cast<int>(order[i])));
    }
    p.point = random_point(c, random, static_cast<int>(used));
    if (random.coin()) {
        const auto axis = random.below(static_cast<std::uint64_t>(mesh_.dimension));
        const int ulps = random.integer(1, 4);
        const bool up = random.coin();
        for (int i = 0; i < ulps; ++i) {
            // A coordinate of zero moves by an ulp of the largest, in a direction of its own.
            if (p.point[axis] == 0) {
                move_by_ulp(whole, p.point[axis], static_cast<int>(axis), random);
            } else {
                p.point[axis] = up ? base::next_up(p.point[axis]) : base::next_down(p.point[axis]);
            }
        }
    }
    keep_finite(p.point);
    for (const Mesh::Index node : p.nodes) {
        const std::span<const Mesh::Index> cells = cells_[static_cast<std::size_t>(node)];
        p.cells.insert(p.cells.end(), cells.begin(), cells.end());
    }
    std::ranges::sort(p.cells);
    p.cells.erase(std::unique(p.cells.begin(), p.cells.end()), p.cells.end());
    return p;
}

}  // namespace barycert::audit
