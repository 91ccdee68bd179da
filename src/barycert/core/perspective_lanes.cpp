#include "barycert/core/perspective_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/core/perspective_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/lane_loop-inl.hpp"
#include "barycert/core/perspective-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

/// answer(tag, lanes, at, certain) for each vector of points.
template <class Answer>
HWY_INLINE std::size_t for_points(const double* vertices, const PointBlock& points, std::uint32_t* undecided,
                                  Answer answer) {
    return for_padded_lanes(points.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        const auto lanes = project_lanes(tag, vertices, hn::LoadU(tag, points.x + at), hn::LoadU(tag, points.y + at));
        auto certain = lanes.valid;
        answer(tag, lanes, at, certain);
        return certain;
    });
}

std::size_t perspective_weights_of(const double* vertices, const PointBlock& points, double* const* out,
                                   std::uint32_t* undecided) {
    return for_points(vertices, points, undecided,
                      [&](auto tag, const auto& lanes, std::size_t at, auto& certain) BARYCERT_LANE_LAMBDA {
                          for (int i = 0; i < 3; ++i)
                              hn::StoreU(rounded_quotient(tag, perspective_weight(tag, lanes, i), certain), tag,
                                         out[i] + at);
                      });
}

std::size_t perspective_depths_of(const double* vertices, const PointBlock& points, double* out,
                                  std::uint32_t* undecided) {
    return for_points(vertices, points, undecided,
                      [&](auto tag, const auto& lanes, std::size_t at, auto& certain) BARYCERT_LANE_LAMBDA {
                          hn::StoreU(rounded_quotient(tag, perspective_depth(tag, lanes), certain), tag, out + at);
                      });
}

std::size_t perspective_values_of(const double* vertices, const PointBlock& points, const double* values,
                                  int components, double* const* out, std::uint32_t* undecided) {
    return for_points(
        vertices, points, undecided,
        [&](auto tag, const auto& lanes, std::size_t at, auto& certain) BARYCERT_LANE_LAMBDA {
            for (int c = 0; c < components; ++c) {
                const hn::Vec<decltype(tag)> f[3] = {hn::Set(tag, values[c]), hn::Set(tag, values[components + c]),
                                                     hn::Set(tag, values[2 * components + c])};
                hn::StoreU(rounded_quotient(tag, perspective_value(tag, lanes, f), certain), tag, out[c] + at);
            }
        });
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(perspective_weights_of);
HWY_EXPORT(perspective_depths_of);
HWY_EXPORT(perspective_values_of);

std::size_t perspective_weight_lanes(const double* vertices, const PointBlock& points, double* const* out,
                                     std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(perspective_weights_of)(vertices, points, out, undecided);
}

std::size_t perspective_depth_lanes(const double* vertices, const PointBlock& points, double* out,
                                    std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(perspective_depths_of)(vertices, points, out, undecided);
}

std::size_t perspective_value_lanes(const double* vertices, const PointBlock& points, const double* values,
                                    int components, double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(perspective_values_of)(vertices, points, values, components, out, undecided);
}

}  // namespace barycert::core
#endif
