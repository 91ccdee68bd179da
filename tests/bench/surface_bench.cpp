// Iso-surfaces and slices of about 2 million tetrahedra, beside VTK's filters.
//
// Before any time is taken, every point of ours must be the one that weights.hpp computes for its edge, by integers,
// and the area that of VTK's surface up to the rounding of the sum. How many of VTK's points have correctly rounded
// coordinates is printed: a difference of an ulp in a point is no fault of a picture, but equal crossings that differ
// are cracks where points are not merged. Wall times, medians of several runs taken in turn; demands are printed, no
// more.

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/weights.hpp"
#include "large_mesh.hpp"
#include "require.hpp"
#ifdef BARYCERT_WITH_VTK
#include "surface_peers.hpp"
#endif

namespace {

using namespace barycert;
using bench::require;

constexpr int repetitions = 9;

struct Line {
    std::string what;
    std::function<void()> run;
    std::vector<double> seconds = {};
};

double time(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
}

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const double* x) {
    return {std::bit_cast<std::uint64_t>(x[0]), std::bit_cast<std::uint64_t>(x[1]), std::bit_cast<std::uint64_t>(x[2])};
}

double area_of(const double* a, const double* b, const double* c) {
    std::array<double, 3> u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}

double area_of(const Surface& s) {
    double sum = 0;
    for (std::size_t t = 0; t < s.cells.size(); t += 3)
        sum += area_of(&s.points[3 * static_cast<std::size_t>(s.cells[t])],
                       &s.points[3 * static_cast<std::size_t>(s.cells[t + 1])],
                       &s.points[3 * static_cast<std::size_t>(s.cells[t + 2])]);
    return sum;
}

/// Each point, from the values at the ends of its edge, as weights.hpp has it.
void verify(const Mesh& mesh, const Surface& s, const std::vector<double>& f, double value) {
    for (std::size_t v = 0; v < s.point_count(); ++v) {
        const auto a = static_cast<std::size_t>(s.mesh_edges[2 * v]),
                   b = static_cast<std::size_t>(s.mesh_edges[2 * v + 1]);
        if (a == b) {
            require(bits_of(&s.points[3 * v]) == bits_of(&mesh.points[3 * a]), "a point at a node");
            continue;
        }
        double point[3];
        point_of_value({&mesh.points[3 * a], 3}, {&mesh.points[3 * b], 3}, f[a], f[b], value, point).value();
        require(bits_of(&s.points[3 * v]) == bits_of(point), "a point on an edge");
    }
}

#ifdef BARYCERT_WITH_VTK
void compare(const char* what, const Surface& own, const bench::PeerSurface& theirs) {
    double area = 0;
    for (const auto& t : theirs.triangles)
        area += area_of(&theirs.points[3 * static_cast<std::size_t>(t[0])],
                        &theirs.points[3 * static_cast<std::size_t>(t[1])],
                        &theirs.points[3 * static_cast<std::size_t>(t[2])]);
    const double ours = area_of(own);
    std::set<Bits> right;
    for (std::size_t v = 0; v < own.point_count(); ++v) right.insert(bits_of(&own.points[3 * v]));
    std::size_t same = 0;
    for (std::size_t v = 0; v < theirs.points.size(); v += 3) same += right.count(bits_of(&theirs.points[v]));
    const std::size_t count = theirs.points.size() / 3;
    std::printf("  %-34s %zu triangles, %zu points, of which %.1f %% are correctly rounded; area off by %.1e\n", what,
                theirs.triangles.size(), count, 100.0 * static_cast<double>(same) / static_cast<double>(count),
                std::fabs(area - ours) / ours);
    // Some 1e5 to 1e6 terms, each with an error of some 1e-15 of the size of an edge times its length.
    require(std::fabs(area - ours) <= 1e-9 * ours, "the area");
}
#endif

struct Subject {
    std::string name;
    double (*f)(double, double, double);
    double value;
};

void time_all(std::vector<Line>& lines) {
    for (int repetition = -1; repetition < repetitions; ++repetition) {  // the first only warms up
        for (Line& line : lines) {
            const double seconds = time(line.run);
            if (repetition >= 0) line.seconds.push_back(seconds);
        }
    }
    for (const Line& line : lines) {
        std::vector<double> ratio;
        for (std::size_t i = 0; i < line.seconds.size(); ++i) ratio.push_back(line.seconds[i] / lines[0].seconds[i]);
        std::printf("  %-62s %8.1f ms %8.2f x\n", line.what.c_str(), 1e3 * median(line.seconds), median(ratio));
    }
}

void print_cut(const Cut& cut) {
    std::printf("  ours: %zu triangles, %zu points, in %llu cells; %llu by integers\n", cut.surface.cell_count(),
                cut.surface.point_count(), static_cast<unsigned long long>(cut.counts.cells),
                static_cast<unsigned long long>(cut.counts.tiers.exact));
}

}  // namespace

int main() {
    const Mesh mesh = read_tetgen(large_mesh_stem()).value();
    std::printf("%zu cells, %zu nodes; medians of %d runs in turn, ratios to the first line\n", mesh.cell_count(),
                mesh.point_count(), repetitions);
    const Subject subjects[] = {
        {"sphere", [](double x, double y, double z) { return std::hypot(x - 0.5, y - 0.5, z - 0.5); }, 0.375},
        {"gyroid, ten periods",
         [](double x, double y, double z) {
             const double k = 62.83;
             return std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) +
                    std::sin(k * z) * std::cos(k * x);
         },
         0.25},
    };
    bool met = true;
#ifdef BARYCERT_WITH_VTK
    bench::SurfacePeers vtk(mesh);
    std::printf("VTK on two threads: %s", bench::use_vtk_threads(2).c_str());
    std::printf("; on one: %s\n", bench::use_vtk_threads(1).c_str());
#endif
    for (const Subject& subject : subjects) {
        Field f{"f", 1, {}};
        for (std::size_t i = 0; i < mesh.points.size(); i += 3)
            f.data.push_back(subject.f(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]));
        std::printf("\nIso-surface: %s\n", subject.name.c_str());
        const auto cut = [&](int threads) {
            return isosurface(mesh, f, subject.value, {.point_fields = {&f}, .threads = threads}).value();
        };
        const Cut own = cut(2);
        print_cut(own);
        verify(mesh, own.surface, f.data, subject.value);
        std::vector<Line> lines;
        lines.push_back({"barycert::isosurface, 2 threads", [&] { cut(2); }});
        lines.push_back({"barycert::isosurface, 1 thread", [&] { cut(1); }});
#ifdef BARYCERT_WITH_VTK
        vtk.set_field(f);
        vtk.contour_filter(subject.value);
        compare("vtkContourFilter", own.surface, vtk.surface());
        vtk.linear_grid(subject.value, true, true);
        compare("vtkContour3DLinearGrid", own.surface, vtk.surface());
        for (const int threads : {2, 1}) {
            const std::string on = threads == 2 ? ", 2 threads" : ", 1 thread";
            for (const bool merge : {true, false}) {
                const std::string what = merge ? ", points merged" : ", triangle soup";
                lines.push_back({"vtkContour3DLinearGrid" + what + on, [&vtk, &subject, threads, merge] {
                                     bench::use_vtk_threads(threads);
                                     vtk.linear_grid(subject.value, merge, threads == 1);
                                 }});
            }
        }
        lines.push_back({"vtkContourFilter", [&] { vtk.contour_filter(subject.value); }});
#endif
        time_all(lines);
        met = met && median(lines[0].seconds) <= 0.3;
    }
    std::printf("\nSlice by an oblique plane\n");
    const Plane plane{{0.3, 0.5, 0.8}, 0.8};
    const auto cut = [&](int threads) { return slice(mesh, plane, {.threads = threads}).value(); };
    const Cut own = cut(2);
    print_cut(own);
    std::vector<Line> lines;
    lines.push_back({"barycert::slice, 2 threads", [&] { cut(2); }});
    lines.push_back({"barycert::slice, 1 thread", [&] { cut(1); }});
#ifdef BARYCERT_WITH_VTK
    vtk.cutter(plane.normal, plane.offset);
    compare("vtkCutter", own.surface, vtk.surface());
    for (const int threads : {2, 1}) {
        const std::string on = threads == 2 ? ", 2 threads" : ", 1 thread";
        lines.push_back({"vtkCutter, triangle soup" + on, [&vtk, &plane, threads] {
                             bench::use_vtk_threads(threads);
                             vtk.cutter(plane.normal, plane.offset);
                         }});
        lines.push_back({"vtkPlaneCutter" + on, [&vtk, &plane, threads] {
                             bench::use_vtk_threads(threads);
                             vtk.plane_cutter(plane.normal, plane.offset);
                         }});
    }
#endif
    time_all(lines);
    std::printf("\nat most 0.3 s for an iso-surface on two threads: %s\n", met ? "met" : "NOT met");
    return 0;
}
