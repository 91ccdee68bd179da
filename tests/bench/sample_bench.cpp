// Fields at points and on grids: barycert beside VTK, CGAL and SciPy, where they are there.
//
// On the cube of 2 million cells, two parts of data/ and a generated mesh, then on generated meshes from 200,000 to 20
// million cells. Answers are verified before they are timed (sample_verify.hpp); peers' answers are compared with the
// exact ones, and differences told. All is timed in turn, in the same run, on one thread if nothing else is said:
// medians of the processor's time; two threads by the clock. At the end: each demand as met or not, and one table.
//
//     bench_sample [--quick] [--repetitions N] [cube] [flange] [bracket] [generated] [growth] [counters]
//
// counters: cache lines, instructions and branches of a query, counted by valgrind.
// Without names all of them: about 20 minutes, of which VTK's image takes most, and 4 GiB of memory. --quick: small
// meshes and few points, to see that all of it works.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "barycert/environment.hpp"
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
#include "peak_memory.hpp"
#include "sample_counters.hpp"
#include "sample_rounds.hpp"
#ifdef BARYCERT_WITH_TETGEN
#include "large_mesh.hpp"
#endif

namespace {

using namespace barycert;
using namespace barycert::bench;

struct Arguments {
    bool quick = false;
    int repetitions = 5;
    std::set<std::string> chosen;

    bool wants(const char* name) const { return chosen.empty() || chosen.count(name) != 0; }
};

[[noreturn]] void usage() {
    std::fprintf(stderr,
                 "usage: bench_sample [--quick] [--repetitions N] [cube] [flange] [bracket] [generated] [growth] "
                 "[counters]\n");
    std::exit(2);
}

Arguments parse(int count, char** text) {
    Arguments out;
    const std::set<std::string> names{"cube", "flange", "bracket", "generated", "growth", "counters"};
    for (int i = 1; i < count; ++i) {
        const std::string_view word = text[i];
        if (word == "--quick") {
            out.quick = true;
        } else if (word == "--repetitions" && i + 1 < count) {
            out.repetitions = std::atoi(text[++i]);
            if (out.repetitions < 1) usage();
        } else if (names.count(std::string(word)) != 0) {
            out.chosen.emplace(word);
        } else {
            usage();
        }
    }
    return out;
}

}  // namespace

Mesh barycert::bench::bench_cube(bool quick) {
    if (quick) return jittered_cube(12, 7);
#ifdef BARYCERT_WITH_TETGEN
    return demand_value(read_tetgen(large_mesh_stem()));
#else
    std::printf("no TetGen: the cube is a generated one\n");
    return jittered_cube(68, 7);
#endif
}

namespace {

Mesh part(const char* name) {
    Mesh mesh = demand_value(read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + name));
    require(mesh.dimension == 3 && mesh.mid_nodes.empty(), "not a mesh of linear tetrahedra");
    return mesh;
}

}  // namespace

int main(int count, char** text) {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // what is known so far shows in a file, too
    if (count > 1 && std::string_view(text[1]) == "count")
        return count_work({text + 2, static_cast<std::size_t>(count - 2)});
    const Arguments arguments = parse(count, text);
    const bool quick = arguments.quick;
    const std::size_t points = quick ? 20'000 : 1'000'000;
    SampleTable table;
    table.cgal = true;
#ifdef BARYCERT_WITH_VTK
    table.vtk = true;
#endif
    RoundOptions how;
    how.repetitions = arguments.repetitions;
    std::printf("SIMD %s\n", simd_target().c_str());
    if (arguments.wants("cube")) {
        how.two_threads = true;
        run_subject(Subject("cube", bench_cube(quick), points, quick ? 24 : 256), how, table);
        how.two_threads = false;
    }
    for (const char* const name : {"flange", "bracket"}) {
        if (arguments.wants(name)) run_subject(Subject(name, part(name), points, quick ? 24 : 128), how, table);
    }
    if (arguments.wants("generated")) {
        how.scipy = true;
        run_subject(Subject("generated", jittered_cube(quick ? 8 : 32, 7), points, quick ? 24 : 64), how, table);
        how.scipy = false;
    }
    if (arguments.wants("growth")) {
        constexpr int few[]{4, 8, 16}, many[]{32, 69, 150};
        run_growth(quick ? few : many, points, how, table);
    }
    if (arguments.wants("counters"))
        run_counters(std::filesystem::read_symlink("/proc/self/exe").string(), quick, table);
    std::printf("peak of memory: %.0f MiB\n\n", peak_mib());
    table.print_demands();
    if (quick) std::printf("(a quick run: these times and ratios say nothing)\n");
    std::printf("\n");
    table.print();
    return 0;
}
