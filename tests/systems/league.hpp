/// Answers of systems, compared with the exact owners and values.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "barycert/verify.hpp"
#include "tests/systems/test_meshes.hpp"

namespace barycert::systems {

struct Tally {
    std::uint64_t points = 0, inside = 0, outside = 0;
    std::uint64_t missed = 0, invented = 0, wrong_cell = 0;
    bool has_cells = false, has_values = false;
    double max_error = 0;  ///< of a value, in parts of the field's range

    void add(const Verdicts& verdicts, bool cells, bool values);
};

struct Standing {
    std::string name, version;
    CellKind kind = CellKind::tetrahedra;
    Tally total;
    std::map<std::string, Tally> by_set, by_mesh;
    std::vector<std::string> failures;  ///< meshes on which it ended by itself, or did not in time: not counted
    std::vector<std::string>
        not_timed;             ///< meshes that are counted, but on which it failed when it was asked for times
    std::vector<double> ns;    ///< a random point of the box, mesh by mesh
    std::string why_not = {};  ///< it is not installed
};

struct League {
    std::uint64_t seed = 1, count = 0;  ///< points of each set and mesh
    std::vector<std::pair<std::string, std::string>> meshes, sets;
    std::vector<Standing> standings;
};

std::string league_markdown(const League& league);
std::string league_json(const League& league);

}  // namespace barycert::systems
