/// Closed boxes, to tell which ranks may hold a point.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace barycert::in_vtk {

struct Box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> low{infinity, infinity, infinity};
    std::array<double, 3> high{-infinity, -infinity, -infinity};

    void add(const double* x) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (x[a] < low[a]) low[a] = x[a];
            if (x[a] > high[a]) high[a] = x[a];
        }
    }
    void add(const Box& other) {
        add(other.low.data());
        add(other.high.data());
    }
    bool empty() const { return !(low[0] <= high[0]); }
    /// Its boundary is part of it.
    bool holds(const double* x) const {
        return low[0] <= x[0] && x[0] <= high[0] && low[1] <= x[1] && x[1] <= high[1] && low[2] <= x[2] &&
               x[2] <= high[2];
    }
    bool meets(const Box& other) const {
        for (std::size_t a = 0; a < 3; ++a)
            if (!(low[a] <= other.high[a] && other.low[a] <= high[a])) return false;
        return true;
    }
};

/// At most `most` boxes, each around as many of the given ones (but one), which together cover them.
std::vector<Box> cover(std::vector<Box> boxes, std::size_t most);

/// Few boxes that cover many, in little memory: those whose middles lie near each other become one.
class Gathered {
public:
    /// The boxes will lie in that one.
    explicit Gathered(const Box& around) : around_(around), bins_(side * side * side) {}
    void add(const Box& box);
    const std::vector<Box>& boxes() const { return bins_; }

private:
    static constexpr std::size_t side = 16;
    Box around_;
    std::vector<Box> bins_;
};

/// Finds all boxes that hold a point.
class BoxTree {
public:
    /// owners[i] is what box i is found as; empty boxes are never found.
    BoxTree(const std::vector<Box>& boxes, const std::vector<int>& owners);

    /// Calls `take(owner)` for each box that holds the point.
    template <class Take>
    void holders(const double* x, Take&& take) const {
        std::array<std::size_t, 64> waiting{};
        std::size_t count = nodes_.empty() ? 0 : 1;
        while (count > 0) {
            const std::size_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!node.box.holds(x)) continue;
            if (node.second == 0) {
                take(node.owner);
            } else {
                waiting[count++] = node.second;
                waiting[count++] = at + 1;
            }
        }
    }

private:
    struct Node {
        Box box;
        std::size_t second = 0;  ///< of its two nodes, the first follows it; 0: it has none, and is a box itself
        int owner = -1;
    };
    void build(std::vector<Node>& leaves, std::size_t begin, std::size_t end);

    std::vector<Node> nodes_;
};

}  // namespace barycert::in_vtk
