#include "barycert/pieces/piece.hpp"

#include <algorithm>
#include <array>

namespace barycert::pieces {

namespace {

constexpr std::size_t side = 16;  ///< of the cube of bins

// Halved first, for boxes may be as large as doubles are.
double middle(const Box& box, std::size_t axis) {
    return box.low[axis] / 2 + box.high[axis] / 2;
}
double half_width(const Box& box, std::size_t axis) {
    return box.high[axis] / 2 - box.low[axis] / 2;
}

std::size_t bin_of(const Box& box, const Box& around) {
    std::size_t bin = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = half_width(around, a);
        const double share = width > 0 ? (middle(box, a) / 2 - around.low[a] / 2) / width : 0;
        const auto place = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(side));
        bin = side * bin + std::min(place, side - 1);
    }
    return bin;
}

// Each around as many of the boxes (but one): halves along the axis on which their middles spread most.
void halve(std::vector<Box>::iterator begin, std::vector<Box>::iterator end, std::size_t most, std::vector<Box>& all) {
    if (begin == end) return;
    Box around = empty_box, middles = empty_box;
    for (auto box = begin; box != end; ++box) {
        const std::array<double, 3> at{middle(*box, 0), middle(*box, 1), middle(*box, 2)};
        middles.add({at, at});
        around.add(*box);
    }
    if (most <= 1 || end - begin == 1) {
        all.push_back(around);
        return;
    }
    std::size_t widest = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (half_width(middles, a) > half_width(middles, widest)) widest = a;
    const std::size_t left = most / 2;
    const auto between = begin + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(end - begin) * left / most);
    std::nth_element(begin, between, end,
                     [&](const Box& a, const Box& b) { return middle(a, widest) < middle(b, widest); });
    halve(begin, between, left, all);
    halve(between, end, most - left, all);
}

}  // namespace

std::vector<Box> cover(const Box& around, std::size_t count, const std::function<Box(std::size_t)>& box_at,
                       std::size_t most) {
    std::vector<Box> bins(side * side * side, empty_box), all;
    for (std::size_t i = 0; i < count; ++i) {
        const Box box = box_at(i);
        bins[bin_of(box, around)].add(box);
    }
    std::erase_if(bins, empty);
    halve(bins.begin(), bins.end(), most, all);
    return all;
}

}  // namespace barycert::pieces
