// Triangles in groups of eight, for lanes that look at a group at once.
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/locate/surface/surface_data.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {
namespace {

using Middle = std::array<float, 3>;

/// Orders a part so that each half has whole groups, as many as a power of two in the first, and so on.
void halve(std::uint32_t* first, std::uint32_t* last, const std::vector<Middle>& middles) {
    const auto count = static_cast<std::size_t>(last - first);
    if (count <= 8) return;
    Middle low = middles[*first], high = low;
    for (const std::uint32_t* i = first; i != last; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], middles[*i][k]);
            high[k] = std::max(high[k], middles[*i][k]);
        }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    const std::size_t groups = (count + 7) / 8;
    std::uint32_t* const middle = first + 8 * std::bit_floor(groups - 1);
    // Ties by number, so that the order depends on the triangles alone.
    std::nth_element(first, middle, last, [&](std::uint32_t a, std::uint32_t b) {
        return middles[a][axis] != middles[b][axis] ? middles[a][axis] < middles[b][axis] : a < b;
    });
    if (count > 8192) {
        tbb::parallel_invoke([&] { halve(first, middle, middles); }, [&] { halve(middle, last, middles); });
    } else {
        halve(first, middle, middles);
        halve(middle, last, middles);
    }
}

}  // namespace

NearGroups::NearGroups(const CellIndex& index) : count(index.cell_count()) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::fabs(index.low[k]), std::fabs(index.high[k])});
    std::frexp(largest, &exponent);
    exponent = -exponent;
    if (std::abs(exponent) > 1000) return;
    to_unit = std::ldexp(1, exponent);
    from_unit = std::ldexp(1, -exponent);
    for (std::size_t i = 0; i < index.nodes.size(); ++i) {
        for (const double x : index.nodes[i].at) {
            if (x * to_unit * from_unit != x) return;
        }
    }
    usable = true;
    order.resize(count);
    std::vector<Middle> middles(count);
    base::parallel_for_each(count, 4096, [&](std::size_t i) {
        order[i] = static_cast<std::uint32_t>(i);
        const auto corners = index.corner_points(static_cast<Place>(i));
        for (std::size_t k = 0; k < 3; ++k)
            middles[i][k] = static_cast<float>((corners[0][k] + corners[1][k] + corners[2][k]) * to_unit);
    });
    halve(order.data(), order.data() + count, middles);

    std::vector<std::size_t> sizes{(count + 7) / 8};
    while (sizes.back() > 8) sizes.push_back((sizes.back() + 7) / 8);
    std::size_t all = 0;
    for (const std::size_t size : sizes) {
        levels.push_back(all);
        all += (size + 7) / 8;
    }
    triangles = Buffer<Triangles>(sizes[0]);
    boxes = Buffer<Boxes>(all);
    constexpr double none = std::numeric_limits<double>::infinity();
    for (std::size_t level = 0; level < levels.size(); ++level) {
        base::parallel_for_each((sizes[level] + 7) / 8, 64, [&](std::size_t b) {
            Boxes& to = boxes[levels[level] + b];
            for (std::size_t l = 0; l < 8; ++l) {
                for (int k = 0; k < 3; ++k) to.low[k][l] = none, to.high[k][l] = -none;
                const std::size_t below = 8 * b + l;
                for (std::size_t i = 0; i < 8 && below < sizes[level]; ++i) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        double low = none, high = -none;
                        if (level != 0) {
                            low = boxes[levels[level - 1] + below].low[k][i];
                            high = boxes[levels[level - 1] + below].high[k][i];
                        } else {
                            const std::uint32_t cell = order[std::min(8 * below + i, count - 1)];
                            const auto corners = index.corner_points(static_cast<Place>(cell));
                            for (std::size_t c = 0; c < 3; ++c) {
                                const double x = corners[c][k] * to_unit;
                                triangles[below].at[c][k][i] = x;
                                low = std::min(low, x);
                                high = std::max(high, x);
                            }
                        }
                        to.low[k][l] = std::min(to.low[k][l], low);
                        to.high[k][l] = std::max(to.high[k][l], high);
                    }
                }
            }
        });
    }
}

}  // namespace barycert::locate
