/// Boxes of cells in a tree, to find every cell that may hold a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/locate/buffer.hpp"
#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// Eight boxes in the whole numbers of the quantizer; in 2D the third axis is zero. A box that is none has low > high.
struct alignas(64) BoxGroup {
    std::array<std::array<std::int32_t, 8>, 3> low, high;
};

/// Cells in the order of space, eight to a group; groups eight to a group above, up to one.
/// A box in the whole numbers of the quantizer.
struct CellBox {
    std::array<std::int32_t, 3> low, high;
};

/// That of the box of `count` points with as many coordinates as the index has dimensions.
CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count);

class CellTree {
public:
    /// On the threads of the calling arena.
    explicit CellTree(const CellIndex& index);

    std::size_t levels() const { return level_.size(); }
    /// By level from the cells up; box i of a level stands in group i / 8 at i % 8.
    const BoxGroup* level(std::size_t l) const { return groups_.data() + level_[l]; }
    std::size_t bytes() const { return groups_.bytes(); }

    /// found(cell) for each cell whose box meets `box`, and maybe for some more, until it returns false.
    template <class Found>
    void for_each_meeting(const CellBox& box, Found found) const {
        struct Open {
            std::size_t level, group;
        };
        std::array<Open, 8 * 12> stack;  // 2^31 cells have 11 levels; each leaves at most 7 of its 8 behind
        std::size_t top = 0;
        stack[top++] = {levels() - 1, 0};
        while (top > 0) {
            const Open open = stack[--top];
            const BoxGroup& group = level(open.level)[open.group];
            for (std::size_t i = 0; i < 8; ++i) {
                bool meets = true;
                for (std::size_t k = 0; k < 3; ++k)
                    meets &= group.low[k][i] <= box.high[k] && group.high[k][i] >= box.low[k];
                if (!meets) continue;
                if (open.level > 0) {
                    stack[top++] = {open.level - 1, 8 * open.group + i};
                } else if (!found(static_cast<Place>(8 * open.group + i))) {
                    return;
                }
            }
        }
    }

private:
    std::vector<std::size_t> level_;  ///< where each begins
    Buffer<BoxGroup> groups_;
};

struct PointRecord;

struct Candidate {
    std::uint32_t point;
    Place cell;
};

/// Appends each cell whose box holds points[i], for i = which[0 .. count), to `out`, point by point. Cells that are not
/// named do not hold the point. Points must lie in the box of the mesh.
void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out);

}  // namespace barycert::locate
