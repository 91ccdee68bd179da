/// Polyhedra on the grid: cells of octrees beside refined ones, and unions of cubes.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::test {

/// Faces by the places of their nodes, seen from outside.
struct PlacedRings {
    std::vector<std::array<int, 3>> places;
    std::vector<std::vector<Mesh::Index>> rings;

    Mesh::Index node(const std::array<int, 3>& place) {
        const auto at = std::ranges::find(places, place);
        if (at == places.end()) places.push_back(place);
        return static_cast<Mesh::Index>(std::ranges::find(places, place) - places.begin());
    }
};

/// A cube of side 2. A bit for each of its sides, those at low x, high x, low y, ...: it is four squares, as that of a
/// neighbour that is refined. `edges`: a bit for each edge with a node in the middle, though both sides there are
/// whole.
inline PlacedRings octree_cell(unsigned sides, unsigned edges = 0) {
    using Place = std::array<int, 3>;
    PlacedRings cell;
    std::map<Place, bool> middles;
    const auto on_side = [](std::size_t side, int u, int v) {
        const std::size_t axis = side / 2;
        Place p{};
        p[axis] = side % 2 == 0 ? 0 : 2;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
    };
    const auto add = [&](std::size_t side, std::vector<Place> ring) {
        if (side % 2 == 0) std::ranges::reverse(ring);
        auto& own = cell.rings.emplace_back();
        for (const Place& p : ring) own.push_back(cell.node(p));
    };
    for (std::size_t side = 0; side < 6; ++side) {
        for (const auto& [u, v] : {std::pair(1, 0), {2, 1}, {1, 2}, {0, 1}}) {
            if ((sides >> side & 1U) != 0) middles[on_side(side, u, v)] = true;
        }
    }
    unsigned edge = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int u : {0, 2}) {
            for (const int v : {0, 2}) {
                Place p{};
                p[axis] = 1;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                if ((edges >> edge++ & 1U) != 0) middles[p] = true;
            }
        }
    }
    for (std::size_t side = 0; side < 6; ++side) {
        if ((sides >> side & 1U) != 0) {
            for (const int u : {0, 1}) {
                for (const int v : {0, 1})
                    add(side, {on_side(side, u, v), on_side(side, u + 1, v), on_side(side, u + 1, v + 1),
                               on_side(side, u, v + 1)});
            }
            continue;
        }
        std::vector<Place> ring;
        for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}) {
            const Place p = on_side(side, u, v);
            if ((u % 2 == 0 && v % 2 == 0) || middles.contains(p)) ring.push_back(p);
        }
        add(side, ring);
    }
    return cell;
}

/// A bit for each of the unit cubes of a cube of side 2, x fastest. Their outer faces are the cell's, each by itself.
inline PlacedRings union_of_cubes(unsigned cubes) {
    PlacedRings cell;
    const auto has = [&](const std::array<int, 3>& at) {
        for (const int x : at) {
            if (x < 0 || x > 1) return false;
        }
        return (cubes >> (at[0] + 2 * at[1] + 4 * at[2]) & 1U) != 0;
    };
    for (int i = 0; i < 8; ++i) {
        const std::array<int, 3> at{i % 2, i / 2 % 2, i / 4};
        for (std::size_t side = 0; has(at) && side < 6; ++side) {
            const std::size_t axis = side / 2;
            std::array<int, 3> beyond = at;
            beyond[axis] += side % 2 == 0 ? -1 : 1;
            if (has(beyond)) continue;
            std::vector<Mesh::Index> ring;
            for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                std::array<int, 3> p = at;
                p[axis] += side % 2 == 0 ? 0 : 1;
                p[(axis + 1) % 3] += u;
                p[(axis + 2) % 3] += v;
                ring.push_back(cell.node(p));
            }
            if (side % 2 == 0) std::ranges::reverse(ring);
            cell.rings.push_back(ring);
        }
    }
    return cell;
}

}  // namespace barycert::test
