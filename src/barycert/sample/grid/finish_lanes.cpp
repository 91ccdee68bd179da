#include "barycert/sample/grid/finish_lanes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/sample/grid/finish_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/base/strict_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One by one: returns true if the point is one of the others.
HWY_INLINE bool finish_point(const FillTarget& target, std::size_t point, const double* outside, FinishedPoints& out) {
    Feature& feature = target.feature[point];
    if (target.owner[point] < 0) {
        if (outside == nullptr) return true;
        ++out.outside;
        std::fill_n(target.values + target.stride * point, target.stride, *outside);
        return false;
    }
    if (feature == Feature::outside) feature = Feature::interior;
    if (lacks_value(feature)) return true;
    out.locations.add(feature);
    ++out.with_value;
    return false;
}

void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out) {
    const hn::ScalableTag<std::int32_t> tag;
    const hn::Rebind<std::int8_t, decltype(tag)> bytes;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<std::int32_t>());
    const auto none = hn::Set(bytes, static_cast<std::int8_t>(Feature::outside));
    const auto interior = hn::Set(bytes, static_cast<std::int8_t>(Feature::interior));
    std::size_t point = first, inside = 0;
    for (; point + width <= last; point += width) {
        auto* const features = reinterpret_cast<std::int8_t*>(target.feature + point);
        const auto known = hn::LoadU(bytes, features);
        const auto unowned = hn::Lt(hn::LoadU(tag, target.owner + point), hn::Zero(tag));
        const std::size_t lost = hn::CountTrue(tag, unowned);
        const bool usual = hn::AllTrue(bytes, hn::Eq(known, none));
        if (usual && lost == 0) {
            hn::StoreU(interior, bytes, features);
            inside += width;
        } else if (usual && lost == width && outside != nullptr) {
            std::fill_n(target.values + target.stride * point, target.stride * width, *outside);
            out.outside += width;
        } else {
            for (std::size_t i = 0; i < width; ++i) {
                if (finish_point(target, point + i, outside, out))
                    out.others.push_back(static_cast<std::uint32_t>(point + i));
            }
        }
    }
    out.locations.add(Feature::interior, inside);
    out.with_value += inside;
    for (; point < last; ++point) {
        if (finish_point(target, point, outside, out)) out.others.push_back(static_cast<std::uint32_t>(point));
    }
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(finish_points);

void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out) {
    HWY_DYNAMIC_DISPATCH(finish_points)(target, first, last, outside, out);
}

}  // namespace barycert::sample
#endif
