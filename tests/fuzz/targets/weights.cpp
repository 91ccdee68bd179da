// Signs, weights and values of a case, one and on lanes, held against the oracle.
#include "barycert/weights.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "barycert/oracle.hpp"
#include "barycert/predicates.hpp"
#include "tests/fuzz/drawn.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

Case draw_case(Draws& draws) {
    Case c{.simplex = all_simplices[draws.below(static_cast<unsigned>(all_simplices.size()))]};
    const auto numbers = static_cast<Numbers>(draws.below(5));
    const auto d = static_cast<std::size_t>(space_dimension(c.simplex)),
               n = static_cast<std::size_t>(vertex_count(c.simplex));
    for (std::size_t i = 0; i < n * d; ++i) c.vertices[i] = draw_number(draws, numbers);
    for (std::size_t k = 0; k < d; ++k) c.point[k] = draw_number(draws, numbers);
    for (std::size_t i = 0; i < n; ++i) c.values[i] = draw_number(draws, numbers);
    return c;
}

}  // namespace

BARYCERT_FUZZ_TARGET(weights) {
    Draws draws(input);
    const Case c = draw_case(draws);
    const OracleAnswer exact = ask_oracle(c);
    const auto n = static_cast<std::size_t>(vertex_count(c.simplex));

    const WeightSigns signs = weight_signs(c.simplex, c.vertices.data(), c.point.data());
    expect(signs.region() == exact.region && signs.feature(c.simplex) == exact.feature, "a region is wrong");
    const Result<Weights> weights = barycentric_weights(c.simplex, c.vertices.data(), c.point.data());
    expect(bool(weights) && weights->degenerate == (exact.region == Region::degenerate), "weights are not given");
    for (std::size_t i = 0; i < n; ++i) {
        expect(static_cast<int>(signs.sign(static_cast<int>(i))) == exact.signs[i], "a sign is wrong");
        expect(same(weights->weights[i], exact.weights[i]), "a weight is wrong");
    }
    const Result<Value> value = interpolate(c.simplex, c.vertices.data(), c.point.data(), c.values.data());
    expect(bool(value) && same(value->value, exact.value), "a value is wrong");

    // The same on lanes: one cell of its own nodes, seventeen times, so that some lanes are of a last, shorter block.
    constexpr std::size_t count = 17;
    const auto d = static_cast<std::size_t>(space_dimension(c.simplex));
    const std::array<std::int32_t, 4> corners{0, 1, 2, 3};
    const std::array<std::int32_t, count> cells{};
    std::vector<double> points;
    for (std::size_t j = 0; j < count; ++j)
        points.insert(points.end(), c.point.begin(), c.point.begin() + static_cast<std::ptrdiff_t>(d));
    const MeshQueries queries{c.simplex, std::span(c.vertices).first(n * d), std::span(corners).first(n), cells,
                              points};
    std::array<WeightSigns, count> many_signs;
    std::vector<double> many_weights(n * count), many_values(count);
    expect(bool(weight_signs(queries, many_signs)) && barycentric_weights(queries, many_weights) &&
               interpolate(queries, NodalValues<double>{std::span(c.values).first(n), 1}, many_values),
           "lanes are not answered");
    for (std::size_t j = 0; j < count; ++j) {
        expect(many_signs[j] == signs, "a sign on lanes is wrong");
        expect(same(many_values[j], exact.value), "a value on lanes is wrong");
        for (std::size_t i = 0; i < n; ++i)
            expect(same(many_weights[n * j + i], exact.weights[i]), "a weight on lanes is wrong");
    }
}

}  // namespace barycert::fuzz
