/// How answers were decided: which tier of arithmetic was needed.
#pragma once

#include <cstdint>
#include <string_view>

namespace barycert {

/// From cheap to dear. A tier answers only what its error bound proves, and passes on the rest.
enum class Tier : std::uint8_t {
    filter,         ///< double, with a bound on the error of the determinant
    double_double,  ///< double + correction, with a bound on the error of their sum
    exact,          ///< integers
};

constexpr std::string_view name(Tier t) {
    return t == Tier::filter ? "filter" : t == Tier::double_double ? "double-double" : "exact";
}

/// Counts of cases, one tier each, and what became of them. Batch functions add to what is there, unless they fail.
struct TierCounts {
    std::uint64_t filter = 0;
    std::uint64_t double_double = 0;
    std::uint64_t exact = 0;
    std::uint64_t degenerate = 0;  ///< of these, cases whose simplex is degenerate
    std::uint64_t not_finite = 0;  ///< of these, cases with a nodal value that is NaN or infinite

    std::uint64_t cases() const { return filter + double_double + exact; }
    void add(Tier t, std::uint64_t count = 1) {
        (t == Tier::filter ? filter : t == Tier::double_double ? double_double : exact) += count;
    }
    void add(const TierCounts& other) {
        filter += other.filter;
        double_double += other.double_double;
        exact += other.exact;
        degenerate += other.degenerate;
        not_finite += other.not_finite;
    }
    friend bool operator==(const TierCounts&, const TierCounts&) = default;
};

}  // namespace barycert
