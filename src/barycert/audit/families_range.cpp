// Families at the ends of the range of doubles, where products and differences under- and overflow.

#include <cmath>
#include <cstddef>

#include "barycert/audit/recipes.hpp"
#include "barycert/base/random.hpp"

namespace barycert::audit {
namespace {

template <int exponent>
void scaled(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return std::ldexp(random.uniform(-1, 1), exponent); });
}

void subnormal(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return random.integer(-4096, 4096) * 0x1p-1074; });
}

void huge(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int) { return random.uniform(-1, 1) * 0.999 * 0x1p1023 * 2; });
}

void mixed_scale(Case& c, base::Random& random, std::uint64_t) {
    fill(c, random, [&](int axis) {
        return std::ldexp(random.uniform(-1, 1), axis == 0 ? 512 : axis == 1 ? -512 : 0);
    });
}

// Products that underflow to zero in one term and are large in another: a filter whose bound ignores underflow
// certifies a wrong sign here.
void filter_underflow(Case& c, base::Random& random, std::uint64_t) {
    const auto m = [&] { return random.uniform(0.5, 2); };
    set_vertex(c, 0, {std::ldexp(m(), -537), 0, std::ldexp(m(), 600)});
    set_vertex(c, 1, {std::ldexp(m(), -537), 0, std::ldexp(m(), 600)});
    set_vertex(c, 2, {0, std::ldexp(m(), -537), 0});
    set_vertex(c, 3, {std::ldexp(m(), 600), std::ldexp(m(), 600), std::ldexp(m(), -537)});
    random_values(c, random);
}

}  // namespace

std::vector<Family> range_families() {
    return {
        built("subnormal", "subnormal coordinates: every product is zero", "k 2^-1074, |k| <= 4096", subnormal, every),
        built("small", "products of three coordinates underflow", "U[-1,1) 2^-400", scaled<-400>, every),
        built("tiny", "products of two coordinates underflow", "U[-1,1) 2^-540", scaled<-540>, every),
        built("large", "products overflow, differences do not", "U[-1,1) 2^600", scaled<600>, every),
        built("huge", "differences and products overflow", "U[-1,1) 0.999 2^1024", huge, every),
        built("mixed-scale", "axes of very different scales", "axes times 2^512, 2^-512, 1", mixed_scale, every),
        built("filter-underflow", "filters whose error bound ignores underflow",
              "face at 2^-537 and 2^600, point at its plane's origin", filter_underflow, tetrahedron_only),
    };
}

}  // namespace barycert::audit
