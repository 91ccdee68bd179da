// Certifying a mesh of about 2 million cells, beside what VTK does of it: vtkCellValidator looks at each cell by
// itself, vtkMeshQuality computes one measure of each cell at a time. Nobody else proves that the cells are a
// partition.
//
// Before any time is taken, the mesh must be certified, its volume must be exactly that of the cube, smallest angles
// must be those that another formula gives, and aspects those of VTK. (VTK 9.1's smallest angle leaves out some of the
// six dihedral angles: how many cells it is wrong for is printed.) Medians of several runs, taken in turn.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

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
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "large_mesh.hpp"
#include "peak_memory.hpp"
#ifdef BARYCERT_WITH_VTK
#include "check_peers.hpp"
#endif

namespace {

using namespace barycert;

struct Line {
    std::string what;
    std::function<void()> run;
    std::vector<double> seconds = {};

    double median() {
        std::sort(seconds.begin(), seconds.end());
        return seconds[seconds.size() / 2];
    }
};

double time(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The smallest dihedral angle by another way: between the parts of two edges normal to a third, for each of six.
double smallest_angle(const Mesh& mesh, std::size_t cell) {
    using Vector = std::array<double, 3>;
    const auto dot = [](const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
    std::array<Vector, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            p[i][k] = mesh.points[static_cast<std::size_t>(mesh.cells[4 * cell + i]) * 3 + k];
    }
    double min = 180;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            std::array<Vector, 3> v{};  // the edge, and from its end to the other two corners
            std::size_t others = 1;
            for (std::size_t l = 0; l < 4; ++l) {
                if (l == i) continue;
                Vector& to = l == j ? v[0] : v[others++];
                for (std::size_t k = 0; k < 3; ++k) to[k] = p[l][k] - p[i][k];
            }
            for (std::size_t m = 1; m < 3; ++m) {
                const double t = dot(v[m], v[0]) / dot(v[0], v[0]);
                for (std::size_t k = 0; k < 3; ++k) v[m][k] -= t * v[0][k];
            }
            const double cosine = dot(v[1], v[2]) / std::sqrt(dot(v[1], v[1]) * dot(v[2], v[2]));
            min = std::min(min, std::acos(cosine) * 180 / std::numbers::pi);
        }
    }
    return min;
}

/// How many are more than 1e-9 apart, relatively.
std::size_t differences(const std::vector<double>& ours, const std::vector<double>& theirs) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) count += std::fabs(ours[i] - theirs[i]) <= 1e-9 * ours[i] ? 0 : 1;
    return count;
}

CheckReport check_with(const Mesh& mesh, int threads, bool delaunay = false) {
    CheckOptions options;
    options.threads = threads;
    options.delaunay = delaunay;
    return check_mesh(mesh, options);
}

}  // namespace

int main() {
    const Mesh mesh = read_tetgen(large_mesh_stem()).value();
    const double before = barycert::bench::peak_mib();
    const CheckReport report = check_with(mesh, 2);
    const double after = barycert::bench::peak_mib();
    if (!report.certified() || report.volume.cells != 1 || !report.volume.equal || !report.defects.empty()) {
        std::fprintf(stderr, "the mesh is not certified, or not the unit cube\n");
        return 1;
    }
    std::vector<double> angles(mesh.cell_count());
    for (std::size_t cell = 0; cell < angles.size(); ++cell) angles[cell] = smallest_angle(mesh, cell);
    if (differences(report.measures.min_angle, angles) != 0) {
        std::fprintf(stderr, "the smallest angles are wrong\n");
        return 1;
    }
    std::vector<Line> lines;
    lines.push_back({"check, 2 threads", [&] { check_with(mesh, 2); }});
    lines.push_back({"check, 1 thread", [&] { check_with(mesh, 1); }});
    lines.push_back({"check with Delaunay, 2 threads", [&] { check_with(mesh, 2, true); }});
#ifdef BARYCERT_WITH_VTK
    VtkPeers vtk(mesh);
    if (differences(report.measures.aspect, vtk.quality(VtkPeers::Quality::aspect)) != 0) {
        std::fprintf(stderr, "the aspects are not VTK's\n");
        return 1;
    }
    std::printf("aspects: as vtkMeshQuality has them; its smallest angle is another one in %zu cells\n",
                differences(angles, vtk.quality(VtkPeers::Quality::min_angle)));
    std::printf("vtkCellValidator: %ld cells not valid\n", vtk.count_invalid());
    lines.push_back({"vtkCellValidator", [&] { vtk.count_invalid(); }});
    lines.push_back({"vtkMeshQuality, smallest dihedral angle", [&] { vtk.quality(VtkPeers::Quality::min_angle); }});
    lines.push_back({"vtkMeshQuality, aspect", [&] { vtk.quality(VtkPeers::Quality::aspect); }});
    lines.push_back({"vtkMeshQuality, radius ratio", [&] { vtk.quality(VtkPeers::Quality::radius_ratio); }});
#endif
    for (int repetition = 0; repetition < 5; ++repetition) {
        for (Line& line : lines) line.seconds.push_back(time(line.run));
    }
    std::printf("%zu cells, %zu nodes\n", mesh.cell_count(), mesh.point_count());
    for (Line& line : lines) std::printf("%-42s %8.3f s\n", line.what.c_str(), line.median());
    std::printf("memory: %.0f MiB with the mesh, %.0f MiB at the peak of a check: %.0f bytes a cell more\n", before,
                after, (after - before) * 1048576 / static_cast<double>(mesh.cell_count()));
    const double two = lines.front().median();
    std::printf("at most 3 s on two threads: %s\n", two <= 3 ? "met" : "NOT met");
    return 0;
}
