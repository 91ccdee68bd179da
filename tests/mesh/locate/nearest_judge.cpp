#include "tests/mesh/locate/nearest_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "barycert/oracle.hpp"
#include "tests/mesh/locate/judge.hpp"

namespace barycert::testing {
namespace {

using Q = mpq_class;
using V = std::array<Q, 3>;

V minus(const V& x, const V& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
Q dot(const V& x, const V& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
V cross(const V& x, const V& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

V vector(const double* x, int d) {
    return {Q(x[0]), Q(x[1]), Q(d == 3 ? x[2] : 0)};
}
V node(const Mesh& mesh, Mesh::Index n) {
    return vector(mesh.points.data() + static_cast<std::ptrdiff_t>(n) * mesh.dimension, mesh.dimension);
}

/// Lowers `best` to the squared distance from p to the segment's or triangle's inside, if its nearest point is there.
void edge(const V& p, const V& a, const V& b, Q& best) {
    const V e = minus(b, a), q = minus(p, a);
    const Q length = dot(e, e), t = dot(q, e);
    if (t <= 0 || t >= length) return;
    best = std::min(best, Q(dot(q, q) - t * t / length));
}
void face(const V& p, const V& a, const V& b, const V& c, Q& best) {
    const V e = minus(b, a), f = minus(c, a), q = minus(p, a), n = cross(e, f);
    const Q square = dot(n, n), beta = dot(cross(q, f), n), gamma = dot(cross(e, q), n);
    if (square == 0 || beta < 0 || gamma < 0 || beta + gamma > square) return;
    const Q height = dot(q, n);
    best = std::min(best, Q(height * height / square));
}

}  // namespace

Q NearestJudge::to_cell(const double* point, Mesh::Index cell) const {
    const V p = vector(point, mesh_.dimension);
    std::vector<V> v;
    for (std::size_t i = 0; i < mesh_.corners(); ++i)
        v.push_back(node(mesh_, mesh_.cells[static_cast<std::size_t>(cell) * mesh_.corners() + i]));
    Q best = dot(minus(p, v[0]), minus(p, v[0]));
    for (std::size_t i = 0; i < v.size(); ++i) {
        best = std::min(best, dot(minus(p, v[i]), minus(p, v[i])));
        for (std::size_t j = i + 1; j < v.size(); ++j) {
            edge(p, v[i], v[j], best);
            for (std::size_t k = j + 1; k < v.size(); ++k) face(p, v[i], v[j], v[k], best);
        }
    }
    return best;
}

Q NearestJudge::to_hull(const double* point, std::span<const Mesh::Index> nodes) const {
    const V p = vector(point, mesh_.dimension), a = node(mesh_, nodes[0]), q = minus(p, a);
    if (nodes.size() == 1) return dot(q, q);
    const V e = minus(node(mesh_, nodes[1]), a);
    if (nodes.size() == 2) return dot(q, q) - dot(q, e) * dot(q, e) / dot(e, e);
    const V n = cross(e, minus(node(mesh_, nodes[2]), a));
    return dot(q, n) * dot(q, n) / dot(n, n);
}

bool NearestJudge::degenerate(Mesh::Index cell) const {
    const std::array<double, 3> origin{};
    return ask_oracle(case_of(mesh_, cell, origin.data())).region == Region::degenerate;
}

TrueNearest NearestJudge::nearest(const double* point) const {
    // Cells in the order of the distance of their boxes: what comes later than the best so far needs no closer look.
    struct Boxed {
        long double square;
        Mesh::Index cell;
    };
    std::vector<Boxed> boxes;
    const auto d = static_cast<std::size_t>(mesh_.dimension);
    const auto away = [&](std::size_t cell, std::size_t k, auto number) {
        using T = decltype(number);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i <= d; ++i) {
            const double x = mesh_.points[d * static_cast<std::size_t>(mesh_.cells[cell * (d + 1) + i]) + k];
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return point[k] < low ? T(T(low) - T(point[k])) : point[k] > high ? T(T(point[k]) - T(high)) : T(0);
    };
    for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
        long double square = 0;
        for (std::size_t k = 0; k < d; ++k) {
            const long double x = away(c, k, 0.0L);
            square += x * x;
        }
        boxes.push_back({square, static_cast<Mesh::Index>(c)});
    }
    std::sort(boxes.begin(), boxes.end(), [](const Boxed& x, const Boxed& y) { return x.square < y.square; });
    TrueNearest best;
    for (const Boxed& box : boxes) {
        if (!best.cells.empty()) {
            Q square = 0;
            for (std::size_t k = 0; k < d; ++k) {
                const Q x = away(static_cast<std::size_t>(box.cell), k, Q(0));
                square += x * x;
            }
            if (square > best.square * Q(1.0000001)) break;  // the order is right to 2^-60
        }
        if (degenerate(box.cell)) continue;
        const Q square = to_cell(point, box.cell);
        if (best.cells.empty() || square < best.square) best = {square, {}};
        if (square == best.square) best.cells.push_back(box.cell);
    }
    std::sort(best.cells.begin(), best.cells.end());
    return best;
}

double ulps_from_root(double computed, const mpq_class& square) {
    const mpf_class root = sqrt(mpf_class(square, 4000));
    if (std::isinf(computed)) return root > mpf_class(std::numeric_limits<double>::max()) ? 0 : computed;
    const double nearly = root.get_d();  // cut off
    const double next = std::nextafter(nearly, std::numeric_limits<double>::infinity());
    if (std::isinf(next)) return 0;
    const mpf_class ulp = mpf_class(next) - nearly;
    return mpf_class(abs(computed - root) / ulp).get_d();
}

}  // namespace barycert::testing
