// Triangles in space without an area: segments and points.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::locate {

FlatCorners corners_along(const std::array<const double*, 3>& at) {
    std::array<std::uint8_t, 3> order{0, 1, 2};
    const auto before = [&](std::uint8_t i, std::uint8_t j) {
        const bool same = std::equal(at[i], at[i] + 3, at[j]);
        return same ? i < j : std::lexicographical_compare(at[i], at[i] + 3, at[j], at[j] + 3);
    };
    // Along a line coordinates grow or fall together: the first that is not constant has its order.
    for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {0U, 1U}}) {
        if (before(order[b], order[a])) std::swap(order[a], order[b]);
    }
    FlatCorners line;
    for (const std::uint8_t i : order) {
        const bool again = line.count != 0 && std::equal(at[i], at[i] + 3, at[line.corner[line.count - 1]]);
        if (!again) line.corner[line.count++] = i;
    }
    return line;
}

unsigned nearest_of_flat(const std::array<const double*, 3>& at, const double* p) {
    const FlatCorners line = corners_along(at);
    for (std::size_t i = 0; i + 1 < line.count; ++i) {
        const std::size_t a = line.corner[i], b = line.corner[i + 1];
        std::array<double, 6> ends{};
        std::copy_n(at[a], 3, ends.begin());
        std::copy_n(at[b], 3, ends.begin() + 3);
        const WeightSigns signs = weight_signs(Simplex::segment, ends.data(), p);
        if (signs.sign(1) != Sign::positive) return 1U << a;
        if (signs.sign(0) == Sign::positive) return 1U << a | 1U << b;
    }
    return 1U << line.corner[line.count - 1];
}

unsigned part_of_flat(const std::array<const double*, 3>& at, const double* p) {
    const unsigned mask = nearest_of_flat(at, p);
    const auto first = static_cast<std::size_t>(std::countr_zero(mask));
    if (std::popcount(mask) == 1) return std::equal(p, p + 3, at[first]) ? mask : 0;
    const std::size_t second = mask >> (first + 1) == 1 ? first + 1 : first + 2;
    return index::proper(3, {{}, {at[first], at[second], p}}) ? 0 : mask;
}

}  // namespace barycert::locate
