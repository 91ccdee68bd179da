/// Runs barycert-tetgen as a process in a folder of its own, and measures meshes.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
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
#include "tests/scratch.hpp"

namespace barycert::test {

inline std::string contents(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Outcome {
    int code = -1;
    std::string out;
    std::string err;
};

inline Outcome run_tetgen(std::vector<std::string> words) {
    const Scratch streams;
    words.insert(words.begin(), BARYCERT_TETGEN_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string out = streams.path("out");
    const std::string err = streams.path("err");
    const pid_t child = fork();
    if (child == 0) {
        if (std::freopen(out.c_str(), "w", stdout) == nullptr) _exit(127);
        if (std::freopen(err.c_str(), "w", stderr) == nullptr) _exit(127);
        alarm(60);  // what waits for ever is ended: code -1
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(out), contents(err)};
}

/// Signed volume of cell i times six, as det(b-a, c-a, d-a), in plain arithmetic.
inline double six_volumes(const Mesh& mesh, std::size_t i) {
    std::array<std::array<double, 3>, 3> e{};
    const auto corner = [&](std::size_t k) { return 3 * static_cast<std::size_t>(mesh.cells[4 * i + k]); };
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            e[k][axis] = mesh.points[corner(k + 1) + axis] - mesh.points[corner(0) + axis];
        }
    }
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

inline double max_volume(const Mesh& mesh) {
    double max = 0;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        max = std::max(max, std::abs(six_volumes(mesh, i)) / 6);
    }
    return max;
}

inline double total_volume(const Mesh& mesh) {
    double total = 0;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) total += std::abs(six_volumes(mesh, i));
    return total / 6;
}

// The unit cube as nodes and as quadrilaterals, in pieces that the formats share.
inline const std::vector<std::array<int, 3>> cube_nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline const std::vector<std::array<int, 4>> cube_sides{{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5},
                                                        {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};

inline std::string cube_rows(int index_base, bool numbered) {
    std::string text;
    for (const auto& [x, y, z] : cube_nodes) {
        if (numbered) text += std::to_string(index_base++) + " ";
        text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
    return text;
}

inline std::string side_rows(int index_base, const std::string& before, const std::string& after) {
    std::string text;
    for (const auto& [a, b, c, d] : cube_sides) {
        text += before + "4";
        for (const int node : {a, b, c, d}) text += " " + std::to_string(node + index_base);
        text += after + "\n";
    }
    return text;
}

inline std::string cube_poly(int index_base = 0) {
    return "8 3 0 0\n" + cube_rows(index_base, true) + "6 1\n" + side_rows(index_base, "1 0 7 # a side\n", "") + "0\n";
}
inline std::string cube_off() {
    return "OFF\n8 6 12\n" + cube_rows(0, false) + side_rows(0, "", "");
}

}  // namespace barycert::test
