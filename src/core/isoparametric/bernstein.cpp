#include "core/isoparametric/bernstein.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {
namespace {

using MultiIndex = BernsteinBasis::Index;

/// Calls use(index) for all that have the sum `degree` in `corners` letters from `first` on.
template <class Use>
void for_indices(MultiIndex& index, std::size_t first, std::size_t corners, std::size_t degree, const Use& use) {
    if (corners == 1) {
        index[first] = static_cast<std::uint8_t>(degree);
        return use();
    }
    for (std::size_t k = 0; k <= degree; ++k) {
        index[first] = static_cast<std::uint8_t>(k);
        for_indices(index, first + 1, corners - 1, degree - k, use);
    }
}

}  // namespace

BernsteinBasis::BernsteinBasis(const std::vector<Factor>& factors) {
    std::vector<MultiIndex> all{MultiIndex{}};
    std::size_t first = 0;
    for (const Factor& factor : factors) {
        std::vector<MultiIndex> longer;
        for (MultiIndex index : all)
            for_indices(index, first, factor.corners, factor.degree, [&] { longer.push_back(index); });
        all = std::move(longer);
        first += factor.corners;
    }
    indices_ = std::move(all);
    std::ranges::sort(indices_);
    for (std::size_t place = 0; place < size(); ++place) {
        bool corner = true;
        std::size_t begin = 0;
        for (const Factor& factor : factors) {
            const auto of = std::span(indices_[place]).subspan(begin, factor.corners);
            corner = corner && std::ranges::max(of) == factor.degree;
            begin += factor.corners;
        }
        if (corner) corners_.push_back(place);
    }
    first = 0;
    for (const Factor& factor : factors) {
        for (std::size_t to = first; to < first + factor.corners; ++to) {
            for (std::size_t from = first; from < to; ++from) {
                std::map<MultiIndex, std::vector<std::uint16_t>> lines;
                for (std::size_t i = 0; i < size(); ++i) {
                    MultiIndex along = indices_[i];
                    along[from] = static_cast<std::uint8_t>(along[from] + along[to]);
                    along[to] = 0;
                    lines[along].push_back(static_cast<std::uint16_t>(i));
                }
                Edge edge{from, to, {}, static_cast<int>(factor.degree)};
                for (auto& [along, line] : lines) {
                    std::ranges::sort(line, {}, [&](std::uint16_t i) { return indices_[i][to]; });
                    edge.lines.push_back(std::move(line));
                }
                edges_.push_back(std::move(edge));
            }
        }
        first += factor.corners;
    }
}

std::size_t BernsteinBasis::place(const MultiIndex& index) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(indices_, index) - indices_.begin());
}

int BernsteinBasis::factorials(std::size_t place) const {
    int product = 1;
    for (const std::uint8_t k : indices_[place]) {
        for (int i = 2; i <= k; ++i) product *= i;
    }
    return product;
}

const BernsteinBasis& jacobian_basis(const Reference& of) {
    static const std::array<BernsteinBasis, 4> products{
        BernsteinBasis({{2, 1}, {2, 1}}), BernsteinBasis({{2, 2}, {2, 2}, {2, 2}}), BernsteinBasis({{3, 1}, {2, 2}}),
        BernsteinBasis({{2, 2}, {2, 2}})};
    static const std::array<std::array<BernsteinBasis, 3>, 2> simplices{
        {{BernsteinBasis({{3, 2}}), BernsteinBasis({{3, 4}}), BernsteinBasis({{3, 6}})},
         {BernsteinBasis({{4, 3}}), BernsteinBasis({{4, 6}}), BernsteinBasis({{4, 9}})}}};
    if (!of.is_simplex()) return products[static_cast<std::size_t>(of.element)];
    return simplices[of.dimension() - 2][static_cast<std::size_t>(of.order - 2)];
}

}  // namespace barycert::core::isoparametric
