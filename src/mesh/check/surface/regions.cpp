#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/base/vectors.hpp"
#include "core/whole_points.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/crossing.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::check {
namespace {

constexpr std::size_t max_shells = 1000;

long double area_of(const std::array<const double*, 3>& t) {
    base::Vector3<long double> u, v;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = static_cast<long double>(t[1][k]) - t[0][k];
        v[k] = static_cast<long double>(t[2][k]) - t[0][k];
    }
    const auto normal = base::cross(u, v);
    return std::sqrt(base::dot(normal, normal)) / 2;  // whose range is wide enough where long double is
}

/// As crossing(), of the middle of a triangle, which no double may be: in thirds, exactly.
int crossing_from_middle(const std::array<const double*, 3>& t, const std::array<const double*, 3>& middle_of) {
    using Number = core::WholeNumber;
    using Vector = core::WholeVector;
    const core::WholePoints whole{t[0], t[1], t[2], middle_of[0], middle_of[1], middle_of[2]};
    Vector p;
    std::array<Vector, 3> at;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector corner = whole.at(t[i]), part = whole.at(middle_of[i]);
        for (std::size_t k = 0; k < 3; ++k) at[i][k] = 3 * corner[k], p[k] += part[k];
    }
    const auto side = [&](const Vector& a, const Vector& b) {
        const Number turn = (b[1] - a[1]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[1] - a[1]);
        return (turn != 0 ? turn : a[2] != b[2] ? Number(a[2] - b[2]) : Number(b[1] - a[1])).sign();
    };
    const int s = side(at[0], at[1]);
    if (s == 0 || side(at[1], at[2]) != s || side(at[2], at[0]) != s) return 0;
    const Vector n = base::cross(base::minus(at[1], at[0]), base::minus(at[2], at[0]));
    return base::dot(n, base::minus(p, at[0])).sign() == -s ? s : 0;
}

/// The sides of triangles that look into one part of space: with normals away from it, a closed surface around it.
struct Chamber {
    std::uint32_t shell = 0;
    Integer six = {};  ///< six times the volume within, negative if it lies around its shell

    bool bounded() const { return six.sign() > 0; }
};

class Regions {
public:
    explicit Regions(SurfaceParts& s) : s_(s), volumes_(3, s.surface.points) {}

    /// Areas and volumes. Chambers if the surface is embedded.
    void measure() {
        const std::size_t count = s_.triangles.size();
        s_.found.shell_count = number_sets(s_.shells, count, shell_of_);
        const Sums sums = add_up(s_.found.shell_count, s_.embedded ? number_sets(s_.sides, 2 * count, chamber_) : 0);
        std::vector<std::uint8_t> balanced(s_.found.shell_count, 1);
        s_.found.shells.resize(s_.found.shell_count);
        for (std::size_t f = 0; f < count; ++f) {
            SurfaceShell& shell = s_.found.shells[shell_of_[f]];
            const Mesh::Index number = s_.triangles.number(f);
            shell.first = shell.first < 0 ? number : std::min(shell.first, number);
            ++shell.triangles;
        }
        for (const Ridge& edge : s_.unbalanced) balanced[shell_of_[edge.facet]] = 0;
        for (const Ridge& edge : s_.open) s_.found.shells[shell_of_[edge.facet]].closed = false;
        for (std::size_t i = 0; i < balanced.size(); ++i) {
            SurfaceShell& shell = s_.found.shells[i];
            shell.area = static_cast<double>(sums.area[i]);
            if (balanced[i] != 0) shell.volume = volumes_.rounded(sums.shell[i]);
            signs_.push_back(balanced[i] != 0 ? sums.shell[i].sign() : 0);
        }
        for (const Integer& six : sums.chamber) chambers_.push_back({.six = six});
        for (std::size_t side = 0; side < chamber_.size(); ++side)
            chambers_[chamber_[side]].shell = shell_of_[side / 2];
    }

    /// The chamber that holds a point on no triangle; nothing outside of all.
    std::optional<std::size_t> chamber_at(const double* p) {
        if (!s_.triangles.index.box_holds(p)) return {};
        std::map<std::uint32_t, int> winding;
        for_each_on_ray(&p, 1, [&](std::size_t f) { add(f, crossing(s_.triangles.turned(f), p), winding); });
        return smallest(winding);
    }

    /// The chamber that holds the shell of triangle f: by a node that no other shell has, or the triangle's middle.
    std::optional<std::size_t> chamber_around(std::size_t f) {
        const std::uint32_t shell = shell_of_[f];
        const double* const own = own_node(shell);
        const auto& at = s_.triangles.facets[f].at;
        std::map<std::uint32_t, int> winding;
        for_each_on_ray(own != nullptr ? &own : at.data(), own != nullptr ? 1 : 3, [&](std::size_t g) {
            if (shell_of_[g] == shell) return;
            const auto turned = s_.triangles.turned(g);
            add(g, own != nullptr ? crossing(turned, own) : crossing_from_middle(turned, at), winding);
        });
        return smallest(winding);
    }

    void nest() {
        std::vector<std::optional<std::size_t>> around(s_.found.shell_count);
        for (std::size_t f = 0; f < s_.triangles.size() && around.size() > 1; ++f) {
            if (s_.shells.find(f) == f) around[shell_of_[f]] = chamber_around(f);
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
        if (s_.triangles.index.box_holds(p)) {
            boxes().for_each_meeting(box_of(s_.triangles.index, &p, 1), [&](std::size_t f) {
                const auto facet = s_.surface.facet(s_.triangles.number(f));
                if ((seed.facet < 0 || facet < seed.facet) && face_around(3, s_.triangles.facets[f], p)[0] >= 0)
                    seed.facet = facet;
                return true;
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
                                          : (hole ? "hole point on a facet" : "region point on a facet"),
                 .point = std::array{p[0], p[1], p[2]}});
            // TetGen 1.5 looks for the cell that has it, and crashes where it finds none.
            if (!hole && seed.facet < 0) s_.defects[DefectKind::misplaced_point].cause = true;
        }
        s_.found.seeds.push_back(seed);
    }

    /// A node of the shell that no other shell has; nullptr if there is none.
    const double* own_node(std::uint32_t shell) {
        if (own_.empty()) {
            own_.assign(s_.found.shell_count, nullptr);
            constexpr std::int64_t none = -1, several = -2;
            std::vector<std::int64_t> shell_at(s_.triangles.index.original_node.size(), none);
            for (std::size_t g = 0; g < s_.triangles.size(); ++g) {
                const std::int64_t here = shell_of_[g];
                for (const Mesh::Index n : s_.triangles.facets[g].nodes) {
                    std::int64_t& at = shell_at[static_cast<std::size_t>(n)];
                    at = at == none || at == here ? here : several;
                }
            }
            for (std::size_t n = 0; n < shell_at.size(); ++n) {
                if (shell_at[n] >= 0)
                    own_[static_cast<std::size_t>(shell_at[n])] = s_.triangles.index.nodes[n].at.data();
            }
        }
        return own_[shell];
    }

    void add(std::size_t f, int crossings, std::map<std::uint32_t, int>& winding) const {
        if (crossings == 0) return;
        winding[chamber_[2 * f + 1]] += crossings;
        winding[chamber_[2 * f]] -= crossings;
    }
    std::optional<std::size_t> smallest(const std::map<std::uint32_t, int>& winding) const {
        std::optional<std::size_t> found;
        for (const auto& [c, times] : winding) {
            if (times == 0 || !chambers_[c].bounded()) continue;
            if (!found || (chambers_[c].six - chambers_[*found].six).sign() < 0) found = c;
        }
        return found;
    }

    const BoxGroups& boxes() {
        if (!boxes_) boxes_.emplace(make_cell_tree(s_.triangles.index));
        return *boxes_;
    }

    /// The triangles that a ray along the first axis from a mean of the points may cross.
    template <class Use>
    void for_each_on_ray(const double* const* points, std::size_t count, Use use) {
        CellBox ray = box_of(s_.triangles.index, points, count);
        ray.high[0] = Quantizer::max;
        boxes().for_each_meeting(ray, [&](std::size_t f) {
            use(f);
            return true;
        });
    }

    /// By shell and chamber: areas, and determinants of the triangles, those that look into a chamber taken off it.
    struct Sums {
        std::vector<long double> area;
        std::vector<Integer> shell, chamber;
    };
    Sums add_up(std::size_t shells, std::size_t chambers) const {
        // Most triangles have the shell and the chambers of the one before them.
        using Kind = std::array<std::uint32_t, 3>;
        std::map<Kind, std::uint32_t> numbers;
        std::vector<Kind> kinds;
        const std::size_t count = s_.triangles.size();
        std::vector<std::uint32_t> kind_of(count);
        for (std::size_t f = 0; f < count; ++f) {
            const Kind kind{shell_of_[f], chambers == 0 ? 0 : chamber_[2 * f], chambers == 0 ? 0 : chamber_[2 * f + 1]};
            if (f != 0 && kind == kinds[kind_of[f - 1]]) {
                kind_of[f] = kind_of[f - 1];
                continue;
            }
            const auto [at, fresh] = numbers.try_emplace(kind, static_cast<std::uint32_t>(kinds.size()));
            if (fresh) kinds.push_back(kind);
            kind_of[f] = at->second;
        }
        struct SumsOfKinds {
            std::vector<long double> area;
            std::vector<Integer> six;
        };
        const std::size_t blocks = kinds.size() > 64 ? 1 : 64, block = count / blocks + 1;
        std::vector<SumsOfKinds> parts(blocks,
                                       {std::vector<long double>(kinds.size()), std::vector<Integer>(kinds.size())});
        base::parallel_for(blocks, [&](std::size_t i) {
            for (std::size_t f = i * block; f < std::min(count, (i + 1) * block); ++f) {
                const auto at = s_.triangles.turned(f);
                parts[i].area[kind_of[f]] += area_of(at);
                Integer& sum = parts[i].six[kind_of[f]];
                sum = sum + volumes_.cone(at.data());
            }
        });
        Sums all{std::vector<long double>(shells), std::vector<Integer>(shells), std::vector<Integer>(chambers)};
        for (const SumsOfKinds& part : parts) {
            for (std::size_t k = 0; k < kinds.size(); ++k) {
                const auto& [shell, front, back] = kinds[k];
                all.area[shell] += part.area[k];
                all.shell[shell] = all.shell[shell] + part.six[k];
                if (chambers == 0) continue;
                all.chamber[front] = all.chamber[front] - part.six[k];
                all.chamber[back] = all.chamber[back] + part.six[k];
            }
        }
        return all;
    }

    /// Numbers sets from 0 in the order of their lowest members, and returns how many there are.
    static std::uint32_t number_sets(base::DisjointSets& sets, std::size_t count, std::vector<std::uint32_t>& number) {
        number.resize(count);
        std::uint32_t next = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t root = sets.find(i);
            number[i] = root == i ? next++ : number[root];
        }
        return next;
    }

    SurfaceParts& s_;
    ExactVolumes volumes_;
    std::vector<std::uint32_t> shell_of_;
    std::vector<int> signs_;  ///< of the volumes of shells
    std::vector<std::uint32_t> chamber_;
    std::vector<Chamber> chambers_;
    std::vector<std::int64_t> region_;  ///< of each chamber
    std::vector<const double*> own_;    ///< of each shell
    std::optional<BoxGroups> boxes_;    ///< of the triangles
};

}  // namespace

void measure_regions(SurfaceParts& s, const Plc* plc) {
    Regions regions(s);
    regions.measure();
    if (s.embedded) {
        regions.nest();
        if (plc != nullptr) regions.place_seeds(*plc);
    }
    if (s.found.shells.size() > max_shells) s.found.shells.resize(max_shells);
}

}  // namespace barycert::check
