#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "barycert/check/surface/parts.hpp"
#include "barycert/index/crossing.hpp"

namespace barycert::check {
namespace {

constexpr std::size_t max_shells = 1000;

long double area_of(const std::array<const double*, 3>& t) {
    long double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = static_cast<long double>(t[1][k]) - t[0][k];
        v[k] = static_cast<long double>(t[2][k]) - t[0][k];
    }
    const long double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return std::hypot(x, y, z) / 2;
}

/// The sides of triangles that look into one part of space: with normals away from it, a closed surface around it.
struct Chamber {
    std::uint32_t side = 0;  ///< the lowest of them
    std::uint32_t shell = 0;
    Integer six = {};  ///< six times the volume within, negative if it lies around its shell

    bool bounded() const { return six.sign() > 0; }
};

class Regions {
public:
    explicit Regions(SurfaceParts& s) : s_(s), volumes_(3, s.surface.points) {}

    void measure_shells() {
        std::vector<std::uint32_t> number(s_.triangles.facets.size());
        std::vector<long double> areas;
        std::vector<std::int64_t> balance;
        for (std::size_t f = 0; f < s_.triangles.facets.size(); ++f) {
            const std::uint32_t root = s_.shells.find(f);
            if (root == f) {
                number[f] = static_cast<std::uint32_t>(s_.found.shells.size());
                s_.found.shells.emplace_back().first = s_.triangles.number[f];
                areas.push_back(0);
            }
            number[f] = number[root];
            SurfaceShell& shell = s_.found.shells[number[f]];
            ++shell.triangles;
            shell.first = std::min(shell.first, s_.triangles.number[f]);
            areas[number[f]] += area_of(s_.triangles.facets[f].at);
        }
        std::vector<std::uint8_t> balanced(areas.size(), 1);
        for_each_ridge(s_.edges, [&](std::span<const Ridge> edge) {
            const auto up = std::ranges::count_if(edge, [&](const Ridge& r) { return s_.triangles.ascends(r); });
            const std::uint32_t shell = number[edge[0].facet];
            if (edge.size() == 1) s_.found.shells[shell].closed = false;
            if (2 * static_cast<std::size_t>(up) != edge.size()) balanced[shell] = 0;
        });
        std::vector<Integer> six(areas.size());
        add_cones(number, six);
        for (std::size_t i = 0; i < areas.size(); ++i) {
            SurfaceShell& shell = s_.found.shells[i];
            shell.area = static_cast<double>(areas[i]);
            if (balanced[i] != 0) shell.volume = volumes_.rounded(six[i]);
            signs_.push_back(balanced[i] != 0 ? six[i].sign() : 0);
        }
        s_.found.shell_count = s_.found.shells.size();
        shell_of_ = std::move(number);
    }

    /// Preconditions: embedded; measure_shells().
    void find_chambers() {
        std::map<std::uint32_t, std::size_t> of_root;
        chamber_.resize(2 * s_.triangles.facets.size());
        for (std::size_t side = 0; side < chamber_.size(); ++side) {
            const std::uint32_t root = s_.sides.find(side);
            if (root == side) {
                chamber_[side] = static_cast<std::uint32_t>(chambers_.size());
                chambers_.push_back({root, shell_of_[side / 2], {}});
            }
            chamber_[side] = chamber_[root];
        }
        std::vector<Integer> out(chambers_.size()), in(chambers_.size());
        std::vector<std::uint32_t> of_front(s_.triangles.facets.size()), of_back(s_.triangles.facets.size());
        for (std::size_t f = 0; f < s_.triangles.facets.size(); ++f) {
            of_front[f] = chamber_[2 * f];
            of_back[f] = chamber_[2 * f + 1];
        }
        add_cones(of_back, out);
        add_cones(of_front, in);
        for (std::size_t c = 0; c < chambers_.size(); ++c) chambers_[c].six = out[c] - in[c];
        s_.boxes = std::make_unique<BoxGroups>(s_.triangles.facets.size(), [&](std::size_t f) {
            return box_of(s_.triangles.index, s_.triangles.facets[f].at.data(), 3);
        });
    }

    /// The chamber that holds a point on no triangle, other than those of `without`; nothing outside of all.
    std::optional<std::size_t> chamber_at(const double* p, std::optional<std::uint32_t> without = {}) const {
        std::map<std::uint32_t, int> winding;
        for_each_on_ray(p, [&](std::size_t f) {
            const int c = without && shell_of_[f] == *without ? 0 : crossing(s_.triangles.turned(f), p);
            winding[chamber_[2 * f + 1]] += c;
            winding[chamber_[2 * f]] -= c;
        });
        std::optional<std::size_t> smallest;
        for (const auto& [c, times] : winding) {
            if (times == 0 || !chambers_[c].bounded()) continue;
            if (!smallest || (chambers_[c].six - chambers_[*smallest].six).sign() < 0) smallest = c;
        }
        return smallest;
    }

    void nest() {
        std::vector<std::uint8_t> outermost(s_.found.shell_count, 1);
        std::vector<std::optional<std::size_t>> around(s_.found.shell_count);
        for (std::size_t f = 0; f < s_.triangles.facets.size(); ++f) {
            if (s_.shells.find(f) == f) around[shell_of_[f]] = chamber_at(own_node(f), shell_of_[f]);
        }
        std::vector<Integer> left;
        for (const Chamber& c : chambers_) left.push_back(c.six);
        for (const Chamber& c : chambers_) {
            if (const auto& hold = around[c.shell]; hold && !c.bounded()) left[*hold] = left[*hold] + c.six;
        }
        region_.assign(chambers_.size(), -1);
        for (std::size_t c = 0; c < chambers_.size(); ++c) {
            if (!chambers_[c].bounded()) continue;
            region_[c] = static_cast<std::int64_t>(s_.found.regions.size());
            s_.found.regions.push_back({volumes_.rounded(left[c]), chambers_[c].shell});
        }
        for (std::size_t i = 0; i < around.size(); ++i) {
            if (around[i]) s_.found.shells[i].inside = chambers_[*around[i]].shell;
        }
        s_.found.outward = s_.found.closed && s_.found.oriented;
        for (std::size_t i = 0; i < around.size(); ++i) {
            std::size_t depth = 0;
            for (std::int64_t j = s_.found.shells[i].inside; j >= 0 && depth <= around.size(); ++depth)
                j = s_.found.shells[static_cast<std::size_t>(j)].inside;
            if (depth % 2 != 0 || signs_[i] >= 0) continue;
            s_.found.outward = false;
            s_.defects.add(DefectKind::inside_out, {.cells = {s_.found.shells[i].first, -1}});
        }
    }

    void place_seeds(const Plc& plc) {
        for (std::size_t i = 0; i + 2 < plc.holes.size(); i += 3) place_seed(true, i / 3, &plc.holes[i]);
        for (std::size_t i = 0; i + 4 < plc.regions.size(); i += 5) place_seed(false, i / 5, &plc.regions[i]);
    }

private:
    void place_seed(bool hole, std::size_t number, const double* p) {
        PlcSeed seed{hole, number, -1, -1};
        const CellBox at = box_of(s_.triangles.index, &p, 1);
        if (s_.triangles.index.box_holds(p)) {
            s_.boxes->for_each_meeting(at, [&](std::size_t f) {
                if (face_around(3, s_.triangles.facets[f], p)[0] >= 0)
                    seed.facet = s_.surface.facet(s_.triangles.number[f]);
                return seed.facet < 0;
            });
        }
        const auto chamber = seed.facet < 0 ? chamber_at(p) : std::nullopt;
        if (chamber) {
            seed.region = region_[*chamber];
            if (hole) s_.found.regions[static_cast<std::size_t>(seed.region)].hole = true;
        } else {
            s_.defects.add(
                DefectKind::misplaced_point,
                {.detail = seed.facet < 0 ? (hole ? "hole point in no closed part" : "region point in no closed part")
                                          : (hole ? "hole point on a facet" : "region point on a facet")});
        }
        s_.found.seeds.push_back(seed);
    }

    /// A node of the triangle's shell that no other shell has, if there is one; else one of the triangle's.
    const double* own_node(std::size_t f) {
        if (shells_at_.empty()) {
            shells_at_.assign(s_.triangles.index.original_node.size(), -1);
            for (std::size_t g = 0; g < s_.triangles.facets.size(); ++g) {
                for (const Mesh::Index n : s_.triangles.facets[g].nodes) {
                    std::int64_t& shell = shells_at_[static_cast<std::size_t>(n)];
                    shell = shell == -1 || shell == shell_of_[g] ? shell_of_[g] : -2;
                }
            }
            own_.assign(s_.found.shell_count, nullptr);
            for (std::size_t n = 0; n < shells_at_.size(); ++n) {
                if (shells_at_[n] >= 0)
                    own_[static_cast<std::size_t>(shells_at_[n])] = s_.triangles.index.nodes[n].at.data();
            }
        }
        const double* const own = own_[shell_of_[f]];
        return own != nullptr ? own : s_.triangles.facets[f].at[0];
    }

    template <class Use>
    void for_each_on_ray(const double* p, Use use) const {
        if (!s_.triangles.index.box_holds(p)) return;
        CellBox ray = box_of(s_.triangles.index, &p, 1);
        ray.high[0] = Quantizer::max;
        s_.boxes->for_each_meeting(ray, [&](std::size_t f) {
            use(f);
            return true;
        });
    }

    /// Adds det(a, b, c) of each triangle to the sum of its number.
    void add_cones(const std::vector<std::uint32_t>& number, std::vector<Integer>& sums) {
        const std::size_t blocks = sums.size() > 64 ? 1 : 64, block = s_.triangles.facets.size() / blocks + 1;
        std::vector<std::vector<Integer>> parts(blocks, sums);
        base::parallel_for(blocks, [&](std::size_t i) {
            for (std::size_t f = i * block; f < std::min(s_.triangles.facets.size(), (i + 1) * block); ++f) {
                Integer& sum = parts[i][number[f]];
                sum = sum + volumes_.cone(s_.triangles.turned(f).data());
            }
        });
        for (const auto& part : parts) {
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[i] + part[i];
        }
    }

    SurfaceParts& s_;
    ExactVolumes volumes_;
    std::vector<std::uint32_t> shell_of_;
    std::vector<int> signs_;  ///< of the volumes of shells
    std::vector<std::uint32_t> chamber_;
    std::vector<Chamber> chambers_;
    std::vector<std::int64_t> region_;     ///< of each chamber
    std::vector<std::int64_t> shells_at_;  ///< of each place of a node: its shell; -2: several
    std::vector<const double*> own_;
};

}  // namespace

void measure_regions(SurfaceParts& s, const Plc* plc) {
    Regions regions(s);
    regions.measure_shells();
    if (s.embedded) {
        regions.find_chambers();
        regions.nest();
        if (plc != nullptr) regions.place_seeds(*plc);
    }
    if (s.found.shells.size() > max_shells) s.found.shells.resize(max_shells);
}

}  // namespace barycert::check
