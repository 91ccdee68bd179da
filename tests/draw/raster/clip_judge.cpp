#include "tests/draw/raster/clip_judge.hpp"

namespace barycert {
namespace {

Rational distance(const RationalRow& row, int bound) {
    const Rational& x = row[static_cast<std::size_t>(bound / 2)];
    return bound % 2 == 0 ? row[3] - x : row[3] + x;
}

RationalRow between(const RationalRow& a, const RationalRow& b, const Rational& t) {
    RationalRow c;
    for (std::size_t k = 0; k < a.size(); ++k) c.push_back(a[k] + t * (b[k] - a[k]));
    return c;
}

}  // namespace

std::vector<RationalRow> judge_clip(const std::vector<double>& vertices) {
    const std::size_t row = vertices.size() / 3;
    std::vector<RationalRow> polygon(3);
    for (std::size_t i = 0; i < vertices.size(); ++i) polygon[i / row].push_back(Rational(vertices[i]));
    for (int bound = 0; bound < 6; ++bound) {
        std::vector<RationalRow> left;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const RationalRow &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const Rational from = distance(a, bound), to = distance(b, bound);
            if (from >= Rational(0)) left.push_back(a);
            if (from * to < Rational(0)) left.push_back(between(a, b, from / (from - to)));
        }
        if (left.size() < 3) return {};  // nothing, a corner or an edge
        polygon = left;
    }
    return polygon;
}

}  // namespace barycert
