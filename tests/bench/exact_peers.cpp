#include "exact_peers.hpp"

// Before Highway's headers.
#include "core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact_peers.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace barycert::peers {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

HWY_INLINE void cross(const V (&x)[3], const V (&y)[3], V (&out)[3]) {
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        out[k] = hn::MulSub(x[l], y[m], hn::Mul(x[m], y[l]));
    }
}

HWY_INLINE V dot(const V (&x)[3], const V (&y)[3]) {
    return hn::MulAdd(x[0], y[0], hn::MulAdd(x[1], y[1], hn::Mul(x[2], y[2])));
}

/// n[1] and n[3] with the other sign: the determinants are n[0], -n[1], n[2], -n[3].
HWY_INLINE void determinants(const core::CaseBlock& cases, std::size_t at, V (&n)[4]) {
    const D tag;
    V r[4][3], m01[3], m23[3];
    for (int k = 0; k < 3; ++k) {
        const V p = hn::LoadU(tag, cases.point[k] + at);
        for (int i = 0; i < 4; ++i) r[i][k] = hn::Sub(hn::LoadU(tag, cases.vertices[3 * i + k] + at), p);
    }
    cross(r[0], r[1], m01);
    cross(r[2], r[3], m23);
    n[0] = dot(r[1], m23);
    n[1] = dot(r[0], m23);
    n[2] = dot(r[3], m01);
    n[3] = dot(r[2], m01);
}

void signs(const core::CaseBlock& cases, WeightSigns* out) {
    const D tag;
    const hn::RebindToUnsigned<D> bits;
    const hn::Rebind<WeightSigns::Bits, D> narrow;
    constexpr std::size_t width = hn::MaxLanes(tag);
    for (std::size_t at = 0; at < cases.count; at += width) {
        V n[4];
        determinants(cases, at, n);
        const auto whole = hn::BitCast(bits, hn::Add(hn::Sub(n[0], n[1]), hn::Sub(n[2], n[3])));
        n[1] = hn::Neg(n[1]);
        n[3] = hn::Neg(n[3]);
        auto packed = hn::ShiftLeft<8>(hn::ShiftRight<63>(whole));
        for (int i = 0; i < 4; ++i) {
            const auto differ = hn::ShiftRight<63>(hn::Xor(hn::BitCast(bits, n[i]), whole));
            packed = hn::Or(packed, hn::ShiftLeftSame(differ, i));
        }
        HWY_ALIGN WeightSigns::Bits buffer[width];
        hn::StoreU(hn::TruncateTo(narrow, packed), narrow, buffer);
        for (std::size_t l = 0; l < width; ++l) out[at + l] = WeightSigns(buffer[l]);
    }
}

void values(const core::CaseBlock& cases, const double* const* f, double* out) {
    const D tag;
    for (std::size_t at = 0; at < cases.count; at += hn::MaxLanes(tag)) {
        V n[4];
        determinants(cases, at, n);
        const V whole = hn::Add(hn::Sub(n[0], n[1]), hn::Sub(n[2], n[3]));
        V sum = hn::Mul(n[0], hn::LoadU(tag, f[0] + at));
        sum = hn::NegMulAdd(n[1], hn::LoadU(tag, f[1] + at), sum);
        sum = hn::MulAdd(n[2], hn::LoadU(tag, f[2] + at), sum);
        sum = hn::NegMulAdd(n[3], hn::LoadU(tag, f[3] + at), sum);
        hn::StoreU(hn::Div(sum, whole), tag, out + at);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::peers
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert {

namespace peers {
HWY_EXPORT(signs);
HWY_EXPORT(values);
}  // namespace peers

void peers::plain_signs(const core::CaseBlock& cases, WeightSigns* out) {
    HWY_DYNAMIC_DISPATCH(signs)(cases, out);
}

void peers::plain_values(const core::CaseBlock& cases, const double* const* f, double* out) {
    HWY_DYNAMIC_DISPATCH(values)(cases, f, out);
}

}  // namespace barycert
#endif
