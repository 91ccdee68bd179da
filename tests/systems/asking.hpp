/// Systems as programs: found, asked about a mesh, judged.
#pragma once

#include <string>
#include <vector>

#include "tests/systems/league.hpp"

namespace barycert::systems {

/// A system as it is asked: `command... TASK FOLDER`, see exchange.hpp.
struct System {
    std::string name;
    std::vector<std::string> command;  ///< program and its first arguments; none: not installed
    bool own_triangulation = false;
    int dimension = 0;         ///< 0: both
    int limit = 60;            ///< seconds for one mesh; then it is taken not to end
    bool other_cells = false;  ///< takes more than linear simplices

    bool takes(CellKind kind) const {
        if (kind == CellKind::others) return other_cells;
        return dimension == 0 || dimension == (kind == CellKind::tetrahedra ? 3 : 2);
    }
};

/// All that are known, installed or not.
std::vector<System> all_systems();

/// Asks a system about one mesh, judges its answers, and adds them, or why there are none, to its standing.
void ask(const System& system, const NamedMesh& mesh, const League& league, Standing& standing);

}  // namespace barycert::systems
