/// A tree of boxes, to find those that meet a box.
///
/// A binary tree over boxes in an order that halves them, at each node, along the longer axis of their centres. Nodes
/// lie in preorder: the left child follows its parent. Boxes are closed, their numbers doubles as given, compared
/// exactly; there are no tolerances.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace barycert::index {

struct Box {
    std::array<double, 3> low, high;  ///< 2D: the last axis is 0

    bool meets(const Box& b) const {
        for (std::size_t k = 0; k < 3; ++k) {
            if (low[k] > b.high[k] || b.low[k] > high[k]) return false;
        }
        return true;
    }
    void add(const Box& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = b.low[k] < low[k] ? b.low[k] : low[k];
            high[k] = b.high[k] > high[k] ? b.high[k] : high[k];
        }
    }
    /// The point of the box that is nearest to p: its coordinates are numbers of the box or of p.
    std::array<double, 3> nearest(const std::array<double, 3>& p) const {
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = std::clamp(p[k], low[k], high[k]);
        return at;
    }
};

inline constexpr double no_coordinate = std::numeric_limits<double>::infinity();
inline constexpr Box empty_box{{no_coordinate, no_coordinate, no_coordinate},
                               {-no_coordinate, -no_coordinate, -no_coordinate}};

/// The box of `count` points with d coordinates.
Box box_of(int d, const double* const* points, int count);

/// Which sides of the box a point with d coordinates is beyond, a bit each: a set of points whose codes have a bit in
/// common has a box that does not meet this one, and the other way round.
inline std::uint8_t outcode(int d, const Box& box, const double* p) {
    unsigned code = 0;
    for (int k = 0; k < d; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        code |= (p[k] < box.low[axis] ? 1U : 0U) << (2 * k) | (p[k] > box.high[axis] ? 2U : 0U) << (2 * k);
    }
    return static_cast<std::uint8_t>(code);
}

class BoxTree {
public:
    /// Takes time O(n log n), on all threads of the calling arena. At most 2^31 boxes.
    explicit BoxTree(std::vector<Box> boxes);

    /// The box of all; none if there are no boxes.
    const Box* bounds() const { return nodes_.empty() ? nullptr : &nodes_.front().box; }

    /// found(i) for each box i that meets `box`, until it returns false. Returns false if it did.
    template <class F>
    bool for_each(const Box& box, F&& found) const {
        if (nodes_.empty()) return true;
        std::uint32_t stack[64];  // the tree is balanced: its depth is at most 31
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            if (!node.box.meets(box)) continue;
            if (node.count == 0) {
                stack[top++] = node.right;
                stack[top++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
                continue;
            }
            for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
                if (boxes_[i].meets(box) && !found(order_[i])) return false;
            }
        }
        return true;
    }

private:
    static constexpr std::size_t leaf_size = 4;

    struct Node {
        Box box;
        std::uint32_t count = 0;  ///< boxes of a leaf; 0 of an inner node
        std::uint32_t right = 0;  ///< inner node: the right child; leaf: its first box
    };

    static std::size_t nodes_over(std::size_t boxes);
    void build(std::size_t first, std::size_t last, std::size_t node);

    std::vector<Box> boxes_;  ///< in the order of the leaves
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace barycert::index
