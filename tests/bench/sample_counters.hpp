/// Cost of a query in counts that do not depend on the machine's memory: cache lines, instructions, branches.
#pragma once

#include <span>
#include <string>

#include "barycert/mesh.hpp"
#include "sample_table.hpp"

namespace barycert::bench {

/// Runs `self` (this program) under cachegrind for each of its subjects and counts what one query adds: the difference
/// of two runs with different numbers of points. A first cache of 48 KiB, a second of 2 MiB, lines of 64 bytes; no
/// memory is fetched ahead. Without valgrind it says so.
void run_counters(const std::string& self, bool quick, SampleTable& table);

/// The work of such a run: `words` are the subject, the number of points, and "quick" or "full". Returns an exit code.
int count_work(std::span<char* const> words);

/// The mesh of the row "cube".
Mesh bench_cube(bool quick);

}  // namespace barycert::bench
