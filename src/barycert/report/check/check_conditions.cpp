#include "barycert/report/check/check_conditions.hpp"

#include <algorithm>

namespace barycert::report {

using check::Finding;
using check::Problem;

std::vector<ConditionRow> condition_rows(const check::Report& report, const Mesh& mesh) {
    const bool plane = report.dimension == 2;
    std::vector<ConditionRow> rows{
        {"P1", plane ? "every cell has 3 different nodes, finite coordinates and an area"
                     : "every cell has 4 different nodes, finite coordinates and a volume"},
        {"P2", "a facet belongs to one cell, or to two on opposite sides of it"},
        {"P3", plane ? "boundary facets meet only in nodes that they share"
                     : "boundary facets meet only in nodes and edges that they share"},
        {"P4", "no piece of the boundary lies inside cells"},
        {"", "hence, by P1 to P4: no two cells overlap"},
        {"P5", plane ? "neighbours that came with the mesh are those of its cells"
                     : "neighbours and faces that came with the mesh are those of its cells"},
    };
    const bool files = !mesh.neighbours.empty() || !mesh.faces.empty();
    const bool looked_at = report.find(Problem::bad_structure) == nullptr;
    for (ConditionRow& row : rows) {
        for (const Finding& f : report.findings) {
            const bool here =
                row.name.empty() ? f.problem == Problem::overlapping_cells : text_of(f.problem).condition == row.name;
            if (!text_of(f.problem).breaks || !here) continue;
            row.count += f.count;
            row.at_least |= f.at_least;
        }
        row.instead = !looked_at ? "not checked" : row.name == "P5" && !files ? "none came" : "ok";
    }
    return rows;
}

bool left_cells_out(const check::Report& report) {
    return std::any_of(report.findings.begin(), report.findings.end(), [](const Finding& f) {
        return f.problem == Problem::index_out_of_range || f.problem == Problem::not_finite ||
               f.problem == Problem::repeated_node;
    });
}

}  // namespace barycert::report
