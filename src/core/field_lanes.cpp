// Fields in their cells: gradients, quadratic values, and values in perspective.
#include <cstddef>
#include <cstdint>
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field_lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/gradient-inl.hpp"
#include "core/lane_loop-inl.hpp"
#include "core/perspective-inl.hpp"
#include "core/quadratic-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

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

template <Simplex s>
std::size_t quadratic_values_of(const CaseBlock& cases, const double* const* values, int components, double* const* out,
                                std::uint32_t* undecided) {
    return for_padded_lanes(cases.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        using D = decltype(tag);
        constexpr int nodes = quadratic_nodes<s>;
        const auto w = quadratic_weights(tag, refine<s>(tag, load_absolute<s>(tag, cases.vertices, cases.point, at)));
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
        const PlainWeights<s, D> plain(tag, c);
        const auto one = hn::Set(tag, 1);
        hn::Vec<D> l[n];
        for (int i = 0; i < n; ++i) l[i] = plain.f.numerator[i] * plain.inverse;
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

std::size_t quadratic_values(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* values,
                             int components, double* const* out, std::uint32_t* undecided) {
    constexpr auto triangle = Simplex::triangle, tetrahedron = Simplex::tetrahedron;
    const bool flat = s == triangle;
    const auto values_of = rounding == Rounding::plain
                               ? (flat ? plain_quadratic_values_of<triangle> : plain_quadratic_values_of<tetrahedron>)
                               : (flat ? quadratic_values_of<triangle> : quadratic_values_of<tetrahedron>);
    return values_of(cases, values, components, out, undecided);
}

template <PerspectiveAnswer what>
std::size_t perspective_of(const double* vertices, const CaseBlock& points, const double* values, int components,
                           double* const* out, std::uint32_t* undecided) {
    return for_padded_lanes(points.count, undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        const auto lanes =
            project_lanes(tag, vertices, hn::LoadU(tag, points.point[0] + at), hn::LoadU(tag, points.point[1] + at));
        auto certain = lanes.valid;
        const auto put = [&](const auto& quotient, int i)
                             HWY_ATTR { hn::StoreU(rounded_quotient(tag, quotient, certain), tag, out[i] + at); };
        if constexpr (what == PerspectiveAnswer::weights) {
            for (int i = 0; i < 3; ++i) put(perspective_weight(tag, lanes, i), i);
        } else if constexpr (what == PerspectiveAnswer::depth) {
            put(perspective_depth(tag, lanes), 0);
        } else {
            for (int c = 0; c < components; ++c) {
                const hn::Vec<decltype(tag)> f[3] = {hn::Set(tag, values[c]), hn::Set(tag, values[components + c]),
                                                     hn::Set(tag, values[2 * components + c])};
                put(perspective_value(tag, lanes, f), c);
            }
        }
        return certain;
    });
}

std::size_t perspective(PerspectiveAnswer what, const double* vertices, const CaseBlock& points, const double* values,
                        int components, double* const* out, std::uint32_t* undecided) {
    const auto answers = what == PerspectiveAnswer::weights ? perspective_of<PerspectiveAnswer::weights>
                         : what == PerspectiveAnswer::depth ? perspective_of<PerspectiveAnswer::depth>
                                                            : perspective_of<PerspectiveAnswer::values>;
    return answers(vertices, points, values, components, out, undecided);
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(gradients);
HWY_EXPORT(quadratic_values);
HWY_EXPORT(perspective);

std::size_t gradient_lanes(Simplex s, const CaseBlock& cells, const double* const* values, int components,
                           double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(gradients)(s, cells, values, components, out, undecided);
}

std::size_t quadratic_lanes(Rounding rounding, Simplex s, const CaseBlock& cases, const double* const* values,
                            int components, double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(quadratic_values)(rounding, s, cases, values, components, out, undecided);
}

std::size_t perspective_lanes(PerspectiveAnswer what, const double* vertices, const CaseBlock& points,
                              const double* values, int components, double* const* out, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(perspective)(what, vertices, points, values, components, out, undecided);
}

}  // namespace barycert::core
#endif
