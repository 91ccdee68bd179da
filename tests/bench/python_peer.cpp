// python_peer FOLDER REPETITIONS: what bench_python.py times in Python, in C++, on the arrays that it left in the
// folder: points, cells (int32), values, at; writes the values to `result` and prints seconds of building and of
// sampling, the least of the repetitions, for one thread and for all.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "barycert/sampler.hpp"

namespace {

using Clock = std::chrono::steady_clock;

template <class T>
std::vector<T> read(const std::filesystem::path& path) {
    std::vector<T> numbers(std::filesystem::file_size(path) / sizeof(T));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size() * sizeof(T)));
    return numbers;
}

template <class Work>
double least_seconds(int repetitions, const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repetitions; ++i) {
        const Clock::time_point begin = Clock::now();
        work();
        least = std::min(least, std::chrono::duration<double>(Clock::now() - begin).count());
    }
    return least;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::filesystem::path folder = argv[1];
    const int repetitions = std::atoi(argv[2]);
    barycert::Mesh mesh;
    mesh.points = read<double>(folder / "points");
    mesh.cells = read<std::int32_t>(folder / "cells");
    mesh.point_fields.push_back({"T", 1, read<double>(folder / "values")});
    const std::vector<double> at = read<double>(folder / "at");
    const std::vector<std::string> all;
    for (const int threads : {1, 0}) {
        barycert::BuildOptions build;
        build.threads = threads;
        barycert::SampleOptions options;
        options.threads = threads;
        const double building = least_seconds(
            repetitions, [&] { return barycert::Sampler::build(mesh, all, build).value().columns().size(); });
        const barycert::Sampler sampler = barycert::Sampler::build(mesh, all, build).value();
        std::vector<double> values;
        const double sampling =
            least_seconds(repetitions, [&] { values = sampler.sample(at, options).value().values; });
        std::printf("%d %.17g %.17g\n", threads, building, sampling);
        std::ofstream file(folder / "result", std::ios::binary);
        file.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(double)));
    }
    return 0;
}
