/// The right answer, by rational arithmetic: normal equations of the edge vectors, solved by elimination, then, for
/// perspective, the depths. Shares nothing with the kernels but the types of a case.
#pragma once

#include <gmpxx.h>

#include <utility>
#include <vector>

#include "barycert/simplex.hpp"

namespace barycert::testing {

struct ExactWeights {
    Region region = Region::degenerate;
    std::vector<mpq_class> weights;  ///< empty if degenerate
};

inline ExactWeights exact_weights(const Case& c) {
    const int n = vertex_count(c.simplex), d = space_dimension(c.simplex), m = n - 1;
    // Row i: (e_i.e_0 ... e_i.e_m-1 | e_i.r) with e_i = v_i+1 - v_0 and r = p - v_0.
    const auto component = [&](int i, int axis) -> mpq_class {
        const double from = i < m ? c.vertex(i + 1, axis) : c.point[static_cast<std::size_t>(axis)];
        return mpq_class(from) - mpq_class(c.vertex(0, axis));
    };
    std::vector<std::vector<mpq_class>> row(static_cast<std::size_t>(m),
                                            std::vector<mpq_class>(static_cast<std::size_t>(n)));
    const auto at = [&](int i, int j) -> mpq_class& {
        return row[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int axis = 0; axis < d; ++axis) at(i, j) += component(i, axis) * component(j, axis);
        }
    }
    // A Gram matrix is positive semidefinite: a zero pivot without a swap means that it is singular.
    for (int k = 0; k < m; ++k) {
        if (at(k, k) == 0) return {};
        for (int i = 0; i < m; ++i) {
            if (i == k) continue;
            const mpq_class factor = at(i, k) / at(k, k);
            for (int j = k; j < n; ++j) at(i, j) -= factor * at(k, j);
        }
    }
    ExactWeights exact{Region::interior, {mpq_class(1)}};
    for (int i = 0; i < m; ++i) {
        exact.weights.push_back(at(i, m) / at(i, i));
        exact.weights[0] -= exact.weights.back();
    }
    if (c.perspective) {
        mpq_class sum;
        for (int i = 0; i < n; ++i) sum += exact.weights[static_cast<std::size_t>(i)] /= mpq_class(c.depth(i));
        if (sum == 0) return {};
        for (mpq_class& w : exact.weights) w /= sum;
    }
    for (const mpq_class& w : exact.weights) {
        if (w == 0 && exact.region == Region::interior) exact.region = Region::boundary;
        if (w < 0) exact.region = Region::outside;
    }
    return exact;
}

}  // namespace barycert::testing
