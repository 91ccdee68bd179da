// VTK's files, read and written: read_vtk and write_vtk on one and two threads beside VTK's own readers and writers, in
// one run. A file that is read was written by VTK. Before any time is taken, each reader must give the mesh that was
// written, bit by bit; repetitions take turns, and medians are told. Files lie in the page cache.
//
// bench_vtk_files [--quick] [--repetitions N] [--only WORD]
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "generated_mesh.hpp"
#include "require.hpp"
#ifdef BARYCERT_WITH_TETGEN
#include "large_mesh.hpp"
#endif
#ifdef BARYCERT_WITH_VTK
#include "vtk_files_peer.hpp"
#endif

namespace {

using namespace barycert;
using namespace barycert::bench;
namespace fs = std::filesystem;

struct Contender {
    std::string name;
    std::function<void()> run;
    std::vector<double> seconds = {};

    double median() const {
        std::vector<double> sorted = seconds;
        std::sort(sorted.begin(), sorted.end());
        return sorted.empty() ? 0 : sorted[sorted.size() / 2];
    }
};

void time_all(std::vector<Contender>& contenders, int repetitions) {
    for (int i = 0; i < repetitions; ++i) {
        for (Contender& c : contenders) {
            const auto start = std::chrono::steady_clock::now();
            c.run();
            c.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
    }
}

void tell(const std::string& what, double bytes, const std::vector<Contender>& contenders) {
    std::printf("%-14s %7.1f MB", what.c_str(), bytes / 1e6);
    for (const Contender& c : contenders) {
        std::printf("  %s %8.1f ms", c.name.c_str(), 1e3 * c.median());
        if (&c != &contenders.front())
            std::printf(" (%.1fx, %.2f GB/s)", contenders.front().median() / c.median(), bytes / c.median() / 1e9);
    }
    std::printf("\n");
    std::fflush(stdout);
}

std::function<void()> on_threads(std::size_t threads, std::function<void()> work) {
    return [threads, work = std::move(work)] {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        work();
    };
}

/// The mesh, with a field of one and one of three components.
Mesh bench_mesh(bool quick) {
    Mesh mesh;
#ifdef BARYCERT_WITH_TETGEN
    mesh = quick ? jittered_cube(12, 1) : read_tetgen(large_mesh_stem()).value();
#else
    mesh = jittered_cube(quick ? 12 : 68, 1);
#endif
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    mesh.point_markers.clear();
    mesh.faces.clear();
    mesh.face_markers.clear();
    mesh.neighbours.clear();
    mesh.index_base = 0;
    Field t{"T", 1, {}}, u{"u", 3, {}};
    for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
        const double x = mesh.points[i], y = mesh.points[i + 1], z = mesh.points[i + 2];
        t.data.push_back(std::sin(3 * x) + y * z);
        u.data.insert(u.data.end(), {y, -x, std::exp(z)});
    }
    mesh.point_fields = {std::move(t), std::move(u)};
    return mesh;
}

struct FileKind {
    const char *what, *name;
    VtkData data;
};
constexpr FileKind kinds[]{{"raw", "raw.vtu", VtkData::raw},
                           {"zlib", "zlib.vtu", VtkData::zlib},
                           {"lz4", "lz4.vtu", VtkData::lz4},
                           {"lzma", "lzma.vtu", VtkData::lzma},
                           {"ascii", "ascii.vtu", VtkData::ascii},
                           {"legacy", "legacy.vtk", VtkData::raw},
                           {"legacy ascii", "text.vtk", VtkData::ascii}};

void same_mesh(const Mesh& a, const Mesh& b, bool exact, const std::string& path) {
    bool good = a.cells == b.cells && a.points.size() == b.points.size() && b.point_fields.size() == 2;
    if (exact && good) {
        good = a.points == b.points;
        for (std::size_t i = 0; i < 2; ++i) good = good && a.point_fields[i].data == b.point_fields[i].data;
    }
    require(good, path + ": what was read is not what was written");
}

}  // namespace

int main(int argc, char** argv) {
    bool quick = false;
    int repetitions = 9;
    std::string only;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--quick") quick = true;
        if (word == "--repetitions" && i + 1 < argc) repetitions = std::atoi(argv[++i]);
        if (word == "--only" && i + 1 < argc) only = argv[++i];
    }
    if (quick) repetitions = 1;
    const char* const given = std::getenv("BARYCERT_BENCH_DIR");
    const fs::path folder = fs::path(given != nullptr ? given : fs::temp_directory_path().string()) /
                            (quick ? "barycert-vtk-files-quick" : "barycert-vtk-files");
    fs::create_directories(folder);
    const Mesh mesh = bench_mesh(quick);
    std::printf("%zu cells, %zu nodes; medians of %d\n", mesh.cell_count(), mesh.point_count(), repetitions);

#ifdef BARYCERT_WITH_VTK
    const std::string first = folder / "first.vtu";
    require(write_vtu(mesh, first).has_value(), "cannot write " + first);
    const VtkGrid grid = vtk_read(first);
    require(vtk_is(grid, mesh), "VTK does not read what was written");
#endif
    for (const FileKind& kind : kinds) {
        if (!only.empty() && only != kind.what) continue;
        const std::string theirs = (folder / "vtk-").string() + kind.name,
                          ours = (folder / "our-").string() + kind.name;
        const auto write_ours = [&] { require(write_vtk(mesh, ours, kind.data).has_value(), "cannot write " + ours); };
        std::vector<Contender> writers, readers;
        write_ours();
        same_mesh(mesh, read_vtk(ours).value(), true, ours);
        std::string read = ours;
#ifdef BARYCERT_WITH_VTK
        require(vtk_is(vtk_read(ours), mesh), ours + ": VTK reads something else");
        require(vtk_write(grid, theirs, kind.data), "VTK cannot write " + theirs);
        // VTK writes 6 to 11 digits.
        same_mesh(mesh, read_vtk(theirs).value(), kind.data != VtkData::ascii, theirs);
        read = theirs;
        writers.push_back({"VTK", [&] { vtk_write(grid, theirs, kind.data); }});
        readers.push_back({"VTK", [&] { require(vtk_read(read) != nullptr, "VTK cannot read " + read); }});
#endif
        const auto read_ours = [&] { require(read_vtk(read).has_value(), "cannot read " + read); };
        for (const std::size_t threads : {1, 2}) {
            const std::string name = threads == 1 ? "1 thread" : "2 threads";
            readers.push_back({name, on_threads(threads, read_ours)});
            writers.push_back({name, on_threads(threads, write_ours)});
        }
        time_all(readers, repetitions);
        tell(std::string("read ") + kind.what, static_cast<double>(fs::file_size(read)), readers);
        time_all(writers, repetitions);
        tell(std::string("write ") + kind.what, static_cast<double>(fs::file_size(ours)), writers);
    }
    fs::remove_all(folder);
    return 0;
}
