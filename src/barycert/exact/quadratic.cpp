#include "barycert/oracle.hpp"

#include <array>
#include <limits>

#include "barycert/environment.hpp"
#include "barycert/exact/rounding.hpp"
#include "barycert/exact/solve.hpp"

namespace barycert {

using namespace exact;

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

}  // namespace barycert
