/// The rounds of bench_sample: what is timed on one subject, and how times grow with the mesh.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sample_contest.hpp"
#include "sample_peers.hpp"
#include "sample_subject.hpp"
#include "sample_table.hpp"

namespace barycert::bench {

struct RoundOptions {
    int repetitions = 5;
    bool scipy = false;        ///< it takes long
    bool two_threads = false;  ///< demand that two threads be worth it
};

/// A subject, barycert and its peers on it, and what is known to be right.
struct Round {
    const Subject& subject;
    RoundOptions how;
    Ours ours;
    Table rows = {};                       ///< at the points
    std::vector<double> grid_values = {};  ///< on the grid
    std::unique_ptr<VtkPeer> vtk = {};     ///< null: not built
    std::unique_ptr<CgalPeer> cgal = {};

    std::size_t bytes = 0;       ///< of the locator, besides the mesh, once built
    std::size_t handed_out = 0;  ///< the same as malloc sees it
    std::size_t vtk_static_bytes = 0, vtk_tree_bytes = 0;
};

/// Verifies and times barycert and its peers on a subject; adds lines and demands to the table.
void run_subject(const Subject& subject, const RoundOptions& options, SampleTable& table);

/// Its parts: they time, and tell.
void run_points(Round& round, SampleTable& table);
void run_single(Round& round, SampleTable& table);
void run_grid(Round& round, SampleTable& table);
void run_builds(Round& round, SampleTable& table);

/// Random points in generated meshes of the cube with 6 n^3 cells each; n from small to large.
void run_growth(std::span<const int> sizes, std::size_t point_count, const RoundOptions& options, SampleTable& table);

/// Parts of a cell of the table, those that are not empty, with commas.
std::string joined(std::initializer_list<std::string> parts);

/// "WHO 12.3x", how often `fast` fits into `slow`; empty if one is missing.
std::string times_as_long(const Contest& contest, const char* who, const std::string& slow, const std::string& fast);

}  // namespace barycert::bench
