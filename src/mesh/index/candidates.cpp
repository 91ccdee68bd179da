#include "mesh/index/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/vectors.hpp"
#include "mesh/index/box_tree.hpp"

namespace barycert::index {
namespace {

using Vector = base::Vector3<double>;

constexpr Box everywhere{{-1, -1, -1}, {1, 1, 1}};

/// v / sum |v_k|, v = to - from; nothing if that cannot be, for all is zero, infinite, or so small that quotients are
/// not accurate.
std::optional<Vector> direction(int d, const double* from, const double* to) {
    Vector v{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) v[k] = to[k] - from[k];
    const double sum = std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]);
    if (!(sum > 0x1p-900 && sum < 0x1p1020)) return std::nullopt;
    return Vector{v[0] / sum, v[1] / sum, v[2] / sum};
}

/// Returns a box of all directions y / |y|, where y is a sum of the given directions with factors that are not
/// negative, and |y| the sum of its components' magnitudes. The given ones have |y| = 1 and components off by at most
/// `error`. A mean y of them has low <= y <= high, and |y| is at least the sum of the magnitudes that no component
/// falls below; in one orthant |y| = 1, being linear there.
Box directions(std::span<const Vector> given, double error) {
    Box box{given[0], given[0]};
    for (const Vector& v : given) box.add({v, v});
    double magnitude = 0;
    bool orthant = true;
    for (std::size_t k = 0; k < 3; ++k) {
        magnitude += std::max({0.0, box.low[k] - error, -box.high[k] - error});
        orthant = orthant && (box.low[k] >= 0 || box.high[k] <= 0);
    }
    if (orthant) magnitude = 1 - 6 * error;  // signs that are wrong by `error` count twice, on three axes
    if (!(magnitude > 0x1p-10)) return everywhere;
    const double wider = 0x1p-48;  // than the roundings here
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] -= error;
        box.high[k] += error;
        box.low[k] = (box.low[k] < 0 ? box.low[k] / magnitude : box.low[k]) - wider;
        box.high[k] = (box.high[k] > 0 ? box.high[k] / magnitude : box.high[k]) + wider;
    }
    return box;
}

/// A box of the directions from the node at `from` to the points of the item.
Box directions_from(int d, const Item& item, const double* from) {
    std::array<Vector, 3> given{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(item.count); ++i) {
        if (item.at[i] == from) continue;
        const auto v = direction(d, from, item.at[i]);
        if (!v) return everywhere;
        given[count++] = *v;
    }
    // A difference, the sum of magnitudes, three roundings in it, and the quotient: below 2^-49.
    return directions(std::span(given).first(count), 0x1p-49);
}

/// A box of the half planes at the line through both, turned by a right angle: v x (to - from), linear in v, has the
/// direction of the half plane of `from` + v, and is no direction but for points of the line.
Box directions_around(int d, const Item& item, const double* from, const double* to) {
    std::array<Vector, 2> given{};
    std::size_t count = 0;
    double error = 0;
    const auto axis = direction(d, from, to);
    for (std::size_t i = 0; i < static_cast<std::size_t>(item.count) && axis; ++i) {
        if (item.at[i] == from || item.at[i] == to) continue;
        const auto v = direction(d, from, item.at[i]);
        if (!v) return everywhere;
        // Products of numbers at most 1 that are off by 2^-49: each component is off by less than 2^-46.
        const Vector normal = base::cross(*v, *axis);
        const double sum = std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]);
        if (!(sum > 0x1p-30)) return everywhere;
        given[count++] = {normal[0] / sum, normal[1] / sum, normal[2] / sum};
        error = std::max(error, 0x1p-43 / sum);  // of the component, and thrice in the sum
    }
    if (count == 0) return everywhere;
    return directions(std::span(given).first(count), error);
}

}  // namespace

const double* Item::place_of(Mesh::Index node) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if (nodes[i] == node) return at[i];
    }
    return nullptr;
}

Candidates::Candidates(int d, std::span<const Item> items, std::size_t most_at_a_node) : d_(d), crowd_(most_at_a_node) {
    std::vector<std::uint32_t> all(items.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    split(-1, all, items);
    std::vector<Box> boxes;
    for (const Group& group : groups_) boxes.push_back(*group.trees[0]->bounds());
    bounds_.emplace(std::move(boxes));
}

/// Members that have `node` (-1: any), in groups by the one of their other nodes that most of them have.
void Candidates::split(Mesh::Index node, const std::vector<std::uint32_t>& members, std::span<const Item> items) {
    std::unordered_map<Mesh::Index, std::size_t> users;
    for (const std::uint32_t m : members) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(items[m].count); ++i) ++users[items[m].nodes[i]];
    }
    users.erase(node);
    std::map<Mesh::Index, std::vector<std::uint32_t>> groups;  // ascending, that all depends on the items alone
    for (const std::uint32_t m : members) {
        std::pair<std::size_t, Mesh::Index> max{crowd_, -1};
        for (std::size_t i = 0; i < static_cast<std::size_t>(items[m].count); ++i) {
            const auto found = users.find(items[m].nodes[i]);
            if (found != users.end() && found->second > max.first) max = {found->second, found->first};
        }
        groups[max.second].push_back(m);
    }
    for (auto& [second, part] : groups) {
        if (node >= 0 || second < 0) {
            add({node >= 0 ? node : second, node >= 0 ? second : -1}, std::move(part), items);
        } else if (d_ == 2) {
            add({second, -1}, std::move(part), items);
        } else {
            split(second, part, items);
        }
    }
}

void Candidates::add(std::array<Mesh::Index, 2> nodes, std::vector<std::uint32_t> members,
                     std::span<const Item> items) {
    Group& group = groups_.emplace_back(Group{nodes, std::move(members), {}});
    std::array<std::vector<Box>, 3> boxes;
    for (const std::uint32_t m : group.members) {
        const Item& item = items[m];
        boxes[0].push_back(box_of(d_, item.at.data(), item.count));
        if (nodes[0] < 0) continue;
        const double* const first = item.place_of(nodes[0]);
        boxes[1].push_back(directions_from(d_, item, first));
        if (nodes[1] >= 0) boxes[2].push_back(directions_around(d_, item, first, item.place_of(nodes[1])));
    }
    for (std::size_t t = 0; t < 3; ++t) {
        if (!boxes[t].empty()) group.trees[t].emplace(std::move(boxes[t]));
    }
}

std::pair<std::size_t, Box> Candidates::query_of(const Group& group, const Item& item, const Box& place) const {
    const double* const first = item.place_of(group.nodes[0]);
    if (first == nullptr) return {0, place};
    const double* const second = group.nodes[1] < 0 ? nullptr : item.place_of(group.nodes[1]);
    if (second == nullptr) return {1, directions_from(d_, item, first)};
    return {2, directions_around(d_, item, first, second)};
}

}  // namespace barycert::index
