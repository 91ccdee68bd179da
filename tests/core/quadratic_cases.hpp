/// Questions to quadratic interpolation and the oracle's verdict, for its tests.
#pragma once

#include "barycert/oracle.hpp"
#include "barycert/weights.hpp"
#include "tests/core/field_cases.hpp"
#include "tests/core/rational.hpp"

namespace barycert::testing_fields {

inline Value value_of(const QuadraticCase& q) {
    const Case& c = q.linear;
    return interpolate_quadratic(c.simplex, c.vertices.data(), c.point.data(), q.nodal().data()).value();
}

inline void expect_as_oracle(const QuadraticCase& q, const Value& v) {
    const double exact = oracle_quadratic_value(q.linear, q.mids);
    ASSERT_EQ(v.degenerate, std::isnan(exact)) << describe(q);
    if (v.degenerate) {
        EXPECT_TRUE(std::isnan(v.value));
    } else {
        EXPECT_EQ(testing_rational::bits(v.value), testing_rational::bits(exact))
            << base::hexadecimal(v.value) << ' ' << base::hexadecimal(exact) << describe(q);
    }
}

inline void expect_law(const QuadraticCase& q) {
    const Value v = value_of(q);
    expect_as_oracle(q, v);
    const auto exact = exact_quadratic(q);
    ASSERT_EQ(v.degenerate, !exact) << describe(q);
    if (exact) {
        EXPECT_TRUE(testing_rational::nearest(v.value, *exact)) << describe(q);
    }
}

inline QuadraticCase with_mids(base::Random& r, const Case& c, testing_cases::Kind kind) {
    QuadraticCase q{c, {}};
    const testing_cases::Kind of_mids = r.coin() ? kind : testing_cases::Kind::ordinary;
    for (int e = 0; e < mid_node_count(c.simplex); ++e) q.mids.push_back(testing_cases::number(r, of_mids, 0));
    return q;
}

inline QuadraticCase stretched_case(base::Random& r, Simplex s, int flattest) {
    QuadraticCase q{stretched_cell(r, s, flattest), {}};
    for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(nodal_value(r));
    return q;
}

}  // namespace barycert::testing_fields
