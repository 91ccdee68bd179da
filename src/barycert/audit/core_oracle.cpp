#include "barycert/audit/judge.hpp"
#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"

namespace barycert::audit {

std::optional<OracleAnswer> ask_core(const Case& c) {
    if (c.perspective) return std::nullopt;
    TierCounts tiers;
    const WeightSigns signs = weight_signs(c.simplex, c.vertices.data(), c.point.data(), &tiers);
    // That a simplex is degenerate is for the integers to say.
    if (tiers.exact != 0 || signs.degenerate()) return std::nullopt;
    const Result<Weights> weights = barycentric_weights(c.simplex, c.vertices.data(), c.point.data());
    if (!weights || weights->tier == Tier::exact) return std::nullopt;
    const Result<Value> value = interpolate(c.simplex, c.vertices.data(), c.point.data(), c.values.data());
    if (!value || value->tier == Tier::exact) return std::nullopt;
    OracleAnswer a;
    a.region = signs.region();
    a.feature = signs.feature(c.simplex);
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        const auto k = static_cast<std::size_t>(i);
        a.signs[k] = static_cast<std::int8_t>(signs.sign(i));
        if (a.signs[k] != 0) a.support = static_cast<std::uint8_t>(a.support | (1U << k));
        a.weights[k] = weights->weights[k];
    }
    a.value = value->value;
    return a;
}

}  // namespace barycert::audit
