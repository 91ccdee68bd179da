/// Lists of values by keys, as the cells of each node.
#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace barycert::base {

template <class Value>
class Lists {
public:
    Lists() = default;
    /// Makes the lists of all keys below `keys`, each in the order in which each(add) calls add(key, value). Calls
    /// `each` twice, to count and to fill: it must do the same both times.
    template <class Each>
    Lists(std::size_t keys, const Each& each) : begin_(keys + 2, 0) {
        // First how many of each key, two entries behind; then, one behind, where the next one goes.
        each([&](std::size_t key, const Value&) { ++begin_[key + 2]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        values_.resize(begin_.back());
        each([&](std::size_t key, const Value& value) { values_[begin_[key + 1]++] = value; });
        begin_.pop_back();
    }

    /// Number of lists.
    std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
    std::span<const Value> operator[](std::size_t key) const {
        return {values_.data() + begin_[key], begin_[key + 1] - begin_[key]};
    }
    std::size_t bytes() const { return begin_.size() * sizeof(std::size_t) + values_.size() * sizeof(Value); }

private:
    std::vector<std::size_t> begin_;
    std::vector<Value> values_;
};

}  // namespace barycert::base
