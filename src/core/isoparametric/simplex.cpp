// Curved simplices: their nodes, Bernstein coefficients, and where points are in them.
#include <tuple>

#include "core/isoparametric/bernstein.hpp"
#include "core/isoparametric/newton.hpp"

namespace barycert::core::isoparametric {
namespace {

/// Multi-indices of the nodes as VTK's vtkLagrangeTriangle and vtkLagrangeTetra number them.
constexpr std::array<std::string_view, 6> node_orders{
    "200 020 002 110 011 101",
    "300 030 003 210 120 021 012 102 201 111",
    "400 040 004 310 220 130 031 022 013 103 202 301 211 121 112",
    "2000 0200 0020 0002 1100 0110 1010 1001 0101 0011",
    "3000 0300 0030 0003 2100 1200 0210 0120 1020 2010 2001 1002 0201 0102 0021 0012 1101 0111 1011 1110",
    "4000 0400 0040 0004 3100 2200 1300 0310 0220 0130 1030 2020 3010 3001 2002 1003 0301 0202 0103 0031 0022 0013 "
    "2101 1201 1102 0121 0112 0211 2011 1012 1021 2110 1120 1210 1111"};

Reference reference_of(std::size_t which) {
    const bool flat = which < 3;
    Reference r{flat ? Element::triangle : Element::tetrahedron, static_cast<int>(which % 3) + 2, 0, 1, {}};
    for (int k = 2; k <= r.order; ++k) r.scale *= k;
    const std::string_view text = node_orders[which];
    for (std::size_t at = 0; at < text.size(); at += flat ? 4 : 5) {
        auto& index = r.indices.emplace_back();
        for (std::size_t c = 0; c < (flat ? 3U : 4U); ++c) index[c] = static_cast<std::uint8_t>(text[at + c] - '0');
    }
    r.nodes = r.indices.size();
    return r;
}

using Index = std::array<std::uint8_t, 4>;

int sum_of(const Index& i) {
    return i[0] + i[1] + i[2] + i[3];
}

int multinomial(const Index& i) {
    constexpr std::array<int, 13> factorial{1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880};
    int n = factorial[static_cast<std::size_t>(sum_of(i))];
    for (const std::uint8_t k : i) n /= factorial[k];
    return n;
}

/// Bernstein coefficients from values at nodes: rows of whole numbers over one denominator.
struct ToBernstein {
    std::vector<std::vector<double>> rows;
    double denominator = 1;
};

ToBernstein to_bernstein(const Reference& of) {
    const std::size_t n = of.nodes;
    std::vector<std::vector<Rational>> a(n, std::vector<Rational>(2 * n));
    for (std::size_t node = 0; node < n; ++node) {
        for (std::size_t j = 0; j < n; ++j) {
            Rational value = multinomial(of.indices[j]);
            for (std::size_t c = 0; c < 4; ++c) {
                for (int k = 0; k < of.indices[j][c]; ++k) value *= Rational(of.indices[node][c]) / of.order;
            }
            a[node][j] = value;
        }
        a[node][n + node] = 1;
    }
    eliminate(a, n);
    boost::multiprecision::cpp_int common = 1;
    for (const auto& row : a) {
        for (const Rational& x : row) common = lcm(common, boost::multiprecision::cpp_int(denominator(x)));
    }
    ToBernstein out;
    out.denominator = common.convert_to<double>();
    for (std::size_t i = 0; i < n; ++i) {
        auto& row = out.rows.emplace_back();
        for (std::size_t j = 0; j < n; ++j) row.push_back(Rational(a[i][n + j] * common).convert_to<double>());
    }
    return out;
}

struct Simplex {
    Reference reference;
    ToBernstein bernstein;
    /// Coefficient i of the derivative by coordinate k: control points `by[k]` less `by[-]`, of index `index`.
    struct Slope {
        Index index;
        std::size_t base;
        std::array<std::size_t, 3> by;
    };
    std::vector<Slope> slopes;
    /// For each multi-index of a degree: the indices of the next degree that have one more of a corner.
    using Level = std::vector<std::array<std::uint8_t, 4>>;
    std::vector<Level> levels;  ///< of degree order - 1, order - 2, ...
};

const std::array<Simplex, 6>& simplices() {
    static const std::array<Simplex, 6> all = [] {
        std::array<Simplex, 6> made;
        for (std::size_t i = 0; i < made.size(); ++i) {
            Simplex& s = made[i];
            s.reference = reference_of(i);
            s.bernstein = to_bernstein(s.reference);
            const auto place = [&](const Index& index) {
                return static_cast<std::size_t>(std::ranges::find(s.reference.indices, index) -
                                                s.reference.indices.begin());
            };
            for (const Index& index : s.reference.indices) {
                if (index[0] == 0) continue;
                Simplex::Slope slope{index, place(index), {}};
                --slope.index[0];
                for (std::size_t k = 0; k < s.reference.dimension(); ++k) {
                    Index raised = slope.index;
                    ++raised[k + 1];
                    slope.by[k] = place(raised);
                }
                s.slopes.push_back(slope);
            }
            std::vector<Index> above = s.reference.indices;
            for (int degree = s.reference.order - 1; degree >= 0; --degree) {
                Simplex::Level level;
                std::vector<Index> indices;
                for (const Index& index : above) {
                    Index lower = index;
                    if (lower[0] == 0) continue;
                    --lower[0];
                    std::array<std::uint8_t, 4> raised{};
                    for (std::size_t c = 0; c <= s.reference.dimension(); ++c) {
                        Index own = lower;
                        ++own[c];
                        raised[c] = static_cast<std::uint8_t>(std::ranges::find(above, own) - above.begin());
                    }
                    indices.push_back(lower);
                    level.push_back(raised);
                }
                above = std::move(indices);
                s.levels.push_back(std::move(level));
            }
        }
        return made;
    }();
    return all;
}

const Simplex& simplex_of(const Reference& of) {
    return *std::ranges::find_if(simplices(), [&](const Simplex& s) { return &s.reference == &of; });
}

/// Control points times the denominator, of nodes at place(node, axis).
template <class N, class Place>
std::vector<Vector<N>> control_points(const Simplex& s, const Place& place) {
    const std::size_t d = s.reference.dimension(), n = s.reference.nodes;
    std::vector<Vector<N>> points(n, Vector<N>{N(0), N(0), N(0)});
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double factor = s.bernstein.rows[i][j];
            if (factor == 0) continue;
            for (std::size_t k = 0; k < d; ++k) points[i][k] = points[i][k] + N(factor) * place(j, k);
        }
    }
    return points;
}

/// Bernstein coefficients of the Jacobian, times one positive number. It is a sum over a coefficient of each
/// derivative; those whose indices have one sum make a coefficient of its own.
template <class N, class Place>
std::vector<N> jacobian_coefficients(const Simplex& s, const Place& place) {
    const std::vector<Vector<N>> points = control_points<N>(s, place);
    const std::size_t d = s.reference.dimension(), m = s.slopes.size();
    std::array<std::vector<Vector<N>>, 3> v;
    for (std::size_t k = 0; k < d; ++k) {
        for (const auto& slope : s.slopes) {
            auto& own = v[k].emplace_back();
            for (std::size_t j = 0; j < 3; ++j) own[j] = points[slope.by[k]][j] - points[slope.base][j];
        }
    }
    if (d == 2) v[2].push_back({N(0), N(0), N(1)});
    const BernsteinBasis& basis = jacobian_basis(s.reference);
    std::vector<N> sums(basis.size(), N(0));
    for (std::size_t a = 0; a < m; ++a) {
        for (std::size_t b = 0; b < m; ++b) {
            const Vector<N> cross = base::cross(v[0][a], v[1][b]);
            for (std::size_t c = 0; c < v[2].size(); ++c) {
                const Index &i = s.slopes[a].index, &j = s.slopes[b].index;
                BernsteinBasis::Index sum{};
                int weight = multinomial(i) * multinomial(j);
                for (std::size_t k = 0; k < 4; ++k) sum[k] = static_cast<std::uint8_t>(i[k] + j[k]);
                if (d == 3) {
                    const Index& l = s.slopes[c].index;
                    weight *= multinomial(l);
                    for (std::size_t k = 0; k < 4; ++k) sum[k] = static_cast<std::uint8_t>(sum[k] + l[k]);
                }
                N& own = sums[basis.place(sum)];
                own = own + N(weight) * base::dot(cross, v[2][c]);
            }
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[i] * N(basis.factorials(i));
    return sums;
}

double middle(const Places& places, std::size_t node, std::size_t k, double scale) {
    const double x = places.at[node][k] * scale;
    return places.other[node] == nullptr ? x : x / 2 + places.other[node][k] * scale / 2;
}

/// Control points in double, each off by at most 2^-40 of the largest coordinate: sums of at most 35 products with
/// factors below 100 times the denominator.
std::vector<Vector<double>> rounded_control_points(const Simplex& s, const Places& places, double scale) {
    auto points =
        control_points<double>(s, [&](std::size_t node, std::size_t k) { return middle(places, node, k, scale); });
    for (auto& p : points) {
        for (double& x : p) x /= s.bernstein.denominator;
    }
    return points;
}
constexpr double control_error = 0x1p-40;

/// Whether no point of the cell is at zero, of control points from there. A box of the reference cell may be left out.
class Search {
public:
    using Coordinates = std::array<double, 4>;   ///< barycentric ones in the reference cell
    using Corners = std::array<Coordinates, 4>;  ///< of a part of it

    explicit Search(const Simplex& s) : s_(s) {}

    /// Leaves out a simplex like the reference cell around `x`, where zero is taken, in which it is taken nowhere else:
    /// with Y about the inverse of the Jacobian there, |1 - Y X'| < 1/2 in all of it. The largest that is found.
    void leave_out_around(const std::vector<Vector<double>>& points, const Vector<double>& x, const Matrix& y) {
        middle_ = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
        for (radius_ = 2; radius_ > 0x1p-20; radius_ /= 2) {
            if (contracts(restricted(points, around()), y)) return;
        }
        radius_ = 0;
    }

    /// Certainly not in the part of the cell with those corners: it is cut at the middle of its longest edge, `depth`
    /// times at most.
    bool excludes(const std::vector<Vector<double>>& points, const Corners& at, int depth) const {
        if (apart(restricted(points, at)) || left_out(at)) return true;
        if (depth == 0) return false;
        const std::size_t corners = s_.reference.dimension() + 1;
        std::size_t a = 0, b = 1;
        double longest = 0;
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                double square = 0;
                for (std::size_t k = 1; k < 4; ++k) square += (at[i][k] - at[j][k]) * (at[i][k] - at[j][k]);
                if (square > longest) std::tie(longest, a, b) = std::tuple(square, i, j);
            }
        }
        for (const std::size_t gone : {a, b}) {
            Corners half = at;
            for (std::size_t k = 0; k < 4; ++k) half[gone][k] = (at[a][k] + at[b][k]) / 2;
            if (!excludes(points, half, depth - 1)) return false;
        }
        return true;
    }

    /// On one side of a plane: along an axis, or across the middle of the control points.
    bool apart(const std::vector<Vector<double>>& points) const {
        const std::size_t d = s_.reference.dimension();
        const auto beyond = [&](const Vector<double>& n) {
            double low = HUGE_VAL, high = -HUGE_VAL, size = 0;
            for (const auto& p : points) {
                const double x = n[0] * p[0] + n[1] * p[1] + (d == 3 ? n[2] * p[2] : 0);
                low = std::min(low, x);
                high = std::max(high, x);
            }
            for (std::size_t k = 0; k < d; ++k) size += std::abs(n[k]);
            const double off = 4 * control_error * size;
            return low > off || high < -off;
        };
        Vector<double> sum{};
        for (std::size_t k = 0; k < d; ++k) {
            Vector<double> axis{};
            axis[k] = 1;
            if (beyond(axis)) return true;
            for (const auto& p : points) sum[k] += p[k];
        }
        if (beyond(sum)) return true;
        // Across the facets of the corners.
        const std::size_t corners = d + 1;
        for (std::size_t c = 0; c < corners; ++c) {
            const auto& p = points[(c + 1) % corners];
            const auto& q = points[(c + 2) % corners];
            const auto& r = points[(c + 3) % corners];
            const auto n = d == 2 ? Vector<double>{q[1] - p[1], p[0] - q[0], 0}
                                  : base::cross(base::minus(q, p), base::minus(r, p));
            if (beyond(n)) return true;
        }
        return false;
    }

private:
    bool left_out(const Corners& at) const {
        const std::size_t corners = s_.reference.dimension() + 1;
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t c = 0; c < corners; ++c) {
                if (!(at[i][c] - middle_[c] >= -0.999 * radius_ / static_cast<double>(corners))) return false;
            }
        }
        return radius_ > 0;
    }

    /// Control points over the simplex with those corners, by de Casteljau's algorithm: at one of them in each step.
    std::vector<Vector<double>> restricted(const std::vector<Vector<double>>& points, const Corners& at) const {
        const std::size_t corners = s_.reference.dimension() + 1;
        std::vector<Vector<double>> all, level, next;
        for (const Index& of : s_.reference.indices) {
            level = points;
            std::size_t degree = 0;
            for (std::size_t corner = 0; corner < corners; ++corner) {
                for (int k = 0; k < of[corner]; ++k, ++degree) {
                    const Simplex::Level& raised = s_.levels[degree];
                    next.assign(raised.size(), {});
                    for (std::size_t i = 0; i < raised.size(); ++i) {
                        for (std::size_t c = 0; c < corners; ++c) {
                            for (std::size_t j = 0; j < 3; ++j) next[i][j] += at[corner][c] * level[raised[i][c]][j];
                        }
                    }
                    std::swap(level, next);
                }
            }
            all.push_back(level.front());
        }
        return all;
    }
    /// The corners of the simplex around middle_ that may be left out.
    Corners around() const {
        const std::size_t corners = s_.reference.dimension() + 1;
        Corners at{};
        for (std::size_t corner = 0; corner < corners; ++corner) {
            at[corner] = middle_;
            for (std::size_t c = 0; c < corners; ++c)
                at[corner][c] += radius_ * ((c == corner ? 1 : 0) - 1 / static_cast<double>(corners));
        }
        return at;
    }

    bool contracts(const std::vector<Vector<double>>& points, const Matrix& y) const {
        const std::size_t d = s_.reference.dimension();
        for (std::size_t row = 0; row < d; ++row) {
            std::array<double, 3> most{};
            for (const auto& slope : s_.slopes) {
                for (std::size_t column = 0; column < d; ++column) {
                    double entry = row == column ? -1 : 0;
                    for (std::size_t k = 0; k < d; ++k)
                        entry += y[row][k] * s_.reference.order / radius_ *
                                 (points[slope.by[column]][k] - points[slope.base][k]);
                    most[column] = std::max(most[column], std::abs(entry));
                }
            }
            if (!(most[0] + most[1] + most[2] < 0.49)) return false;
        }
        return true;
    }

    const Simplex& s_;
    Coordinates middle_{};
    double radius_ = 0;
};

}  // namespace

const Reference* simplex_reference(int dimension, std::size_t nodes) {
    for (const Simplex& s : simplices()) {
        if (s.reference.nodes == nodes && s.reference.dimension() == static_cast<std::size_t>(dimension))
            return &s.reference;
    }
    return nullptr;
}

JacobianSign simplex_jacobian_sign(const Reference& of, const Places& places, int bisections) {
    const Simplex& s = simplex_of(of);
    const double scale = scale_of(of, places);
    using B = Ball<double>;
    const auto near = [&](std::size_t node, std::size_t k) {
        if (places.other[node] == nullptr) return B(places.at[node][k] * scale);
        return B(places.at[node][k] * scale / 2) + B(places.other[node][k] * scale / 2);
    };
    if (const auto sign = sign_by_bisection(of, jacobian_coefficients<B>(s, near), &B::sign, bisections)) return *sign;
    const WholePlaces place(of, places);
    return *sign_by_bisection(
        of, jacobian_coefficients<Whole>(s, place), [](const Whole& x) { return std::optional(x.sign()); }, bisections);
}

std::array<double, 6> hull_box(const Reference& of, const Places& places) {
    const double scale = scale_of(of, places);
    std::array<double, 6> box{};
    const auto points = rounded_control_points(simplex_of(of), places, scale);
    for (std::size_t k = 0; k < of.dimension(); ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& p : points) {
            low = std::min(low, p[k]);
            high = std::max(high, p[k]);
        }
        box[k] = (low - control_error) / scale;
        box[3 + k] = (high + control_error) / scale;
    }
    return box;
}

InSimplex locate_in_simplex(const Reference& of, const Places& places, const double* point, unsigned flat,
                            const std::array<int, 4>& beyond) {
    const std::size_t corners = of.dimension() + 1;
    Inverse inverse(of, places, point);
    const auto judge = [&]<class T>(const std::array<Ball<T>, 3>& x, bool last) -> std::optional<InSimplex> {
        InSimplex in{.inside = true, .proved = true};
        Ball<T> sum(0);
        for (std::size_t k = 0; k + 1 < corners; ++k) sum = sum + x[k];
        for (std::size_t c = 0; c < corners; ++c) {
            const Ball<T> own = c == 0 ? Ball<T>(1) - sum : x[c - 1];
            if (const auto sign = own.sign()) {
                if (*sign < 0) in.inside = false;
                continue;
            }
            if ((flat >> c & 1U) != 0) {
                if (beyond[c] < 0) in.inside = false;
                if (beyond[c] == 0) in.zeros |= 1U << c;
                continue;
            }
            if (!last) return std::nullopt;
            in.zeros |= 1U << c;
            in.proved = false;
        }
        return in;
    };
    bool beside = *std::min_element(beyond.begin(), beyond.begin() + static_cast<std::ptrdiff_t>(corners)) >= 0 &&
                  inverse.search();
    if (beside) {
        std::array<Ball<double>, 3> x;
        const std::optional<InSimplex> found = inverse.enclose<double>(x, 0x1p-30) ? judge(x, false) : std::nullopt;
        if (found && found->inside) return *found;
    }
    const double scale = scale_of(of, places);
    auto points = rounded_control_points(simplex_of(of), places, scale);
    for (auto& p : points) {
        for (std::size_t k = 0; k < of.dimension(); ++k) p[k] -= point[k] * scale;
    }
    Search search(simplex_of(of));
    if (search.apart(points)) return {.proved = true};
    beside = beside || inverse.search() || inverse.search(true);
    if (beside) {
        std::array<Ball<TwoDoubles>, 3> x;
        const bool enclosed = inverse.enclose<TwoDoubles>(x, 0x1p-88);
        std::optional<InSimplex> found = enclosed ? judge(x, false) : std::nullopt;
        Vector<double> about{};
        for (std::size_t k = 0; k + 1 < corners; ++k) about[k] = x[k].mid.high;
        // On a facet or about there: exactly, or with more digits.
        const auto exact = enclosed && !found ? inverse.exactly(about) : std::nullopt;
        if (exact) {
            found = {.inside = true, .proved = true};
            Rational sum = 0;
            for (std::size_t k = 0; k + 1 < corners; ++k) sum += (*exact)[k];
            for (std::size_t c = 0; c < corners; ++c) {
                const Rational l = c == 0 ? Rational(1 - sum) : (*exact)[c - 1];
                if (l < 0) found->inside = false;
                if (l == 0) found->zeros |= 1U << c;
            }
        } else if (enclosed && !found) {
            std::array<Ball<Wide<300>>, 3> wide;
            if (inverse.enclose<Wide<300>>(wide, 0x1p-250)) found = judge(wide, true);
        }
        if (found && found->inside) return *found;
    }
    // Not where Newton's method went: nowhere?
    constexpr Search::Corners corners_at{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    if (beside) {
        const double by = of.scale * std::ldexp(1 / scale, inverse.shift());  // to the scale of `points`
        Matrix y = inverse.inverse();
        for (auto& row : y) {
            for (double& x : row) x *= by;
        }
        search.leave_out_around(points, inverse.found(), y);
    }
    return {.proved = search.excludes(points, corners_at, 24)};
}

}  // namespace barycert::core::isoparametric
