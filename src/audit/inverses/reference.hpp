/// Cells of VTK's types 9, 12, 13 and 14, as those who know their maps have them.
#pragma once

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::audit {

namespace iso = core::isoparametric;

/// Where node i of the reference cell is; the apex of a pyramid over the middle of its base.
inline std::array<double, 3> reference_node(std::uint8_t type, std::size_t i) {
    if (type == vtk_wedge) return {double(i % 3 == 1), double(i % 3 == 2), double(i >= 3)};
    if (i == 4 && type == vtk_pyramid) return {0.5, 0.5, 1};
    return {double(i % 4 == 1 || i % 4 == 2), double(i % 4 >= 2), double(i >= 4)};
}

inline iso::Places places_of(const InverseCase& c) {
    iso::Places places;
    for (std::size_t i = 0; i < c.values.size(); ++i) places.at[i] = &c.nodes[c.point.size() * i];
    return places;
}

}  // namespace barycert::audit
