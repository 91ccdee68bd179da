#include "barycert/core/gradient_lanes.hpp"

// Before Highway's headers.
#include "barycert/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/core/gradient_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include "barycert/core/gradient-inl.hpp"
#include "barycert/core/padded_lanes-inl.hpp"

#undef BARYCERT_LANE_LAMBDA
#define BARYCERT_LANE_LAMBDA HWY_ATTR __attribute__((always_inline))

HWY_BEFORE_NAMESPACE();
namespace barycert {
namespace HWY_NAMESPACE {

template <int d>
std::size_t gradients_of(const double* const* vertices, const double* const* values, int components, std::size_t count,
                         double* const* out, std::uint32_t* undecided) {
    return for_padded_lanes(count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        using V = hn::Vec<D>;
        V v[d + 1][d];
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) v[i][k] = hn::LoadU(tag, vertices[d * i + k] + at);
        }
        const auto m = cell_matrix<d>(tag, v);
        auto certain = m.valid;
        for (int c = 0; c < components; ++c) {
            V f[d + 1], g[d];
            for (int i = 0; i <= d; ++i) f[i] = hn::LoadU(tag, values[(d + 1) * c + i] + at);
            gradient_of<d>(tag, m, f, g, certain);
            for (int k = 0; k < d; ++k) hn::StoreU(g[k], tag, out[d * c + k] + at);
        }
        return certain;
    });
}

std::size_t gradients(Simplex s, const double* const* vertices, const double* const* values, int components,
                      std::size_t count, double* const* out, std::uint32_t* undecided) {
    return s == Simplex::triangle ? gradients_of<2>(vertices, values, components, count, out, undecided)
                                  : gradients_of<3>(vertices, values, components, count, out, undecided);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert {

HWY_EXPORT(gradients);

std::size_t lanes::gradients(Simplex s, const double* const* vertices, const double* const* values, int components,
                             std::size_t count, double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(gradients)(s, vertices, values, components, count, out, undecided);
}

}  // namespace barycert
#endif
