#include "tests/mesh/check/judge.hpp"

#include <CGAL/Gmpz.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace barycert::testing {
namespace {

using CGAL::Gmpz;
__extension__ using Wide = __int128;

/// A finite double is m * 2^e with an odd integer m, or 0.
struct Binary {
    std::int64_t m = 0;
    int e = 0;
    explicit Binary(double x) {
        if (x == 0) return;
        int exponent = 0;
        m = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
        e = exponent - 53;
        while (m % 2 == 0) m /= 2, ++e;
    }
    int bits() const { return m == 0 ? 0 : std::ilogb(std::fabs(static_cast<double>(m))) + 1; }
};

/// The unit of each axis: what divides all coordinates. Axes may be stretched apart: that keeps every incidence.
struct Grid {
    std::array<int, 3> exponent;
    int bits = 0;
    explicit Grid(const Mesh& mesh) {
        exponent.fill(std::numeric_limits<int>::max());
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t pass = 0; pass < 2; ++pass) {
            for (std::size_t i = 0; i < mesh.points.size(); ++i) {
                if (!std::isfinite(mesh.points[i]) || mesh.points[i] == 0) continue;
                const Binary b(mesh.points[i]);
                int& unit = exponent[i % d];
                if (pass == 0) unit = std::min(unit, b.e);
                if (pass == 1) bits = std::max(bits, b.bits() + b.e - unit);
            }
        }
    }
};

template <class N>
N shifted(std::int64_t m, int by) {
    return N(m) * (N(1) << by);
}
template <>
Gmpz shifted<Gmpz>(std::int64_t m, int by) {
    return Gmpz(static_cast<long>(m)) << by;
}

template <class N>
using Vector = std::array<N, 3>;

template <class N>
N dot(const Vector<N>& x, const Vector<N>& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
template <class N>
Vector<N> cross(const Vector<N>& x, const Vector<N>& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
template <class N>
Vector<N> minus(const Vector<N>& x, const Vector<N>& y) {
    return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
template <class N>
bool zero(const Vector<N>& x) {
    return x[0] == N(0) && x[1] == N(0) && x[2] == N(0);
}

/// normal . x >= offset. A plane mesh lies in z = 0, and its cells are prisms along z cut by that plane.
template <class N>
struct HalfSpace {
    Vector<N> normal;
    N offset{};
};

/// x / w.
template <class N>
struct Point {
    Vector<N> x;
    N w{};
};

template <class N>
int side(const HalfSpace<N>& h, const Point<N>& p) {  // w > 0
    const N s = dot(h.normal, p.x) - h.offset * p.w;
    return s > N(0) ? 1 : s < N(0) ? -1 : 0;
}

template <class N>
class Pairs {
public:
    Pairs(const Mesh& mesh, const Grid& grid) : mesh_(mesh), d_(static_cast<std::size_t>(mesh.dimension)) {
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            Vector<N> v{N(0), N(0), N(0)};
            for (std::size_t k = 0; k < d_; ++k) {
                const double c = mesh.points[i * d_ + k];
                if (!std::isfinite(c) || c == 0) continue;
                const Binary b(c);
                v[k] = shifted<N>(b.m, b.e - grid.exponent[k]);
            }
            at_.push_back(v);
        }
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) sides_.push_back(sides_of(c));
    }

    bool proper(std::size_t c) const { return !sides_[c].empty(); }

    Meeting meet(std::size_t a, std::size_t b) const {
        if (boxes_apart(a, b)) return {};
        const std::size_t count = 2 * (d_ + 1);
        std::array<const HalfSpace<N>*, 8> all{};
        for (std::size_t i = 0; i < count; ++i) all[i] = i <= d_ ? &sides_[a][i] : &sides_[b][i - d_ - 1];
        Meeting meeting;
        std::array<bool, 8> tight;
        tight.fill(true);
        const auto look_at = [&](Point<N> p) {
            if (p.w == N(0)) return;
            if (p.w < N(0)) p = {{-p.x[0], -p.x[1], -p.x[2]}, -p.w};
            std::array<int, 8> s{};
            for (std::size_t i = 0; i < count; ++i) {
                s[i] = side(*all[i], p);
                if (s[i] < 0) return;
            }
            meeting.dimension = 0;
            for (std::size_t i = 0; i < count; ++i) tight[i] = tight[i] && s[i] == 0;
            // In a: on the common face if it has no weight at the other corners.
            for (std::size_t i = 0; i <= d_; ++i) {
                if (!common(node(a, i), b) && s[i] != 0) meeting.in_common_face = false;
            }
        };
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (d_ == 2) look_at(cut(*all[i], *all[j], {{N(0), N(0), N(1)}, N(0)}));
                for (std::size_t k = 0; d_ == 3 && k < j; ++k) look_at(cut(*all[i], *all[j], *all[k]));
            }
        }
        if (meeting.dimension == 0) meeting.dimension = static_cast<int>(d_) - rank_of(all, tight, count);
        return meeting;
    }

private:
    Mesh::Index node(std::size_t c, std::size_t i) const { return mesh_.cells[c * (d_ + 1) + i]; }
    const Vector<N>& corner(std::size_t c, std::size_t i) const { return at_[static_cast<std::size_t>(node(c, i))]; }

    bool common(Mesh::Index n, std::size_t c) const {
        const auto first = mesh_.cells.begin() + static_cast<std::ptrdiff_t>(c * (d_ + 1));
        return std::find(first, first + static_cast<std::ptrdiff_t>(d_ + 1), n) != first + mesh_.dimension + 1;
    }

    /// The sides of a cell whose nodes are different, finite and there, and that is not flat; of others none.
    std::vector<HalfSpace<N>> sides_of(std::size_t c) const {
        for (std::size_t i = 0; i <= d_; ++i) {
            if (node(c, i) < 0 || static_cast<std::size_t>(node(c, i)) >= at_.size()) return {};
            for (std::size_t k = 0; k < d_; ++k) {
                if (!std::isfinite(mesh_.points[static_cast<std::size_t>(node(c, i)) * d_ + k])) return {};
            }
        }
        std::vector<HalfSpace<N>> sides;
        for (std::size_t i = 0; i <= d_; ++i) {
            const Vector<N>&p = corner(c, (i + 1) % (d_ + 1)), &q = corner(c, (i + 2) % (d_ + 1));
            const Vector<N> up{N(0), N(0), N(1)};
            HalfSpace<N> h{cross(minus(q, p), d_ == 2 ? up : minus(corner(c, (i + 3) % (d_ + 1)), p)), N(0)};
            h.offset = dot(h.normal, p);
            const int s = side(h, Point<N>{corner(c, i), N(1)});
            if (s == 0) return {};
            if (s < 0) h = {{-h.normal[0], -h.normal[1], -h.normal[2]}, -h.offset};
            sides.push_back(h);
        }
        return sides;
    }

    bool boxes_apart(std::size_t a, std::size_t b) const {
        for (std::size_t k = 0; k < d_; ++k) {
            bool below = true, above = true;
            for (std::size_t i = 0; i <= d_; ++i) {
                for (std::size_t j = 0; j <= d_; ++j) {
                    below = below && corner(a, i)[k] < corner(b, j)[k];
                    above = above && corner(a, i)[k] > corner(b, j)[k];
                }
            }
            if (below || above) return true;
        }
        return false;
    }

    /// Where three planes meet (w = 0: in no single point), by Cramer's rule.
    static Point<N> cut(const HalfSpace<N>& f, const HalfSpace<N>& g, const HalfSpace<N>& h) {
        const Vector<N> gh = cross(g.normal, h.normal), hf = cross(h.normal, f.normal), fg = cross(f.normal, g.normal);
        Point<N> p{{}, dot(f.normal, gh)};
        if (p.w == N(0)) return p;
        for (std::size_t k = 0; k < 3; ++k) p.x[k] = f.offset * gh[k] + g.offset * hf[k] + h.offset * fg[k];
        return p;
    }

    /// The rank of the normals of those half-spaces whose planes hold all extreme points.
    static int rank_of(const std::array<const HalfSpace<N>*, 8>& all, const std::array<bool, 8>& tight,
                       std::size_t count) {
        int rank = 0;
        Vector<N> line{}, plane{};
        for (std::size_t i = 0; i < count; ++i) {
            if (!tight[i]) continue;
            const Vector<N>& n = all[i]->normal;
            if (rank == 0) {
                line = n, rank = 1;
            } else if (rank == 1 && !zero(cross(line, n))) {
                plane = cross(line, n), rank = 2;
            } else if (rank == 2 && dot(plane, n) != N(0)) {
                return 3;
            }
        }
        return rank;
    }

    const Mesh& mesh_;
    std::size_t d_;
    std::vector<Vector<N>> at_;
    std::vector<std::vector<HalfSpace<N>>> sides_;
};

bool repeats(const Mesh& mesh, std::size_t c) {
    const auto n = mesh.corners();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (mesh.cells[c * n + i] == mesh.cells[c * n + j]) return true;
        }
    }
    return false;
}

bool has_place(const Mesh& mesh, std::size_t c) {
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        const Mesh::Index n = mesh.cells[c * mesh.corners() + i];
        if (n < 0 || static_cast<std::size_t>(n) >= mesh.point_count()) return false;
        for (int k = 0; k < mesh.dimension; ++k) {
            if (!std::isfinite(mesh.points[static_cast<std::size_t>(n * mesh.dimension + k)])) return false;
        }
    }
    return true;
}

template <class N>
Judgement judge_in(const Mesh& mesh, const Grid& grid, std::size_t first) {
    const Pairs<N> pairs(mesh, grid);
    Judgement j;
    for (std::size_t a = first; a < mesh.cell_count(); ++a) {
        j.complex = j.complex && pairs.proper(a);
        if (!pairs.proper(a) && has_place(mesh, a) && !repeats(mesh, a)) ++j.degenerate;
    }
    for (std::size_t a = 0; a < mesh.cell_count(); ++a) {
        for (std::size_t b = std::max(a + 1, first); pairs.proper(a) && b < mesh.cell_count(); ++b) {
            if (!pairs.proper(b)) continue;
            const Meeting m = pairs.meet(a, b);
            if (m.dimension == mesh.dimension)
                j.overlaps.push_back({static_cast<Mesh::Index>(a), static_cast<Mesh::Index>(b)});
            j.complex = j.complex && m.in_common_face && m.dimension < mesh.dimension;
        }
    }
    return j;
}

/// f.operator()<N>() with a number that has room: with coordinates of B bits, edges have B + 1, normals 2 B + 3,
/// offsets 3 B + 5, numerators of points 7 B + 14 and what side() adds up 9 B + 19.
template <class F>
auto with_numbers(const Grid& grid, F f) {
    if (9 * grid.bits + 19 <= 62) return f.template operator()<std::int64_t>();
    if (9 * grid.bits + 19 <= 126) return f.template operator()<Wide>();
    return f.template operator()<Gmpz>();
}

}  // namespace

Judgement judge(const Mesh& mesh, std::size_t first) {
    const Grid grid(mesh);
    return with_numbers(grid, [&]<class N>() { return judge_in<N>(mesh, grid, first); });
}

Meeting meeting(const Mesh& mesh, Mesh::Index a, Mesh::Index b) {
    const Grid grid(mesh);
    return with_numbers(grid, [&]<class N>() {
        return Pairs<N>(mesh, grid).meet(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    });
}

}  // namespace barycert::testing
