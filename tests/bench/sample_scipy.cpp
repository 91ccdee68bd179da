#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sample_peers.hpp"

namespace barycert::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* script = R"(
import sys, time
import numpy, scipy
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

folder, repetitions = sys.argv[1], int(sys.argv[2])
load = lambda name: numpy.fromfile(folder + '/' + name)
nodes, values, points = load('nodes').reshape(-1, 3), load('values'), load('points').reshape(-1, 3)

def median(work):
    times = []
    for _ in range(repetitions):
        start = time.process_time()
        result = work()
        times.append(time.process_time() - start)
    return sorted(times)[len(times) // 2], result

start = time.process_time()
triangulation = Delaunay(nodes)
build = time.process_time() - start
interpolator = LinearNDInterpolator(triangulation, values)
find, _ = median(lambda: triangulation.find_simplex(points))
interpolate, result = median(lambda: interpolator(points))
result.tofile(folder + '/result')
print(scipy.__version__, build, find, interpolate)
)";

/// A folder of its own that goes when it is done with.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("barycert-bench-" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const char* name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }

private:
    fs::path path_;
};

void write(const std::string& path, std::span<const double> numbers) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes()));
}

bool read(const std::string& path, std::vector<double>& numbers) {
    std::ifstream file(path, std::ios::binary);
    const auto size = static_cast<std::streamsize>(numbers.size() * sizeof(double));
    return file.read(reinterpret_cast<char*>(numbers.data()), size) && file.peek() == std::ifstream::traits_type::eof();
}

/// Runs a command of the shell: takes what it prints, and returns whether it ended well.
bool run(const std::string& command, std::string& output) {
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return false;
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) output += buffer;
    return ::pclose(pipe) == 0;
}

}  // namespace

ScipyRun run_scipy(const Mesh& mesh, const std::vector<double>& nodal, std::span<const double> points,
                   int repetitions) {
    ScipyRun out;
    // The first python3 of the path need not be the system's, for which Debian's package is.
    std::string python, ignored;
    for (const char* const candidate : {"python3", "/usr/bin/python3"}) {
        if (python.empty() && run(std::string(candidate) + " -c 'import scipy' 2>/dev/null", ignored))
            python = candidate;
    }
    if (python.empty()) {
        out.why_not = "no python3 with scipy";
        return out;
    }
    const Folder folder;
    write(folder / "nodes", mesh.points);
    write(folder / "values", nodal);
    write(folder / "points", points);
    std::ofstream(folder / "run.py") << script;
    std::string output;
    const std::string command = "OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 timeout 600 " + python + " '" +
                                (folder / "run.py") + "' '" + folder.path() + "' " + std::to_string(repetitions);
    if (!run(command, output)) {
        out.why_not = "python3 failed, or took more than 600 s";
        return out;
    }
    out.values.resize(points.size() / 3);
    std::istringstream numbers(output);
    if (!(numbers >> out.version >> out.build >> out.find >> out.interpolate) || !read(folder / "result", out.values))
        out.why_not = "python3 printed something else: " + output;
    return out;
}

}  // namespace barycert::bench
