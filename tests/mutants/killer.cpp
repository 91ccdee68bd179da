// killer prepare FILE: makes cases, and their answers by the oracle and by GMP's rationals.
// killer check FILE:   holds the core that it is linked with against them; exit code 1 and the name of the check that
//                      failed first, 0 if none did, with a hash of the tier counts, which correct answers do not tell.
//
// The cases: families; near-ties and ties of weights and values on simplices of volume 2^k; determinants scaled to
// where products under- and overflow; results at the ends of the range; quotients whose leading digits mislead; and,
// climbed to in each rounding mode, cases in which the determinant in double is wrong by as much as can be found.

#include <gmpxx.h>

#include <cfenv>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <type_traits>
#include <vector>
#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "barycert/audit/families.hpp"
#include "barycert/core/inverse.hpp"
#include "barycert/core/predicates.hpp"
#include "barycert/core/weights.hpp"
#include "barycert/exact/oracle.hpp"
#include "barycert/mesh/tetgen_io.hpp"

using namespace barycert;

namespace {

enum class Group : std::uint8_t { family, climbed, ties, scaled, ends, quotients, environment };
constexpr const char* group_names[] = {"families", "climbed", "ties", "scaled", "ends", "quotients", "environment"};

struct Record {
    Case c;
    exact::Answer answer;
    Group group = Group::family;
};
static_assert(std::is_trivially_copyable_v<Record>);

/// Input and answer of inverse.hpp. kind 0: point_from_weights (12 coordinates, 4 weights); 1: point_of_value (a, b, 3
/// attribute values), whose answer has t as the fourth.
struct Inverse {
    int kind = 0;
    double in[16] = {};
    double out[4] = {};
};

/// Points and the signs of orient2d and orient3d.
struct Orientation {
    double p[12] = {};
    int flat = 0, solid = 0;
};

// ---- arithmetic of the twin ----

double rounded(const mpq_class& q) {
    if (q == 0) return 0;
    const bool negative = q < 0;
    mpz_class n = abs(q.get_num()), d = q.get_den();
    const long bits =
        static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(d.get_mpz_t(), 2));
    long unit = std::max(bits - 54, -1074L);  // at least 53 bits are kept; corrected below
    const auto divide = [&](mpz_class& quotient, mpz_class& rest) {
        const mpz_class nn = unit < 0 ? mpz_class(n << static_cast<unsigned long>(-unit)) : n;
        const mpz_class dd = unit > 0 ? mpz_class(d << static_cast<unsigned long>(unit)) : d;
        mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), nn.get_mpz_t(), dd.get_mpz_t());
        return dd;
    };
    mpz_class m, rest, dd = divide(m, rest);
    while (mpz_sizeinbase(m.get_mpz_t(), 2) > 53) {
        ++unit;
        dd = divide(m, rest);
    }
    const mpz_class twice = 2 * rest;
    if (twice > dd || (twice == dd && mpz_odd_p(m.get_mpz_t()))) m += 1;
    const double x = std::ldexp(m.get_d(), static_cast<int>(unit));
    return negative ? -x : x;
}

template <class T>
T determinant(const T (&a)[3], const T (&b)[3], const T (&c)[3]) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

int exact_orientation(const double* p, int d) {
    mpq_class e[3][3];
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) e[i][k] = mpq_class(p[d * (i + 1) + k]) - mpq_class(p[k]);
    }
    return d == 2 ? sgn(mpq_class(e[0][0] * e[1][1] - e[0][1] * e[1][0]))
                  : sgn(mpq_class(determinant(e[0], e[1], e[2])));
}

// ---- cases ----

void move_by(double& x, Random& random) {
    const int ulps = random.integer(-3, 3);
    for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps < 0 ? -HUGE_VAL : HUGE_VAL);
}

/// A formula of numerators-inl.hpp in any arithmetic, and the quantity that the filter's constant multiplies.
enum class Quantity : std::uint8_t { numerator, denominator };

template <class T>
T formula(const T (&r)[4][3], const T (&e)[2][3], Simplex s, Quantity quantity) {
    const auto cross = [](const T(&x)[3], const T(&y)[3], T(&out)[3]) {
        out[0] = x[1] * y[2] - x[2] * y[1];
        out[1] = x[2] * y[0] - x[0] * y[2];
        out[2] = x[0] * y[1] - x[1] * y[0];
    };
    const auto dot = [](const T(&x)[3], const T(&y)[3]) { return T(T(x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]); };
    if (s == Simplex::tetrahedron) {
        T m01[3], m23[3];
        cross(r[0], r[1], m01);
        cross(r[2], r[3], m23);
        if (quantity == Quantity::numerator) return dot(r[1], m23);
        return T(T(dot(r[1], m23) - dot(r[0], m23)) + T(dot(r[3], m01) - dot(r[2], m01)));
    }
    if (s == Simplex::triangle) {
        const auto n = [&](int i) {
            const T(&x)[3] = r[(i + 1) % 3];
            const T(&y)[3] = r[(i + 2) % 3];
            return T(x[0] * y[1] - x[1] * y[0]);
        };
        return quantity == Quantity::numerator ? n(0) : T(T(n(0) + n(1)) + n(2));
    }
    if (s == Simplex::segment) return quantity == Quantity::numerator ? dot(r[1], e[0]) : dot(e[0], e[0]);
    T normal[3], m[3];
    cross(e[0], e[1], normal);
    cross(r[1], r[2], m);
    return quantity == Quantity::numerator ? dot(normal, m) : dot(normal, normal);
}

template <class T, class Convert>
T evaluate(const Case& c, Quantity q, Convert convert) {
    T r[4][3] = {}, e[2][3] = {};
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        const T p = convert(c.point[static_cast<std::size_t>(k)]);
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            r[i][k] = convert(c.vertex(i, k)) - p;
            if (i == 1 || i == 2) e[i - 1][k] = convert(c.vertex(i, k)) - convert(c.vertex(0, k));
        }
    }
    return formula<T>(r, e, c.simplex, q);
}

/// |determinant in double| over the filter's unit, 2^-52 times the product of extents; negative if its sign is right.
double badness(const Case& c, Quantity q) {
    const volatile double fl = evaluate<double>(c, q, [](double x) { return x; });
    const auto as_integer = [](double x) { return mpz_class(std::ldexp(x, 400)); };
    const int exact = sgn(evaluate<mpz_class>(c, q, as_integer));
    double r[3] = {}, e[3] = {};
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        for (int i = 0; i < vertex_count(c.simplex); ++i) {
            r[k] = std::max(r[k], std::fabs(c.vertex(i, k) - c.point[static_cast<std::size_t>(k)]));
            e[k] = std::max(e[k], std::fabs(c.vertex(i, k) - c.vertex(0, k)));
        }
    }
    const auto minors = [](const double* x, const double* y) {
        return 4 * (x[1] * y[1] * x[2] * y[2] + x[0] * y[0] * x[2] * y[2] + x[0] * y[0] * x[1] * y[1]);
    };
    const double unit = c.simplex == Simplex::tetrahedron ? r[0] * r[1] * r[2]
                        : c.simplex == Simplex::triangle  ? r[0] * r[1]
                        : c.simplex == Simplex::segment   ? r[0] * e[0] + r[1] * e[1] + r[2] * e[2]
                        : q == Quantity::numerator        ? minors(e, r)
                                                          : minors(e, e);
    const double size = std::fabs(fl) / (unit * 0x1p-52);
    const int computed = fl > 0 ? 1 : fl < 0 ? -1 : 0;
    return exact == 0 || exact != computed ? size : -size;
}

/// Climbs from a simplex whose determinant vanishes but for the point's (or origin's) last bits.
void climb(Simplex s, Quantity q, int mode, Random& random, std::vector<Record>& records) {
    const int n = vertex_count(s), d = space_dimension(s);
    double best_of_all = 0;
    for (int start = 0; start < 6; ++start) {
        Case c;
        c.simplex = s;
        const auto side = [&] { return (random.coin() ? 1 : -1) * (1 + random.integer(0, 8) * 0x1p-52); };
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < d; ++k) c.vertex(i, k) = start % 2 == 0 ? side() : random.uniform(-1, 1);
        }
        // coplanar: with the point, or among themselves
        const int flat = q == Quantity::numerator ? n - 1 : n - 1;
        for (int k = 0; k < d; ++k) {
            c.point[static_cast<std::size_t>(k)] = std::ldexp(random.uniform(-1, 1), -53);
            if (q == Quantity::numerator && s != Simplex::segment && s != Simplex::triangle3d)
                c.vertex(flat, k) = n == 4 ? -(c.vertex(1, k) + c.vertex(2, k)) / 2 : -c.vertex(1, k);
            if (q == Quantity::denominator)
                c.vertex(flat, k) = n == 4
                                        ? (c.vertex(0, k) + c.vertex(1, k)) / 2 + (c.vertex(2, k) - c.vertex(1, k)) / 4
                                        : (c.vertex(0, k) + 3 * c.vertex(1, k)) / 4;
        }
        double best = -HUGE_VAL;
        Case kept = c;
        for (int step = 0; step < 25000; ++step) {
            Case next = kept;
            for (int moves = random.integer(1, 3); moves > 0; --moves) {
                const auto at = static_cast<std::size_t>(random.below(static_cast<std::uint64_t>((n + 1) * d)));
                double& x = at < static_cast<std::size_t>(n * d) ? next.vertices[at]
                                                                 : next.point[at - static_cast<std::size_t>(n * d)];
                const auto kind = random.below(4);
                if (kind == 0) move_by(x, random);
                if (kind == 1) x += std::ldexp(random.uniform(-1, 1), -random.integer(1, 60));
                if (kind == 2)
                    x = std::fabs(x) > 0x1p-30 ? x * (1 + std::ldexp(random.uniform(-1, 1), -random.integer(2, 52)))
                                               : std::ldexp(random.uniform(-1, 1), -random.integer(50, 60));
                if (kind == 3) x = -x;
            }
            std::fesetround(mode);
            const double b = badness(next, q);
            std::fesetround(FE_TONEAREST);
            if (std::isfinite(b) && b >= best) {
                if (b > 0 && b > best * 1.02) {
                    Record r;
                    r.c = next;
                    r.group = Group::climbed;
                    records.push_back(r);
                    if (s == Simplex::tetrahedron || s == Simplex::triangle) {
                        // the cell of which this quantity is a numerator that leaves the rest clear of the bound
                        Record far = r;
                        for (int k = 0; k < d; ++k) {
                            if (q == Quantity::numerator) far.c.vertex(0, k) = random.uniform(-1, 1);
                            if (q == Quantity::denominator)
                                far.c.point[static_cast<std::size_t>(k)] = random.uniform(-1, 1) * 0x1p-52 + 0x1p-53;
                        }
                        records.push_back(far);
                    }
                }
                best = b;
                kept = next;
            }
        }
        best_of_all = std::max(best_of_all, best);
    }
    std::printf("  %-11s %-11s mode %d: up to %.2f e\n", std::string(name(s)).c_str(),
                q == Quantity::numerator ? "numerator" : "denominator", mode, best_of_all);
}

/// A simplex of small integers with volume (squared: for those projected on) 2^k, where weights are short sums.
Case unimodular(Simplex s, Random& random) {
    Case c;
    c.simplex = s;
    const int n = vertex_count(s), d = space_dimension(s), m = n - 1;
    double e[3][3] = {};
    const bool projected = s == Simplex::segment || s == Simplex::triangle3d;
    const int turn = random.integer(0, d - 1);
    for (int i = 0; i < m; ++i) e[i][(i + turn) % d] = random.coin() ? 1 : -1;
    for (int step = projected ? 0 : random.integer(0, 4); step > 0; --step) {
        const int i = random.integer(0, m - 1), j = (i + random.integer(1, m - 1)) % m, t = random.integer(-2, 2);
        for (int k = 0; k < d; ++k) e[i][k] += t * e[j][k];
    }
    const int scale = random.integer(-3, 3);
    const bool away = random.coin();
    const int far = random.integer(0, 20);
    double o[3];
    for (int k = 0; k < d; ++k) {
        o[k] = away ? std::ldexp(random.integer(-4, 4), far) : 0;
        const int last = random.integer(0, 1);
        for (int i = 0; i < n; ++i) {
            const int edge = (i + (last == 0 ? 0 : 0) + n - 1) % n;  // vertex 0 has the last edge, vertex n - 1 none
            c.vertex((i + 1) % n, k) = o[k] + (edge < m ? std::ldexp(e[edge][k], scale) : 0);
        }
        double q = 0;
        switch (random.below(5)) {
            case 0:
                q = random.uniform(-1, 2);
                break;
            case 1:
                q = (random.coin() ? 1 : -1) * std::ldexp(1, -random.integer(50, 60));
                break;
            case 2:
                q = (random.coin() ? 1 : -1) * std::ldexp(1, -random.integer(60, 160));
                break;
            case 3:
                q = random.integer(-8, 8) * 0.125;
                break;
            default:
                q = random.integer(-8, 8) * 0.125 + random.integer(-8, 8) * 0x1p-53;
        }
        c.point[static_cast<std::size_t>(k)] = o[k] + q;
    }
    for (double& f : c.values) {
        switch (random.below(4)) {
            case 0:
                f = random.integer(-9, 9);
                break;
            case 1:
                f = random.uniform(-1, 1);
                break;
            case 2:
                f = std::ldexp(random.integer(-9, 9), -random.integer(40, 120));
                break;
            default:
                f = 1 + random.integer(-9, 9) * 0x1p-52;
        }
    }
    return c;
}

/// Weight 1 is (p_x + p_y + p_z) / 3: a tie, or one but for the last coordinate, too small for a double-double.
Case projected_tie(Simplex s, Random& random) {
    Case c;
    c.simplex = s;
    const std::uint64_t m = (random.bits() >> 11) | 1;  // 53 bits and odd: m 2^-53 is no tie, m 2^-54 + 1/2 is one
    const double half = random.coin() ? 0x1p-54 : -0x1p-54;
    const double tie = 0.5 + 0.5 * static_cast<double>(m >> 1) * 0x1p-52;  // and `half` beyond its last bit
    const double x = 3 * tie;
    const double rest = std::fma(3, tie, -x) + 3 * half;
    const int shift = random.integer(-2, 2), turn = random.integer(0, 2);
    const double tiny = random.integer(0, 3) == 0 ? 0 : std::ldexp(random.coin() ? 1 : -1, -random.integer(90, 170));
    const double p[3] = {x, rest, tiny}, v1[3] = {1, 1, 1}, v2[3] = {1, -1, 0};
    for (int k = 0; k < 3; ++k) {
        const int to = (k + turn) % 3;
        c.point[static_cast<std::size_t>(to)] = std::ldexp(p[k], shift);
        c.vertex(1, to) = std::ldexp(v1[k], shift);
        if (s == Simplex::triangle3d) c.vertex(2, to) = std::ldexp(v2[k], shift);
    }
    for (double& f : c.values) f = random.coin() ? random.integer(-3, 3) : -0.0;
    c.values[1] = random.coin() ? 1 : c.values[1];
    return c;
}

double integer_of(Random& random, int bits) {
    return static_cast<double>((random.bits() >> (64 - bits)) | 1);
}

std::vector<Record> make_records(const std::string& data) {
    audit::MeshSource meshes;
    for (const char* mesh : {"cube-hole", "lattice-box", "plate"})
        meshes.add(mesh, read_tetgen(data + "/meshes/" + mesh).value());
    std::vector<Record> records;
    const auto add = [&](const Case& c, Group g) {
        Record r;
        r.c = c;
        r.group = g;
        records.push_back(r);
    };
    for (const audit::Family& f : audit::all_families()) {
        for (const Simplex s : f.simplices) {
            for (std::uint64_t i = 0; i < 300; ++i) add(audit::make_case(f, s, 77, i, meshes), Group::family);
        }
    }
    for (const Simplex s : all_simplices) {
        Random random = Random::stream(4, static_cast<std::uint64_t>(s), 1);
        const int n = vertex_count(s), d = space_dimension(s);
        const bool projected = s == Simplex::segment || s == Simplex::triangle3d;
        for (int mode : {FE_TONEAREST, FE_UPWARD, FE_TOWARDZERO}) {
            climb(s, Quantity::numerator, mode, random, records);
            if (s != Simplex::segment) climb(s, Quantity::denominator, mode, random, records);
        }
        for (int i = 0; i < 20000; ++i) add(unimodular(s, random), Group::ties);
        for (int i = 0; i < 4000 && projected; ++i) add(projected_tie(s, random), Group::ties);
        // near a facet, scaled to where products leave the range
        const audit::Family near = audit::families_matching(projected && n == 2 ? "random" : "on-facet").at(0);
        for (std::uint64_t i = 0; i < 15000; ++i) {
            Case c = audit::make_case(i % 4 == 0 ? audit::families_matching("nearly-degenerate").at(0) : near, s, 5, i,
                                      meshes);
            int common = i % 2 == 0 ? random.integer(-1000, 900) : random.integer(-400, -300);
            if (projected && i % 2 == 1) common = random.integer(-290, -100);
            for (int k = 0; k < d; ++k) {
                int e = common;
                if (!projected && i % 4 < 2) e = random.integer(-900, 900);
                if (!projected && i % 8 == 4) e = k == 0 ? -common : common;
                if (projected && i % 3 == 0) e = common + random.integer(-60, 60);
                for (int j = 0; j < n; ++j) c.vertex(j, k) = std::ldexp(c.vertex(j, k), e);
                c.point[static_cast<std::size_t>(k)] = std::ldexp(c.point[static_cast<std::size_t>(k)], e);
            }
            add(c, Group::scaled);
        }
        // values and weights at the ends of the range
        for (int i = 0; i < 6000; ++i) {
            Case c = unimodular(s, random);
            for (double& f : c.values) {
                switch (random.below(4)) {
                    case 0:
                        f = random.integer(-9, 9) * 0x1p-1074;
                        break;
                    case 1:
                        f = random.uniform(-1, 1) * 0x1p-1022;
                        break;
                    case 2:
                        f = (1 - random.integer(1, 3) * 0x1p-53) * 0x1p+1023 * 2;
                        break;
                    default:
                        f = std::ldexp(random.uniform(-1, 1), i % 2 == 0 ? -1022 : 1023);
                }
                if (i % 3 == 0) f = random.integer(-9, 9) * 0x1p-1074;
                if (i % 3 == 1) f = (random.coin() ? 1 : -1) * (1 - random.integer(1, 3) * 0x1p-53) * 0x1p+1023 * 2;
            }
            add(c, Group::ends);
        }
        for (int i = 0; i < 6000; ++i) {
            Case c;
            c.simplex = s;
            const int down = random.integer(0, 1);
            const double length = std::ldexp(random.coin() ? 1 : integer_of(random, 12), down != 0 ? 40 : -200);
            for (int j = 1; j < n; ++j) c.vertex(j, j - 1) = length;
            const int at = down != 0 ? random.integer(-1074, -1010) : random.integer(770, 830);
            c.point[0] = std::ldexp(integer_of(random, random.integer(1, 53)), at);
            if (!std::isfinite(c.point[0])) c.point[0] = 1;
            for (double& f : c.values) f = random.integer(-3, 3);
            if (projected || s == Simplex::triangle || s == Simplex::tetrahedron) add(c, Group::ends);
        }
    }
    // divisors whose leading limb is just above 2^63 and whose next is large
    Random random(99);
    for (int i = 0; i < 40000; ++i) {
        Case c;
        c.simplex = i % 4 == 0 ? Simplex::triangle : Simplex::segment;
        const double root = 6369051672525773;  // of 2^105, rounded up
        const int spread = random.integer(1, 30);
        const double e = root + std::floor(std::ldexp(random.unit(), spread));
        c.vertex(1, 0) = e;
        if (c.simplex == Simplex::triangle) c.vertex(2, 1) = root + std::floor(std::ldexp(random.unit(), spread));
        c.point[0] = i % 2 == 0 ? 2 * e - integer_of(random, random.integer(1, 40)) : integer_of(random, 53);
        c.point[1] = c.simplex == Simplex::triangle ? integer_of(random, 53) : 0;
        for (double& f : c.values) f = random.coin() ? random.integer(-9, 9) : integer_of(random, 53);
        add(c, Group::quotients);
    }
    const auto any = [&] {
        switch (random.below(4)) {
            case 0:
                return 0.0;
            case 1:
                return random.integer(-9, 9) * 0x1p-1074;
            case 2:
                return static_cast<double>(random.integer(-4, 4));
            default: {
                const double m = random.coin() ? random.integer(-3, 3) : random.uniform(-1, 1);
                return std::ldexp(m, random.integer(-1074, 900));
            }
        }
    };
    for (int i = 0; i < 6000; ++i) {
        Case c;
        c.simplex = all_simplices[random.below(4)];
        for (double& x : c.vertices) x = any();
        for (double& x : c.point) x = any();
        for (double& x : c.values) x = any();
        add(c, Group::environment);
    }
    for (Record& r : records) r.answer = exact::ask(r.c);
    return records;
}

std::vector<Inverse> make_inverses() {
    std::vector<Inverse> all;
    Random random(3);
    for (int i = 0; i < 4000; ++i) {
        const auto number = [&]() -> double {
            const int kind = i % 4;
            if (kind == 0) return random.uniform(-1, 1);
            if (kind == 1) return random.integer(-8, 8) * 0.125 + random.integer(-3, 3) * 0x1p-53;
            if (kind == 2) return std::ldexp(random.uniform(-1, 1), random.integer(-540, 510));
            return random.coin() ? 0 : std::ldexp(random.integer(-3, 3), random.integer(-540, 510));
        };
        Inverse v;
        for (double& x : v.in) x = number();
        for (int k = 0; k < 3; ++k) {
            mpq_class sum = 0;
            for (int j = 0; j < 4; ++j) sum += mpq_class(v.in[3 * j + k]) * mpq_class(v.in[12 + j]);
            v.out[k] = rounded(sum);
        }
        all.push_back(v);
        v = {};
        v.kind = 1;
        for (int j = 0; j < 9; ++j) v.in[j] = number();
        if (v.in[6] == v.in[7]) v.in[7] += 1;
        if (v.in[6] == v.in[7]) continue;
        const mpq_class t = (mpq_class(v.in[8]) - mpq_class(v.in[6])) / (mpq_class(v.in[7]) - mpq_class(v.in[6]));
        for (int k = 0; k < 3; ++k)
            v.out[k] = rounded(mpq_class(v.in[k]) + t * (mpq_class(v.in[3 + k]) - mpq_class(v.in[k])));
        v.out[3] = rounded(t);
        all.push_back(v);
    }
    return all;
}

std::vector<Orientation> make_orientations(const std::vector<Record>& records) {
    std::vector<Orientation> all;
    Random random(8);
    for (const Record& r : records) {
        if (r.c.simplex != Simplex::tetrahedron && r.c.simplex != Simplex::triangle) continue;
        if (r.group != Group::climbed && r.group != Group::environment && random.below(12) != 0) continue;
        const int d = space_dimension(r.c.simplex);
        double points[15];
        for (int i = 0; i < d * (d + 1); ++i) points[i] = r.c.vertices[static_cast<std::size_t>(i)];
        for (int k = 0; k < d; ++k) points[d * (d + 1) + k] = r.c.point[static_cast<std::size_t>(k)];
        // the simplex; then the point and all vertices but one, the point first
        for (int skip = -1; skip <= d; ++skip) {
            Orientation o;
            int at = 0;
            if (skip >= 0) {
                for (int k = 0; k < d; ++k) o.p[at++] = points[d * (d + 1) + k];
            }
            for (int i = 0; i <= d; ++i) {
                for (int k = 0; k < d && i != skip; ++k) o.p[at++] = points[d * i + k];
            }
            o.flat = d == 2 ? exact_orientation(o.p, 2) : 2;
            o.solid = d == 3 ? exact_orientation(o.p, 3) : 2;
            all.push_back(o);
        }
    }
    return all;
}

// ---- the checks ----

[[noreturn]] void killed(const std::string& check) {
    std::printf("KILLED %s\n", check.c_str());
    std::fflush(stdout);
    std::_Exit(1);
}
void expect(bool law, const std::string& check) {
    if (!law) killed(check);
}

bool same(double x, double y) {
    return std::memcmp(&x, &y, sizeof x) == 0 || (std::isnan(x) && std::isnan(y));
}

bool agrees(const Record& r, WeightSigns w) {
    const bool degenerate = r.answer.region == Region::degenerate;
    if (w.degenerate() != degenerate || w.region() != r.answer.region || w.feature(r.c.simplex) != r.answer.feature)
        return false;
    for (int i = 0; i < vertex_count(r.c.simplex); ++i) {
        if (static_cast<int>(w.sign(i)) != r.answer.signs[static_cast<std::size_t>(i)]) return false;
    }
    return true;
}

/// Records of one simplex in arrays.
struct Arrays {
    std::vector<std::vector<double>> rows;
    CaseArrays cases;
    ValueArrays<double> values;
    std::vector<double> triples[4];
    ValueArrays<double> with_triples;

    Arrays(Simplex s, const std::vector<const Record*>& records) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
        rows.resize((n + 1) * d + n);
        cases.simplex = s;
        cases.count = records.size();
        for (const Record* r : records) {
            for (std::size_t i = 0; i < n * d; ++i) rows[i].push_back(r->c.vertices[i]);
            for (std::size_t k = 0; k < d; ++k) rows[n * d + k].push_back(r->c.point[k]);
            for (std::size_t i = 0; i < n; ++i) {
                rows[(n + 1) * d + i].push_back(r->c.values[i]);
                for (const double f : {1.0, r->c.values[i], -r->c.values[i]}) triples[i].push_back(f);
            }
        }
        for (std::size_t i = 0; i < n * d; ++i) cases.vertices[i] = rows[i].data();
        for (std::size_t k = 0; k < d; ++k) cases.point[k] = rows[n * d + k].data();
        for (std::size_t i = 0; i < n; ++i) {
            values.at[i] = rows[(n + 1) * d + i].data();
            with_triples.at[i] = triples[i].data();
        }
        with_triples.components = 3;
    }
};

bool flushed = true;  ///< check with subnormals flushed, too
std::uint64_t tier_hash = 0;
void note(const Tiers& t) {
    for (const std::uint64_t x : {t.filter, t.double_double, t.exact}) tier_hash = mix64(tier_hash ^ x) + 1;
}

void check_batches(Simplex s, Group g, const std::vector<const Record*>& records) {
    const std::string where = std::string(group_names[static_cast<int>(g)]) + "/" + std::string(name(s));
    const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
    const Arrays a(s, records);
    const std::size_t count = records.size();
    std::uint64_t degenerate = 0;
    for (const Record* r : records) degenerate += r->answer.region == Region::degenerate ? 1 : 0;

    std::vector<WeightSigns> signs(count);
    const auto check_signs = [&](const std::string& how) {
        Tiers tiers;
        expect(weight_signs(a.cases, signs, &tiers).has_value(), "signs: error " + where + how);
        for (std::size_t j = 0; j < count; ++j) expect(agrees(*records[j], signs[j]), "signs " + where + how);
        expect(tiers.cases() == count && tiers.degenerate <= degenerate, "signs: count " + where + how);
        return tiers;
    };
    note(check_signs(""));
    for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        check_signs(" rounding " + std::to_string(mode));
        std::fesetround(FE_TONEAREST);
    }
#ifdef __x86_64__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);
    if (flushed) check_signs(" flushed");
    _mm_setcsr(before);
#endif

    std::vector<double> weights(n * count), values(count), triples(3 * count);
    Tiers tiers, value_tiers;
    expect(barycentric_weights(a.cases, weights, &tiers).has_value(), "weights: error " + where);
    expect(interpolate(a.cases, a.values, values, &value_tiers).has_value(), "values: error " + where);
    expect(interpolate(a.cases, a.with_triples, triples).has_value(), "triples: error " + where);
    for (std::size_t j = 0; j < count; ++j) {
        const exact::Answer& answer = records[j]->answer;
        for (std::size_t i = 0; i < n; ++i) expect(same(weights[n * j + i], answer.weights[i]), "weights " + where);
        expect(same(values[j], answer.value), "values " + where);
        const bool is_one = answer.region == Region::degenerate ? std::isnan(triples[3 * j]) : triples[3 * j] == 1;
        expect(is_one && same(triples[3 * j + 1], answer.value) &&
                   (triples[3 * j + 2] == -answer.value || std::isnan(answer.value)),
               "triples " + where);
    }
    note(tiers);
    note(value_tiers);
    expect(tiers.cases() == count && tiers.degenerate == degenerate, "weights: count " + where);
    expect(value_tiers.cases() == count && value_tiers.degenerate == degenerate, "values: count " + where);

    // as a mesh, the cells in reverse; and alone
    std::vector<double> nodes(count * n * d), points, field(count * n);
    std::vector<std::int32_t> corners(count * n), cells;
    for (std::size_t j = 0; j < count; ++j) {
        const Case& c = records[j]->c;
        const std::size_t cell = count - 1 - j;
        cells.push_back(static_cast<std::int32_t>(cell));
        for (std::size_t i = 0; i < n; ++i) {
            corners[n * cell + i] = static_cast<std::int32_t>(n * j + i);
            for (std::size_t k = 0; k < d; ++k) nodes[d * (n * j + i) + k] = c.vertices[d * i + k];
            field[n * j + i] = c.values[i];
        }
        points.insert(points.end(), c.point.begin(), c.point.begin() + static_cast<std::ptrdiff_t>(d));
    }
    const MeshQueries queries{s, nodes, corners, cells, points};
    std::vector<WeightSigns> mesh_signs(count);
    std::vector<double> mesh_weights(n * count), mesh_values(count);
    expect(weight_signs(queries, mesh_signs).has_value() && mesh_signs == signs, "mesh signs " + where);
    expect(barycentric_weights(queries, mesh_weights).has_value() &&
               interpolate(queries, NodalValues<double>{field, 1}, mesh_values).has_value(),
           "mesh error " + where);
    for (std::size_t i = 0; i < n * count; ++i) expect(same(mesh_weights[i], weights[i]), "mesh weights " + where);
    for (std::size_t j = 0; j < count; ++j) expect(same(mesh_values[j], values[j]), "mesh values " + where);
    for (std::size_t j = 0; j < count; j += 7) {
        const Case& c = records[j]->c;
        Tiers one;
        expect(*weight_signs(s, c.vertices.data(), c.point.data(), &one) == signs[j] && one.cases() == 1,
               "single signs " + where);
        const auto w = barycentric_weights(s, c.vertices.data(), c.point.data());
        const auto v = interpolate(s, c.vertices.data(), c.point.data(), c.values.data());
        for (std::size_t i = 0; i < n; ++i) expect(same(w->weights[i], weights[n * j + i]), "single weights " + where);
        expect(same(v->value, values[j]), "single value " + where);
        const bool flat = records[j]->answer.region == Region::degenerate;
        expect(w->degenerate == flat && v->degenerate == flat, "single degenerate " + where);
    }
}

/// Batches of every length near that of a vector and of a block, and numbers that are not finite.
void check_edges(Simplex s, const std::vector<const Record*>& all) {
    const std::string where = std::string(name(s));
    const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
    for (const std::size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 31, 255, 256, 257, 511, 513}) {
        std::vector<const Record*> some;
        for (std::size_t j = 0; j < count; ++j) some.push_back(all[j * 37 % all.size()]);
        const Arrays a(s, some);
        std::vector<WeightSigns> signs(count);
        std::vector<double> weights(n * count), values(count);
        Tiers t;
        expect(weight_signs(a.cases, signs, &t).has_value() && t.cases() == count, "lengths: signs " + where);
        expect(barycentric_weights(a.cases, weights).has_value(), "lengths: weights " + where);
        expect(interpolate(a.cases, a.values, values).has_value(), "lengths: values " + where);
        for (std::size_t j = 0; j < count; ++j) {
            expect(agrees(*some[j], signs[j]) && same(values[j], some[j]->answer.value), "lengths " + where);
            for (std::size_t i = 0; i < n; ++i)
                expect(same(weights[n * j + i], some[j]->answer.weights[i]), "lengths " + where);
        }
    }
    std::vector<const Record*> some(all.begin(), all.begin() + 300);
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        for (std::size_t row = 0; row < (n + 1) * d; ++row) {
            Arrays a(s, some);
            const std::size_t j = 251 + row;
            a.rows[row][j] = bad;
            std::vector<WeightSigns> signs(300);
            std::vector<double> weights(n * 300), values(300);
            const std::string expected = "case " + std::to_string(j) + ": coordinate " + std::to_string(row % d) +
                                         " of " +
                                         (row < n * d ? "vertex " + std::to_string(row / d) : std::string("the point"));
            const Status errors[3] = {weight_signs(a.cases, signs), barycentric_weights(a.cases, weights),
                                      interpolate(a.cases, a.values, values)};
            for (const Status& e : errors) expect(!e && e.error().what == expected, "not finite " + where);
            Case c = some[j]->c;
            (row < n * d ? c.vertices[row] : c.point[row - n * d]) = bad;
            expect(!weight_signs(s, c.vertices.data(), c.point.data()) &&
                       !barycentric_weights(s, c.vertices.data(), c.point.data()) &&
                       !interpolate(s, c.vertices.data(), c.point.data(), c.values.data()),
                   "not finite, single " + where);
        }
        Arrays a(s, some);
        a.rows[(n + 1) * d + n - 1][17] = bad;
        std::vector<double> values(300);
        Tiers t;
        expect(interpolate(a.cases, a.values, values, &t).has_value() && std::isnan(values[17]),
               "nodal value " + where);
        const std::uint64_t counted = some[17]->answer.region == Region::degenerate ? 0 : 1;
        expect(t.not_finite == counted, "nodal value counted " + where);
    }
    Arrays a(s, some);
    std::vector<double> weights(n * 300), values(300);
    for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const bool refused =
            !barycentric_weights(a.cases, weights) && !interpolate(a.cases, a.values, values) &&
            !barycentric_weights(s, some[0]->c.vertices.data(), some[0]->c.point.data()) &&
            !interpolate(s, some[0]->c.vertices.data(), some[0]->c.point.data(), some[0]->c.values.data());
        std::fesetround(FE_TONEAREST);
        expect(refused, "environment refused " + where);
    }
    // plain: near the value for ordinary cells, and NaN or infinite for degenerate ones
    std::vector<const Record*> easy;
    for (const Record* r : all) {
        if (r->answer.region == Region::interior && easy.size() < 100) easy.push_back(r);
    }
    const Arrays e(s, easy);
    values.resize(easy.size());
    expect(interpolate(e.cases, e.values, values, nullptr, Rounding::plain).has_value(), "plain " + where);
    for (std::size_t j = 0; j < easy.size(); ++j)
        expect(std::fabs(values[j] - easy[j]->answer.value) <= 1e-6 * (1 + std::fabs(easy[j]->answer.value)),
               "plain " + where);
}

void check_inverses(const std::vector<Inverse>& all) {
    for (const Inverse& v : all) {
        double out[3] = {};
        if (v.kind == 0) {
            expect(point_from_weights(Simplex::tetrahedron, v.in, v.in + 12, out).has_value(), "point_from_weights");
        } else {
            const auto t = point_of_value({v.in, 3}, {v.in + 3, 3}, v.in[6], v.in[7], v.in[8], out);
            expect(t.has_value() && same(t->t, v.out[3]) && !t->undetermined, "point_of_value: t");
            expect(same(parameter_of_value(v.in[6], v.in[7], v.in[8])->t, v.out[3]), "parameter_of_value");
        }
        for (int k = 0; k < 3; ++k)
            expect(out[k] == v.out[k] && (v.out[k] != 0 || v.kind == 0 || same(out[k], v.out[k])),
                   v.kind == 0 ? "point_from_weights" : "point_of_value");
    }
    double out[3] = {1, 1, 1};
    const double ends[6] = {0, 1, 2, 3, 4, 5}, bad[6] = {0, HUGE_VAL, 2, 3, std::nan(""), 5}, w[4] = {.5, .5, 0, 0};
    const auto flat = point_of_value({ends, 3}, {ends + 3, 3}, 2, 2, 2, out);
    expect(flat.has_value() && flat->undetermined && std::isnan(flat->t) && std::isnan(out[2]), "undetermined");
    expect(!point_of_value({bad, 3}, {ends, 3}, 0, 1, 2, out) &&
               !point_of_value({ends, 3}, {bad + 3, 3}, 0, 1, 2, out) && !parameter_of_value(HUGE_VAL, 0, 0) &&
               !parameter_of_value(0, std::nan(""), 0) && !parameter_of_value(0, 1, HUGE_VAL),
           "inverse: not finite");
    expect(!point_from_weights(Simplex::segment, bad, w, out) && !point_from_weights(Simplex::segment, ends, bad, out),
           "inverse: not finite");
    expect(point_from_weights(Simplex::segment, ends, w, out).has_value() && out[0] == 1.5 && out[2] == 3.5,
           "inverse: segment");
}

void check_orientations(const std::vector<Orientation>& all) {
    for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        for (const Orientation& o : all) {
            const double* const p = o.p;
            const bool good = o.flat != 2 ? static_cast<int>(*orient2d(p, p + 2, p + 4)) == o.flat
                                          : static_cast<int>(*orient3d(p, p + 3, p + 6, p + 9)) == o.solid;
            if (!good) {
                std::fesetround(FE_TONEAREST);
                killed(o.flat != 2 ? "orient2d" : "orient3d");
            }
        }
    }
    std::fesetround(FE_TONEAREST);
    for (int i = 0; i < 12; ++i) {
        double p[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
        p[i] = i % 2 == 0 ? HUGE_VAL : std::nan("");
        expect(!orient3d(p, p + 3, p + 6, p + 9), "orient3d: not finite");
        if (i < 6) expect(!orient2d(p, p + 2, p + 4), "orient2d: not finite");
    }
}

template <class T>
void write(std::ofstream& out, const std::vector<T>& all) {
    const std::size_t size = all.size();
    out.write(reinterpret_cast<const char*>(&size), sizeof size);
    out.write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(size * sizeof(T)));
}
template <class T>
std::vector<T> read(std::ifstream& in) {
    std::size_t size = 0;
    in.read(reinterpret_cast<char*>(&size), sizeof size);
    std::vector<T> all(size);
    in.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(size * sizeof(T)));
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4 && std::strcmp(argv[1], "prepare") == 0) {
        const std::vector<Record> records = make_records(argv[3]);
        std::ofstream out(argv[2], std::ios::binary);
        write(out, records);
        write(out, make_inverses());
        write(out, make_orientations(records));
        std::printf("%zu cases\n", records.size());
        return 0;
    }
    if ((argc != 3 && argc != 4) || std::strcmp(argv[1], "check") != 0) return 2;
    flushed = argc == 3;  // a fourth argument leaves that out
    std::ifstream in(argv[2], std::ios::binary);
    const auto records = read<Record>(in);
    const auto inverses = read<Inverse>(in);
    const auto orientations = read<Orientation>(in);
    for (const Simplex s : all_simplices) {
        std::vector<const Record*> of_group[7];
        for (const Record& r : records) {
            if (r.c.simplex == s) of_group[static_cast<int>(r.group)].push_back(&r);
        }
        for (int g = 0; g < 7; ++g) {
            if (!of_group[g].empty()) check_batches(s, static_cast<Group>(g), of_group[g]);
        }
        check_edges(s, of_group[0]);
    }
    check_orientations(orientations);
    check_inverses(inverses);
    std::printf("SURVIVED %016" PRIx64 "\n", tier_hash);
    return 0;
}
