#include "barycert/audit_pictures.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

#include "barycert/base/random.hpp"
#include "barycert/base/ulp.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"

namespace barycert {
namespace {

/// The first cases: the rim of the 2x2 picture of the notes, and what is just below 0.
constexpr std::array<std::pair<double, std::int64_t>, 2> known_failures{{{1, 2}, {-0x1p-60, 2}}};

/// Of pictures, of powers of two and beside them, and the largest.
std::int64_t texel_count(base::Random& random) {
    constexpr std::array<std::int64_t, 12> usual{1, 2, 3, 5, 7, 100, 255, 256, 257, 1000, 1920, 4096};
    const auto k = random.below(usual.size() + 4);
    if (k < usual.size()) return usual[k];
    return 1 + static_cast<std::int64_t>(random.below(std::uint64_t{1} << random.integer(0, 31)));
}

double some_steps_away(double u, base::Random& random) {
    const int steps = random.integer(-2, 2);
    for (int k = 0; k < steps; ++k) u = base::next_up(u);
    for (int k = 0; k > steps; --k) u = base::next_down(u);
    return u;
}

double coordinate(base::Random& random, std::int64_t size) {
    switch (random.below(6)) {
        case 0:  // a border of texels of the row or of one beside it, and its neighbours
        case 1: {
            const auto k = static_cast<double>(random.below(static_cast<std::uint64_t>(size) + 1));
            const int row = random.integer(-1, 1);
            return some_steps_away(row + k / static_cast<double>(size), random);
        }
        case 2:  // an end of a row
            return some_steps_away(random.integer(-2, 2), random);
        case 3:
            return random.uniform(-2, 3);
        case 4:
            return random.unit();
        default: {  // any finite number
            const double u = std::bit_cast<double>(random.bits());
            return std::isfinite(u) ? u : -0.0;
        }
    }
}

void add(TexelResult& result, double u, std::int64_t size, std::int64_t exact) {
    const std::int64_t texel = result.rule.texel(u, size);
    ++result.cases;
    if (texel == exact) return;
    const auto finding = static_cast<std::size_t>(texel >= size ? TexelFinding::past_end
                                                  : texel < 0   ? TexelFinding::before_start
                                                                : TexelFinding::wrong_texel);
    if (result.counts[finding]++ == 0) result.witnesses[finding] = {u, size, texel, exact};
}

}  // namespace

std::vector<TexelResult> audit_texels(const std::vector<TexelRule>& rules, std::uint64_t count, std::uint64_t seed) {
    const ExactEnvironment environment;
    std::vector<TexelResult> results;
    results.reserve(rules.size());
    for (const TexelRule& rule : rules) results.push_back({rule, 0, {}, {}});
    for (std::uint64_t i = 0; i < count; ++i) {
        base::Random random = base::Random::stream(seed, base::hash64("texels"), i);
        std::int64_t size = texel_count(random);
        double u = coordinate(random, size);
        if (i < known_failures.size()) std::tie(u, size) = known_failures[i];
        for (TexelResult& result : results)
            add(result, u, size, oracle_texel(u, size, result.rule.wrap == TexelWrap::repeat));
    }
    return results;
}

}  // namespace barycert
