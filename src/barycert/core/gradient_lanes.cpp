#include "barycert/core/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/core/gradient_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/gradient-inl.hpp"
#include "barycert/core/lane_loop-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

template <int d>
std::size_t gradients_of(const CaseBlock& cells, const double* const* values, int components, double* const* out,
                         std::uint32_t* undecided) {
    return for_padded_lanes(cells.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        using V = hn::Vec<D>;
        V v[d + 1][d];
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) v[i][k] = hn::LoadU(tag, cells.vertices[d * i + k] + at);
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

std::size_t gradients(Simplex s, const CaseBlock& cells, const double* const* values, int components,
                      double* const* out, std::uint32_t* undecided) {
    return s == Simplex::triangle ? gradients_of<2>(cells, values, components, out, undecided)
                                  : gradients_of<3>(cells, values, components, out, undecided);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(gradients);

std::size_t gradient_lanes(Simplex s, const CaseBlock& cells, const double* const* values, int components,
                           double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(gradients)(s, cells, values, components, out, undecided);
}

}  // namespace barycert::core
#endif
