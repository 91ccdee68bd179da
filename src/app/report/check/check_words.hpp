/// The words of reports on meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/report/common/terminal_text.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"

namespace barycert::report {

/// A condition of the certificate in words, and how often it is violated.
struct ConditionRow {
    std::string_view name;          ///< "P1" ...; empty for what follows from P1 to P4
    std::string_view text;          ///< what holds
    std::uint64_t count = 0;        ///< violations
    bool at_least = false;          ///< there may be more
    std::string_view instead = {};  ///< without violations: "ok", "not provided" or "not checked"
};
std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh);

/// The word for what the report counts: cells, triangles, or facets of a PLC.
inline const char* cell_word(const CheckReport& report) {
    return !report.surface ? "cell" : report.surface->plc ? "facet" : "triangle";
}
/// "8 cells, cut into 48 tetrahedra,": of a mesh; "8 cells" of simplices.
inline std::string cells_text(const CheckReport& r) {
    return r.shapes == 0 ? cells_text(r.cells, 0, r.dimension) : cells_text(r.shapes, r.cells, r.dimension);
}
/// Says, for surfaces, whether TetGen gets what it needs, and why not.
std::string tetgen_sentence(const CheckReport& report);

/// Cells with it took no part in P2 to P5, and may have no place in space.
inline bool leaves_cells_out(const Defect& f) {
    return f.kind == DefectKind::index_out_of_range || f.kind == DefectKind::not_finite ||
           f.kind == DefectKind::repeated_node;
}

/// "3 cells are degenerate".
inline std::string reason(const Defect& defect) {
    const DefectText& text = defect_text(defect.kind);
    return (defect.at_least ? "at least " : "") + counted(defect.count, text.one, text.more);
}
/// "touch along a segment": of cells that do not overlap; "meet along a segment": of triangles in space.
inline std::string touch_text(const CellContact& contact, bool in_space = false) {
    const std::string where = contact.dimension <= 0   ? " in a point"
                              : contact.dimension == 1 ? " along a segment"
                                                       : " in an area";
    return (in_space ? "meet" : "touch") + where;
}
/// "cells 3 and 17, nodes 4 5 6 (coplanar)".
std::string place_text(const CheckReport& report, DefectKind kind, const DefectPlace& place);
/// Where a defect may come from: of one with curved cells.
inline std::string curved_text(const Defect& defect) {
    return counted(defect.curved_cells, "cell of these is", "cells of these are") +
           " curved: sides of curved cells were taken as straight";
}

/// "1 part, 0 cavities, 7 tunnels"; in the plane a cavity is a hole.
std::string domain_text(const CheckReport& report);
/// The outcome, then the worst violation if there is one. Requires the report's `delaunay`.
std::vector<std::string> delaunay_sentences(const CheckReport& report);
/// The outcome, distances, missing nodes, and as many violated facets as fit in `room`. Requires `conformity`.
std::vector<std::string> conformity_sentences(const CheckReport& report, std::size_t room);

/// Describes what was done to a mesh, a line each.
std::vector<std::string> fix_sentences(const FixedMesh& fixed);

}  // namespace barycert::report
