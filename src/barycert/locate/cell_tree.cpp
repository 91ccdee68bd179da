#include "barycert/locate/cell_tree.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace barycert::locate {
namespace {

struct QuantizedBox {
    std::array<std::int32_t, 3> low{Quantizer::max, Quantizer::max, Quantizer::max}, high{-1, -1, -1};

    void add(const QuantizedBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], b.low[k]);
            high[k] = std::max(high[k], b.high[k]);
        }
    }
};

QuantizedBox box_of_cell(const CellIndex& index, const std::vector<std::array<std::int32_t, 3>>& nodes,
                         std::size_t cell) {
    QuantizedBox box;
    for (std::size_t i = 0; i < index.corners(); ++i) {
        const auto& at = nodes[static_cast<std::size_t>(index.cells[cell].node[i])];
        box.add({at, at});
    }
    return box;
}

}  // namespace

CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count) {
    CellBox box{{Quantizer::max, Quantizer::max, Quantizer::max}, {-1, -1, -1}};
    for (std::size_t k = 0; k < 3; ++k) {
        if (k >= index.dimension()) {
            box.low[k] = box.high[k] = 0;
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t q = index.bins.quantizer().at(k, points[i][k]);
            box.low[k] = std::min(box.low[k], q);
            box.high[k] = std::max(box.high[k], q);
        }
    }
    return box;
}

CellTree::CellTree(const CellIndex& index) {
    std::vector<std::array<std::int32_t, 3>> nodes(index.original_node.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 8192), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            nodes[i] = {};
            for (std::size_t k = 0; k < index.dimension(); ++k)
                nodes[i][k] = index.bins.quantizer().at(k, index.nodes[i].at[k]);
        }
    });
    std::size_t groups = 0;
    for (std::size_t boxes = index.cell_count();;) {
        level_.push_back(groups);
        const std::size_t above = (boxes + 7) / 8;
        groups += std::max<std::size_t>(above, 1);
        if (above <= 1) break;
        boxes = above;
    }
    groups_ = Buffer<BoxGroup>(groups);
    std::size_t boxes = index.cell_count();
    for (std::size_t l = 0; l < level_.size(); ++l) {
        BoxGroup* const to = groups_.data() + level_[l];
        const std::size_t above = std::max<std::size_t>((boxes + 7) / 8, 1);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, above, 1024), [&](const auto& range) {
            for (std::size_t i = 8 * range.begin(); i < 8 * range.end(); ++i) {
                QuantizedBox box;
                if (i < boxes && l == 0) {
                    box = box_of_cell(index, nodes, i);
                } else if (i < boxes) {
                    const BoxGroup& below = groups_[level_[l - 1] + i];
                    for (std::size_t b = 0; b < 8; ++b)
                        box.add({{below.low[0][b], below.low[1][b], below.low[2][b]},
                                 {below.high[0][b], below.high[1][b], below.high[2][b]}});
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    to[i / 8].low[k][i % 8] = box.low[k];
                    to[i / 8].high[k][i % 8] = box.high[k];
                }
            }
        });
        boxes = above;
    }
}

}  // namespace barycert::locate
