// Reading a large mesh from .msh files, of both versions, as text and binary: read_gmsh on one thread and two, and as
// peers, where they are installed, Gmsh itself and meshio as processes, in the same run.
//
// The mesh is that of large_mesh.hpp. Before any time is taken, each file must give the arrays that read_tetgen gives.
// A process takes the time of its start besides: the rows gmsh_start and meshio_start tell how much. Repetitions are
// interleaved and medians compared, for the machine may not be idle.
//
// Developers only: the mesh is TetGen's (AGPL).
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "large_mesh.hpp"

namespace {

namespace fs = std::filesystem;
using barycert::GmshWriteOptions;

struct Subject {
    const char* name;
    GmshWriteOptions options;
};
constexpr std::array<Subject, 4> subjects{{{"41-binary", {GmshWriteOptions::Version::v41, true}},
                                           {"41-text", {GmshWriteOptions::Version::v41, false}},
                                           {"22-binary", {GmshWriteOptions::Version::v22, true}},
                                           {"22-text", {GmshWriteOptions::Version::v22, false}}}};

std::string path_of(const std::string& stem, const Subject& subject) {
    return stem + "-" + subject.name + ".msh";
}

/// Writes the files that are not there; false if one does not hold the mesh.
bool make_files(const std::string& stem) {
    const barycert::Mesh mesh = barycert::read_tetgen(stem).value();
    for (const Subject& subject : subjects) {
        const std::string path = path_of(stem, subject);
        if (!fs::exists(path)) barycert::write_gmsh(mesh, path, subject.options).value();
        const barycert::Mesh read = barycert::read_gmsh(path).value();
        if (read.points != mesh.points || read.cells != mesh.cells) {
            std::fprintf(stderr, "%s does not hold the mesh of %s\n", path.c_str(), stem.c_str());
            return false;
        }
    }
    return true;
}

bool runs(const std::string& command) {
    return std::system(("(" + command + ") >/dev/null 2>&1 </dev/null").c_str()) == 0;
}

template <class Run>
void add(const std::string& name, std::uint64_t bytes, int repetitions, Run run) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [run, bytes](benchmark::State& state) {
                                     for (auto _ : state) run();
                                     if (bytes != 0) state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(1)
        ->Repetitions(repetitions)
        ->ReportAggregatesOnly();
}

void add_process(const std::string& name, std::uint64_t bytes, const std::string& command) {
    add(name, bytes, 3, [command] {
        if (!runs(command)) std::fprintf(stderr, "failed: %s\n", command.c_str());
    });
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    char interleave[] = "--benchmark_enable_random_interleaving=true";
    arguments.insert(arguments.begin() + 1, interleave);
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());

    const std::string stem = large_mesh_stem();
    if (!make_files(stem)) return 1;
    const bool gmsh = runs("gmsh --version");
    std::string python;
    for (const char* candidate : {"/usr/bin/python3", "python3"}) {
        if (runs(std::string(candidate) + " -c 'import meshio'")) python = candidate;
    }
    if (gmsh) add_process("gmsh_start", 0, "gmsh -");
    if (!python.empty()) add_process("meshio_start", 0, python + " -c 'import meshio'");
    for (const Subject& subject : subjects) {
        const std::string path = path_of(stem, subject), name = subject.name;
        const std::uint64_t bytes = fs::file_size(path);
        for (const int threads : {1, 2}) {
            add("read_gmsh/" + name + "/" + std::to_string(threads), bytes, 15, [path, threads] {
                benchmark::DoNotOptimize(barycert::read_gmsh(path, {.step = {}, .threads = threads}).value());
            });
        }
        add("write_gmsh/" + name, bytes, 5, [&stem, path, &subject] {
            static const barycert::Mesh mesh = barycert::read_tetgen(stem).value();
            barycert::write_gmsh(mesh, path + "-again", subject.options).value();
            fs::remove(path + "-again");
        });
        if (gmsh) add_process("gmsh/" + name, bytes, "gmsh " + path + " -");
        if (!python.empty())
            add_process("meshio/" + name, bytes, python + " -c 'import meshio; meshio.read(\"" + path + "\")'");
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
