#include "mesh/index/box_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/threads/arena.hpp"

namespace barycert::index {

Box box_of(int d, const double* const* points, int count) {
    const auto at = [&](int i) {
        std::array<double, 3> x{};
        for (int k = 0; k < d; ++k) x[static_cast<std::size_t>(k)] = points[i][k];
        return Box{x, x};
    };
    Box box = at(0);
    for (int i = 1; i < count; ++i) box.add(at(i));
    return box;
}

/// Nodes of the subtree over so many boxes: both halves and one more.
std::size_t BoxTree::nodes_over(std::size_t boxes) {
    if (boxes <= leaf_size) return 1;
    return nodes_over(boxes / 2) + nodes_over(boxes - boxes / 2) + 1;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    if (boxes_.empty()) return;
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.resize(nodes_over(boxes_.size()));
    build(0, boxes_.size(), 0);
    std::vector<Box> sorted(boxes_.size());
    base::parallel_for_each(boxes_.size(), 4096, [&](std::size_t i) { sorted[i] = boxes_[order_[i]]; });
    boxes_ = std::move(sorted);
}

void BoxTree::build(std::size_t first, std::size_t last, std::size_t at) {
    Node& node = nodes_[at];
    const auto count = last - first;
    // Halved before they are added up or subtracted: their sum may overflow.
    const auto centre = [&](std::uint32_t i, std::size_t axis) {
        return boxes_[i].low[axis] / 2 + boxes_[i].high[axis] / 2;
    };
    Box centres = empty_box;
    node.box = empty_box;
    for (std::size_t i = first; i < last; ++i) {
        const std::array<double, 3> c{centre(order_[i], 0), centre(order_[i], 1), centre(order_[i], 2)};
        centres.add({c, c});
        node.box.add(boxes_[order_[i]]);
    }
    if (count <= leaf_size) {
        node.count = static_cast<std::uint32_t>(count);
        node.right = static_cast<std::uint32_t>(first);
        return;
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (centres.high[k] / 2 - centres.low[k] / 2 > centres.high[axis] / 2 - centres.low[axis] / 2) axis = k;
    }
    const std::size_t middle = first + count / 2, left = at + 1, right = left + nodes_over(count / 2);
    // Ties by number, so that the tree depends on the boxes alone.
    std::uint32_t* const order = order_.data();
    std::ranges::nth_element(order + first, order + middle, order + last, {},
                             [&](std::uint32_t i) { return std::pair(centre(i, axis), i); });
    node.right = static_cast<std::uint32_t>(right);
    if (count > 8192) {
        tbb::parallel_invoke([&] { build(first, middle, left); }, [&] { build(middle, last, right); });
    } else {
        build(first, middle, left);
        build(middle, last, right);
    }
}

}  // namespace barycert::index
