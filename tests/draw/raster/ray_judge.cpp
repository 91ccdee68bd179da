#include "tests/draw/raster/ray_judge.hpp"

namespace barycert {

std::optional<RayHit> cast_ray(const std::vector<double>& rows, RasterSize size, std::int32_t i, std::int32_t j) {
    const std::size_t row = rows.size() / 3;
    const auto at = [&](std::size_t vertex, std::size_t k) { return Rational(rows[row * vertex + k]); };
    const Rational x = Rational(2 * i + 1) / Rational(size.width) - Rational(1);
    const Rational y = Rational(2 * j + 1) / Rational(size.height) - Rational(1);
    // Weights with sum w_i (x_i - x w) = 0 and the same for y: orthogonal to both rows of numbers.
    Rational p[3], q[3], weight[3];
    for (std::size_t v = 0; v < 3; ++v) {
        p[v] = at(v, 0) - x * at(v, 3);
        q[v] = at(v, 1) - y * at(v, 3);
    }
    Rational sum(0);
    for (std::size_t v = 0; v < 3; ++v) {
        weight[v] = p[(v + 1) % 3] * q[(v + 2) % 3] - p[(v + 2) % 3] * q[(v + 1) % 3];
        sum += weight[v];
    }
    if (sum == Rational(0)) return std::nullopt;
    const auto value = [&](std::size_t k) {
        Rational total(0);
        for (std::size_t v = 0; v < 3; ++v) total += weight[v] * at(v, k);
        return Rational(total / sum);
    };
    for (const Rational& w : weight) {
        if (w / sum < Rational(0)) return std::nullopt;
    }
    const Rational w = value(3);
    if (w <= Rational(0)) return std::nullopt;
    RayHit hit{value(2) / w, {}};
    if (magnitude(hit.depth) > Rational(1)) return std::nullopt;
    for (std::size_t k = 4; k < row; ++k) hit.attributes.push_back(value(k));
    return hit;
}

}  // namespace barycert
