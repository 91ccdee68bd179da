/// Which tier of arithmetic decided an answer.
#pragma once

#include <cstdint>
#include <string_view>

namespace barycert {

/// From cheap to expensive. A tier answers only what its error bound proves; what it leaves undecided goes to the next.
enum class Tier : std::uint8_t {
    filter,         ///< double, with a bound on the error of the determinant
    double_double,  ///< double + correction, with a bound on the error of their sum
    exact,          ///< integers
};

constexpr std::string_view name(Tier t) {
    return t == Tier::filter ? "filter" : t == Tier::double_double ? "double-double" : "exact";
}

/// How many cases each tier decided. Functions add to the counts they are given; one that returns an Error leaves them
/// unchanged.
struct TierCounts {
    std::uint64_t filter = 0;
    std::uint64_t double_double = 0;
    std::uint64_t exact = 0;
    std::uint64_t degenerate = 0;  ///< cases, of those above, whose simplex is degenerate
    std::uint64_t not_finite = 0;  ///< cases, of those above, with a NaN or infinite nodal value that takes part

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
