#include "mesh/locate/lanes.hpp"
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/simplex.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/locate/occupancy.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/locate/lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/filter-inl.hpp"
#include "mesh/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using index::HWY_NAMESPACE::load_records;
using index::HWY_NAMESPACE::meeting;

// Bins of points.

/// Points one vector at a time. The arithmetic is the quantizer's, operation for operation.
template <std::size_t d, class D>
class BinsOfPoints {
public:
    using V = hn::Vec<D>;
    using I = hn::Rebind<std::int32_t, D>;

    HWY_INLINE BinsOfPoints(const CellIndex& index, const Occupancy* occupancy)
        : index_(index), occupancy_(occupancy), strange_(hn::Zero(D())) {}

    HWY_INLINE void find(const double* from, std::uint32_t* to) {
        const D tag;
        const I integers;
        V x[d];
        if constexpr (d == 3) {
            hn::LoadInterleaved3(tag, from, x[0], x[1], x[2]);
        } else {
            hn::LoadInterleaved2(tag, from, x[0], x[1]);
        }
        auto in_box = hn::MaskFromVec(hn::Zero(tag));
        for (std::size_t k = 0; k < d; ++k) {
            const V zero = x[k] - x[k];  // of finite numbers alone
            strange_ = strange_ + zero;
            const auto own = within(tag, x[k], index_.low[k], index_.high[k]);
            in_box = k == 0 ? own : hn::And(in_box, own);
        }
        const Quantizer& quantizer = index_.bins.quantizer();
        hn::Vec<I> q[d];
        auto bin = hn::Zero(integers);
        for (std::size_t k = 0; k < d; ++k) {
            const V t =
                (x[k] * hn::Set(tag, 0.5) - hn::Set(tag, quantizer.half_low(k))) * hn::Set(tag, quantizer.scale(k));
            // At least zero in the box; others become zero, so that every place below is one of the tables.
            const V inside = hn::IfThenElseZero(in_box, hn::Min(t, hn::Set(tag, double{Quantizer::max})));
            q[k] = hn::DemoteTo(integers, inside);
            const auto* const curve = reinterpret_cast<const std::int32_t*>(index_.bins.curve(k));
            bin = hn::Or(bin, hn::GatherIndex(integers, curve, hn::ShiftRightSame(q[k], index_.bins.shift(k))));
        }
        // no_bin has all bits set.
        bin = hn::Or(bin, hn::DemoteTo(integers, hn::IfThenElse(in_box, hn::Zero(tag), hn::Set(tag, -1))));
        if (occupancy_ != nullptr) bin = hn::Or(bin, all_bits_if_empty(q));
        hn::StoreU(bin, integers, reinterpret_cast<std::int32_t*>(to));
    }

    HWY_INLINE bool all_finite() const { return hn::AllTrue(D(), hn::Eq(strange_, hn::Zero(D()))); }

private:
    HWY_INLINE hn::Vec<I> all_bits_if_empty(const hn::Vec<I> (&q)[d]) const {
        const I integers;
        auto row = hn::Zero(integers);
        for (std::size_t k = d - 1; k > 0; --k)
            row = hn::Or(hn::ShiftLeftSame(row, occupancy_->bits(k)),
                         hn::ShiftRightSame(q[k], Quantizer::bits - occupancy_->bits(k)));
        const auto column = hn::ShiftRightSame(q[0], Quantizer::bits - occupancy_->bits(0));
        const auto word = hn::Or(hn::ShiftLeftSame(row, occupancy_->bits(0) - Occupancy::word_bits),
                                 hn::ShiftRight<Occupancy::word_bits>(column));
        const auto* const words = reinterpret_cast<const std::int32_t*>(occupancy_->words());
        const auto bit = hn::And(column, hn::Set(integers, (1 << Occupancy::word_bits) - 1));
        const auto one = hn::Set(integers, 1);
        return hn::And(hn::Shr(hn::GatherIndex(integers, words, word), bit), one) - one;
    }

    const CellIndex& index_;
    const Occupancy* occupancy_;
    V strange_;
};

template <std::size_t d>
bool find_bins_of(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points,
                  std::uint32_t* bin) {
    constexpr std::size_t width = hn::MaxLanes(hn::CappedTag<double, 8>());
    BinsOfPoints<d, hn::CappedTag<double, 8>> bins(index, occupancy);
    const std::size_t count = points.size() / d;
    std::size_t at = 0;
    for (; at + width <= count; at += width) bins.find(points.data() + d * at, bin + at);
    if (at < count) {
        double rest[d * width] = {};
        std::uint32_t found[width];
        std::copy(points.data() + d * at, points.data() + d * count, rest);
        bins.find(rest, found);
        std::copy(found, found + (count - at), bin + at);
    }
    return bins.all_finite();
}

bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin) {
    return index.simplex == Simplex::triangle ? find_bins_of<2>(index, occupancy, points, bin)
                                              : find_bins_of<3>(index, occupancy, points, bin);
}

// Cells whose boxes hold a point.

void find_candidates(const locate::CellIndex& index, const locate::CellTree& tree, const locate::PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out) {
    struct Open {
        std::uint32_t level, group;
    };
    Open stack[8 * 12];  // 2^31 cells have 11 levels; each leaves at most 7 of its 8 behind
    for (std::size_t i = 0; i < count; ++i) {
        const double* const p = points[which[i]].at.data();
        const CellBox at = box_of(index, &p, 1);
        std::size_t top = 0;
        stack[top++] = {static_cast<std::uint32_t>(tree.levels() - 1), 0};
        while (top > 0) {
            const Open open = stack[--top];
            for (std::uint32_t bits = meeting(tree.level(open.level)[open.group], at); bits != 0; bits &= bits - 1) {
                const std::uint32_t box = 8 * open.group + static_cast<std::uint32_t>(__builtin_ctz(bits));
                if (open.level == 0) {
                    out.push_back({which[i], static_cast<Place>(box)});
                } else {
                    stack[top++] = {open.level - 1, box};
                }
            }
        }
    }
}

// Walks.

struct StepTargets {
    std::uint64_t* going;
    WalkList* arrived;
    WalkList* stuck;
    std::size_t going_count;
};

template <class D, class M>
HWY_INLINE void append(D bits, hn::Vec<D> walks, M mask, WalkList& to) {
    to.count += hn::CompressStore(walks, mask, bits, reinterpret_cast<std::uint64_t*>(to.walks.data() + to.count));
}

/// Steps of the walks [at, at + width). Proofs are those of filter-inl.hpp. If all numerators are certainly of one
/// sign, so is the denominator, their exact sum.
template <Simplex s, bool fetch, class D>
HWY_INLINE void step(D tag, const CellRecord* cells, const NodeRecord* nodes, const PointRecord* points,
                     const Walk* walks, StepTargets& to) {
    using V = hn::Vec<D>;
    constexpr int n = vertex_count(s), d = space_dimension(s);
    const hn::RebindToUnsigned<D> bits;
    const auto walk = hn::LoadU(bits, reinterpret_cast<const std::uint64_t*>(walks));
    V p[4];
    load_records(
        tag, [&](std::size_t l) HWY_ATTR { return points[walks[l].point].at.data(); }, p);
    Relative<s, V> c;
    for (int i = 0; i < n; ++i) {
        V v[4];
        load_records(
            tag,
            [&](std::size_t l) HWY_ATTR {
                const Place node = cells[walks[l].cell].node[static_cast<std::size_t>(i)];
                return nodes[node].at.data();
            },
            v);
        for (int k = 0; k < d; ++k) c.r[i][k] = v[k] - p[k];
    }
    Fractions<s, V> f;
    solve(c, hn::Zero(tag), f);
    const Bounds<D> bound = filter_bounds<s>(tag, c);

    const V flip = hn::And(f.denominator, hn::SignBit(tag));
    V lowest = hn::Xor(f.numerator[0], flip);
    auto face = hn::Zero(bits);
    for (int i = 1; i < n; ++i) {
        const V numerator = hn::Xor(f.numerator[i], flip);
        face = hn::IfThenElse(hn::RebindMask(bits, hn::Lt(numerator, lowest)), hn::Set(bits, i), face);
        lowest = hn::Min(lowest, numerator);
    }
    const auto inside = hn::RebindMask(bits, hn::And(bound.valid, hn::Gt(lowest, bound.numerator)));
    const auto beyond = hn::RebindMask(bits, hn::And(bound.valid, hn::Lt(lowest, hn::Neg(bound.numerator))));

    // Two neighbours are eight bytes, of which one half is the one asked for. Bits 32 to 63 of a walk are its cell.
    const auto cell = hn::ShiftRight<32>(walk), one = hn::Set(bits, 1);
    static_assert(sizeof(CellRecord) == 32 && offsetof(CellRecord, next) == 16 &&
                  std::endian::native == std::endian::little);
    const auto pair = hn::Add(hn::ShiftLeft<5>(cell), hn::ShiftLeft<2>(hn::AndNot(one, face)));
    const auto two = hn::GatherOffset(bits, reinterpret_cast<const std::uint64_t*>(cells[0].next.data()),
                                      hn::BitCast(hn::RebindToSigned<D>(), pair));
    const auto next = hn::ShiftLeft<32>(hn::Shr(two, hn::ShiftLeft<5>(hn::And(face, one))));
    const auto has_next = hn::Eq(hn::ShiftRight<63>(next), hn::Zero(bits));
    const auto goes_on = hn::And(beyond, has_next);
    const auto point = hn::And(walk, hn::Set(bits, 0xffffffffU));
    const std::size_t going = hn::CompressStore(hn::Or(point, next), goes_on, bits, to.going + to.going_count);
    if constexpr (fetch) {  // what they name is read in the next round
        for (std::size_t l = 0; l < going; ++l) __builtin_prefetch(&cells[to.going[to.going_count + l] >> 32]);
    }
    to.going_count += going;
    append(bits, walk, inside, *to.arrived);
    const auto others = hn::Not(hn::Or(inside, goes_on));
    if (HWY_UNLIKELY(!hn::AllFalse(bits, others))) {
        const auto outside = hn::IfThenElseZero(beyond, hn::Set(bits, 0xffffffff00000000U));
        append(bits, hn::Xor(walk, outside), others, *to.stuck);
    }
}

/// How many vectors ahead the nodes of cells are asked for.
constexpr std::size_t vectors_ahead = 4;

/// How many walks of the next chunk are found between steps.
constexpr std::size_t found_between = 4;

template <Simplex s, std::size_t width>
HWY_INLINE void fetch_nodes(const locate::CellIndex& index, const NodeRecord* nodes, const Walk* walks) {
    for (std::size_t l = 0; l < width; ++l) {
        const auto& node = index.cells[walks[l].cell].node;
        for (std::size_t i = 0; i < vertex_count(s); ++i) __builtin_prefetch(&nodes[static_cast<std::size_t>(node[i])]);
    }
}

template <Simplex s, bool fetch>
std::size_t step_all(const locate::CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                     std::size_t count, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    StepTargets to{reinterpret_cast<std::uint64_t*>(walks), &arrived, &stuck, 0};
    std::size_t at = 0;
    const auto run = [&](auto tag) HWY_ATTR {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        // Copied before the walks that go on are moved over them.
        Walk block[width];
        for (; at + width <= count; at += width) {
            for (std::size_t l = 0; l < width; ++l) block[l] = walks[at + l];
            if (fetch && at + (vectors_ahead + 1) * width <= count)
                fetch_nodes<s, width>(index, nodes, walks + at + vectors_ahead * width);
            upcoming.find(found_between);
            step<s, fetch>(tag, index.cells.data(), nodes, points, block, to);
        }
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
    return to.going_count;
}

std::size_t step_walks(const locate::CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    const auto step = index.simplex == Simplex::triangle
                          ? fetch ? step_all<Simplex::triangle, true> : step_all<Simplex::triangle, false>
                      : fetch ? step_all<Simplex::tetrahedron, true>
                              : step_all<Simplex::tetrahedron, false>;
    return step(index, nodes, points, walks, count, upcoming, arrived, stuck);
}

}  // namespace barycert::locate::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(find_bins);
HWY_EXPORT(find_candidates);
HWY_EXPORT(step_walks);

bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin) {
    return HWY_DYNAMIC_DISPATCH(find_bins)(index, occupancy, points, bin);
}

void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out) {
    HWY_DYNAMIC_DISPATCH(find_candidates)(index, tree, points, which, count, out);
}

std::size_t step_walks(const CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    return HWY_DYNAMIC_DISPATCH(step_walks)(index, nodes, points, walks, count, fetch, upcoming, arrived, stuck);
}

}  // namespace barycert::locate
#endif
