// The core's answers against a judge that shares nothing with it, over the cases of a family. For tests and `judge`.
//
// Signs. The judge of a triangle or tetrahedron is CGAL::orientation of Epick, its kernel of exact predicates: the
// simplex with a vertex replaced by the point, against the simplex. The oracle judges the rest:
//   segment, triangle3d    CGAL has no predicate for the sign of a projected weight; the oracle is built on its
//                          integers.
//   families at the ends of the range of doubles: CGAL makes no promise for Epick where products under- or overflow.
//                          There CGAL::orientation over the rationals Gmpq, 20 to 100 times as slow, judges one case in
//                          64 besides.
// Regions and features are the oracle's, in one case of 16 if Epick judges, else in all.
//
// Weights and values. The oracle judges, bit by bit; a zero must have its sign too: + if exact, else the number's.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
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
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/predicates.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/weights.hpp"
#include "barycert/witness.hpp"

namespace barycert::laws {

/// The project's own meshes, all of them.
inline const MeshSource& own_meshes() {
    static const MeshSource source = [] {
        MeshSource s;
        for (const char* name :
             {"bracket", "cube-hole", "flange", "lattice-box", "lattice-eighths", "needle-slit", "plate", "torus"}) {
            s.add(name, read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + name).value());
        }
        return s;
    }();
    return source;
}

struct Subject {
    const Family* family = nullptr;
    Simplex simplex = Simplex::tetrahedron;

    std::string title() const { return family->name + " " + std::string(name(simplex)); }
    std::uint64_t simplices() const { return family->simplices.size(); }
};

/// Every family with every simplex that it applies to; not those of perspective, which are not for the functions judged
/// here.
inline std::vector<Subject> all_subjects() {
    std::vector<Subject> subjects;
    for (const Family& f : all_families()) {
        if (f.perspective) continue;
        for (const Simplex s : f.simplices) subjects.push_back({&f, s});
    }
    return subjects;
}

/// The family's coordinates stay where Epick promises to be right.
inline bool within_range(const Family& f) {
    static const std::array<const char*, 7> at_the_ends{"subnormal",   "small",           "tiny", "large", "huge",
                                                        "mixed-scale", "filter-underflow"};
    return std::none_of(at_the_ends.begin(), at_the_ends.end(), [&](const char* name) { return f.name == name; });
}

inline bool epick_judges(const Subject& s) {
    return (s.simplex == Simplex::triangle || s.simplex == Simplex::tetrahedron) && within_range(*s.family);
}

inline std::string hexadecimal(double x) {
    char text[64];
    std::snprintf(text, sizeof text, "%a", x);
    return text;
}

inline std::string describe(const Subject& s, std::uint64_t index, const Case& c) {
    const int n = vertex_count(c.simplex), d = space_dimension(c.simplex);
    std::string text = s.title() + " case " + std::to_string(index) + "\n";
    for (int i = 0; i <= n; ++i) {
        text += i < n ? "  vertex " + std::to_string(i) : std::string("  point   ");
        for (int k = 0; k < d; ++k)
            text += "  " + hexadecimal(i < n ? c.vertex(i, k) : c.point[static_cast<std::size_t>(k)]);
        if (i < n) text += "  value " + hexadecimal(c.values[static_cast<std::size_t>(i)]);
        text += "\n";
    }
    return text;
}

/// Results of a comparison.
struct Tally {
    std::uint64_t cases = 0;
    std::uint64_t disagreements = 0;
    TierCounts tiers;
    double own_seconds = 0;    ///< in the core's batches
    double judge_seconds = 0;  ///< in the judge, as far as it was the one asked of every case
    std::vector<std::string> first;

    void disagree(std::string text) {
        ++disagreements;
        if (first.size() < 5) first.push_back(std::move(text));
    }
    void add(const Tally& other) {
        cases += other.cases;
        disagreements += other.disagreements;
        tiers.add(other.tiers);
        own_seconds += other.own_seconds;
        judge_seconds += other.judge_seconds;
        for (const std::string& text : other.first) {
            if (first.size() < 5) first.push_back(text);
        }
    }
};

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Signs as a judge gives them.
struct Verdict {
    int orientation = 0;  ///< 0 if degenerate, or if the judge does not tell
    bool degenerate = false;
    std::array<int, 4> signs{};

    std::string text(int n) const {
        std::string t = "orientation " + std::to_string(orientation) + (degenerate ? ", degenerate, (" : ", (");
        for (int i = 0; i < n; ++i) t += (i == 0 ? "" : " ") + std::to_string(signs[static_cast<std::size_t>(i)]);
        return t + ")";
    }
};

/// The signs by CGAL::orientation of a kernel. Requires: triangle or tetrahedron.
template <class Kernel>
Verdict cgal_verdict(const Case& c) {
    Verdict v;
    const auto ask = [&](const auto& points, const auto& point, const auto& orientation) {
        v.orientation = orientation(points);
        v.degenerate = v.orientation == 0;
        for (std::size_t i = 0; i < points.size() && !v.degenerate; ++i) {
            auto replaced = points;
            replaced[i] = point;
            v.signs[i] = orientation(replaced) * v.orientation;
        }
    };
    if (c.simplex == Simplex::triangle) {
        using Point = typename Kernel::Point_2;
        const auto at = [&](int i) { return Point(c.vertex(i, 0), c.vertex(i, 1)); };
        ask(std::array<Point, 3>{at(0), at(1), at(2)}, Point(c.point[0], c.point[1]),
            [](const auto& p) { return static_cast<int>(CGAL::orientation(p[0], p[1], p[2])); });
    } else {
        using Point = typename Kernel::Point_3;
        const auto at = [&](int i) { return Point(c.vertex(i, 0), c.vertex(i, 1), c.vertex(i, 2)); };
        ask(std::array<Point, 4>{at(0), at(1), at(2), at(3)}, Point(c.point[0], c.point[1], c.point[2]),
            [](const auto& p) { return static_cast<int>(CGAL::orientation(p[0], p[1], p[2], p[3])); });
    }
    return v;
}

inline Verdict verdict(const OracleAnswer& a) {
    Verdict v;
    v.degenerate = a.region == Region::degenerate;
    std::copy(a.signs.begin(), a.signs.end(), v.signs.begin());
    return v;
}

inline Verdict verdict(WeightSigns w, int n) {
    Verdict v;
    v.orientation = static_cast<int>(w.orientation());
    v.degenerate = w.degenerate();
    for (int i = 0; i < n; ++i) v.signs[static_cast<std::size_t>(i)] = static_cast<int>(w.sign(i));
    return v;
}

/// Consecutive cases of a subject, one by one and in structure of arrays.
class Block {
public:
    static constexpr std::size_t capacity = 2048;

    void fill(const Subject& s, std::uint64_t seed, std::uint64_t first, std::size_t count) {
        const auto d = static_cast<std::size_t>(space_dimension(s.simplex));
        const auto n = static_cast<std::size_t>(vertex_count(s.simplex));
        cases.resize(count);
        coordinates_.resize((n + 1) * d * capacity);
        values_.resize(n * capacity);
        for (std::size_t j = 0; j < count; ++j) {
            const Case c = make_case(*s.family, s.simplex, seed, first + j, own_meshes());
            cases[j] = c;
            for (std::size_t i = 0; i < n * d; ++i) coordinates_[i * capacity + j] = c.vertices[i];
            for (std::size_t k = 0; k < d; ++k) coordinates_[(n * d + k) * capacity + j] = c.point[k];
            for (std::size_t i = 0; i < n; ++i) values_[i * capacity + j] = c.values[i];
        }
        arrays = {};
        arrays.simplex = s.simplex;
        arrays.count = count;
        for (std::size_t i = 0; i < n * d; ++i) arrays.vertices[i] = coordinates_.data() + i * capacity;
        for (std::size_t k = 0; k < d; ++k) arrays.point[k] = coordinates_.data() + (n * d + k) * capacity;
        values = {};
        for (std::size_t i = 0; i < n; ++i) values.at[i] = values_.data() + i * capacity;
    }

    std::vector<Case> cases;
    CaseArrays arrays;
    ValueArrays<double> values;

private:
    std::vector<double> coordinates_, values_;
};

/// The cases of a block as queries to a mesh in which each has a cell of its own; node, cell and case numbers differ.
struct BlockMesh {
    std::vector<double> nodes, points, field, pairs;
    std::vector<std::int32_t> corners, cells;
    MeshQueries queries;

    explicit BlockMesh(const Block& b) {
        const std::size_t count = b.cases.size();
        const Simplex s = b.arrays.simplex;
        const auto d = static_cast<std::size_t>(space_dimension(s)), n = static_cast<std::size_t>(vertex_count(s));
        nodes.resize(count * n * d);
        field.resize(count * n);
        pairs.resize(2 * count * n);
        corners.resize(count * n);
        for (std::size_t j = 0; j < count; ++j) {
            const Case& c = b.cases[j];
            const std::size_t cell = count - 1 - j;
            cells.push_back(static_cast<std::int32_t>(cell));
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t node = i * count + j;
                corners[cell * n + i] = static_cast<std::int32_t>(node);
                for (std::size_t k = 0; k < d; ++k) nodes[node * d + k] = c.vertices[d * i + k];
                field[node] = c.values[i];
                pairs[2 * node] = c.values[(i + 1) % n];
                pairs[2 * node + 1] = c.values[i];
            }
            points.insert(points.end(), c.point.begin(), c.point.begin() + static_cast<std::ptrdiff_t>(d));
        }
        queries = {s, nodes, corners, cells, points};
    }
};

template <class Work>
void for_blocks_of(const Subject& s, std::uint64_t seed, std::uint64_t first, std::uint64_t count, Block& block,
                   Work work) {
    for (std::uint64_t done = 0; done < count; done += Block::capacity) {
        block.fill(s, seed, first + done,
                   static_cast<std::size_t>(std::min<std::uint64_t>(Block::capacity, count - done)));
        work(first + done);
    }
}

/// Signs of cases first ... first + count - 1.
inline Tally judge_signs(const Subject& s, std::uint64_t seed, std::uint64_t first, std::uint64_t count) {
    using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Rational = CGAL::Simple_cartesian<CGAL::Gmpq>;
    const int n = vertex_count(s.simplex);
    const bool epick = epick_judges(s), fills = s.simplex == Simplex::triangle || s.simplex == Simplex::tetrahedron;
    Tally tally;
    Block block;
    std::vector<WeightSigns> out(Block::capacity);
    std::vector<Verdict> verdicts(Block::capacity);
    std::vector<OracleAnswer> answers(epick ? 0 : Block::capacity);
    for_blocks_of(s, seed, first, count, block, [&](std::uint64_t at) {
        const std::size_t cases = block.cases.size();
        const std::span<WeightSigns> signs(out.data(), cases);
        const Stopwatch own;
        const Status status = weight_signs(block.arrays, signs, &tally.tiers);
        tally.own_seconds += own.seconds();
        if (!status) return tally.disagree(s.title() + ": " + status.error().message());

        const Stopwatch judging;
        for (std::size_t j = 0; j < cases; ++j) {
            if (epick) {
                verdicts[j] = cgal_verdict<Epick>(block.cases[j]);
            } else {
                answers[j] = ask_oracle(block.cases[j]);
            }
        }
        tally.judge_seconds += judging.seconds();

        for (std::size_t j = 0; j < cases; ++j) {
            const Case& c = block.cases[j];
            const WeightSigns w = signs[j];
            const Verdict ours = verdict(w, n);
            const auto tell = [&](const std::string& who, const std::string& judged, const std::string& answer) {
                tally.disagree(describe(s, at + j, c) + "  " + who + ": " + judged + "\n  barycert: " + answer + "\n");
            };
            const auto compare = [&](const Verdict& v, bool tells_orientation, const char* who) {
                if (v.degenerate != ours.degenerate || v.signs != ours.signs ||
                    (tells_orientation && v.orientation != ours.orientation))
                    tell(who, v.text(n), ours.text(n));
            };
            if (epick) compare(verdicts[j], true, "Epick");
            if (!epick || (at + j) % 16 == 0) {
                const OracleAnswer a = epick ? ask_oracle(c) : answers[j];
                compare(verdict(a), false, "oracle");
                if (a.region != w.region() || a.feature != w.feature(s.simplex))
                    tell("oracle", std::string(name(a.region)) + ", " + std::string(name(a.feature)),
                         std::string(name(w.region())) + ", " + std::string(name(w.feature(s.simplex))));
            }
            if (!epick && fills && (at + j) % 64 == 0) compare(cgal_verdict<Rational>(c), true, "Gmpq");
            if (!fills && !w.degenerate() && w.orientation() != Sign::positive)
                tell("convention", "orientation 1", ours.text(n));
        }
        tally.cases += cases;
    });
    return tally;
}

inline bool same(double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
}

/// Weights and values of cases first ... first + count - 1. One in 16 is asked as a single case too, and with the next
/// vertex's values; `meshes`: all of them as queries to a mesh as well, for signs, weights, values and pairs of values.
inline Tally judge_values(const Subject& s, std::uint64_t seed, std::uint64_t first, std::uint64_t count, bool meshes) {
    const auto n = static_cast<std::size_t>(vertex_count(s.simplex));
    Tally tally;
    Block block;
    std::vector<double> weights(n * Block::capacity), values(Block::capacity);
    std::vector<OracleAnswer> answers(Block::capacity);
    for_blocks_of(s, seed, first, count, block, [&](std::uint64_t at) {
        const std::size_t cases = block.cases.size();
        TierCounts of_values;
        const Stopwatch own;
        const Status weighed = barycentric_weights(block.arrays, {weights.data(), n * cases}, &tally.tiers);
        const Status valued = interpolate(block.arrays, block.values, {values.data(), cases}, &of_values);
        tally.own_seconds += own.seconds();
        if (!weighed || !valued)
            return tally.disagree(s.title() + ": " + (weighed ? valued : weighed).error().message());

        const Stopwatch judging;
        for (std::size_t j = 0; j < cases; ++j) answers[j] = ask_oracle(block.cases[j]);
        tally.judge_seconds += judging.seconds();

        std::uint64_t degenerate = 0;
        for (std::size_t j = 0; j < cases; ++j) {
            const Case& c = block.cases[j];
            const OracleAnswer& a = answers[j];
            const auto check = [&](double judged, double answer, const std::string& what) {
                if (!same(judged, answer))
                    tally.disagree(describe(s, at + j, c) + "  " + what + ": judge " + hexadecimal(judged) +
                                   ", barycert " + hexadecimal(answer) + "\n");
            };
            const auto hold = [&](bool law, const char* what) {
                if (!law) tally.disagree(describe(s, at + j, c) + "  " + what + "\n");
            };
            degenerate += a.region == Region::degenerate ? 1 : 0;
            for (std::size_t i = 0; i < n; ++i) {
                const double w = weights[n * j + i];
                check(a.weights[i], w, "weight " + std::to_string(i));
                hold(a.signs[i] != 0 || a.region == Region::degenerate || same(w, 0.0), "an exact zero is not +0");
                hold(std::isnan(w) == (a.region == Region::degenerate), "NaN where not degenerate, or the reverse");
            }
            check(a.value, values[j], "value");
            if ((at + j) % 16 != 0) continue;

            const auto alone = barycentric_weights(s.simplex, c.vertices.data(), c.point.data());
            const auto value = interpolate(s.simplex, c.vertices.data(), c.point.data(), c.values.data());
            hold(alone && value, "a single call gave an error");
            if (!alone || !value) continue;
            for (std::size_t i = 0; i < n; ++i)
                check(weights[n * j + i], alone->weights[i], "single call, weight " + std::to_string(i));
            check(values[j], value->value, "single call, value");
            hold(alone->degenerate == (a.region == Region::degenerate), "single call: degenerate");
            hold(value->degenerate == alone->degenerate, "single call: degenerate value");
        }
        if (meshes) {
            const BlockMesh mesh(block);
            std::vector<double> w(n * cases), v(cases), pairs(2 * cases);
            std::vector<WeightSigns> signs(cases), from_mesh(cases);
            TierCounts mesh_weights, mesh_values, array_tiers, mesh_tiers;
            const bool fine = weight_signs(block.arrays, signs, &array_tiers).has_value() &&
                              weight_signs(mesh.queries, from_mesh, &mesh_tiers).has_value() &&
                              barycentric_weights(mesh.queries, w, &mesh_weights).has_value() &&
                              interpolate(mesh.queries, NodalValues<double>{mesh.field, 1}, v, &mesh_values) &&
                              interpolate(mesh.queries, NodalValues<double>{mesh.pairs, 2}, pairs);
            if (!fine) return tally.disagree(s.title() + ": an error from mesh queries");
            if (!(mesh_values == of_values) || !(mesh_tiers == array_tiers))
                tally.disagree(s.title() + ": tiers of mesh queries differ from those of arrays");
            for (std::size_t j = 0; j < cases; ++j) {
                bool alike = signs[j] == from_mesh[j] && same(v[j], values[j]) && same(pairs[2 * j + 1], values[j]);
                for (std::size_t i = 0; i < n; ++i) alike = alike && same(w[n * j + i], weights[n * j + i]);
                if ((at + j) % 16 == 0) {
                    Case next = block.cases[j];
                    for (std::size_t i = 0; i < n; ++i) next.values[i] = block.cases[j].values[(i + 1) % n];
                    alike = alike && same(pairs[2 * j], ask_oracle(next).value);
                }
                if (!alike) tally.disagree(describe(s, at + j, block.cases[j]) + "  mesh queries differ\n");
            }
        }
        if (of_values.degenerate != degenerate || of_values.cases() != cases)
            tally.disagree(s.title() + ": degenerate cases miscounted from case " + std::to_string(at));
        tally.cases += cases;
    });
    return tally;
}

}  // namespace barycert::laws
