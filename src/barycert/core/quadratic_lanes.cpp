#include "barycert/core/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/core/quadratic_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/lane_loop-inl.hpp"
#include "barycert/core/quadratic-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

template <Simplex s>
std::size_t quadratic_values_of(const CaseBlock& cases, const double* const* values, int components, double* const* out,
                                std::uint32_t* undecided) {
    return for_padded_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        constexpr int n = vertex_count(s), d = space_dimension(s), nodes = quadratic_nodes<s>;
        Absolute<s, hn::Vec<D>> c;
        for (int k = 0; k < d; ++k) {
            c.p[k] = hn::LoadU(tag, cases.point[k] + at);
            for (int i = 0; i < n; ++i) c.v[i][k] = hn::LoadU(tag, cases.vertices[d * i + k] + at);
        }
        const auto w = quadratic_weights(tag, refine<s>(tag, c));
        auto certain = w.valid;
        for (int component = 0; component < components; ++component) {
            hn::Vec<D> f[nodes];
            for (int i = 0; i < nodes; ++i) f[i] = hn::LoadU(tag, values[nodes * component + i] + at);
            hn::StoreU(quadratic_value<s>(tag, w, f, certain), tag, out[component] + at);
        }
        return certain;
    });
}

template <Simplex s>
std::size_t plain_quadratic_values_of(const CaseBlock& cases, const double* const* values, int components,
                                      double* const* out, std::uint32_t* undecided) {
    return for_padded_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        constexpr int n = vertex_count(s), nodes = quadratic_nodes<s>;
        Relative<s, hn::Vec<D>> c;
        load_relative<s>(tag, cases.vertices, cases.point, at, c);
        Fractions<s, hn::Vec<D>> fractions;
        solve(c, hn::Zero(tag), fractions);
        const auto one = hn::Set(tag, 1), inverse = one / fractions.denominator;
        hn::Vec<D> l[n];
        for (int i = 0; i < n; ++i) l[i] = fractions.numerator[i] * inverse;
        auto finite = hn::Eq(one, one);
        for (int component = 0; component < components; ++component) {
            const double* const* const f = values + nodes * component;
            hn::Vec<D> sum = hn::Zero(tag);
            for (int i = 0; i < n; ++i) sum = sum + l[i] * (l[i] + l[i] - one) * hn::LoadU(tag, f[i] + at);
            for (int e = 0; e < nodes - n; ++e) {
                const auto product = l[quadratic_edges[e][0]] * l[quadratic_edges[e][1]];
                sum = sum + hn::Set(tag, 4) * product * hn::LoadU(tag, f[n + e] + at);
            }
            finite = hn::And(finite, hn::Eq(sum - sum, hn::Zero(tag)));
            hn::StoreU(sum, tag, out[component] + at);
        }
        return finite;
    });
}

std::size_t quadratic_values(Simplex s, const CaseBlock& cases, const double* const* values, int components,
                             double* const* out, std::uint32_t* undecided) {
    return s == Simplex::triangle
               ? quadratic_values_of<Simplex::triangle>(cases, values, components, out, undecided)
               : quadratic_values_of<Simplex::tetrahedron>(cases, values, components, out, undecided);
}

std::size_t plain_quadratic_values(Simplex s, const CaseBlock& cases, const double* const* values, int components,
                                   double* const* out, std::uint32_t* undecided) {
    return s == Simplex::triangle
               ? plain_quadratic_values_of<Simplex::triangle>(cases, values, components, out, undecided)
               : plain_quadratic_values_of<Simplex::tetrahedron>(cases, values, components, out, undecided);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(quadratic_values);
HWY_EXPORT(plain_quadratic_values);

std::size_t quadratic_lanes(Simplex s, const CaseBlock& cases, const double* const* values, int components,
                            double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(quadratic_values)(s, cases, values, components, out, undecided);
}

std::size_t plain_quadratic_lanes(Simplex s, const CaseBlock& cases, const double* const* values, int components,
                                  double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(plain_quadratic_values)(s, cases, values, components, out, undecided);
}

}  // namespace barycert::core
#endif
