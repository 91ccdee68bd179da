#include "barycert/check/conformity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "barycert/check/exact_volumes.hpp"
#include "barycert/check/findings.hpp"
#include "barycert/check/plc_facet.hpp"
#include "barycert/mesh/facets.hpp"

namespace barycert::check {
namespace {

/// A face of a cell, by its nodes, that may be part of a facet.
struct Candidate {
    std::uint32_t facet;
    std::array<const double*, 3> nodes;
};

double extent_of(const Plc& plc) {
    std::array<double, 3> low{}, high{};
    for (std::size_t i = 0; i < plc.points.size(); ++i) {
        low[i % 3] = i < 3 ? plc.points[i] : std::min(low[i % 3], plc.points[i]);
        high[i % 3] = i < 3 ? plc.points[i] : std::max(high[i % 3], plc.points[i]);
    }
    return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

/// Twice the area of a facet and of the faces on it, projected, as exact integers in one unit.
class Areas {
public:
    Areas(const PlcRegion& region, std::span<const Candidate> faces)
        : region_(region), volumes_(2, project(region, faces)) {
        for (const PlcRegion::Ring& ring : region.rings()) {
            Integer twice;
            for (std::size_t i = 0; i < ring.points.size(); ++i) {
                const auto a = projected(ring.points[i]), b = projected(ring.points[(i + 1) % ring.points.size()]);
                const double* const ends[] = {a.data(), b.data()};
                twice = twice + volumes_.cone(ends);
            }
            facet_ = (twice.sign() < 0) == ring.hole ? facet_ + twice : facet_ - twice;
        }
        for (const Candidate& face : faces) {
            const auto a = projected(face.nodes[0]), b = projected(face.nodes[1]), c = projected(face.nodes[2]);
            const double* const corners[] = {a.data(), b.data(), c.data()};
            const Integer twice = volumes_.cell(corners);
            covered_ = twice.sign() < 0 ? covered_ - twice : covered_ + twice;
        }
    }

    bool equal() const { return (facet_ - covered_).sign() == 0; }
    double share() const { return volumes_.rounded(covered_) / volumes_.rounded(facet_); }

private:
    std::array<double, 2> projected(const double* p) const {
        const auto [x, y] = region_.axes();
        return {p[x], p[y]};
    }

    static std::vector<double> project(const PlcRegion& region, std::span<const Candidate> faces) {
        const auto [x, y] = region.axes();
        std::vector<double> all;
        for (const PlcRegion::Ring& ring : region.rings()) {
            for (const double* p : ring.points) all.insert(all.end(), {p[x], p[y]});
        }
        for (const Candidate& face : faces) {
            for (const double* p : face.nodes) all.insert(all.end(), {p[x], p[y]});
        }
        return all;
    }

    const PlcRegion& region_;
    ExactVolumes volumes_;
    Integer facet_, covered_;
};

class ConformityChecker {
public:
    ConformityChecker(const Mesh& mesh, std::span<const std::uint8_t> use, const Plc& plc)
        : mesh_(mesh), use_(use), extent_(extent_of(plc)) {
        for (const PlcFacet& facet : plc.facets) regions_.emplace_back(plc, facet);
    }

    Conformity run(std::size_t examples) {
        const std::vector<Candidate> candidates = find_candidates();
        Conformity out;
        auto at = candidates.begin();
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            const auto end = std::find_if(at, candidates.end(), [&](const Candidate& c) { return c.facet != i; });
            if (regions_[i].proper()) judge(i, {at, end}, examples, out);
            at = end;
        }
        out.relative_distance = extent_ > 0 ? out.largest_distance / extent_ : 0;
        out.missing_vertices = count_missing();
        return out;
    }

private:
    double slack() const { return 0x1p-40 * extent_; }

    /// Faces close to the plane of a facet and over its polygons; by facet.
    std::vector<Candidate> find_candidates() const {
        std::vector<Box> boxes;
        std::vector<std::uint32_t> numbers;
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            if (!regions_[i].proper()) continue;
            boxes.push_back(regions_[i].box(2 * slack()));
            numbers.push_back(static_cast<std::uint32_t>(i));
        }
        const BoxTree tree(std::move(boxes));
        const detail::FacetTable table(mesh_, use_);
        std::vector<Candidate> all;
        in_blocks(
            table.node_count(), 4096, [] { return std::vector<Candidate>(); },
            [&](std::size_t first, std::size_t last, std::vector<Candidate>& part) {
                table.for_each_group(first, last, [&](std::span<const detail::CellFacet> equal) {
                    const auto nodes = nodes_of(equal.front());
                    tree.for_each(box_of(3, nodes.data(), 3), [&](std::uint32_t i) {
                        if (close(regions_[numbers[i]], nodes)) part.push_back({numbers[i], nodes});
                        return true;
                    });
                });
            },
            [&](const std::vector<Candidate>& part) { all.insert(all.end(), part.begin(), part.end()); });
        std::stable_sort(all.begin(), all.end(),
                         [](const Candidate& a, const Candidate& b) { return a.facet < b.facet; });
        return all;
    }

    std::array<const double*, 3> nodes_of(const detail::CellFacet& f) const {
        std::array<const double*, 3> nodes{};
        std::size_t n = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (static_cast<std::int32_t>(i) == f.corner) continue;
            nodes[n++] =
                &mesh_.points[static_cast<std::size_t>(mesh_.cells[static_cast<std::size_t>(f.cell) * 4 + i]) * 3];
        }
        return nodes;
    }

    bool close(const PlcRegion& region, const std::array<const double*, 3>& nodes) const {
        double centroid[3]{};
        for (const double* p : nodes) {
            if (region.distance(p) > slack()) return false;
            for (int k = 0; k < 3; ++k) centroid[k] += p[k] / 3;
        }
        return region.holds(centroid);
    }

    void judge(std::size_t i, std::span<const Candidate> faces, std::size_t examples, Conformity& out) const {
        ++out.facets;
        const PlcRegion& region = regions_[i];
        const Areas areas(region, faces);
        bool in_plane = true;
        double farthest = 0;
        for (const Candidate& face : faces) {
            for (const double* p : face.nodes) {
                in_plane = in_plane && region.in_plane(p);
                farthest = std::max(farthest, region.distance(p));
            }
        }
        const double share = areas.share();
        if (in_plane && areas.equal()) {
            ++out.exact;
        } else if (std::fabs(share - 1) <= 0x1p-30) {
            ++out.rounded;
            out.largest_distance = std::max(out.largest_distance, farthest);
        } else {
            ++out.violated;
            if (out.examples.size() < examples) out.examples.push_back({static_cast<std::int64_t>(i), share});
        }
    }

    /// Vertices of proper facets that are no node, bit for bit (0 and -0 are the same).
    std::uint64_t count_missing() const {
        using Point = std::array<double, 3>;
        std::vector<Point> nodes;
        for (std::size_t i = 0; i < mesh_.point_count(); ++i) {
            const Point p{mesh_.points[3 * i], mesh_.points[3 * i + 1], mesh_.points[3 * i + 2]};
            if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) nodes.push_back(p);
        }
        std::sort(nodes.begin(), nodes.end());
        std::vector<Point> vertices;
        for (const PlcRegion& region : regions_) {
            for (const PlcRegion::Ring& ring : region.rings()) {
                for (const double* p : ring.points) vertices.push_back({p[0], p[1], p[2]});
            }
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        return static_cast<std::uint64_t>(std::count_if(vertices.begin(), vertices.end(), [&](const Point& p) {
            return !std::binary_search(nodes.begin(), nodes.end(), p);
        }));
    }

    const Mesh& mesh_;
    std::span<const std::uint8_t> use_;
    double extent_;
    std::vector<PlcRegion> regions_;
};

}  // namespace

Conformity check_conformity(const Mesh& mesh, std::span<const std::uint8_t> use, const Plc& plc, std::size_t examples) {
    return ConformityChecker(mesh, use, plc).run(examples);
}

}  // namespace barycert::check
