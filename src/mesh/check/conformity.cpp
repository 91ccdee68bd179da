// Does the mesh conform to the facets of the PLC that it was made from?
//
// A PLC facet is respected if it is a union of faces of cells. Faces that may be part of it have their three nodes
// close to its plane and their centroid in its region. It is respected
//   exactly        if all these nodes lie in its plane, no side of these faces crosses a side of its polygons, the
//                  polygons' vertices are nodes, and the faces add up to its area, all exactly. In a certified mesh
//                  then each of the faces lies in the region, for a side of a polygon that entered it would have to end
//                  in a node inside it or cross one of its sides; faces do not overlap; so equal areas mean equal sets;
//   by rounding    if that fails by little: a mesher that puts new nodes on slanted facets has to round them. Nodes
//                  within 2^-40 of the PLC's extent from the plane, crossings within that of an end, areas that agree
//                  to 2^-30. How far the farthest node is off the plane is measured;
// else it is violated. The share of it that is covered is then the area of what faces close to its plane, wherever
// their centroids lie, have in common with it. Facets without area (single segments) are left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "barycert/check_results.hpp"
#include "barycert/plc.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/check/plc_facet.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/exact_volumes.hpp"

namespace barycert::check {
namespace {

/// A face of a cell, by its nodes, close to the plane of a facet.
struct Candidate {
    std::uint32_t facet;
    bool beside;  ///< its centroid is not in the region
    std::array<const double*, 3> nodes;
};

/// Half of the largest extent of the PLC: a difference may overflow.
double half_extent_of(const Plc& plc) {
    Box box = empty_box;
    for (std::size_t i = 0; i + 3 <= plc.points.size(); i += 3) {
        const std::array<double, 3> at{plc.points[i], plc.points[i + 1], plc.points[i + 2]};
        box.add({at, at});
    }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, box.high[k] / 2 - box.low[k] / 2);
    return extent;
}

/// Twice the area of a facet and of the faces on it, projected, as exact integers in one unit.
class Areas {
public:
    Areas(const PlcRegion& region, std::span<const Candidate> faces)
        : points_(project(region, faces)), volumes_(2, points_) {
        const double* at = points_.data();
        for (std::size_t i = 0; i < region.triangles().size() + faces.size(); ++i, at += 6) {
            const double* const corners[] = {at, at + 2, at + 4};
            const Integer twice = volumes_.cell(corners);
            Integer& sum = i < region.triangles().size() ? facet_ : covered_;
            sum = twice.sign() < 0 ? sum - twice : sum + twice;
        }
    }

    bool none() const { return facet_.sign() == 0; }  ///< the facet has no area
    bool equal() const { return (facet_ - covered_).sign() == 0; }
    double share() const { return volumes_.rounded(covered_) / volumes_.rounded(facet_); }

private:
    static std::vector<double> project(const PlcRegion& region, std::span<const Candidate> faces) {
        const auto [x, y] = region.axes();
        std::vector<double> all;
        const auto add = [&, x = x, y = y](const PlcRegion::Triangle& t) {
            for (const double* p : t) all.insert(all.end(), {p[x], p[y]});
        };
        std::ranges::for_each(region.triangles(), add);
        for (const Candidate& face : faces) add(face.nodes);
        return all;
    }

    std::vector<double> points_;  ///< projected: of the facet's triangles, then of faces
    ExactVolumes volumes_;
    Integer facet_, covered_;
};

class ConformityChecker {
public:
    explicit ConformityChecker(const Checked& c) : c_(c) {
        for (const PlcFacet& facet : c.options.plc->facets) regions_.emplace_back(*c.options.plc, facet, exponent_);
    }

    ConformityReport run() {
        missing_ = find_missing();
        const std::vector<Candidate> candidates = find_candidates();
        ConformityReport out;
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            const auto faces = [&](bool beside) -> std::span<const Candidate> {
                const std::pair key(static_cast<std::uint32_t>(i), beside);
                return {std::ranges::lower_bound(candidates, key, {}, order),
                        std::ranges::upper_bound(candidates, key, {}, order)};
            };
            if (regions_[i].proper()) judge(i, faces(false), faces(true), out);
        }
        out.max_distance = std::scalbn(out.relative_distance, exponent_);
        if (half_extent_ > 0) out.relative_distance /= std::scalbn(half_extent_, 1 - exponent_);
        out.missing_vertices = missing_.size();
        return out;
    }

private:
    static constexpr double slack = 0x1p-40;  ///< in the unit of the regions: the PLC's extent, or down to half of it

    /// Faces close to the plane of a facet and about its polygons; by facet, those of the region first.
    std::vector<Candidate> find_candidates() const {
        std::vector<Box> boxes;
        std::vector<std::uint32_t> numbers;
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            if (!regions_[i].proper()) continue;
            boxes.push_back(regions_[i].box(2 * std::scalbn(slack, exponent_)));
            numbers.push_back(static_cast<std::uint32_t>(i));
        }
        const BoxTree tree(std::move(boxes));
        const mesh::FacetTable table(c_.mesh, c_.usable);
        std::vector<Candidate> all;
        in_blocks(
            table.node_count(), 4096, std::vector<Candidate>(),
            [&](std::size_t first, std::size_t last, std::vector<Candidate>& part) {
                table.for_each_group(first, last, [&](std::span<const mesh::CellFacet> equal) {
                    const auto nodes = nodes_of(equal.front());
                    tree.for_each(box_of(3, nodes.data(), 3), [&](std::uint32_t i) {
                        const PlcRegion& region = regions_[numbers[i]];
                        if (std::ranges::all_of(nodes, [&](const double* p) { return region.distance(p) <= slack; }))
                            part.push_back({numbers[i], !region.holds(centroid(region, nodes)), nodes});
                        return true;
                    });
                });
            },
            [&](const std::vector<Candidate>& part) { all.insert(all.end(), part.begin(), part.end()); });
        std::ranges::stable_sort(all, {}, order);
        return all;
    }

    static std::pair<std::uint32_t, bool> order(const Candidate& c) { return {c.facet, c.beside}; }

    std::array<const double*, 3> nodes_of(const mesh::CellFacet& f) const {
        std::array<const double*, 3> nodes{};
        for (std::size_t i = 0, n = 0; i < 4; ++i) {
            if (static_cast<std::int32_t>(i) != f.corner)
                nodes[n++] = c_.mesh.point(c_.mesh.cells[static_cast<std::size_t>(f.cell) * 4 + i]);
        }
        return nodes;
    }

    static PlcRegion::PlcPosition centroid(const PlcRegion& region, const std::array<const double*, 3>& nodes) {
        PlcRegion::PlcPosition c{};
        for (const double* p : nodes) {
            const PlcRegion::PlcPosition at = region.place(p);
            for (std::size_t k = 0; k < 2; ++k) c[k] += at[k] / 3;
        }
        return c;
    }

    void judge(std::size_t i, std::span<const Candidate> faces, std::span<const Candidate> beside,
               ConformityReport& out) const {
        const PlcRegion& region = regions_[i];
        const Areas areas(region, faces);
        if (areas.none()) return;
        ++out.facets;
        bool in_plane = true;
        double farthest = 0, crossing = -1;
        for (const Candidate& face : faces) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double* const p = face.nodes[k];
                in_plane = in_plane && region.in_plane(p);
                farthest = std::max(farthest, region.distance(p));
                crossing = std::max(crossing, region.crossing(p, face.nodes[(k + 1) % 3]));
            }
        }
        if (in_plane && crossing < 0 && areas.equal() && !misses_vertex(region)) {
            ++out.exact;
        } else if (crossing <= slack && std::fabs(areas.share() - 1) <= 0x1p-30) {
            ++out.rounded;
            out.relative_distance = std::max(out.relative_distance, farthest);
        } else {
            ++out.violated;
            if (out.examples.size() >= c_.options.examples) return;
            double covered = 0;
            for (const auto list : {faces, beside}) {
                for (const Candidate& face : list) covered += region.covered_by(face.nodes);
            }
            out.examples.push_back({static_cast<std::int64_t>(i), covered});
        }
    }

    using Point = std::array<double, 3>;
    static Point point(const double* p) { return {p[0], p[1], p[2]}; }

    bool misses_vertex(const PlcRegion& region) const {
        return !missing_.empty() && std::ranges::any_of(region.vertices(), [&](const double* p) {
            return std::ranges::binary_search(missing_, point(p));
        });
    }

    /// Vertices of polygons that are no node, bit for bit (0 and -0 are the same); sorted.
    std::vector<Point> find_missing() const {
        std::vector<Point> nodes, vertices, missing;
        for (std::size_t i = 0; i < c_.finite.size(); ++i) {
            if (c_.finite[i] != 0) nodes.push_back(point(&c_.mesh.points[3 * i]));
        }
        for (const PlcRegion& region : regions_) {
            for (const double* p : region.vertices()) vertices.push_back(point(p));
        }
        for (auto* list : {&nodes, &vertices}) {
            std::ranges::sort(*list);
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
        std::ranges::set_difference(vertices, nodes, std::back_inserter(missing));
        return missing;
    }

    const Checked& c_;
    double half_extent_ = half_extent_of(*c_.options.plc);
    /// Exponent of the unit of the regions, the largest power of two in the extent.
    int exponent_ = half_extent_ > 0 ? std::ilogb(half_extent_) + 1 : 0;
    std::vector<PlcRegion> regions_;
    std::vector<Point> missing_;
};

}  // namespace

ConformityReport check_conformity(const Checked& c) {
    return ConformityChecker(c).run();
}

}  // namespace barycert::check
