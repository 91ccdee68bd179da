// prepare FILE DATA: makes the killer's cases, and their answers by the oracle and by GMP's rationals.
//
// The cases: families; ties and near-ties of weights and values; determinants scaled to where products under- and
// overflow; results at the ends of the range; quotients whose leading digits mislead; and, climbed to in each rounding
// mode, cases in which the determinant in double is wrong by as much as can be found.

#include <gmpxx.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"
#include "cases.hpp"
#include "core/base/random.hpp"

using namespace barycert;
using namespace barycert::mutants;

namespace {

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

/// A simplex of small integers with volume (squared: for those projected on) 2^k, where weights are short sums.
Case unimodular(Simplex s, base::Random& random) {
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
Case projected_tie(Simplex s, base::Random& random) {
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

double integer_of(base::Random& random, int bits) {
    return static_cast<double>((random.bits() >> (64 - bits)) | 1);
}

/// A segment of length 2^-500 with a numerator of three products, of which two are below 2^-1022 and outweigh the
/// third.
Case underflowing(base::Random& random) {
    Case c;
    c.simplex = Simplex::segment;
    const int turn = random.integer(0, 2);
    const double sign = random.coin() ? 1 : -1;
    for (int k = 0; k < 3; ++k) {
        const int to = (k + turn) % 3;
        c.vertex(1, to) = 0x1p-500;
        const double r = k == 0 ? random.uniform(1, 1.1) : -random.uniform(0.6, 0.99);
        c.point[static_cast<std::size_t>(to)] = 0x1p-500 - sign * r * 0x1p-522;
    }
    return c;
}

/// A triangle with two numerators of different sign that overflow, the one of the denominator's sign by more.
Case overflowing(base::Random& random) {
    Case c;
    c.simplex = Simplex::triangle;
    const int up = random.integer(520, 900), across = 1040 - up;
    const double sign = random.coin() ? 1 : -1;
    const double r[3][2] = {{1, 0}, {0x1p-10, sign * 0x1p-40}, {0, sign}};
    const int first = random.integer(0, 2);
    for (int i = 0; i < 3; ++i) {
        c.vertex((i + first) % 3, 0) = std::ldexp(r[i][0] * random.uniform(1, 1.5), across);
        c.vertex((i + first) % 3, 1) = std::ldexp(r[i][1] * random.uniform(1, 1.5), up);
    }
    return c;
}

std::vector<Record> make_records(const std::string& data) {
    MeshSource meshes;
    for (const char* mesh : {"cube-hole", "lattice-box", "plate"})
        meshes.add(mesh, read_tetgen(data + "/meshes/" + mesh).value());
    std::vector<Record> records;
    const auto add = [&](const Case& c, Group g) {
        Record r;
        r.c = c;
        r.group = g;
        records.push_back(r);
    };
    for (const Family& f : all_families()) {
        if (f.perspective) continue;
        for (const Simplex s : f.simplices) {
            for (std::uint64_t i = 0; i < 300; ++i) add(make_case(f, s, 77, i, meshes), Group::family);
        }
    }
    for (const Simplex s : all_simplices) {
        base::Random random = base::Random::stream(4, static_cast<std::uint64_t>(s), 1);
        const int n = vertex_count(s), d = space_dimension(s);
        const bool projected = s == Simplex::segment || s == Simplex::triangle3d;
        for (int mode : {FE_TONEAREST, FE_UPWARD, FE_TOWARDZERO}) {
            climb(s, Quantity::numerator, mode, random, records);
            if (s != Simplex::segment) climb(s, Quantity::denominator, mode, random, records);
        }
        for (int i = 0; i < 20000; ++i) add(unimodular(s, random), Group::ties);
        for (int i = 0; i < 4000 && projected; ++i) add(projected_tie(s, random), Group::ties);
        add_near_ties(s, records);
        // near a facet, scaled to where products leave the range
        const Family near = families_matching(projected && n == 2 ? "random" : "on-facet").at(0);
        for (std::uint64_t i = 0; i < 15000; ++i) {
            Case c = make_case(i % 4 == 0 ? families_matching("nearly-degenerate").at(0) : near, s, 5, i, meshes);
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
    base::Random ends(12);
    for (int i = 0; i < 400; ++i) {
        add(underflowing(ends), Group::scaled);
        add(overflowing(ends), Group::scaled);
    }
    // divisors whose leading limb is just above 2^63 and whose next is large
    base::Random random(99);
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
    for (Record& r : records) {
        r.answer = ask_oracle(r.c);
        const bool oriented = r.c.simplex == Simplex::triangle || r.c.simplex == Simplex::tetrahedron;
        const bool flat = r.answer.region == Region::degenerate;
        const auto sign = [&] { return exact_orientation(r.c.vertices.data(), space_dimension(r.c.simplex)); };
        r.orientation = static_cast<std::int8_t>(flat ? 0 : oriented ? sign() : 1);
    }
    return records;
}

std::vector<Inverse> make_inverses() {
    std::vector<Inverse> all;
    base::Random random(3);
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
    base::Random random(8);
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
    // a subnormal difference times a large one, against a product that is no smaller than a subnormal one could be
    for (int i = 0; i < 200; ++i) {
        Orientation o;
        const double y = std::ldexp(1, random.integer(-20, 250)), sign = random.coin() ? 1 : -1;
        o.p[2] = random.uniform(1, 2) * 0x1p-1023;
        o.p[3] = sign * y * 0x1p-24;
        o.p[4] = 0x1p-1000;
        o.p[5] = sign * y * random.uniform(1, 2);
        o.flat = exact_orientation(o.p, 2);
        o.solid = 2;
        all.push_back(o);
    }
    return all;
}

template <class T>
void write(std::ofstream& out, const std::vector<T>& all) {
    const std::size_t size = all.size();
    out.write(reinterpret_cast<const char*>(&size), sizeof size);
    out.write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(size * sizeof(T)));
}
}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::vector<Record> records = make_records(argv[2]);
    std::ofstream out(argv[1], std::ios::binary);
    write(out, records);
    write(out, make_inverses());
    write(out, make_orientations(records));
    std::printf("%zu cases\n", records.size());
    return 0;
}
