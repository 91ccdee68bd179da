/// Boxes in a tree of groups of eight, to find every cell that may hold a point.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {

/// In the whole numbers of a quantizer; in 2D the third axis is zero. A box that is none has low > high.
struct CellBox {
    std::array<std::int32_t, 3> low{Quantizer::max, Quantizer::max, Quantizer::max}, high{-1, -1, -1};

    void add(const CellBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], b.low[k]);
            high[k] = std::max(high[k], b.high[k]);
        }
    }
};

struct alignas(64) BoxGroup {
    std::array<std::array<std::int32_t, 8>, 3> low, high;

    CellBox box(std::size_t i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
    }
    void set(std::size_t i, const CellBox& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k][i] = box.low[k];
            high[k][i] = box.high[k];
        }
    }
    CellBox box_of_all() const {
        CellBox all;
        for (std::size_t i = 0; i < 8; ++i) all.add(box(i));
        return all;
    }
    /// A bit for each of the boxes that meet `b`.
    std::uint32_t meeting(const CellBox& b) const {
        // A sign bit for each that is apart: no difference overflows, from numbers of 31 bits and -1. All of it in
        // operations that every processor has on lanes.
        std::array<std::int32_t, 8> apart{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < 8; ++i) apart[i] |= (b.high[k] - low[k][i]) | (high[k][i] - b.low[k]);
        }
        constexpr std::array<std::int32_t, 8> bit{1, 2, 4, 8, 16, 32, 64, 128};
        std::int32_t bits = 0;
        for (std::size_t i = 0; i < 8; ++i) bits += ~(apart[i] >> 31) & bit[i];
        return static_cast<std::uint32_t>(bits);
    }
};

/// Boxes in the order of space, eight to a group; groups eight to a group above, up to one.
class BoxGroups {
public:
    /// `count` boxes, box_at(i) each. On the threads of the calling arena.
    template <class BoxAt>
    BoxGroups(std::size_t count, BoxAt box_at) {
        std::size_t groups = 0;
        for (std::size_t boxes = count;; boxes = (boxes + 7) / 8) {
            level_.push_back(groups);
            groups += std::max<std::size_t>((boxes + 7) / 8, 1);
            if (boxes <= 8) break;
        }
        groups_ = Buffer<BoxGroup>(groups);
        for (std::size_t l = 0, boxes = count; l < level_.size(); ++l, boxes = (boxes + 7) / 8) {
            BoxGroup* const to = groups_.data() + level_[l];
            const BoxGroup* const below = l == 0 ? nullptr : groups_.data() + level_[l - 1];
            base::parallel_for_each(8 * std::max<std::size_t>((boxes + 7) / 8, 1), 8192, [&](std::size_t i) {
                to[i / 8].set(i % 8, i >= boxes ? CellBox{} : below == nullptr ? box_at(i) : below[i].box_of_all());
            });
        }
    }

    std::size_t levels() const { return level_.size(); }
    /// By level from the boxes up; box i of a level stands in group i / 8 at i % 8.
    const BoxGroup* level(std::size_t l) const { return groups_.data() + level_[l]; }
    std::size_t bytes() const { return groups_.bytes(); }

    /// found(i) for each box i that meets `box`, until it returns false.
    template <class UseCell>
    void for_each_meeting(const CellBox& box, UseCell found) const {
        struct Open {
            std::size_t level, group;
        };
        std::array<Open, 8 * 12> stack;  // 2^31 boxes have 11 levels; each leaves at most 7 of its 8 behind
        std::size_t top = 0;
        stack[top++] = {levels() - 1, 0};
        while (top > 0) {
            const Open open = stack[--top];
            for (std::uint32_t bits = level(open.level)[open.group].meeting(box); bits != 0; bits &= bits - 1) {
                const std::size_t i = 8 * open.group + static_cast<std::size_t>(std::countr_zero(bits));
                if (open.level > 0) {
                    stack[top++] = {open.level - 1, i};
                } else if (!found(i)) {
                    return;
                }
            }
        }
    }

    using TakePairs = std::function<void(std::span<FacetPair>)>;
    /// take() for all pairs of boxes that meet, the lower number first, in the group g of the lowest level: some at a
    /// time, in an order that depends on the boxes alone (lanes.cpp).
    void for_pairs(std::size_t g, const TakePairs& take) const;

private:
    std::vector<std::size_t> level_;  ///< where each begins
    Buffer<BoxGroup> groups_;
};

/// In the order of their places.
using CellTree = BoxGroups;

/// On the threads of the calling arena.
CellTree make_cell_tree(const CellIndex& index);

/// The box of `count` points with as many coordinates as the index has dimensions.
CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count);

/// The box of a cell.
CellBox box_of(const CellIndex& index, Place cell);

}  // namespace barycert::index
