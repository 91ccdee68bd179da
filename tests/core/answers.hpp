/// One number for all that the exact core answers to a fixed stream of cases: law D1 is that it never changes.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "core/base/random.hpp"
#include "tests/core/environments.hpp"

namespace barycert::testing_answers {

/// FNV-1a, 64 bits.
class Hash {
public:
    void add(std::uint64_t word) {
        for (int i = 0; i < 8; ++i) state_ = (state_ ^ (word >> (8 * i) & 0xff)) * 0x100000001b3ULL;
    }
    /// NaN is one answer, whatever its bits.
    void add(double x) { add(std::isnan(x) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(x)); }
    void add(const TierCounts& t) {
        for (const std::uint64_t n : {t.filter, t.double_double, t.exact, t.degenerate, t.not_finite}) add(n);
    }
    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Additions, products and ldexp alone, and one draw a statement: the same numbers from every compiler.
inline double number(base::Random& r, int kind) {
    const double x = r.uniform(-1, 1);
    const int small = r.integer(-2, 2);
    const int wide = r.integer(-1074, 1022);
    switch (kind) {
        case 0:
            return small;
        case 1:
            return small * 0x1p-1074;
        case 2:
            return 1 + small * 0x1p-52;
        case 3:
            return std::ldexp(x, 1024);  // below 2^1024
        case 4:
            return std::ldexp(x, -1060);  // few bits, subnormal
        case 5:
            return std::ldexp(x, wide);
        default:
            return small == 0 ? x : small * 0.1;
    }
}

/// Case number k: easy ones, which need no integers; extreme numbers, lattices and coincidences; flat cells; cells of
/// sizes 2^-180 to 2^180.
inline Case stream_case(Simplex s, std::uint64_t k) {
    base::Random r = base::Random::stream(12, base::hash64("answers"), k);
    const int how = r.integer(0, 3);
    const int kind = r.integer(0, 6);
    Case c{.simplex = s};
    const int n = vertex_count(s), d = space_dimension(s);
    for (double& x : c.vertices) x = how == 0 ? number(r, kind) : r.uniform(-1, 1);
    for (double& x : c.values) x = how == 0 ? number(r, kind) : r.scaled(-1, 1, -4, 4);
    if (how == 2) {  // flat: all but in one plane, or line
        const int flat = r.integer(0, 50);
        for (int i = 0; i < n; ++i) c.vertex(i, d - 1) = std::ldexp(c.vertex(i, d - 1), -flat) + c.vertex(i, 0);
    }
    const int on = r.integer(0, 5);
    for (int axis = 0; axis < d; ++axis) {
        double p = 0;
        for (int i = 0; i < n; ++i) p += r.uniform(-0.1, 0.6) * c.vertex(i, axis);
        const bool finite = std::fabs(p) <= 0x1.fffffffffffffp+1023;
        if (how == 0) p = number(r, kind);
        if (on == 0 || !finite) p = c.vertex(0, axis);
        if (on == 1) p = c.vertex(0, axis) * 0.5 + c.vertex(1, axis) * 0.5;
        c.point[static_cast<std::size_t>(axis)] = p;
    }
    if (how == 3) {
        const int shift = r.integer(-180, 180);
        for (double& x : c.vertices) x = std::ldexp(x, shift);
        for (double& x : c.point) x = std::ldexp(x, shift);
    }
    return c;
}

/// All answers to cases [first, first + count) of a simplex, batches of 500 cases in both layouts and single calls.
/// The order in `words` is that of the cases; counts go to `tiers`.
inline void answer(Simplex s, std::uint64_t first, std::uint64_t count, std::vector<double>& numbers,
                   std::vector<std::uint64_t>& words, std::array<TierCounts, 6>& tiers) {
    const auto n = static_cast<std::size_t>(vertex_count(s));
    std::vector<Case> cases;
    for (std::uint64_t k = first; k < first + count; ++k) cases.push_back(stream_case(s, k));
    const testing_environments::Columns columns(s, cases);
    std::vector<WeightSigns> signs(count), mesh_signs(count);
    std::vector<double> w(n * count), mesh_w(n * count), v(count), mesh_v(count);
    bool good = weight_signs(columns.arrays(), signs, &tiers[0]).has_value();
    good = weight_signs(columns.mesh(), mesh_signs, &tiers[1]).has_value() && good;
    good = barycentric_weights(columns.arrays(), w, &tiers[2]).has_value() && good;
    good = barycentric_weights(columns.mesh(), mesh_w, &tiers[3]).has_value() && good;
    good = interpolate(columns.arrays(), columns.values(), v, &tiers[4]).has_value() && good;
    good = interpolate(columns.mesh(), columns.nodal_values(), mesh_v, &tiers[5]).has_value() && good;
    words.push_back(good ? 1 : 0);
    for (std::size_t j = 0; j < count; ++j) {
        const Case& c = cases[j];
        words.push_back(signs[j].bits());
        words.push_back(mesh_signs[j].bits());
        for (std::size_t i = 0; i < n; ++i) {
            numbers.push_back(w[n * j + i]);
            numbers.push_back(mesh_w[n * j + i]);
        }
        numbers.push_back(v[j]);
        numbers.push_back(mesh_v[j]);
        if (j % 4 != 0) continue;
        const double* const vertices = c.vertices.data();
        const Value value = interpolate(s, vertices, c.point.data(), c.values.data()).value();
        numbers.push_back(value.value);
        words.push_back(static_cast<std::uint64_t>(value.tier));
        const Weights weights = barycentric_weights(s, vertices, c.point.data()).value();
        for (std::size_t i = 0; i < n; ++i) numbers.push_back(weights.weights[i]);
        words.push_back(static_cast<std::uint64_t>(weights.tier));
        words.push_back(weight_signs(s, vertices, c.point.data()).bits());
        std::array<double, 3> p{};
        const Parameter t =
            point_of_value({vertices, 2}, {vertices + 2, 2}, c.values[0], c.values[1], c.values[0] / 3, {p.data(), 2})
                .value();
        numbers.insert(numbers.end(), {t.t, p[0], p[1]});
        (void)point_from_weights(s, vertices, c.values.data(), p.data()).has_value();
        numbers.insert(numbers.end(), p.begin(), p.end());
    }
}

/// The number. Chunks of cases are dealt to `threads` threads.
inline std::uint64_t hash_of_answers(int threads, std::uint64_t cases_a_simplex) {
    constexpr std::uint64_t chunk = 500;
    const std::uint64_t chunks = cases_a_simplex / chunk;
    Hash hash;
    for (const Simplex s : all_simplices) {
        struct Part {
            std::vector<double> numbers;
            std::vector<std::uint64_t> words;
            std::array<TierCounts, 6> tiers;
        };
        std::vector<Part> parts(chunks);
        const auto work = [&](std::uint64_t from) {
            for (std::uint64_t i = from; i < chunks; i += static_cast<std::uint64_t>(threads))
                answer(s, chunk * i, chunk, parts[i].numbers, parts[i].words, parts[i].tiers);
        };
        std::vector<std::thread> others;
        for (int t = 1; t < threads; ++t) others.emplace_back(work, static_cast<std::uint64_t>(t));
        work(0);
        for (std::thread& t : others) t.join();
        for (const Part& part : parts) {
            for (const double x : part.numbers) hash.add(x);
            for (const std::uint64_t x : part.words) hash.add(x);
            for (const TierCounts& t : part.tiers) hash.add(t);
        }
    }
    return hash.value();
}

/// For 4000 cases of each simplex. Pinned: answers are exact, or correctly rounded, so no change to the library may
/// alter them; a change of the bounds alters the counts of the tiers, and may.
inline constexpr std::uint64_t pinned_cases = 4000;
inline constexpr std::uint64_t pinned_hash = 0x48489dbae5530a6cULL;

}  // namespace barycert::testing_answers
