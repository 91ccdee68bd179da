#include "mesh/index/warped_sides.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/lists.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;
using Ring = std::array<Index, 4>;

/// use(nodes of a side, its bit) for each side of four nodes.
template <class Use>
void for_quadrilaterals(const Mesh& mesh, std::size_t whole, const Use& use) {
    const std::span<const Index> nodes = mesh.shapes.nodes_of(whole);
    unsigned bit = 1;
    for (const std::vector<Index>& places : rings_of(mesh.shapes.types[whole])) {
        if (places.size() != 4) continue;
        Ring ring{};
        for (std::size_t i = 0; i < 4; ++i) ring[i] = nodes[static_cast<std::size_t>(places[i])];
        use(ring, bit);
        bit <<= 1U;
    }
}

/// From the lowest node towards the lower one beside it: the same from both sides.
Ring in_order(const Ring& ring) {
    const auto low = static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin());
    const std::size_t step = ring[(low + 1) % 4] < ring[(low + 3) % 4] ? 1 : 3;
    return {ring[low], ring[(low + step) % 4], ring[(low + 2) % 4], ring[(low + 3 * step) % 4]};
}

using SideTriangle = std::array<Index, 3>;
struct HashOfSideTriangle {
    std::size_t operator()(const SideTriangle& t) const {
        std::uint64_t hash = 0;
        for (const Index node : t) {
            hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 29U;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// Sides that no other cell has as they are: those of the boundary, and split ones.
class LoneSides {
public:
    LoneSides(const Mesh& mesh, std::vector<SplitSide> sides) : mesh_(mesh), sides_(std::move(sides)) {
        used_.assign(mesh.point_count(), 0);
        for (std::size_t side = 0; side < sides_.size(); ++side) {
            const Ring& ring = sides_[side].ring;
            for (std::size_t i = 0; i < 4; ++i) {
                used_[static_cast<std::size_t>(ring[i])] = 1;
                SideTriangle triangle{ring[i], ring[(i + 1) % 4], ring[(i + 2) % 4]};
                std::ranges::sort(triangle);
                by_triangle_.emplace(triangle, side);
            }
        }
    }

    /// Sides with a triangle of their nodes, along either diagonal, that is a facet of a part of another cell.
    std::vector<SplitSide> split() {
        const std::vector<Index> wholes = whole_of_parts(mesh_);
        base::parallel_for_each(mesh_.cell_count(), 4096, [&](std::size_t cell) {
            const std::span<const Index> corners = mesh_.corners_of(cell);
            for (std::size_t left_out = 0; left_out < corners.size(); ++left_out) {
                SideTriangle facet{};
                std::size_t count = 0;
                for (std::size_t i = 0; i < corners.size(); ++i) {
                    if (i != left_out && used_[static_cast<std::size_t>(corners[i])] != 0) facet[count++] = corners[i];
                }
                if (count == 3) look_at(facet, wholes[cell]);
            }
        });
        std::erase_if(sides_, [](const SplitSide& side) { return side.beyond < 0; });
        return std::move(sides_);
    }

private:
    void look_at(SideTriangle facet, Index whole) {
        std::ranges::sort(facet);
        const auto [begin, end] = by_triangle_.equal_range(facet);
        for (auto at = begin; at != end; ++at) {
            SplitSide& side = sides_[at->second];
            if (side.whole == whole) continue;
            std::atomic_ref<Index> beyond(side.beyond);
            for (Index now = beyond; (now < 0 || whole < now) && !beyond.compare_exchange_weak(now, whole);) {
            }
        }
    }

    const Mesh& mesh_;
    std::vector<SplitSide> sides_;
    std::vector<std::uint8_t> used_;  ///< nodes of such sides
    std::unordered_multimap<SideTriangle, std::size_t, HashOfSideTriangle> by_triangle_;
};

}  // namespace

std::vector<std::uint8_t> warped_sides(const Mesh& mesh, std::span<const std::uint8_t> has_map) {
    std::vector<std::uint8_t> warped(mesh.shapes.count(), 0);
    if (mesh.dimension == 2) return warped;
    base::parallel_for_each(warped.size(), 1024, [&](std::size_t whole) {
        if (has_map[whole] == 0) return;
        for_quadrilaterals(mesh, whole, [&](const Ring& ring, unsigned bit) {
            const bool flat = orient3d(mesh.point(ring[0]), mesh.point(ring[1]), mesh.point(ring[2]),
                                       mesh.point(ring[3])) == Sign::zero;
            if (!flat) warped[whole] = static_cast<std::uint8_t>(warped[whole] | bit);
        });
    });
    return warped;
}

SidesOfCells compare_sides(const Mesh& mesh, std::span<const std::uint8_t> warped) {
    std::vector<SplitSide> all;
    for (std::size_t whole = 0; whole < warped.size(); ++whole) {
        if (warped[whole] == 0) continue;
        for_quadrilaterals(mesh, whole, [&](const Ring& ring, unsigned bit) {
            if ((warped[whole] & bit) != 0) all.push_back({static_cast<Index>(whole), -1, in_order(ring)});
        });
    }
    const base::Lists<std::uint32_t> at_nodes(mesh.point_count(), [&](const auto& add) {
        for (std::size_t i = 0; i < all.size(); ++i)
            add(static_cast<std::size_t>(all[i].ring[0]), static_cast<std::uint32_t>(i));
    });
    SidesOfCells sides;
    std::vector<SplitSide> lone;
    for (const SplitSide& side : all) {
        std::size_t alike = 0;
        bool first = true;
        for (const std::uint32_t i : at_nodes[static_cast<std::size_t>(side.ring[0])]) {
            if (all[i].ring != side.ring) continue;
            first = first && &all[i] >= &side;
            ++alike;
        }
        sides.warped += first ? 1 : 0;
        if (alike == 1) lone.push_back(side);
    }
    if (!lone.empty()) sides.split = LoneSides(mesh, std::move(lone)).split();
    return sides;
}

}  // namespace barycert::mesh
