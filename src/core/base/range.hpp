/// From the least to the greatest of some numbers.
#pragma once

#include <algorithm>
#include <cmath>

namespace barycert::base {

struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;

    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    bool empty() const { return !(low <= high); }
    double middle() const { return 0.5 * low + 0.5 * high; }
    double half() const { return 0.5 * high - 0.5 * low; }
};

}  // namespace barycert::base
