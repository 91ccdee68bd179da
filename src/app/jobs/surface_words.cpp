#include "app/jobs/surface_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"
#include "core/base/text.hpp"

namespace barycert::jobs {

InnerEdges::InnerEdges(const Surface& surface) : surface_(surface) {
    if (surface.facets.empty()) return;
    std::vector<Edge> all;
    for (std::size_t t = 0; t < surface.cell_count(); ++t) {
        const Mesh::Index* const n = &surface.cells[3 * t];
        const Mesh::Index facet = surface.facets[t];
        const bool alone = (t == 0 || surface.facets[t - 1] != facet) &&
                           (t + 1 == surface.cell_count() || surface.facets[t + 1] != facet);
        for (std::size_t i = 0; i < 3 && !alone; ++i)
            all.push_back({facet, std::min(n[i], n[(i + 1) % 3]), std::max(n[i], n[(i + 1) % 3])});
    }
    std::ranges::sort(all);
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i] == all[i - 1] && (edges_.empty() || edges_.back() != all[i])) edges_.push_back(all[i]);
    }
}

Feature InnerEdges::feature(const SurfaceNearest& nearest) const {
    if (nearest.cell < 0) return Feature::outside;
    const auto& n = nearest.nodes;
    if (n[2] >= 0) return Feature::face;
    if (n[1] < 0) return Feature::vertex;
    return std::ranges::binary_search(edges_, Edge{surface_.facet(nearest.cell), n[0], n[1]}) ? Feature::face
                                                                                              : Feature::edge;
}

void note_sides(const SideRules& sides, const Surface& surface, const std::string& path, Notes& notes) {
    if (sides.turned == Turned::open) {
        const std::string why =
            sides.open < 0 ? "it encloses nothing"
                           : fmt::format("its shell with {} {} is open, or meets itself",
                                         surface.facets.empty() ? "triangle" : "polygon", surface.facet(sides.open));
        notes.push_back(
            {Note::Kind::left_out, "the sign of distances: the surface has no inside, as " + why, path, true});
        return;
    }
    const auto tell = [&](std::uint64_t triangles, const char* text) {
        if (triangles != 0)
            notes.push_back({Note::Kind::guessed,
                             fmt::format("the inside of shells that are not turned alike ({}): {}",
                                         base::counted(triangles, "triangle"), text),
                             path, true});
    };
    tell(sides.by_regions, "the regions that they enclose");
    tell(sides.by_parity, "by parity, as they meet themselves");
    if (sides.idle != 0)
        notes.push_back({Note::Kind::left_out,
                         base::counted(sides.idle, "triangle encloses nothing, and does not say",
                                       "triangles enclose nothing, and do not say") +
                             " what is inside",
                         path, true});
}

}  // namespace barycert::jobs
