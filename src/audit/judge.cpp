#include "audit/judge.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "barycert/audit.hpp"
#include "barycert/oracle.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"

namespace barycert::audit {
namespace {

std::string first_of(std::span<const double> numbers, int count) {
    return base::joined(numbers.first(static_cast<std::size_t>(count)), " ", base::hexadecimal);
}

std::string told(const OracleAnswer& a, const Case& c) {
    return std::string(name(a.region)) + ", weights " + first_of(a.weights, vertex_count(c.simplex)) + ", value " +
           base::hexadecimal(a.value);
}

}  // namespace

std::optional<OracleAnswer> ask_core(const Case& c) {
    if (c.perspective) return std::nullopt;
    TierCounts tiers;
    const WeightSigns signs = weight_signs(c.simplex, c.vertices.data(), c.point.data(), &tiers);
    // Integers decide whether a simplex is degenerate.
    if (tiers.exact != 0 || signs.degenerate()) return std::nullopt;
    const Result<Weights> weights = barycentric_weights(c.simplex, c.vertices.data(), c.point.data());
    if (!weights || weights->tier == Tier::exact) return std::nullopt;
    const Result<Value> value = interpolate(c.simplex, c.vertices.data(), c.point.data(), c.values.data());
    if (!value || value->tier == Tier::exact) return std::nullopt;
    OracleAnswer a{.region = signs.region(), .feature = signs.feature(c.simplex)};
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        const auto k = static_cast<std::size_t>(i);
        a.signs[k] = static_cast<std::int8_t>(signs.sign(i));
        if (a.signs[k] != 0) a.support = static_cast<std::uint8_t>(a.support | (1U << k));
        a.weights[k] = weights->weights[k];
    }
    a.value = value->value;
    return a;
}

OracleAnswer Judge::decide(const Case& c, std::uint64_t index, OracleCounts& counts,
                           std::optional<Disagreement>& disagreement) const {
    const auto confirm = [&](const char* first, const OracleAnswer& answer, const char* second, Oracle oracle,
                             std::uint64_t& agreed) {
        const OracleAnswer other = oracle(c);
        ++agreed;
        if (!same_answer(answer, other)) keep_first(disagreement, Disagreement{index, first, second, answer, other, c});
    };
    if (choice_ == OracleChoice::cgal) {
        ++counts.cgal;
        return cgal_(c);
    }
    // Not every n-th: families number their cases by patterns of their own.
    const std::uint64_t dice = base::mix64(index);
    const bool in_sample = choice_ == OracleChoice::automatic && dice % cgal_share == 0;
    if (core_) {
        if (const std::optional<OracleAnswer> answer = ask_core(c)) {
            ++counts.core;
            if (dice % integers_share == 0) confirm("the core", *answer, "integers", ask_oracle, counts.also_integers);
            if (in_sample) confirm("the core", *answer, "CGAL", cgal_, counts.also_cgal);
            return *answer;
        }
    }
    const OracleAnswer answer = ask_oracle(c);
    ++counts.integers;
    if (!answer.narrow) ++counts.wide;
    if (choice_ == OracleChoice::both || in_sample || (choice_ == OracleChoice::automatic && !answer.narrow))
        confirm("integers", answer, "CGAL", cgal_, counts.also_cgal);
    return answer;
}

Error error_of(const Disagreement& d, const std::string& family, std::uint64_t seed) {
    const int n = vertex_count(d.c.simplex);
    return {.code = "audit.disagreement",
            .what = "two oracles disagree, so nothing is said of any kernel: family " + family + ", case " +
                    std::to_string(d.index) + ", seed " + std::to_string(seed) + ", " + std::string(name(d.c.simplex)) +
                    (d.c.perspective ? " in perspective" : "") + ", vertices " +
                    first_of(d.c.vertices, n * d.c.stride()) + ", point " +
                    first_of(d.c.point, space_dimension(d.c.simplex)) + ", values " + first_of(d.c.values, n),
            .expected = d.first + ": " + told(d.first_answer, d.c),
            .found = d.second + ": " + told(d.second_answer, d.c),
            .remedy = "one of them has a defect: report the case"};
}

}  // namespace barycert::audit
