// Internal: lanes of points and triangles.
//
// Included once per SIMD target.
#if defined(BARYCERT_LOCATE_NEAR_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_LOCATE_NEAR_LANES_INL_HPP
#undef BARYCERT_LOCATE_NEAR_LANES_INL_HPP
#else
#define BARYCERT_LOCATE_NEAR_LANES_INL_HPP
#endif

#include "core/error_free-inl.hpp"
#include "core/lane_loop-inl.hpp"
#include "core/numerators-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using Wide = DoubleDouble<Lanes>;
inline constexpr std::size_t width = hn::MaxLanes(Tag());

}  // namespace barycert::locate::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
