#include "barycert/raster/fill_rows.hpp"

#include <algorithm>

namespace barycert::raster {

ValuedEdges::ValuedEdges(const SortedTriangle& t, const double* vertices, std::span<const double> values,
                         int components)
    : middle(t.middle) {
    const auto values_of = [&](const double* vertex) { return values.data() + (vertex - vertices) / 2 * components; };
    const auto edge = [&](const double* a, const double* b) { return ValuedEdge{a, b, values_of(a), values_of(b)}; };
    whole = edge(t.vertex[0], t.vertex[2]);
    lower = edge(t.vertex[0], t.vertex[1]);
    upper = edge(t.vertex[1], t.vertex[2]);
}

void BilinearRows::fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) const {
    const double y = j + 0.5;
    const ValuedEdge &p = edges_.whole, &q = edges_.shorter(j);
    const double tp = (y - p.a[1]) / (p.b[1] - p.a[1]), tq = (y - q.a[1]) / (q.b[1] - q.a[1]);
    const double xp = p.a[0] + tp * (p.b[0] - p.a[0]), xq = q.a[0] + tq * (q.b[0] - q.a[0]);
    const double inverse = xp == xq ? 0 : 1 / (xq - xp);
    for (std::int32_t i = first; i < last; ++i) {
        const double r = (i + 0.5 - xp) * inverse, s = r > 0 ? std::min(r, 1.0) : 0;  // 0 for NaN too
        for (std::size_t c = 0; c < components_; ++c) {
            const double fp = p.fa[c] + tp * (p.fb[c] - p.fa[c]), fq = q.fa[c] + tq * (q.fb[c] - q.fa[c]);
            *out++ = fp + s * (fq - fp);
        }
    }
}

ScanlineRows::ScanlineRows(const SortedTriangle& t, const double* vertices, std::span<const double> values,
                           int components)
    : components_(static_cast<std::size_t>(components)),
      row_(t.begin),
      at_(components_),
      up_(components_),
      along_(components_),
      here_(components_) {
    const ValuedEdges edges(t, vertices, values, components);
    const ValuedEdge &p = edges.whole, &q = edges.lower;
    const double x1 = q.b[0] - q.a[0], y1 = q.b[1] - q.a[1], x2 = p.b[0] - p.a[0], y2 = p.b[1] - p.a[1];
    const double area = x1 * y2 - x2 * y1, start = (row_ + 0.5) - p.a[1];
    x_step_ = x2 / y2;
    x_ = p.a[0] + start * x_step_;
    for (std::size_t c = 0; c < components_; ++c) {
        const double f1 = q.fb[c] - q.fa[c], f2 = p.fb[c] - p.fa[c];
        up_[c] = f2 / y2;
        at_[c] = p.fa[c] + start * up_[c];
        along_[c] = (f1 * y2 - f2 * y1) / area;
    }
}

void ScanlineRows::fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) {
    for (; row_ < j; ++row_) {
        x_ += x_step_;
        for (std::size_t c = 0; c < components_; ++c) at_[c] += up_[c];
    }
    for (std::size_t c = 0; c < components_; ++c) here_[c] = at_[c] + (first + 0.5 - x_) * along_[c];
    for (std::int32_t i = first; i < last; ++i) {
        for (std::size_t c = 0; c < components_; ++c) {
            *out++ = here_[c];
            here_[c] += along_[c];
        }
    }
}

void CorrectRows::fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) {
    constexpr std::array<std::int32_t, 3> corners{0, 1, 2};
    const auto count = static_cast<std::size_t>(last - first);
    cells_.assign(count, 0);
    set_centres(j, first, last, points_);
    // No error can occur: sizes fit, and coordinates are finite.
    (void)interpolate(MeshQueries{Simplex::triangle, vertices_, corners, cells_, points_},
                      NodalValues<double>{values_, components_}, {out, count * static_cast<std::size_t>(components_)});
}

void set_centres(std::int32_t j, std::int32_t first, std::int32_t last, std::vector<double>& points) {
    points.clear();
    for (std::int32_t i = first; i < last; ++i) points.insert(points.end(), {i + 0.5, j + 0.5});
}

}  // namespace barycert::raster
