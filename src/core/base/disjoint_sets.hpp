/// Disjoint sets of numbers, joined two at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace barycert::base {

class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    /// The lowest number of i's set.
    std::uint32_t find(std::size_t i) {
        auto at = static_cast<std::uint32_t>(i);
        while (parent_[at] != at) at = parent_[at] = parent_[parent_[at]];
        return at;
    }

    void join(std::size_t i, std::size_t j) {
        std::uint32_t a = find(i), b = find(j);
        if (a > b) std::swap(a, b);
        parent_[b] = a;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace barycert::base
