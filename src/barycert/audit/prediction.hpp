/// What the condition number of a cell predicts of a kernel's error, beside what was measured.
///
/// The prediction: where nothing under- or overflows, a kernel that works with differences of coordinates has weights
/// within C * 2^-53 * kappa of the exact ones for points of the cell, with a small constant C (core/condition.hpp).
/// Cases are sorted by log2(kappa), the bits that the cell may cost, one bit a bin.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/core/simplex.hpp"

namespace barycert::audit {

/// kappa of the case's cell where there is something to predict: a triangle or tetrahedron, not degenerate, with the
/// point in it or on its boundary, and no product of differences far out in the range of double. NaN elsewhere.
/// `region` is the exact one.
double predicting_condition(const Case& c, Region region);

class Prediction {
public:
    static constexpr int last_bits = 1100;  ///< and more: above the log2 of every double

    struct Bin {
        int bits = 0;  ///< floor(log2(kappa))
        std::uint64_t cases = 0;
        double median = 0;  ///< of the cases' largest errors, in units of 2^-53; the upper edge of half an octave
        double worst = 0;   ///< the largest of them, likewise
    };

    /// One case: kappa >= 1 and the largest |weight - exact weight|, finite.
    void add(double kappa, double error);
    void merge(const Prediction& other);

    std::uint64_t cases() const;

    /// The largest error / (2^-53 kappa) where kappa < 2^47, up to which the prediction is one of first order: the
    /// constant C that would have held. -1 without such cases.
    double worst_factor() const { return worst_factor_; }

    /// Those that hold cases, ascending.
    std::vector<Bin> bins() const;

private:
    struct Row {
        double worst = 0;
        std::vector<std::uint64_t> errors;  ///< by magnitude, as long as it takes
    };
    std::vector<Row> rows_;  ///< by bits, likewise
    double worst_factor_ = -1;
};

}  // namespace barycert::audit
