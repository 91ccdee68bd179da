#include "barycert/index/overlap.hpp"

#include <algorithm>
#include <cstddef>

#include "barycert/predicates.hpp"

namespace barycert::index {
namespace {

// Two open convex polytopes are disjoint if and only if a plane separates them weakly, and then there is one whose
// normal is that of a facet of their Minkowski difference: the normal of a face of one, or the product of an edge of
// one and an edge of the other (in the plane: the normal of an edge of one).

/// The other corners, when corner i is left out.
constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
/// The ends of an edge, then the other two corners.
constexpr std::array<std::array<std::size_t, 4>, 6> edges{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

/// Side of p at the facet of a opposite to corner i.
Sign side(int d, const Corners& a, std::size_t i, const double* p) {
    const auto& f = faces[i];
    if (d == 2) return orient2d(a[f[0]], a[f[1]], p);
    return orient3d(a[f[0]], a[f[1]], a[f[2]], p);
}

/// A facet of a has all of b on its outer side, or on it.
bool facet_separates(int d, const Corners& a, const Corners& b) {
    const auto corners = static_cast<std::size_t>(d) + 1;
    for (std::size_t i = 0; i < corners; ++i) {
        const Sign inner = side(d, a, i, a[i]);
        bool separates = true;
        for (std::size_t j = 0; j < corners && separates; ++j) {
            bool common = false;  // a vertex of the facet is on its plane
            for (std::size_t k = 0; k < corners; ++k) common |= k != i && a[k] == b[j];
            separates = common || side(d, a, i, b[j]) != inner;
        }
        if (separates) return true;
    }
    return false;
}

/// The plane through edge e of a, parallel to edge f of b, has a on one side and b on the other, or on it.
bool edges_separate(const Corners& a, const Corners& b, const std::array<std::size_t, 4>& e,
                    const std::array<std::size_t, 4>& f) {
    const double *const p = a[e[0]], *const q = a[e[1]], *const r = b[f[0]], *const s = b[f[1]];
    // Sides of that plane; both ends of f have the same.
    const Sign b_edge = det3d(p, q, r, s, p, r);
    const Sign a2 = det3d(p, q, r, s, p, a[e[2]]), a3 = det3d(p, q, r, s, p, a[e[3]]);
    if (a2 == Sign::zero && a3 == Sign::zero) return false;  // parallel edges: no normal
    const Sign a_side = a2 != Sign::zero ? a2 : a3;
    if (a2 * a3 == Sign::negative || b_edge == a_side) return false;
    const Sign b2 = det3d(p, q, r, s, p, b[f[2]]), b3 = det3d(p, q, r, s, p, b[f[3]]);
    return b2 != a_side && b3 != a_side;
}

}  // namespace

bool may_overlap(int d, const Corners& a, const Corners& b) {
    return !facet_separates(d, a, b) && !facet_separates(d, b, a);
}

bool interiors_meet(int d, const Corners& a, const Corners& b) {
    if (!may_overlap(d, a, b)) return false;
    if (d == 2) return true;
    for (const auto& e : edges) {
        for (const auto& f : edges) {
            if (edges_separate(a, b, e, f)) return false;
        }
    }
    return true;
}

}  // namespace barycert::index
