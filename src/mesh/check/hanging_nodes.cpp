#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/index/facet_contact.hpp"

namespace barycert::check {
namespace {

using Index = Mesh::Index;

/// A difference of two doubles, and what its rounding lost: a node an ulp off an edge is far off nothing else.
struct Difference {
    double high = 0, low = 0;
};
using DifferenceVector = std::array<Difference, 3>;

/// x u - y v to about its last place, however much of it cancels.
double minor(const Difference& x, const Difference& u, const Difference& y, const Difference& v) {
    const double product = y.high * v.high;
    return std::fma(x.high, u.high, -product) + std::fma(-y.high, v.high, product) +
           (x.high * u.low + x.low * u.high - y.high * v.low - y.low * v.high);
}

DifferenceVector cross(const DifferenceVector& u, const DifferenceVector& v) {
    DifferenceVector out;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        out[k].high = minor(u[a], v[b], u[b], v[a]);
    }
    return out;
}

double dot(const DifferenceVector& u, const DifferenceVector& v) {
    return u[0].high * v[0].high + u[1].high * v[1].high + u[2].high * v[2].high;
}

double length(const DifferenceVector& u) {
    return std::hypot(u[0].high, u[1].high, u[2].high);
}

class NearFaces {
public:
    NearFaces(const Checked& c, const std::vector<double>& radius)
        : mesh_(c.mesh), d_(static_cast<std::size_t>(mesh_.dimension)), volumes_(c.volumes), radius_(radius) {}

    /// The edge of the facet, or all of it, that the node nearly lies within; a face without nodes if there is none.
    HangingNode face_at(Index node, const BoundaryFacet& f) const {
        HangingNode h{.node = node, .face = {-1, -1, -1}, .cell = f.cell};
        double extent = 0, radius = radius_[index(node)];
        for (std::size_t i = 0; i < d_; ++i) {
            if (f.nodes[i] == node) return h;
            for (const Difference& x : between(f.nodes[0], f.nodes[i], 0)) extent = std::max(extent, std::fabs(x.high));
            radius = std::min(radius, radius_[index(f.nodes[i])]);
        }
        const int unit = std::ilogb(extent);  // squares of lengths are to be doubles
        radius = std::ldexp(radius, -unit);
        const DifferenceVector normal =
            cross(between(f.nodes[0], f.nodes[1], unit), between(f.nodes[0], f.nodes[d_ - 1], unit));
        bool inside = d_ == 3;
        h.distance = radius;
        for (std::size_t i = 0; i < d_; ++i) {
            const DifferenceVector to = between(f.nodes[i], node, unit);
            if (length(to) <= radius) return {.node = node, .face = {-1, -1, -1}, .cell = f.cell};
            if (d_ == 2 && i == 1) break;
            const Index next = f.nodes[(i + 1) % d_];
            const DifferenceVector side = between(f.nodes[i], next, unit), area = cross(side, to);
            const double along = dot(side, to), distance = length(area) / length(side);
            inside = inside && dot(area, normal) > 0;
            if (along > 0 && along < dot(side, side) && distance <= h.distance)
                h.face = {std::min(f.nodes[i], next), std::max(f.nodes[i], next), -1}, h.distance = distance;
        }
        if (h.face[0] < 0 && inside) {
            const double* const p[] = {at(f.nodes[0]), at(f.nodes[1]), at(f.nodes[2]), at(node)};
            h.distance = 6 * std::fabs(volumes_.rounded(volumes_.cell(p), unit)) / length(normal);
            if (h.distance <= radius) h.face = f.nodes;
            std::ranges::sort(h.face);
        }
        h.distance = std::ldexp(h.distance, unit);
        return h;
    }

    /// Not near the plane of the facet (2D: its line), as most facets are not whose boxes are near. In plain double:
    /// the rounding errors of h are below 16 units of 2^-53 of the sum of its terms' magnitudes, unless these
    /// underflow.
    bool is_far(Index node, const BoundaryFacet& f) const {
        std::array<double, 3> u{}, v{0, 0, 1}, t{};
        for (std::size_t k = 0; k < d_; ++k) {
            const double origin = at(f.nodes[0])[k];
            u[k] = at(f.nodes[1])[k] - origin, t[k] = at(node)[k] - origin;
            if (d_ == 3) v[k] = at(f.nodes[2])[k] - origin;
        }
        const double radius = radius_[index(node)];
        double h = 0, normal = 0, terms = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = u[(k + 1) % 3] * v[(k + 2) % 3], y = u[(k + 2) % 3] * v[(k + 1) % 3];
            h += t[k] * (x - y);
            normal += std::fabs(x - y);
            terms += (std::fabs(t[k]) + radius) * (std::fabs(x) + std::fabs(y));
        }
        return terms > 0x1p-900 && std::fabs(h) > radius * normal + 0x1p-48 * terms;
    }

    /// The node is beyond the facet.
    bool is_beyond(Index node, const BoundaryFacet& f) const {
        return weight(node, index(f.cell), static_cast<std::size_t>(f.corner)) <= 0;
    }
    bool is_in(Index node, std::size_t cell) const {
        for (std::size_t i = 0; i <= d_; ++i) {
            if (weight(node, cell, i) < 0) return false;
        }
        return true;
    }

private:
    static std::size_t index(Index i) { return static_cast<std::size_t>(i); }
    const double* at(Index node) const { return mesh_.point(node); }

    /// Its sign: that of the node in the cell, at corner i.
    int weight(Index node, std::size_t cell, std::size_t i) const {
        auto corners = corner_points(mesh_, cell);
        const int whole = exact_sign(mesh_.dimension, corners);
        corners[i] = at(node);
        return whole * exact_sign(mesh_.dimension, corners);
    }

    /// In units of 2^unit.
    DifferenceVector between(Index from, Index to, int unit) const {
        DifferenceVector v;
        for (std::size_t k = 0; k < d_; ++k) {
            const double a = std::ldexp(at(to)[k], -unit), b = std::ldexp(at(from)[k], -unit);
            const double high = a - b, less = high - a;
            v[k] = {high, (a - (high - less)) - (b + less)};
        }
        return v;
    }

    const Mesh& mesh_;
    std::size_t d_;
    const ExactVolumes& volumes_;
    const std::vector<double>& radius_;
};

/// Without those of a cell that has the node, too: it is a thin cell, not one that was not split. And without those
/// behind a facet and in no cell at the edge or facet: there are other cells in between, as in thin plates, whose two
/// sides are near each other and right.
void leave_out_right_ones(const Checked& c, const NearFaces& faces, std::vector<HangingNode>& all) {
    std::ranges::sort(all, {}, &HangingNode::face);
    for (std::size_t cell = 0; cell < c.usable.size() && !all.empty(); ++cell) {
        const std::span nodes = c.mesh.corners_of(cell);
        const auto has = [&](Index n) { return n < 0 || std::ranges::count(nodes, n) != 0; };
        for (const Index node : nodes) {
            if (c.usable[cell] == 0) break;
            auto h = std::ranges::lower_bound(all, node, {}, [](const HangingNode& a) { return a.face[0]; });
            for (; h != all.end() && h->face[0] == node; ++h) {
                if (h->node < 0 || !std::ranges::all_of(h->face, has)) continue;
                if (has(h->node))
                    h->node = -1;
                else if (h->cell < 0 && faces.is_in(h->node, cell))
                    h->cell = static_cast<Index>(cell);
            }
        }
    }
    std::erase_if(all, [](const HangingNode& h) { return h.node < 0 || h.cell < 0; });
}

}  // namespace

LimitedList<HangingNode> nearly_hanging(const Checked& c, const std::vector<double>& radius, std::size_t limit) {
    const int d = c.mesh.dimension;
    std::vector<Box> boxes;
    for (const BoundaryFacet& f : c.boundary) boxes.push_back(box_of(d, placed(c.mesh, f).at.data(), d));
    const BoxTree tree(std::move(boxes));
    const NearFaces faces(c, radius);
    auto all = up_to<HangingNode>(limit, radius.size(), 1024, [&](std::size_t first, std::size_t last, auto& part) {
        for (std::size_t n = first; n < last && part.size() <= limit; ++n) {
            const auto node = static_cast<Index>(n);
            if (radius[n] == 0) continue;
            tree.for_each(box_around(c.mesh, node, radius[n]), [&](std::uint32_t f) {
                const BoundaryFacet& facet = c.boundary[f];
                // A degenerate cell is told as such.
                if (!facet.oriented || faces.is_far(node, facet)) return true;
                HangingNode h = faces.face_at(node, facet);
                // A node that hangs is told as such.
                if (h.face[1] < 0 || face_around(d, placed(c.mesh, facet), c.mesh.point(node))[0] >= 0) return true;
                if (!faces.is_beyond(node, facet)) h.cell = -1;
                part.push_back(h);
                return part.size() <= limit;
            });
        }
    });
    leave_out_right_ones(c, faces, all.list);
    sort_hanging(all.list);
    return all;
}

}  // namespace barycert::check
