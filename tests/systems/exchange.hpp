/// Data that go to a system and come back: arrays in files of a folder, as they stand in memory.
///
/// A system is a program of its own, so that its threads, its crashes and its language stay there:
///     PROGRAM SYSTEM triangulate FOLDER    for systems that make their own triangulation: nodes -> cells
///     PROGRAM SYSTEM locate FOLDER         nodes, cells, values, points -> owners, sampled, times
/// It prints its version. This header is for those in C++17 (VTK 9.1 does not compile as C++20) and in C++20.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace barycert::systems {

/// FOLDER/dimension.i32 holds 2 or 3. Coordinates are `dimension` doubles a node or point.
///
///     nodes.f64  cells.i32  values.f64 (one a node)  points.f64     to the system
///     types.u8  ends.i64   if cells are not linear simplices: VTK's numbers of types, where nodes of each cell end
///     owners.i64   a cell for each point, -1 outside                from it; not there if it tells no cells
///     sampled.f64  a value for each point, NaN outside              from it; not there if it gives no values
///     seconds.f64  to make its index, and to answer all points      from it
template <class T>
std::vector<T> read_array(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    std::vector<T> array(static_cast<std::size_t>(file.tellg()) / sizeof(T));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(array.data()), static_cast<std::streamsize>(array.size() * sizeof(T)));
    return array;
}

template <class T>
void write_array(const std::string& path, const std::vector<T>& array) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(array.data()), static_cast<std::streamsize>(array.size() * sizeof(T)));
    if (!file.flush()) {
        std::fprintf(stderr, "cannot write %s\n", path.c_str());
        std::exit(2);
    }
}

/// Seconds from some moment on.
inline double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Question to a system.
struct Question {
    explicit Question(const std::string& folder_with_arrays)
        : folder(folder_with_arrays),
          dimension(static_cast<std::size_t>(read_array<std::int32_t>(folder + "/dimension.i32").at(0))),
          nodes(read_array<double>(folder + "/nodes.f64")),
          cells(read_array<std::int32_t>(folder + "/cells.i32")),
          types(read_array<std::uint8_t>(folder + "/types.u8")),
          ends(read_array<std::int64_t>(folder + "/ends.i64")),
          values(read_array<double>(folder + "/values.f64")),
          points(read_array<double>(folder + "/points.f64")) {}

    std::size_t node_count() const { return nodes.size() / dimension; }
    std::size_t cell_count() const { return types.empty() ? cells.size() / (dimension + 1) : types.size(); }
    std::size_t point_count() const { return points.size() / dimension; }

    std::string folder;
    std::size_t dimension;
    std::vector<double> nodes;
    std::vector<std::int32_t> cells;
    std::vector<std::uint8_t> types;
    std::vector<std::int64_t> ends;
    std::vector<double> values, points;
};

/// Its answer; empty arrays are not written.
struct Answer {
    std::vector<std::int64_t> owners;
    std::vector<double> sampled;
    double index_seconds = 0, seconds = 0;

    void write(const std::string& folder) const {
        if (!owners.empty()) write_array(folder + "/owners.i64", owners);
        if (!sampled.empty()) write_array(folder + "/sampled.f64", sampled);
        write_array(folder + "/seconds.f64", std::vector<double>{index_seconds, seconds});
    }
};

}  // namespace barycert::systems
