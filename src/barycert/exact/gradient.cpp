#include "barycert/oracle.hpp"

#include <limits>

#include "barycert/environment.hpp"
#include "barycert/exact/rounding.hpp"
#include "barycert/exact/solve.hpp"

namespace barycert {

using namespace exact;

namespace {

using Numbers = std::array<BigInteger, 3>;

/// The gradient of weight i times the denominator, each axis in the product of the units of the others.
Numbers weight_gradient(Simplex s, const std::array<Vector<Wide>, 4>& v, std::size_t i) {
    if (s == Simplex::triangle) {
        const auto e = difference<Wide>(v[(i + 1) % 3], v[(i + 2) % 3]);
        return {e[1], -e[0], BigInteger(0)};
    }
    constexpr std::array<std::array<std::size_t, 3>, 4> opposite{{{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}}};
    const auto [a, b, c] = opposite[i];
    const Numbers normal = cross<Wide>(difference<Wide>(v[b], v[a]), difference<Wide>(v[c], v[a]));
    return {-normal[0], -normal[1], -normal[2]};
}

}  // namespace

GradientAnswer oracle_gradient(const Case& c) {
    const ExactEnvironment environment;
    const auto d = static_cast<std::size_t>(space_dimension(c.simplex));
    Case at_vertex = c;
    for (std::size_t k = 0; k < d; ++k) at_vertex.point[k] = c.vertex(0, static_cast<int>(k));
    const Scales scales(at_vertex);
    const auto v = relative_vertices<Wide>(at_vertex, scales);
    const auto e = difference<Wide>(v[1], v[0]), f = difference<Wide>(v[2], v[0]);
    const BigInteger whole = d == 2 ? cross<Wide>(e, f)[2] : dot(cross<Wide>(e, f), difference<Wide>(v[3], v[0]));
    GradientAnswer answer;
    if (whole.sign() == 0) {
        answer.degenerate = true;
        answer.gradient.fill(std::numeric_limits<double>::quiet_NaN());
        return answer;
    }
    Numbers sum{};
    for (std::size_t i = 0; i <= d; ++i) {
        const Numbers g = weight_gradient(c.simplex, v, i);
        for (std::size_t k = 0; k < d; ++k) sum[k] += g[k] * scaled<BigInteger>(c.values[i], scales.values.low);
    }
    for (std::size_t k = 0; k < d; ++k)
        answer.gradient[k] = round_quotient(sum[k], whole, scales.values.low - scales.axes[k].low);
    return answer;
}

}  // namespace barycert
