#include "barycert/locate/cells_at_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "barycert/index/buffer.hpp"
#include "barycert/locate/cells_at_points_lanes.hpp"

namespace barycert::locate {
namespace {

/// So many points still leave most bins of the coarser grid empty.
constexpr std::size_t few = 1024;

constexpr std::size_t nodes_at_once = std::size_t{1} << 14;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::uint32_t place_of(std::uint32_t code, std::size_t axis) {
    return code >> (8 * axis) & 0xFFU;
}

}  // namespace

PointBins::PointBins(std::size_t d, std::span<const double> points) : d_(d), bits_(points.size() / d <= few ? 6 : 7) {
    for (std::size_t k = 0; k < d; ++k) {
        low_[k] = infinity;
        high_[k] = -infinity;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        low_[i % d] = std::min(low_[i % d], points[i]);
        high_[i % d] = std::max(high_[i % d], points[i]);
    }
    quantizer_ = Quantizer(d, low_.data(), high_.data());
    for (std::size_t level = 0; level < near_.size(); ++level)
        near_[level].assign((std::size_t{1} << 3 * bits(level)) / 32, 0);
    rows_.assign((std::size_t{1} << 3 * bits_) / 64, 0);
    for (std::size_t i = 0; i + d <= points.size(); i += d) {
        const std::uint32_t at = code(points.data() + i);
        const std::array<std::uint32_t, 3> bin{place_of(at, 0), place_of(at, 1), place_of(at, 2)};
        const auto number = [&](std::size_t level, std::uint32_t before) {
            std::uint32_t n = 0;
            for (std::size_t k = 0; k < 3; ++k)
                n |= ((bin[k] >> level) - (before >> k & 1U)) << (static_cast<std::uint32_t>(bits(level)) * k);
            return n;
        };
        rows_[number(0, 0) / 64] |= std::uint64_t{1} << number(0, 0) % 64;
        for (std::size_t level = 0; level < near_.size(); ++level) {
            for (std::uint32_t before = 0; before < 8; ++before) {
                const std::uint32_t n = number(level, before);
                std::int32_t& word = near_[level][n / 32];
                word = static_cast<std::int32_t>(static_cast<std::uint32_t>(word) | 1U << n % 32);
            }
        }
    }
}

bool PointBins::some_in(std::uint32_t low, std::uint32_t high) const {
    const std::uint32_t last = (1U << bits_) - 1;
    for (std::size_t k = 0; k < 3; ++k) {
        if (place_of(high, k) < first || place_of(low, k) == last) return false;  // not even the box of the points
    }
    constexpr std::uint32_t enough = 256;
    const std::uint32_t rows = (place_of(high, 1) - place_of(low, 1) + 1) * (place_of(high, 2) - place_of(low, 2) + 1);
    if (rows > enough) return true;
    const std::uint32_t x0 = place_of(low, 0), x1 = place_of(high, 0);
    for (std::uint32_t z = place_of(low, 2); z <= place_of(high, 2); ++z) {
        for (std::uint32_t y = place_of(low, 1); y <= place_of(high, 1); ++y) {
            const std::size_t row = (std::size_t{z} << bits_ | y) << (bits_ - 6);
            for (std::uint32_t word = x0 / 64; word <= x1 / 64; ++word) {
                std::uint64_t found = rows_[row + word];
                if (word == x0 / 64) found &= ~std::uint64_t{0} << x0 % 64;
                if (word == x1 / 64) found &= ~std::uint64_t{0} >> (63 - x1 % 64);
                if (found != 0) return true;
            }
        }
    }
    return false;
}

namespace {

struct NodeBox {
    std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

    void add(const NodeBox& other) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
    }
};

NodeBox box_of_nodes(const Mesh& mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto join = [](NodeBox a, const NodeBox& b) {
        a.add(b);
        return a;
    };
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, mesh.point_count(), nodes_at_once), NodeBox(),
        [&](const auto& range, NodeBox box) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                NodeBox node;
                for (std::size_t k = 0; k < d; ++k) node.low[k] = node.high[k] = mesh.points[d * i + k];
                box.add(node);
            }
            return box;
        },
        join);
}

/// Those in the box of the nodes: no cell holds another, and one far away would make the bins large.
std::vector<double> points_in_box(const Mesh& mesh, std::span<const double> points) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const NodeBox box = box_of_nodes(mesh);
    std::vector<double> inside;
    for (std::size_t i = 0; i + d <= points.size(); i += d) {
        bool in = true;
        for (std::size_t k = 0; k < d; ++k) in = in && points[i + k] >= box.low[k] && points[i + k] <= box.high[k];
        if (in) inside.insert(inside.end(), points.data() + i, points.data() + i + d);
    }
    return inside;
}

}  // namespace

std::optional<std::vector<Mesh::Index>> cells_at_points(const Mesh& mesh, std::span<const double> all_points,
                                                        std::size_t max) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<double> points = points_in_box(mesh, all_points);
    if (points.empty()) return std::vector<Mesh::Index>();
    const PointBins bins(d, points);
    Buffer<std::int32_t> codes(mesh.point_count());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, codes.size(), nodes_at_once), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            codes[i] = static_cast<std::int32_t>(bins.code(mesh.points.data() + d * i));
    });
    constexpr std::size_t block = std::size_t{1} << 15;
    const std::size_t cells = mesh.cell_count(), blocks = (cells + block - 1) / block;
    std::vector<std::vector<Mesh::Index>> found(blocks);
    std::atomic<std::size_t> count{0};
    std::atomic<bool> sound{true};
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
        if (count > max || !sound) return;
        const std::size_t first = b * block, size = std::min(block, cells - first);
        Buffer<CellBins> near(size);
        const auto kept = find_near({mesh.cells.data() + (d + 1) * first, size, d + 1, {codes.data(), codes.size()}},
                                    bins, near.data());
        if (!kept) {
            sound = false;
            return;
        }
        for (std::size_t i = 0; i < *kept; ++i) {
            if (bins.some_in(near[i].low, near[i].high))
                found[b].push_back(static_cast<Mesh::Index>(first + near[i].cell));
        }
        count += found[b].size();
    });
    if (count > max || !sound) return std::nullopt;
    std::vector<Mesh::Index> all;
    all.reserve(count);
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace barycert::locate
