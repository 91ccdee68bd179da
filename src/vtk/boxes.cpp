#include "vtk/boxes.hpp"

#include <algorithm>

namespace barycert::in_vtk {

namespace {

// Halves of these, by their middles along the axis on which the middles spread most.
template <class Item, class BoxOf>
void halve(std::vector<Item>& items, std::size_t begin, std::size_t middle, std::size_t end, BoxOf&& box_of) {
    const auto middle_of = [&](const Item& item, std::size_t a) {
        // Halved first, for boxes may be as large as doubles are.
        return box_of(item).low[a] / 2 + box_of(item).high[a] / 2;
    };
    Box spread;
    for (std::size_t i = begin; i < end; ++i) {
        std::array<double, 3> x{};
        for (std::size_t a = 0; a < 3; ++a) x[a] = middle_of(items[i], a);
        spread.add(x.data());
    }
    std::size_t widest = 0;
    const auto width = [&](std::size_t a) { return spread.high[a] / 2 - spread.low[a] / 2; };
    for (const std::size_t a : {std::size_t{1}, std::size_t{2}})
        if (width(a) > width(widest)) widest = a;
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](const Item& a, const Item& b) { return middle_of(a, widest) < middle_of(b, widest); });
}

void cover_some(std::vector<Box>& boxes, std::size_t begin, std::size_t end, std::size_t most, std::vector<Box>& all) {
    if (most <= 1 || end - begin <= 1) {
        Box around;
        for (std::size_t i = begin; i < end; ++i) around.add(boxes[i]);
        if (begin < end) all.push_back(around);
        return;
    }
    const std::size_t left = most / 2, middle = begin + (end - begin) * left / most;
    halve(boxes, begin, middle, end, [](const Box& box) -> const Box& { return box; });
    cover_some(boxes, begin, middle, left, all);
    cover_some(boxes, middle, end, most - left, all);
}

}  // namespace

std::vector<Box> cover(std::vector<Box> boxes, std::size_t most) {
    std::erase_if(boxes, [](const Box& box) { return box.empty(); });
    std::vector<Box> all;
    cover_some(boxes, 0, boxes.size(), most, all);
    return all;
}

void Gathered::add(const Box& box) {
    std::size_t bin = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        // Halved first, for boxes may be as large as doubles are.
        const double middle = box.low[a] / 2 + box.high[a] / 2, width = around_.high[a] / 2 - around_.low[a] / 2;
        const double share = width > 0 ? (middle / 2 - around_.low[a] / 2) / width : 0;
        const auto place = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(side));
        bin = side * bin + std::min(place, side - 1);
    }
    bins_[bin].add(box);
}

BoxTree::BoxTree(const std::vector<Box>& boxes, const std::vector<int>& owners) {
    std::vector<Node> leaves;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].empty()) leaves.push_back({boxes[i], 0, owners[i]});
    nodes_.reserve(2 * leaves.size());
    if (!leaves.empty()) build(leaves, 0, leaves.size());
}

void BoxTree::build(std::vector<Node>& leaves, std::size_t begin, std::size_t end) {
    if (end - begin == 1) {
        nodes_.push_back(leaves[begin]);
        return;
    }
    const std::size_t at = nodes_.size(), middle = begin + (end - begin) / 2;
    nodes_.emplace_back();
    halve(leaves, begin, middle, end, [](const Node& node) -> const Box& { return node.box; });
    build(leaves, begin, middle);
    const std::size_t second = nodes_.size();
    build(leaves, middle, end);
    nodes_[at].second = second;
    nodes_[at].box = nodes_[at + 1].box;
    nodes_[at].box.add(nodes_[second].box);
}

}  // namespace barycert::in_vtk
