#include "mesh/locate/cells_at_points.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/threads/arena.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/locate/cells_at_points.cpp"
#include "core/foreach_target.hpp"

#include "core/lane_loop-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A bit in `near` for each of the cells of these corners that may be near, and the codes of their lowest and highest
/// bins. False if a corner is no node.
template <std::size_t n, class D>
HWY_INLINE bool look(D tag, const Mesh::Index* corner, const CellBlock& block, const PointBins& bins, std::int32_t* low,
                     std::int32_t* high, std::uint64_t& near) {
    using V = hn::Vec<D>;
    V node[n], code[n];
    if constexpr (n == 4) {
        hn::LoadInterleaved4(tag, corner, node[0], node[1], node[2], node[3]);
    } else {
        hn::LoadInterleaved3(tag, corner, node[0], node[1], node[2]);
    }
    const V last = hn::Set(tag, static_cast<std::int32_t>(block.codes.size() - 1));
    auto wrong = hn::MaskFromVec(hn::Zero(tag));
    for (const V& v : node) wrong = hn::Or(wrong, hn::Or(hn::Lt(v, hn::Zero(tag)), hn::Gt(v, last)));
    if (!hn::AllFalse(tag, wrong)) return false;
    for (std::size_t i = 0; i < n; ++i) code[i] = hn::GatherIndex(tag, block.codes.data(), node[i]);

    const V byte = hn::Set(tag, 0xFF), one = hn::Set(tag, 1), thirty_one = hn::Set(tag, 31);
    V lowest[3], highest[3];
    for (int k = 0; k < 3; ++k) {
        V places[n];
        for (std::size_t i = 0; i < n; ++i) places[i] = hn::And(hn::ShiftRightSame(code[i], 8 * k), byte);
        lowest[k] = highest[k] = places[0];
        for (std::size_t i = 1; i < n; ++i) {
            lowest[k] = hn::Min(lowest[k], places[i]);
            highest[k] = hn::Max(highest[k], places[i]);
        }
    }
    // Where the cell spans at most two bins of a level an axis, the level has the answer; where none does, none.
    auto found = hn::MaskFromVec(hn::Zero(tag));
    auto open = hn::Not(found);
    for (std::size_t level = 0; level < PointBins::levels && !hn::AllFalse(tag, open); ++level) {
        const int bits = bins.bits(level);
        V number = hn::Zero(tag);
        auto fits = open;
        for (int k = 0; k < 3; ++k) {
            const V a = hn::ShiftRightSame(lowest[k], static_cast<int>(level));
            const V b = hn::ShiftRightSame(highest[k], static_cast<int>(level));
            fits = hn::And(fits, hn::Not(hn::Gt(hn::Sub(b, a), one)));
            number = hn::Or(number, hn::ShiftLeftSame(a, bits * k));
        }
        const V word = hn::GatherIndex(tag, bins.near(level), hn::ShiftRight<5>(number));
        const V bit = hn::And(word >> hn::And(number, thirty_one), one);
        found = hn::Or(found, hn::And(fits, hn::Eq(bit, one)));
        open = hn::AndNot(fits, open);
    }
    found = hn::Or(found, open);
    near = core::HWY_NAMESPACE::mask_bits(tag, found);
    if (near == 0) return true;
    const auto packed = [&](const V(&v)[3])
                            HWY_ATTR { return hn::Or(v[0], hn::Or(hn::ShiftLeft<8>(v[1]), hn::ShiftLeft<16>(v[2]))); };
    hn::Store(packed(lowest), tag, low);
    hn::Store(packed(highest), tag, high);
    return true;
}

template <std::size_t n>
std::optional<std::size_t> find_near_corners(const CellBlock& block, const PointBins& bins, CellBins* out) {
    const hn::ScalableTag<std::int32_t> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<std::int32_t>());
    HWY_ALIGN std::int32_t low[width], high[width];
    CellBins* const begin = out;
    for (std::size_t at = 0; at < block.count; at += width) {
        const std::size_t count = std::min(width, block.count - at);
        const Mesh::Index* corner = block.corner + n * at;
        Mesh::Index padded[n * width];
        if (count < width) {  // filled up with the first of them
            for (std::size_t i = 0; i < n * width; ++i) padded[i] = corner[i < n * count ? i : i % n];
            corner = padded;
        }
        std::uint64_t near = 0;
        if (!look<n>(tag, corner, block, bins, low, high, near)) return std::nullopt;
        if (count < width) near &= (std::uint64_t{1} << count) - 1;
        for (; near != 0; near &= near - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(near));
            *out++ = {static_cast<std::uint32_t>(at + lane), static_cast<std::uint32_t>(low[lane]),
                      static_cast<std::uint32_t>(high[lane])};
        }
    }
    return static_cast<std::size_t>(out - begin);
}

/// Writes the cells that may be near a bin with a point to `out`, ascending, and returns how many; all others are not.
/// Nothing if a corner is no node. `out` has room for all.
std::optional<std::size_t> find_near(const CellBlock& block, const PointBins& bins, CellBins* out) {
    return block.corners == 4 ? find_near_corners<4>(block, bins, out) : find_near_corners<3>(block, bins, out);
}

}  // namespace barycert::locate::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(find_near);

namespace {

/// So many points still leave most bins of the coarser grid empty.
constexpr std::size_t few = 1024;

constexpr std::size_t nodes_at_once = std::size_t{1} << 14;

std::uint32_t place_of(std::uint32_t code, std::size_t axis) {
    return code >> (8 * axis) & 0xFFU;
}

/// Returns the points in the box of the nodes: no cell holds another, and one far away would make the bins large.
std::vector<double> points_in_box(const Mesh& mesh, std::span<const double> points) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Box box = base::parallel_reduce(
        mesh.point_count(), nodes_at_once, empty_box,
        [&](std::size_t begin, std::size_t end, Box& part) {
            for (std::size_t i = begin; i != end; ++i) {
                std::array<double, 3> node{};
                std::copy_n(mesh.points.data() + d * i, d, node.begin());
                part.add({node, node});
            }
        },
        [](Box& all, const Box& part) { all.add(part); });
    std::vector<double> inside;
    for (std::size_t i = 0; i + d <= points.size(); i += d) {
        bool in = true;
        for (std::size_t k = 0; k < d; ++k) in = in && points[i + k] >= box.low[k] && points[i + k] <= box.high[k];
        if (in) inside.insert(inside.end(), points.data() + i, points.data() + i + d);
    }
    return inside;
}

}  // namespace

PointBins::PointBins(std::size_t d, std::span<const double> points) : d_(d), bits_(points.size() / d <= few ? 6 : 7) {
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

std::optional<std::vector<Mesh::Index>> cells_at_points(const Mesh& mesh, std::span<const double> all_points,
                                                        std::size_t max) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<double> points = points_in_box(mesh, all_points);
    if (points.empty()) return std::vector<Mesh::Index>();
    const PointBins bins(d, points);
    Buffer<std::int32_t> codes(mesh.point_count());
    base::parallel_for_each(codes.size(), nodes_at_once, [&](std::size_t i) {
        codes[i] = static_cast<std::int32_t>(bins.code(mesh.points.data() + d * i));
    });
    constexpr std::size_t block = std::size_t{1} << 15;
    const std::size_t cells = mesh.cell_count(), blocks = (cells + block - 1) / block;
    std::vector<std::vector<Mesh::Index>> found(blocks);
    std::atomic<std::size_t> count{0};
    std::atomic<bool> sound{true};
    base::parallel_for(blocks, [&](std::size_t b) {
        if (count > max || !sound) return;
        const std::size_t first = b * block, size = std::min(block, cells - first);
        Buffer<CellBins> near(size);
        const auto kept = HWY_DYNAMIC_DISPATCH(find_near)(
            {mesh.cells.data() + (d + 1) * first, size, d + 1, {codes.data(), codes.size()}}, bins, near.data());
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
#endif
