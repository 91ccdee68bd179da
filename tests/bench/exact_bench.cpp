// Exact signs, correctly rounded weights and values: their price beside plain double, and beside other exact ways.
//
// Rows that are compared run turn by turn, and ratios are medians of ratios within a repetition, so that noise hits
// both sides. Times are the thread's own. Every answer is verified first: signs against CGAL::orientation, weights and
// values against the oracle, and all of them between the SIMD targets; then the exit code is 1 if one is wrong. Missed
// demands are printed, no more.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/predicates.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/weights.hpp"
#include "barycert/witness.hpp"
#include "core/base/random.hpp"
#include "core/blocks.hpp"
#include "exact_peers.hpp"
#include "exact_table.hpp"
#include "numerators.hpp"
#include "require.hpp"

namespace {

using namespace barycert;
using bench::Demand;
using bench::require;
using bench::Row;
using bench::TargetTable;

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Epick::Point_3;

constexpr int repetitions = 11;
constexpr auto tetrahedron = Simplex::tetrahedron;
constexpr std::size_t queries_of_a_mesh = 1U << 18;
constexpr std::size_t in_cache = 1024;  // cases; 160 KB with their values

/// Keeps what a peer computed from being optimised away.
template <class T>
void keep(const T& x) {
    asm volatile("" : : "g"(&x) : "memory");
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

Point as_point(const double* x) {
    return {x[0], x[1], x[2]};
}

// ---- Data ----------------------------------------------------------------------------------------------------------

/// The unit cube in side^3 voxels of 6 tetrahedra along the diagonal, inner nodes displaced by up to 0.15 voxels.
struct CubeMesh {
    std::vector<double> nodes, field, field3;
    std::vector<std::int32_t> corners;
    std::vector<Point> points;

    std::size_t cells() const { return corners.size() / 4; }

    explicit CubeMesh(int side) {
        base::Random random(7);
        const double h = 1.0 / side;
        for (int z = 0; z <= side; ++z) {
            for (int y = 0; y <= side; ++y) {
                for (int x = 0; x <= side; ++x) {
                    const bool inner = x % side != 0 && y % side != 0 && z % side != 0;
                    for (const int k : {x, y, z})
                        nodes.push_back(h * (k + (inner ? random.uniform(-0.15, 0.15) : 0.0)));
                    for (int c = 0; c < 3; ++c) field3.push_back(random.uniform(-1, 1));
                    field.push_back(field3[field3.size() - 3]);
                    points.push_back(as_point(nodes.data() + nodes.size() - 3));
                }
            }
        }
        const std::int32_t row = side + 1;
        const std::array<std::int32_t, 3> step{1, row, row * row};
        for (int z = 0; z < side; ++z) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const std::int32_t first = x + row * (y + row * z), opposite = first + step[0] + step[1] + step[2];
                    for (std::size_t a = 0; a < 3; ++a) {  // from corner to corner along three axes in each order
                        for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3}) {
                            const std::int32_t p = first + step[a], q = p + step[b];
                            const bool even = b == (a + 1) % 3;
                            for (const std::int32_t node : {first, even ? p : q, even ? q : p, opposite})
                                corners.push_back(node);
                        }
                    }
                }
            }
        }
        for (std::size_t c = 0; c < cells(); ++c)
            require(CGAL::orientation(corner(c, 0), corner(c, 1), corner(c, 2), corner(c, 3)) == CGAL::POSITIVE,
                    "a cell of the mesh is turned");
    }

    const Point& corner(std::size_t cell, std::size_t i) const {
        return points[static_cast<std::size_t>(corners[4 * cell + i])];
    }
};

/// Random points for random cells of a mesh, the cells in random order or in that of their numbers.
struct Queries {
    std::vector<std::int32_t> cells;
    std::vector<double> coordinates;
    std::vector<Point> points;

    /// Points anywhere in the cube, or such with weights of up to half beyond those inside.
    Queries(const CubeMesh& mesh, bool near, bool in_order = false) {
        base::Random random(11);
        for (std::size_t j = 0; j < queries_of_a_mesh; ++j)
            cells.push_back(static_cast<std::int32_t>(random.below(mesh.cells())));
        if (in_order) std::sort(cells.begin(), cells.end());
        for (std::size_t j = 0; j < queries_of_a_mesh; ++j) {
            const auto cell = static_cast<std::size_t>(cells[j]);
            std::array<double, 4> w{};
            double sum = 0;
            for (double& x : w) sum += x = random.unit();
            for (std::size_t k = 0; k < 3; ++k) {
                double x = near ? 0 : random.unit();
                for (std::size_t i = 0; near && i < 4; ++i) {
                    const auto node = static_cast<std::size_t>(mesh.corners[4 * cell + i]);
                    x += (1.5 * w[i] / sum - 0.125) * mesh.nodes[3 * node + k];
                }
                coordinates.push_back(x);
            }
            points.push_back(as_point(coordinates.data() + 3 * j));
        }
    }

    MeshQueries of(const CubeMesh& mesh) const { return {tetrahedron, mesh.nodes, mesh.corners, cells, coordinates}; }
};

/// Cases in structure of arrays, and vertex after vertex.
struct Cases {
    explicit Cases(std::vector<Case> from) : list(std::move(from)) {
        for (std::size_t i = 0; i < 12; ++i) {
            for (const Case& c : list) vertices[i].push_back(c.vertices[i]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            for (const Case& c : list) point[k].push_back(c.point[k]);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            for (const Case& c : list) {
                values[i].push_back(c.values[i]);
                for (const std::size_t k : {0, 1, 2}) values3[i].push_back(c.values[(i + k) % 4]);
            }
        }
        for (const Case& c : list) {
            for (std::size_t i = 0; i < 4; ++i) cgal.push_back(as_point(c.vertices.data() + 3 * i));
            cgal.push_back(as_point(c.point.data()));
        }
    }

    std::size_t count() const { return list.size(); }

    CaseArrays arrays() const {
        CaseArrays a;
        a.count = count();
        for (std::size_t i = 0; i < 12; ++i) a.vertices[i] = vertices[i].data();
        for (std::size_t k = 0; k < 3; ++k) a.point[k] = point[k].data();
        return a;
    }
    ValueArrays<double> field() const { return {{f(0), f(1), f(2), f(3)}, 1}; }
    ValueArrays<double> field3() const {
        return {{values3[0].data(), values3[1].data(), values3[2].data(), values3[3].data()}, 3};
    }
    const double* f(std::size_t i) const { return values[i].data(); }

    std::vector<Case> list;
    std::array<std::vector<double>, 12> vertices;
    std::array<std::vector<double>, 3> point;
    std::array<std::vector<double>, 4> values, values3;
    std::vector<Point> cgal;  ///< five a case, the last the point
};

Case case_of(const CubeMesh& mesh, const Queries& queries, std::size_t j) {
    Case c;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto node = static_cast<std::size_t>(mesh.corners[4 * static_cast<std::size_t>(queries.cells[j]) + i]);
        for (std::size_t k = 0; k < 3; ++k) c.vertices[3 * i + k] = mesh.nodes[3 * node + k];
        c.values[i] = mesh.field[node];
    }
    for (std::size_t k = 0; k < 3; ++k) c.point[k] = queries.coordinates[3 * j + k];
    return c;
}

Cases cases_of(const CubeMesh& mesh, const Queries& queries, std::size_t count) {
    std::vector<Case> list;
    for (std::size_t j = 0; j < count; ++j) list.push_back(case_of(mesh, queries, j));
    return Cases(std::move(list));
}

/// Points exactly on vertices, edges and faces in turn: coordinates of 20 bits, weights in sixteenths.
Cases cases_on_features(std::size_t count) {
    std::vector<Case> list(count);
    base::Random random(13);
    for (std::size_t j = 0; j < count; ++j) {
        Case& c = list[j];
        const int support = 1 + static_cast<int>(j % 3);
        std::array<int, 4> w{};
        for (int i = 0, left = 16; i < support; ++i) {
            w[static_cast<std::size_t>(i)] = i + 1 == support ? left : random.integer(1, left - (support - i - 1));
            left -= w[static_cast<std::size_t>(i)];
        }
        const auto turn = static_cast<std::size_t>(random.below(4));
        for (double& x : c.vertices) x = random.integer(-(1 << 20), 1 << 20) * 0x1p-20;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < 4; ++i) c.point[k] += w[(i + turn) % 4] * c.vertices[3 * i + k] / 16;
        }
        for (double& f : c.values) f = random.uniform(-1, 1);
    }
    return Cases(std::move(list));
}

/// Points in the middle of edges, where the value lies exactly between two doubles: (f0 + f1)/2 with an odd last bit.
Cases cases_of_ties(std::size_t count) {
    std::vector<Case> list(count);
    base::Random random(17);
    for (Case& c : list) {
        for (double& x : c.vertices) x = random.integer(-(1 << 20), 1 << 20) * 0x1p-20;
        for (std::size_t k = 0; k < 3; ++k) c.point[k] = (c.vertices[k] + c.vertices[3 + k]) / 2;
        for (double& f : c.values) f = 1 + static_cast<double>(random.bits() >> 12 & ~std::uint64_t{1}) * 0x1p-52;
        c.values[1] += 0x1p-52;
    }
    return Cases(std::move(list));
}

Cases cases_of_family(const char* glob, std::size_t count) {
    const std::vector<Family> families = families_matching(glob);
    require(families.size() == 1, "no such family");
    std::vector<Case> list;
    for (std::size_t j = 0; j < count; ++j) list.push_back(make_case(families[0], tetrahedron, 1, j, MeshSource()));
    return Cases(std::move(list));
}

// ---- Peers ---------------------------------------------------------------------------------------------------------

/// The code of WeightSigns from CGAL's four signs of a point and a cell of positive volume.
WeightSigns cgal_signs(const Point& a, const Point& b, const Point& c, const Point& d, const Point& p) {
    const std::array<CGAL::Orientation, 4> s{CGAL::orientation(p, b, c, d), CGAL::orientation(a, p, c, d),
                                             CGAL::orientation(a, b, p, d), CGAL::orientation(a, b, c, p)};
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= s[i] == CGAL::NEGATIVE ? 1U << i : s[i] == CGAL::ZERO ? 1U << (4 + i) : 0;
    return WeightSigns(static_cast<WeightSigns::Bits>(bits));
}

void cgal_signs(const CubeMesh& mesh, const Queries& queries, std::vector<WeightSigns>& out) {
    for (std::size_t j = 0; j < queries.cells.size(); ++j) {
        const auto cell = static_cast<std::size_t>(queries.cells[j]);
        out[j] = cgal_signs(mesh.corner(cell, 0), mesh.corner(cell, 1), mesh.corner(cell, 2), mesh.corner(cell, 3),
                            queries.points[j]);
    }
    keep(out[0]);
}

void cgal_signs(const Cases& cases, std::vector<WeightSigns>& out) {
    for (std::size_t j = 0; j < cases.count(); ++j) {
        const Point* const v = cases.cgal.data() + 5 * j;
        out[j] = cgal_signs(v[0], v[1], v[2], v[3], v[4]);
    }
    keep(out[0]);
}

/// The library's own blocks, decided by plain determinants.
template <class Batch>
void plain_signs(const Batch& batch, WeightSigns* out) {
    const auto decide = [&](std::size_t first, const core::CaseBlock& block, std::uint32_t*) -> std::size_t {
        peers::plain_signs(block, out + first);
        return 0;
    };
    core::for_blocks(batch, Tier::filter, nullptr, decide, [](std::size_t, std::size_t, const core::SingleCase&) {
        return core::ExactCase{};
    }).value();
}

void lean_values(const Cases& cases, double* out) {
    core::CaseBlock all{};
    for (std::size_t i = 0; i < 12; ++i) all.vertices[i] = cases.vertices[i].data();
    for (std::size_t k = 0; k < 3; ++k) all.point[k] = cases.point[k].data();
    all.count = cases.count();
    const std::array<const double*, 4> f{cases.f(0), cases.f(1), cases.f(2), cases.f(3)};
    peers::plain_values(all, f.data(), out);
}

/// Coordinates and values of a mesh gathered at once, those of the cases to come asked for ahead.
void lean_values(const CubeMesh& mesh, const Queries& queries, double* out) {
    alignas(64) static std::array<std::array<double, core::block_size + 8>, 19> buffer;
    core::CaseBlock block{};
    std::array<const double*, 4> f{};
    for (std::size_t i = 0; i < 12; ++i) block.vertices[i] = buffer[i].data();
    for (std::size_t k = 0; k < 3; ++k) block.point[k] = buffer[12 + k].data();
    for (std::size_t i = 0; i < 4; ++i) f[i] = buffer[15 + i].data();
    block.count = core::block_size;
    for (std::size_t first = 0; first < queries.cells.size(); first += core::block_size) {
        for (std::size_t j = 0; j < core::block_size; ++j) {
            if (first + j + 32 < queries.cells.size()) {
                const auto corners_of = [&](std::size_t ahead) {
                    return mesh.corners.data() + 4 * static_cast<std::size_t>(queries.cells[first + j + ahead]);
                };
                __builtin_prefetch(corners_of(32));
                for (std::size_t i = 0; i < 4; ++i) {
                    const auto node = static_cast<std::size_t>(corners_of(16)[i]);
                    __builtin_prefetch(mesh.nodes.data() + 3 * node);
                    __builtin_prefetch(mesh.field.data() + node);
                }
            }
            const std::int32_t* const corners =
                mesh.corners.data() + 4 * static_cast<std::size_t>(queries.cells[first + j]);
            for (std::size_t i = 0; i < 4; ++i) {
                const auto node = static_cast<std::size_t>(corners[i]);
                for (std::size_t k = 0; k < 3; ++k) buffer[3 * i + k][j] = mesh.nodes[3 * node + k];
                buffer[15 + i][j] = mesh.field[node];
            }
            for (std::size_t k = 0; k < 3; ++k) buffer[12 + k][j] = queries.coordinates[3 * (first + j) + k];
        }
        peers::plain_values(block, f.data(), out + first);
    }
}

// ---- Verification --------------------------------------------------------------------------------------------------

/// Returns what `ask` writes; requires that it is the same on every target, counts of tiers included.
template <class T, class Ask>
std::vector<T> same_on_all_targets(const TargetTable& table, std::size_t count, TierCounts& tiers, Ask ask) {
    std::vector<T> first;
    for (const std::string& target : table.targets()) {
        require(use_simd_target(target), "a target cannot be chosen");
        std::vector<T> out(count);
        TierCounts own;
        ask(std::span<T>(out), &own);
        if (first.empty()) {
            first = out;
            tiers = own;
        }
        bool same = own == tiers;
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (std::is_same_v<T, double>) {
                same = same && same_bits(out[i], first[i]);
            } else {
                same = same && out[i] == first[i];
            }
        }
        require(same, "answers depend on the target");
    }
    use_simd_target("");
    return first;
}

template <class Batch>
std::vector<WeightSigns> verified_signs(const TargetTable& table, const Batch& batch,
                                        const std::vector<WeightSigns>& right, TierCounts& tiers) {
    auto found = same_on_all_targets<WeightSigns>(
        table, right.size(), tiers, [&](auto out, TierCounts* t) { weight_signs(batch, out, t).value(); });
    require(found == right, "signs differ from CGAL's");
    return found;
}

/// Single calls give what batches gave.
void verify_singles(const Cases& cases, const std::vector<WeightSigns>* signs, const std::vector<double>* weights,
                    const std::vector<double>* values) {
    for (std::size_t j = 0; j < cases.count(); ++j) {
        const Case& c = cases.list[j];
        const double* const v = c.vertices.data();
        const double* const p = c.point.data();
        if (signs != nullptr) require(weight_signs(tetrahedron, v, p) == (*signs)[j], "signs of one case");
        if (weights != nullptr) {
            const Weights w = barycentric_weights(tetrahedron, v, p).value();
            for (std::size_t i = 0; i < 4; ++i)
                require(same_bits(w.weights[i], (*weights)[4 * j + i]), "weights of one case");
        }
        if (values != nullptr) {
            const Value f = interpolate(tetrahedron, v, p, c.values.data()).value();
            require(same_bits(f.value, (*values)[j]), "value of one case");
        }
    }
}

struct Verified {
    std::vector<double> weights, values;
    TierCounts weight_tiers, value_tiers;
};

/// Weights and values of a batch, required to be the oracle's. `at(j)` is case j.
template <class Batch, class Values, class At>
Verified verified_weights(const TargetTable& table, const Batch& batch, const Values& field, std::size_t count, At at) {
    Verified v;
    v.weights = same_on_all_targets<double>(
        table, 4 * count, v.weight_tiers, [&](auto out, TierCounts* t) { barycentric_weights(batch, out, t).value(); });
    v.values = same_on_all_targets<double>(table, count, v.value_tiers,
                                           [&](auto out, TierCounts* t) { interpolate(batch, field, out, t).value(); });
    for (std::size_t j = 0; j < count; ++j) {
        const OracleAnswer right = ask_oracle(at(j));
        if (right.region == Region::degenerate) {
            require(std::isnan(v.values[j]) && std::isnan(v.weights[4 * j]), "a degenerate cell has weights");
            continue;
        }
        for (std::size_t i = 0; i < 4; ++i)
            require(right.weights[i] == v.weights[4 * j + i], "a weight is not the oracle's");
        require(right.value == v.values[j], "a value is not the oracle's");
    }
    return v;
}

// ---- Groups of the table -------------------------------------------------------------------------------------------

struct Group {
    std::vector<Row> rows;
    std::vector<Demand> demands;

    std::size_t add(std::string what, std::size_t cases, std::function<void()> work, const TierCounts& tiers = {}) {
        rows.push_back({std::move(what), static_cast<double>(cases), std::move(work), false, tiers});
        return rows.size() - 1;
    }
    std::size_t add_peer(std::string what, std::size_t cases, std::function<void()> work) {
        add(std::move(what), cases, std::move(work));
        rows.back().peer = true;
        return rows.size() - 1;
    }
    void at_least(std::string what, std::size_t slow, std::size_t fast, double limit) {
        demands.push_back({std::move(what), slow, fast, limit, false});
    }
    void at_most(std::string what, std::size_t slow, std::size_t fast, double limit) {
        demands.push_back({std::move(what), slow, fast, limit, true});
    }
    void at_most_ns(std::string what, std::size_t row, double limit) {
        demands.push_back({std::move(what), row, Demand::none, limit, true});
    }
};

/// Runs `work` so often that small batches take measurable time.
std::function<void()> times(std::size_t n, std::function<void()> work) {
    return [=] {
        for (std::size_t i = 0; i < n; ++i) work();
    };
}

constexpr std::size_t rounds = 64;  // of what fits the cache

Group signs_of_mesh(const TargetTable& table, const CubeMesh& mesh, const Queries& queries) {
    Group g;
    const std::size_t count = queries.cells.size();
    static std::vector<WeightSigns> out(count);
    std::vector<WeightSigns> right(count);
    cgal_signs(mesh, queries, right);
    TierCounts tiers;
    const MeshQueries batch = queries.of(mesh);
    verified_signs(table, batch, right, tiers);
    const auto ours = g.add(
        "signs", count, [=] { weight_signs(batch, out).value(); }, tiers);
    const auto plain = g.add("  plain double, same gather", count, [=] { plain_signs(batch, out.data()); });
    const auto cgal = g.add_peer("  CGAL Epick, 4 orientations", count, [&] { cgal_signs(mesh, queries, out); });
    g.at_least("CGAL Epick / signs", cgal, ours, 10);
    g.at_most("signs / plain double", ours, plain, 1.5);
    return g;
}

Group signs_of_arrays(const TargetTable& table, const Cases& small, const Cases& large) {
    Group g;
    static std::vector<WeightSigns> out(large.count());
    for (const Cases* cases : {&small, &large}) {
        const std::string where = cases == &small ? "arrays in cache" : "arrays in memory";
        const std::size_t n = cases == &small ? rounds : 1, count = cases->count();
        std::vector<WeightSigns> right(count);
        cgal_signs(*cases, right);
        TierCounts tiers;
        const CaseArrays batch = cases->arrays();
        verified_signs(table, batch, right, tiers);
        const std::span<WeightSigns> to(out.data(), count);
        const auto ours =
            g.add("signs, " + where, n * count, times(n, [=] { weight_signs(batch, to).value(); }), tiers);
        const auto plain = g.add("  plain double", n * count, times(n, [=] { plain_signs(batch, to.data()); }));
        const auto cgal =
            g.add_peer("  CGAL Epick, 4 orientations", n * count, times(n, [=] { cgal_signs(*cases, out); }));
        g.at_least("CGAL Epick / signs, " + where, cgal, ours, 10);
        g.at_most("signs / plain double, " + where, ours, plain, 1.5);
    }
    return g;
}

Group values_of_all(const TargetTable& table, const CubeMesh& mesh, const Queries& queries, const Cases& small,
                    const Cases& large) {
    Group g;
    const std::size_t all = queries.cells.size();
    static std::vector<double> out(4 * all);
    const MeshQueries batch = queries.of(mesh);
    const NodalValues<double> field{mesh.field, 1}, field3{mesh.field3, 3};
    const Verified right =
        verified_weights(table, batch, field, all, [&](std::size_t j) { return case_of(mesh, queries, j); });
    TierCounts tiers3;
    const auto values3 = same_on_all_targets<double>(
        table, 3 * all, tiers3, [&](auto to, TierCounts* t) { interpolate(batch, field3, to, t).value(); });
    for (std::size_t j = 0; j < all; ++j) require(same_bits(values3[3 * j], right.values[j]), "a component");
    interpolate(batch, field, std::span(out).first(all), nullptr, Rounding::plain).value();
    std::size_t differ = 0;
    for (std::size_t j = 0; j < all; ++j) differ += out[j] != right.values[j] ? 1 : 0;
    std::printf(
        "plain double values that differ from the correctly rounded ones, random cells and points near them: "
        "%zu of %zu (%.1f %%)\n",
        differ, all, 100 * static_cast<double>(differ) / static_cast<double>(all));

    constexpr std::size_t rational_count = 1000;
    const std::vector<Case>* const list = &large.list;
    const auto gmpq = g.add_peer("value, CGAL Gmpq, then to_double", rational_count, [=] {
        for (std::size_t j = 0; j < rational_count; ++j)
            out[j] = CGAL::to_double(barycert::bench::value_in<CGAL::Gmpq>((*list)[j]));
    });
    g.add_peer("value, CGAL Epeck, exact(), then to_double", rational_count, [=] {
        for (std::size_t j = 0; j < rational_count; ++j)
            out[j] = CGAL::to_double(barycert::bench::value_in<Epeck::FT>((*list)[j]).exact());
    });

    const std::span<double> one = std::span(out).first(all), three = std::span(out).first(3 * all);
    const auto mesh_value = g.add(
        "value, mesh", all, [=] { interpolate(batch, field, one).value(); }, right.value_tiers);
    const auto mesh_plain =
        g.add("  Rounding::plain", all, [=] { interpolate(batch, field, one, nullptr, Rounding::plain).value(); });
    const auto mesh_lean =
        g.add("  plain double, one gather", all, [&mesh, &queries, one] { lean_values(mesh, queries, one.data()); });
    const auto mesh_value3 = g.add(
        "3 components, mesh", all, [=] { interpolate(batch, field3, three).value(); }, tiers3);
    const auto mesh_plain3 =
        g.add("  Rounding::plain", all, [=] { interpolate(batch, field3, three, nullptr, Rounding::plain).value(); });
    g.add(
        "weights, mesh", all, [=] { barycentric_weights(batch, out).value(); }, right.weight_tiers);
    g.at_most("value / Rounding::plain, mesh", mesh_value, mesh_plain, 4);
    g.at_most("value / plain double of one gather, mesh", mesh_value, mesh_lean, 4);
    g.at_most("3 components / Rounding::plain, mesh", mesh_value3, mesh_plain3, 4);
    g.at_least("Gmpq / value, mesh", gmpq, mesh_value, 500);

    for (const Cases* cases : {&small, &large}) {
        const std::string where = cases == &small ? "arrays in cache" : "arrays in memory";
        const std::size_t n = cases == &small ? rounds : 1, count = cases->count();
        const CaseArrays arrays = cases->arrays();
        const ValueArrays<double> f = cases->field(), f3 = cases->field3();
        const Verified own = verified_weights(table, arrays, f, count, [&](std::size_t j) { return cases->list[j]; });
        const std::span<double> to1 = std::span(out).first(count), to3 = std::span(out).first(3 * count),
                                to4 = std::span(out).first(4 * count);
        TierCounts own3;
        interpolate(arrays, f3, to3, &own3).value();
        const auto value = g.add("value, " + where, n * count, times(n, [=] { interpolate(arrays, f, to1).value(); }),
                                 own.value_tiers);
        const auto plain = g.add("  Rounding::plain", n * count,
                                 times(n, [=] { interpolate(arrays, f, to1, nullptr, Rounding::plain).value(); }));
        const auto lean =
            g.add("  plain double, no blocks", n * count, times(n, [=] { lean_values(*cases, to1.data()); }));
        const auto value3 =
            g.add("3 components, " + where, n * count, times(n, [=] { interpolate(arrays, f3, to3).value(); }), own3);
        const auto plain3 = g.add("  Rounding::plain", n * count,
                                  times(n, [=] { interpolate(arrays, f3, to3, nullptr, Rounding::plain).value(); }));
        g.add("weights, " + where, n * count, times(n, [=] { barycentric_weights(arrays, to4).value(); }),
              own.weight_tiers);
        g.at_most("value / Rounding::plain, " + where, value, plain, 4);
        g.at_most("value / plain double without blocks, " + where, value, lean, 4);
        g.at_most("3 components / Rounding::plain, " + where, value3, plain3, 4);
        g.at_least("Gmpq / value, " + where, gmpq, value, 500);
    }
    return g;
}

/// Single calls over all cases; what they return is added up.
template <class Call>
std::function<void()> each(const Cases& cases, Call call) {
    return [=, &cases] {
        double sum = 0;
        for (const Case& c : cases.list) sum += call(c);
        keep(sum);
    };
}

double one_signs(const Case& c) {
    return static_cast<double>(weight_signs(tetrahedron, c.vertices.data(), c.point.data()).bits());
}
double one_weights(const Case& c) {
    return (*barycentric_weights(tetrahedron, c.vertices.data(), c.point.data())).weights[0];
}
double one_value(const Case& c) {
    return (*interpolate(tetrahedron, c.vertices.data(), c.point.data(), c.values.data())).value;
}

int one_orient3d(const Case& c) {
    const double* const v = c.vertices.data();
    return static_cast<int>(orient3d(v, v + 3, v + 6, c.point.data()));
}

Group hard_cases(const TargetTable& table, const Cases& cases, const std::string& name, bool values_only) {
    Group g;
    static std::vector<WeightSigns> signs(cases.count());
    static std::vector<double> out(4 * cases.count());
    const std::size_t count = cases.count();
    const CaseArrays arrays = cases.arrays();
    const ValueArrays<double> f = cases.field();
    const Verified right = verified_weights(table, arrays, f, count, [&](std::size_t j) { return cases.list[j]; });
    TierCounts sign_tiers;
    const auto right_signs = same_on_all_targets<WeightSigns>(
        table, count, sign_tiers, [&](auto to, TierCounts* t) { weight_signs(arrays, to, t).value(); });
    for (std::size_t j = 0; j < count; ++j) {
        const OracleAnswer a = ask_oracle(cases.list[j]);
        for (int i = 0; i < 4; ++i)
            require(static_cast<int>(right_signs[j].sign(i)) == a.signs[static_cast<std::size_t>(i)], "an exact sign");
    }
    verify_singles(cases, &right_signs, &right.weights, &right.values);
    const auto ns = [&](const std::string& what, std::size_t row) { g.at_most_ns(what, row, 1000); };
    if (!values_only) {
        ns("signs, single, " + name, g.add("signs, single", count, each(cases, one_signs), sign_tiers));
        ns("signs, batch, " + name,
           g.add(
               "signs, batch", count, [=] { weight_signs(arrays, signs).value(); }, sign_tiers));
        g.add_peer("  CGAL Epick, 4 orientations", count, [&cases] { cgal_signs(cases, signs); });
        ns("weights, single, " + name, g.add("weights, single", count, each(cases, one_weights), right.weight_tiers));
        ns("weights, batch, " + name,
           g.add(
               "weights, batch", count, [=] { barycentric_weights(arrays, out).value(); }, right.weight_tiers));
    }
    ns("value, single, " + name, g.add("value, single", count, each(cases, one_value), right.value_tiers));
    const std::span<double> to = std::span(out).first(count);
    ns("value, batch, " + name,
       g.add(
           "value, batch", count, [=] { interpolate(arrays, f, to).value(); }, right.value_tiers));
    return g;
}

Group family(const TargetTable& table, const Cases& cases) {
    Group g;
    static std::vector<WeightSigns> signs(cases.count());
    const std::size_t count = cases.count();
    const CaseArrays arrays = cases.arrays();
    TierCounts tiers;
    const auto right = same_on_all_targets<WeightSigns>(
        table, count, tiers, [&](auto to, TierCounts* t) { weight_signs(arrays, to, t).value(); });
    verify_singles(cases, &right, nullptr, nullptr);
    for (std::size_t j = 0; j < count; ++j) {
        const Point* const v = cases.cgal.data() + 5 * j;
        const WeightSigns s = cgal_signs(v[0], v[1], v[2], v[3], v[4]);
        const int whole = CGAL::orientation(v[0], v[1], v[2], v[3]);
        for (int i = 0; i < 4; ++i)
            require(static_cast<int>(right[j].sign(i)) == static_cast<int>(s.sign(i)) * whole, "signs of the family");
        require(one_orient3d(cases.list[j]) == CGAL::orientation(v[0], v[1], v[2], v[4]), "orient3d of the family");
    }
    g.at_most_ns("signs, single", g.add("signs, single", 4 * count, each(cases, one_signs), tiers), 300);
    g.at_most_ns("signs, batch",
                 g.add(
                     "signs, batch", 4 * count, [=] { weight_signs(arrays, signs).value(); }, tiers),
                 300);
    g.add_peer("  CGAL Epick, 4 orientations", 4 * count, [&cases] { cgal_signs(cases, signs); });
    g.at_most_ns("orient3d of three vertices and the point",
                 g.add_peer("orient3d of three vertices and the point", count, each(cases, one_orient3d)), 300);
    g.add_peer("  CGAL Epick, orientation of the same", count, [&cases, count] {
        int sum = 0;
        for (std::size_t j = 0; j < count; ++j) {
            const Point* const v = cases.cgal.data() + 5 * j;
            sum += CGAL::orientation(v[0], v[1], v[2], v[4]);
        }
        keep(sum);
    });
    return g;
}

Group singles(const Cases& cases) {
    Group g;
    const std::size_t count = cases.count(), n = 16;
    static std::vector<WeightSigns> signs(count);
    static std::vector<Epick::Point_2> flat;
    for (const Case& c : cases.list) {
        for (std::size_t i = 0; i < 3; ++i) flat.push_back({c.vertices[3 * i], c.vertices[3 * i + 1]});
    }
    const auto one_orient2d = [](const Case& c) {
        const double* const v = c.vertices.data();
        return static_cast<int>(orient2d(v, v + 3, v + 6));
    };
    const auto add = [&](const char* what, bool peer, std::function<void()> work) {
        (peer ? g.add_peer(what, n * count, times(n, work)) : g.add(what, n * count, times(n, work)));
    };
    for (std::size_t j = 0; j < count; ++j) {
        const Point* const v = cases.cgal.data() + 5 * j;
        require(one_orient3d(cases.list[j]) == CGAL::orientation(v[0], v[1], v[2], v[4]), "orient3d");
        require(one_orient2d(cases.list[j]) == CGAL::orientation(flat[3 * j], flat[3 * j + 1], flat[3 * j + 2]),
                "orient2d");
    }
    add("orient2d", true, each(cases, one_orient2d));
    add("  CGAL Epick, orientation", true, [count] {
        int sum = 0;
        for (std::size_t j = 0; j < count; ++j) sum += CGAL::orientation(flat[3 * j], flat[3 * j + 1], flat[3 * j + 2]);
        keep(sum);
    });
    add("orient3d", true, each(cases, one_orient3d));
    add("  CGAL Epick, orientation", true, [&cases, count] {
        int sum = 0;
        for (std::size_t j = 0; j < count; ++j) {
            const Point* const v = cases.cgal.data() + 5 * j;
            sum += CGAL::orientation(v[0], v[1], v[2], v[4]);
        }
        keep(sum);
    });
    add("weight_signs", false, each(cases, one_signs));
    add("  CGAL Epick, 4 orientations", true, [&cases] { cgal_signs(cases, signs); });
    add("barycentric_weights", false, each(cases, one_weights));
    add("interpolate", false, each(cases, one_value));
    return g;
}

}  // namespace

int main() {
    const double start = bench::seconds();
    const TargetTable table;
    std::vector<std::pair<std::string, Group>> groups;
    const auto add = [&](const std::string& title, Group g) {
        table.run(title, g.rows, repetitions);
        std::fflush(stdout);
        groups.emplace_back(title, std::move(g));
    };
    std::printf("Medians of %d repetitions, rows of a group turn by turn, one thread, its own time.\n", repetitions);
    const CubeMesh mesh200k(32), mesh2m(70);
    const Queries far200k(mesh200k, false), near200k(mesh200k, true), far2m(mesh2m, false), near2m(mesh2m, true),
        ordered2m(mesh2m, true, true);
    std::printf("Meshes: the unit cube in voxels of 6 tetrahedra, nodes displaced; %zu and %zu cells. %zu queries.\n",
                mesh200k.cells(), mesh2m.cells(), queries_of_a_mesh);
    const Cases large = cases_of(mesh200k, near200k, queries_of_a_mesh), small = cases_of(mesh200k, near200k, in_cache);
    const Cases on = cases_on_features(3072), ties = cases_of_ties(3072),
                plane = cases_of_family("anisotropic-plane", 3072);

    add("Signs, random of 200k cells, points anywhere", signs_of_mesh(table, mesh200k, far200k));
    add("Signs, random of 200k cells, points near them", signs_of_mesh(table, mesh200k, near200k));
    add("Signs, random of 2M cells, points anywhere", signs_of_mesh(table, mesh2m, far2m));
    add("Signs, random of 2M cells, points near them", signs_of_mesh(table, mesh2m, near2m));
    add("Signs, some of 2M cells in order, points near them", signs_of_mesh(table, mesh2m, ordered2m));
    add("Signs, arrays", signs_of_arrays(table, small, large));
    add("Values and weights, 200k cells, points near", values_of_all(table, mesh200k, near200k, small, large));
    add("Points exactly on vertices, edges and faces", hard_cases(table, on, "on features", false));
    add("Values exactly between two doubles", hard_cases(table, ties, "ties", true));
    add("Family anisotropic-plane, four signs a case, ns per sign", family(table, plane));
    add("Single calls, random cases", singles(small));

    for (const auto& [title, g] : groups) {
        if (g.demands.empty()) continue;
        table.heading(title);
        for (const Demand& d : g.demands) table.demand(g.rows, d);
    }
    std::printf("\n%.0f s\n", bench::seconds() - start);
}
