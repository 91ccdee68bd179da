#include "barycert/locate/near_feature.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "barycert/core/exact_tier.hpp"
#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"

namespace barycert::locate {
namespace {

// Which feature? Let x be the point of a proper cell nearest to p, p not inside, and F the open face of the cell in
// which x lies. F is the only one for which
//   vertex a:   p projects to each edge ab at a or beyond it: (p - a).(b - a) <= 0;
//   edge ab:    p projects to the inside of ab, and to the plane of each face abc on ab or on the other side than c;
//   face abc:   p projects to the inside of abc, and does not lie on the cell's side of it.
// For x is nearest if and only if (p - x).(c - x) <= 0 for all corners c, and all these are signs of such products:
// with x on ab and p - x normal to it, that of c has the sign of the weight of c of p's projection to abc. In the plane
// the edges are what faces are here. All of it are signs of weights.

class Classifier {
public:
    Classifier(const NearCell& cell, const Point3& p) : cell_(cell), p_(p) {
        std::array<double, 12> vertices{};
        const auto n = static_cast<std::size_t>(cell.count), d = n - 1;
        for (std::size_t i = 0; i < n; ++i) std::copy_n(cell.at[i].begin(), d, &vertices[d * i]);
        sides_ = weight_signs(d == 2 ? Simplex::triangle : Simplex::tetrahedron, vertices.data(), p.data());
    }

    bool degenerate() const { return sides_.degenerate(); }
    bool inside() const { return sides_.region() == Region::interior; }

    bool nearest(unsigned mask) {
        const int corners = std::popcount(mask);
        if (corners == cell_.count - 1 && sides_.sign(std::countr_one(mask)) == Sign::positive) return false;
        for (int i = 0; i < cell_.count; ++i) {
            // What lies within it, and on the faces of one dimension more.
            if (corners > 1 && (mask >> i & 1) != 0 && !positive(mask, i)) return false;
            if (corners < cell_.count - 1 && (mask >> i & 1) == 0 && positive(mask | 1U << i, i)) return false;
        }
        return true;
    }

private:
    /// The weight of corner i in the projection of p to the edge or face is positive.
    bool positive(unsigned mask, int i) {
        auto& known = signs_[mask];
        const NearFeature f = cell_.feature(mask);
        if (!known) known = weight_signs(f.simplex(), f.vertices().data(), p_.data());
        const int place = std::popcount(mask & ((1U << i) - 1));
        return known->sign(place) == Sign::positive;
    }

    const NearCell& cell_;
    const Point3& p_;
    WeightSigns sides_;
    std::array<std::optional<WeightSigns>, 16> signs_;
};

}  // namespace

NearFeature NearCell::feature(unsigned mask) const {
    NearFeature f;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if ((mask >> i & 1) == 0) continue;
        f.nodes[static_cast<std::size_t>(f.count)] = nodes[i];
        f.at[static_cast<std::size_t>(f.count++)] = at[i];
    }
    return f;
}

bool nearest_feature(const NearCell& cell, const Point3& p, unsigned guess, NearFeature& out) {
    Classifier is(cell, p);
    if (is.degenerate()) return false;
    if (is.inside()) {
        out = NearFeature{.count = 1, .at = {p}};
        return true;
    }
    const unsigned all = (1U << cell.count) - 1;
    unsigned found = is.nearest(guess) ? guess : 0;
    for (unsigned mask = 1; found == 0 && mask < all; ++mask) {
        if (is.nearest(mask)) found = mask;
    }
    out = cell.feature(found);
    return true;
}

std::array<double, 3> weights_of(const Point3& p, const NearFeature& f) {
    if (f.count == 1) return {1, 0, 0};
    const std::array<double, 9> vertices = f.vertices();
    std::array<double, 3> weights{};
    const Result<Weights> quick = barycentric_weights(f.simplex(), vertices.data(), p.data());
    // No Error but one of the environment, to which integers do not look.
    if (quick) {
        std::copy_n(quick->weights.begin(), 3, weights.begin());
    } else {
        const core::ExactWeights exact(f.simplex(), vertices.data(), p.data());
        for (int i = 0; i < f.count; ++i) weights[static_cast<std::size_t>(i)] = exact.weight(i);
    }
    return weights;
}

}  // namespace barycert::locate
