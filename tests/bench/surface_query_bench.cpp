// Points and surfaces: the nearest triangle, inside or outside, self-intersections; beside CGAL, VTK and Embree.
//
// Before any time is taken, answers for some points are held against a search of all triangles that is written apart,
// in long double with its own error in mind, and those of the peers are counted that differ. Indexes are built before;
// times are medians of runs taken in turn.
//
//   bench_surface_queries [SURFACE]   default: a torus with waves of 200,000 triangles, and one of 1,000,000

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <random>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_locator.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "mesh/index/open_sheets.hpp"
#include "mesh/index/triangles.hpp"
#include "mesh/threads/arena.hpp"
#include "require.hpp"
#include "surface_query_peers.hpp"

namespace {

using namespace barycert;
using bench::QueryPeer, bench::QueryPeers, bench::require;

double seconds_of(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> x) {
    std::ranges::sort(x);
    return x[x.size() / 2];
}

/// A torus whose tube has waves; 2 * around * along triangles.
Surface torus(int around, int along) {
    Surface s;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
            const double r = 0.4 + 0.05 * std::sin(7 * u) * std::cos(5 * v);
            s.points.insert(s.points.end(), {(1 + r * std::cos(v)) * std::cos(u), (1 + r * std::cos(v)) * std::sin(u),
                                             r * std::sin(v)});
            const auto at = [&](int a, int b) { return ((i + a) % around) * along + (j + b) % along; };
            s.cells.insert(s.cells.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return s;
}

/// Points off the surface by a normal distribution of that width, in parts of its size.
std::vector<double> points_near(const Surface& s, std::size_t count, double width) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part;
    std::normal_distribution<double> off(0, width);
    const auto [low, high] = std::ranges::minmax(s.points);
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t t = random() % s.cell_count();
        double a = part(random), b = part(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto x = [&](std::size_t c) {
                return s.points[3 * static_cast<std::size_t>(s.cells[3 * t + c]) + k];
            };
            points.push_back(x(0) + a * (x(1) - x(0)) + b * (x(2) - x(0)) + off(random) * (high - low));
        }
    }
    return points;
}

std::vector<double> points_in_box(const Surface& s, std::size_t count) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> part;
    double low[3] = {s.points[0], s.points[1], s.points[2]}, high[3] = {low[0], low[1], low[2]};
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], s.points[i]);
        high[i % 3] = std::max(high[i % 3], s.points[i]);
    }
    std::vector<double> points;
    for (std::size_t i = 0; i < 3 * count; ++i)
        points.push_back(low[i % 3] + part(random) * (high[i % 3] - low[i % 3]));
    return points;
}

constexpr std::size_t count = 1000000, few = 20000;  // points for us, and for peers

using Real = long double;
Real square_to(const double* p, const double* a, const double* b, const double* c) {
    Real e[3], f[3], w[3], ee = 0, ef = 0, ff = 0, we = 0, wf = 0;
    for (int k = 0; k < 3; ++k) {
        e[k] = static_cast<Real>(b[k]) - a[k], f[k] = static_cast<Real>(c[k]) - a[k],
        w[k] = static_cast<Real>(p[k]) - a[k];
        ee += e[k] * e[k], ef += e[k] * f[k], ff += f[k] * f[k], we += w[k] * e[k], wf += w[k] * f[k];
    }
    const auto at = [&](Real s, Real t) {
        Real sum = 0;
        for (int k = 0; k < 3; ++k) sum += (w[k] - s * e[k] - t * f[k]) * (w[k] - s * e[k] - t * f[k]);
        return sum;
    };
    const auto unit = [](Real x) { return std::clamp<Real>(x, 0, 1); };
    const Real s = we * ff - wf * ef, t = wf * ee - we * ef, det = ee * ff - ef * ef;
    const Real r = unit((wf - we - ef + ee) / (ee - 2 * ef + ff));
    Real best = std::min({at(unit(we / ee), 0), at(0, unit(wf / ff)), at(1 - r, r)});
    if (s > 0 && t > 0 && s + t < det) best = std::min(best, at(s / det, t / det));
    return best;
}

void verify_nearest(const Surface& s, const std::vector<double>& points, const std::vector<SurfaceNearest>& found) {
    for (std::size_t i = 0; i < 100; ++i) {
        Real best = 1e300L;
        for (std::size_t t = 0; t < s.cell_count(); ++t) {
            const auto at = [&](std::size_t c) { return &s.points[3 * static_cast<std::size_t>(s.cells[3 * t + c])]; };
            best = std::min(best, square_to(&points[3 * i], at(0), at(1), at(2)));
        }
        require(std::fabs(static_cast<double>(std::sqrt(best)) / found[i].distance - 1) < 1e-13,
                "the nearest distance");
    }
}

struct Row {
    std::string name;
    std::size_t count;  ///< what it is asked for in a run
    std::function<void()> run;
    std::vector<double> seconds = {};
    std::size_t differ = 0;
};

void print(std::vector<Row>& rows, int repetitions) {
    for (int r = 0; r < repetitions; ++r) {
        for (Row& row : rows) row.seconds.push_back(seconds_of(row.run));
    }
    const auto time_of = [](const Row& row) { return median(row.seconds) / static_cast<double>(row.count); };
    const double ours = time_of(rows.front());
    for (const Row& row : rows) {
        const double time = time_of(row);
        std::printf("  %-34s %9.1f ns a point   %6.2fx   %zu differ\n", row.name.c_str(), time * 1e9, time / ours,
                    row.differ);
    }
}

void nearest(const Surface& s, const std::vector<QueryPeers>& peers, double width) {
    const std::vector<double> points = points_near(s, count, width);
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    std::vector<SurfaceNearest> found(count);
    const auto run = [&](int threads) {
        return [&, threads] { require(bool(locator.nearest(points, HUGE_VAL, found, threads)), "nearest"); };
    };
    run(1)();
    verify_nearest(s, points, found);
    std::vector<Row> rows{{"barycert, 1 thread", count, run(1)}, {"barycert, 2 threads", count, run(2)}};
    // Peers take their time.
    std::vector<std::int64_t> answers(few);
    std::vector<double> distances(few);
    for (const QueryPeers& some : peers) {
        for (const QueryPeer& peer : some.nearest) {
            Row row{peer.name, few, [&] { peer.run(points, answers, distances); }};
            row.run();
            for (std::size_t i = 0; i < few; ++i) row.differ += distances[i] != found[i].distance ? 1 : 0;
            rows.push_back(std::move(row));
        }
    }
    std::printf("nearest triangle and point, %zu triangles, points off by %g of the size (differ: in the distance)\n",
                s.cell_count(), width);
    print(rows, 3);
}

void inside(const Surface& s, const std::vector<QueryPeers>& peers) {
    const std::vector<double> points = points_in_box(s, count);
    const SurfaceLocator locator = SurfaceLocator::build(s).value();
    std::vector<SurfaceLocation> found(count);
    const auto run = [&](int threads) {
        return [&, threads] { require(bool(locator.locate(points, found, threads)), "locate"); };
    };
    run(1)();
    for (std::size_t i = 0; i < 20000; ++i)
        require(locator.locate(&points[3 * i]).value() == found[i], "with a map and without");
    std::vector<Row> rows{{"barycert, 1 thread", count, run(1)}, {"barycert, 2 threads", count, run(2)}};
    std::vector<std::int64_t> answers(few);
    std::vector<double> ignored;
    for (const QueryPeers& some : peers) {
        for (const QueryPeer& peer : some.inside) {
            Row row{peer.name, few, [&] { peer.run(points, answers, ignored); }};
            row.run();
            for (std::size_t i = 0; i < few; ++i)
                row.differ += (answers[i] != 0) != (found[i].feature == Feature::interior) ? 1 : 0;
            rows.push_back(std::move(row));
        }
    }
    std::printf("inside or outside, %zu triangles, points in the box\n", s.cell_count());
    print(rows, 3);
}

void intersections(const Surface& s, const QueryPeers& cgal) {
    const auto pairs = [&](int threads) {
        return [&, threads] {
            base::in_arena(threads, s.cell_count(), [&] {
                std::vector<Mesh::Index> numbers(s.cell_count());
                std::iota(numbers.begin(), numbers.end(), 0);
                const index::Triangles triangles = index::place_triangles(s.points, s.cells, numbers);
                require(index::conflicting_pairs(triangles.index, triangles.facets, 1).empty(), "a clean surface");
            });
        };
    };
    const auto check = [&](int threads) {
        return [&, threads] { require(check_surface(s, {.threads = threads}).certified(), "a clean surface"); };
    };
    const std::size_t n = s.cell_count();
    std::vector<Row> rows{
        {"barycert, these alone, 2 threads", n, pairs(2)},
        {"barycert, these alone, 1 thread", n, pairs(1)},
        {"barycert, the whole check, 2 threads", n, check(2)},
        {"barycert, the whole check, 1 thread", n, check(1)},
        {"CGAL PMP::self_intersections", n, [&] { require(cgal.self_intersections() == 0, "none"); }}};
    std::printf("self-intersections, %zu triangles; ns a triangle\n", n);
    print(rows, 3);
}

}  // namespace

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const Surface s = argc > 1 ? read_surface(argv[1]).value() : torus(500, 200);
    const std::vector<QueryPeers> peers{bench::cgal_peers(s),
#ifdef BARYCERT_WITH_VTK
                                        bench::vtk_peers(s),
#endif
#ifdef BARYCERT_WITH_EMBREE
                                        bench::embree_peers(s)
#endif
    };
    nearest(s, peers, 0.01);
    nearest(s, peers, 0.1);
    inside(s, peers);
    if (argc > 1) {
        intersections(s, peers.front());
    } else {
        const Surface large = torus(1000, 500);
        intersections(large, bench::cgal_peers(large));
    }
}
