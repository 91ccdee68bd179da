#include "barycert/environment.hpp"
#include "barycert/exact/integers.hpp"
#include "barycert/oracle.hpp"

namespace barycert {

using namespace exact;

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
