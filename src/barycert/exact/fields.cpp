// Gradients, quadratic interpolation and texels.
#include <array>
#include <limits>

#include "barycert/environment.hpp"
#include "barycert/exact/rounding.hpp"
#include "barycert/exact/solve.hpp"
#include "barycert/oracle.hpp"

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

double oracle_quadratic_value(const Case& c, std::span<const double> mids) {
    const ExactEnvironment environment;
    constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    Scales scales(c);
    for (const double f : mids) scales.values.include(f);
    const int low = scales.values.low;
    const Solution<Wide> s = solve<Wide>(c, scales);
    if (s.denominator.sign() == 0) return std::numeric_limits<double>::quiet_NaN();
    const auto& n = s.numerators;
    BigInteger sum(0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(vertex_count(c.simplex)); ++i)
        sum += n[i] * (n[i] + n[i] - s.denominator) * scaled<BigInteger>(c.values[i], low);
    for (std::size_t e = 0; e < mids.size(); ++e)
        sum += ((n[edges[e][0]] * n[edges[e][1]]) << 2) * scaled<BigInteger>(mids[e], low);
    return round_quotient(sum, BigInteger(s.denominator * s.denominator), low);
}

std::int64_t oracle_texel(double u, std::int64_t size, bool repeat) {
    const ExactEnvironment environment;
    const Dyadic d = dyadic(u);
    // floor(u size): a shift of the product, towards minus infinity.
    BigInteger product = BigInteger(d.mantissa) * size, floor = product;
    if (d.exponent >= 0) {
        floor <<= static_cast<unsigned>(d.exponent);
    } else {
        const BigInteger unit = BigInteger(1) << static_cast<unsigned>(-d.exponent);
        BigInteger rest;
        mp::divide_qr(product, unit, floor, rest);
        if (rest.sign() < 0) --floor;
    }
    if (repeat) {
        floor %= size;
        return static_cast<std::int64_t>(floor.sign() < 0 ? BigInteger(floor + size) : floor);
    }
    if (floor.sign() < 0) return 0;
    return floor < size ? static_cast<std::int64_t>(floor) : size - 1;
}

}  // namespace barycert
