/// Questions about gradients and the oracle's verdict, for their tests.
#pragma once

#include "barycert/oracle.hpp"
#include "barycert/weights.hpp"
#include "tests/core/field_cases.hpp"
#include "tests/core/rational.hpp"

namespace barycert::testing_fields {

inline Gradient gradient_in(const Case& c) {
    return gradient(c.simplex, c.vertices.data(), c.values.data()).value();
}

/// The oracle's bits; its degeneracy, and NaN there.
inline void expect_as_oracle(const Case& c, const Gradient& g) {
    const GradientAnswer answer = oracle_gradient(c);
    ASSERT_EQ(g.degenerate, answer.degenerate) << testing_cases::describe(c);
    for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(c.simplex)); ++k) {
        if (answer.degenerate) {
            EXPECT_TRUE(std::isnan(g.gradient[k]));
        } else {
            EXPECT_EQ(testing_rational::bits(g.gradient[k]), testing_rational::bits(answer.gradient[k]))
                << k << ' ' << testing_cases::describe(c);
        }
    }
}

/// Core and oracle, each rounded rightly by the definition.
inline void expect_gradient_law(const Case& c) {
    const Gradient g = gradient_in(c);
    expect_as_oracle(c, g);
    const auto exact = exact_gradient(c);
    ASSERT_EQ(g.degenerate, !exact) << testing_cases::describe(c);
    for (std::size_t k = 0; exact && k < exact->size(); ++k)
        EXPECT_TRUE(testing_rational::nearest(g.gradient[k], (*exact)[k])) << k << ' ' << testing_cases::describe(c);
}

}  // namespace barycert::testing_fields
