// Certifying a mesh of about 2 million cells, beside what VTK does of it: vtkCellValidator looks at each cell by
// itself, vtkMeshQuality computes one measure of each cell at a time. Nobody else proves that the cells are a
// partition.
//
// Before any time is taken, the mesh must be certified, its volume must be exactly that of the cube, and VTK's measures
// must agree with ours. Medians of several runs, taken in turn.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "barycert/check/check.hpp"
#include "barycert/mesh/tetgen_io.hpp"
#include "large_mesh.hpp"
#ifdef BARYCERT_WITH_VTK
#include "check_peers.hpp"
#endif

namespace {

using namespace barycert;

double peak_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

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

#ifdef BARYCERT_WITH_VTK
/// The largest relative difference.
double difference(const std::vector<double>& ours, const std::vector<double>& theirs) {
    double largest = ours.size() == theirs.size() ? 0 : INFINITY;
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i)
        largest = std::max(largest, std::fabs(ours[i] - theirs[i]) / std::fabs(ours[i]));
    return largest;
}
#endif

check::Report check_with(const Mesh& mesh, int threads, bool delaunay = false) {
    check::Options options;
    options.threads = threads;
    options.delaunay = delaunay;
    return check::run(mesh, options);
}

}  // namespace

int main() {
    const Mesh mesh = read_tetgen(large_mesh_stem()).value();
    const double before = peak_mib();
    {
        const check::Report report = check_with(mesh, 2);
        if (!report.certified() || report.volume.cells != 1 || !report.volume.equal || !report.findings.empty()) {
            std::fprintf(stderr, "the mesh is not certified, or not the unit cube\n");
            return 1;
        }
    }
    const double after = peak_mib();
    std::vector<Line> lines;
    lines.push_back({"check, 2 threads", [&] { check_with(mesh, 2); }});
    lines.push_back({"check, 1 thread", [&] { check_with(mesh, 1); }});
    lines.push_back({"check with Delaunay, 2 threads", [&] { check_with(mesh, 2, true); }});
#ifdef BARYCERT_WITH_VTK
    VtkPeers vtk(mesh);
    const check::Report report = check_with(mesh, 2);
    const double angles = difference(report.measures.min_angle, vtk.quality(VtkPeers::Quality::min_angle)),
                 aspects = difference(report.measures.aspect, vtk.quality(VtkPeers::Quality::aspect));
    const long invalid = vtk.count_invalid();
    std::printf("VTK agrees: smallest dihedral angles within %.1e, aspects within %.1e; %ld cells not valid\n", angles,
                aspects, invalid);
    if (angles > 1e-9 || aspects > 1e-9) return 1;
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
