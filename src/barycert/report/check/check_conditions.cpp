#include "barycert/report/check/check_conditions.hpp"

#include <algorithm>

namespace barycert::report {

std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh) {
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
    const bool looked_at = report.find(DefectKind::bad_structure) == nullptr;
    for (ConditionRow& row : rows) {
        for (const Defect& f : report.defects) {
            const bool here =
                row.name.empty() ? f.kind == DefectKind::overlapping_cells : defect_text(f.kind).condition == row.name;
            if (!defect_text(f.kind).breaks || !here) continue;
            row.count += f.count;
            row.at_least |= f.at_least;
        }
        row.instead = !looked_at ? "not checked" : row.name == "P5" && !files ? "none came" : "ok";
    }
    return rows;
}

bool left_cells_out(const CheckReport& report) {
    return std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& f) {
        return f.kind == DefectKind::index_out_of_range || f.kind == DefectKind::not_finite ||
               f.kind == DefectKind::repeated_node;
    });
}

}  // namespace barycert::report
