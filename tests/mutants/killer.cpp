// killer FILE: holds the core that it is linked with against the cases that `prepare` made. Exit code 1 and the name of
// the check that failed first, or 0 with a hash of the tier counts, which correct answers do not tell.

#include <cfenv>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "cases.hpp"

using namespace barycert;
using namespace barycert::mutants;

namespace {

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
    if (static_cast<int>(w.orientation()) != r.orientation) return false;
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

std::uint64_t tier_hash = 0;
void note(const TierCounts& t) {
    for (const std::uint64_t x : {t.filter, t.double_double, t.exact}) tier_hash = base::mix64(tier_hash ^ x) + 1;
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
        TierCounts tiers;
        expect(weight_signs(a.cases, signs, &tiers).has_value(), "signs: error " + where + how);
        for (std::size_t j = 0; j < count; ++j) expect(agrees(*records[j], signs[j]), "signs " + where + how);
        expect(tiers.cases() == count && tiers.degenerate == degenerate, "signs: count " + where + how);
        return tiers;
    };
    if (g != Group::near_ties) note(check_signs(""));  // what is near in them is no sign
    for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        if (g == Group::near_ties) break;
        std::fesetround(mode);
        check_signs(" rounding " + std::to_string(mode));
        std::fesetround(FE_TONEAREST);
    }
#ifdef __x86_64__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);
    if (g != Group::near_ties) check_signs(" flushed");
    _mm_setcsr(before);
#endif

    std::vector<double> weights(n * count), values(count), triples(3 * count);
    TierCounts tiers, value_tiers;
    expect(barycentric_weights(a.cases, weights, &tiers).has_value(), "weights: error " + where);
    expect(interpolate(a.cases, a.values, values, &value_tiers).has_value(), "values: error " + where);
    expect(interpolate(a.cases, a.with_triples, triples).has_value(), "triples: error " + where);
    for (std::size_t j = 0; j < count; ++j) {
        const OracleAnswer& answer = records[j]->answer;
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

    if (g == Group::near_ties) return;
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
        TierCounts one;
        expect(weight_signs(s, c.vertices.data(), c.point.data(), &one) == signs[j] && one.cases() == 1,
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
        TierCounts t;
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
            expect(!checked_weight_signs(s, c.vertices.data(), c.point.data()) &&
                       !barycentric_weights(s, c.vertices.data(), c.point.data()) &&
                       !interpolate(s, c.vertices.data(), c.point.data(), c.values.data()),
                   "not finite, single " + where);
        }
        Arrays a(s, some);
        a.rows[(n + 1) * d + n - 1][17] = bad;
        std::vector<double> values(300);
        TierCounts t;
        const bool degenerate = some[17]->answer.region == Region::degenerate;
        const std::uint64_t counted =
            degenerate ? 0 : some[17]->answer.support >> (n - 1) & 1;  // unless it has no part
        expect(interpolate(a.cases, a.values, values, &t).has_value() &&
                   std::isnan(values[17]) == (degenerate || counted != 0),
               "nodal value " + where);
        expect(t.not_finite == counted, "nodal value counted " + where);
        Arrays first(s, some);
        first.triples[n - 1][3 * 17] = bad;  // of three components the first alone
        std::vector<double> triples(900);
        TierCounts of_triples;
        expect(interpolate(first.cases, first.with_triples, triples, &of_triples).has_value() &&
                   of_triples.not_finite == counted,
               "component counted " + where);
    }
    Arrays a(s, some);
    std::vector<double> weights(n * 300), values(300), right_weights(n * 300), right_values(300);
    expect(barycentric_weights(a.cases, right_weights).has_value() &&
               interpolate(a.cases, a.values, right_values).has_value(),
           "default environment " + where);
    for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        std::vector<double> single_weights(n * 300), single_values(300);
        bool fine =
            barycentric_weights(a.cases, weights).has_value() && interpolate(a.cases, a.values, values).has_value();
        for (std::size_t j = 0; j < 300; ++j) {
            const Case& c = some[j]->c;
            const auto w = barycentric_weights(s, c.vertices.data(), c.point.data());
            const auto v = interpolate(s, c.vertices.data(), c.point.data(), c.values.data());
            fine = fine && w.has_value() && v.has_value();
            for (std::size_t i = 0; i < n; ++i) single_weights[n * j + i] = w->weights[i];
            single_values[j] = v->value;
        }
        std::fesetround(FE_TONEAREST);
        for (std::size_t i = 0; i < n * 300; ++i)
            fine = fine && same(weights[i], right_weights[i]) && same(single_weights[i], right_weights[i]);
        for (std::size_t j = 0; j < 300; ++j)
            fine = fine && same(values[j], right_values[j]) && same(single_values[j], right_values[j]);
        expect(fine, "environment set " + where);
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
    const auto check = [&](const std::string& how) {
        for (const Orientation& o : all) {
            const double* const p = o.p;
            if (o.flat != 2) expect(static_cast<int>(orient2d(p, p + 2, p + 4)) == o.flat, "orient2d" + how);
            if (o.flat == 2) expect(static_cast<int>(orient3d(p, p + 3, p + 6, p + 9)) == o.solid, "orient3d" + how);
        }
    };
    for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        check(" rounding " + std::to_string(mode));
    }
    std::fesetround(FE_TONEAREST);
#ifdef __x86_64__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040);
    check(" flushed");
    _mm_setcsr(before);
#endif
    for (int i = 0; i < 12; ++i) {
        double p[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
        p[i] = i % 2 == 0 ? HUGE_VAL : std::nan("");
        expect(!checked_orient3d(p, p + 3, p + 6, p + 9), "orient3d: not finite");
        if (i < 6) expect(!checked_orient2d(p, p + 2, p + 4), "orient2d: not finite");
    }
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
    if (argc != 2) return 2;
    std::ifstream in(argv[1], std::ios::binary);
    const auto records = read<Record>(in);
    const auto inverses = read<Inverse>(in);
    const auto orientations = read<Orientation>(in);
    for (const Simplex s : all_simplices) {
        std::vector<const Record*> of_group[group_count];
        for (const Record& r : records) {
            if (r.c.simplex == s) of_group[static_cast<int>(r.group)].push_back(&r);
        }
        for (int g = 0; g < group_count; ++g) {
            if (!of_group[g].empty()) check_batches(s, static_cast<Group>(g), of_group[g]);
        }
        check_edges(s, of_group[0]);
    }
    check_orientations(orientations);
    check_inverses(inverses);
    std::printf("SURVIVED %016" PRIx64 "\n", tier_hash);
    return 0;
}
