#include "barycert/locate/nearest_tree.hpp"

#include <algorithm>
#include <limits>

namespace barycert::locate {
namespace {

ExactBox empty_box() {
    constexpr double none = std::numeric_limits<double>::infinity();
    return {{none, none, none}, {-none, -none, -none}};
}

}  // namespace

void ExactBox::add(const std::array<double, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
    }
}

void ExactBox::add(const ExactBox& b) {
    add(b.low);
    add(b.high);
}

std::array<double, 3> ExactBox::nearest(const std::array<double, 3>& p) const {
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = std::clamp(p[k], low[k], high[k]);
    return at;
}

ExactBox box_of_cell(const CellIndex& index, std::size_t cell) {
    ExactBox box = empty_box();
    for (std::size_t i = 0; i < index.corners(); ++i)
        box.add(index.nodes[static_cast<std::size_t>(index.cells[cell].node[i])].at);
    return box;
}

NearestTree::NearestTree(const CellIndex& index) {
    std::size_t below = index.cell_count();
    do {
        const std::size_t level = begin_.size(), count = (below + fan - 1) / fan;
        begin_.push_back(boxes_.size());
        for (std::size_t i = 0; i < count; ++i) {
            ExactBox all = empty_box();
            for (std::size_t j = fan * i; j < std::min(below, fan * (i + 1)); ++j)
                all.add(level == 0 ? box_of_cell(index, j) : boxes_[begin_[level - 1] + j]);
            boxes_.push_back(all);
        }
        below = count;
    } while (below > 1);
    begin_.push_back(boxes_.size());
}

}  // namespace barycert::locate
