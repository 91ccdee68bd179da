/// Points to ask systems about: where answers are easy, where they change, and just beyond.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::systems {

struct PointSet {
    std::string name;
    std::string recipe;  ///< one line
    std::size_t first = 0, count = 0;
};

struct Points {
    std::vector<double> coordinates;
    std::vector<PointSet> sets;
};

/// `count` points of each set, by the mesh and the seed alone.
Points make_points(const Mesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace barycert::systems
