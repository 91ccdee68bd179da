#include "app/report/check/check_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/measures.hpp"

namespace barycert::report {

std::vector<Measure> measures_of(const CheckReport& r) {
    using Kind = BinRule::Kind;
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    std::vector<double> sizes(m.volume), bits(m.condition);
    for (double& x : sizes) x = std::fabs(x);
    for (double& x : bits) x = std::isnan(x) ? x : std::log2(std::max(1.0, x));  // kappa is at least 1, but rounded
    // Angles from flat to regular: 70.53 degrees, in 2D 60.
    return {{plane ? "area" : "volume",
             plane ? "area, unit of coordinates squared" : "volume, unit of coordinates cubed",
             {.kind = Kind::logarithmic},
             std::move(sizes),
             &CellMeasures::volume,
             false,
             "overflow"},
            {"accuracy lost to shape, bits",
             "accuracy lost to shape: log2 of the condition number, of 53 bits",
             {Kind::linear, 0, 10, 0},
             std::move(bits)},
            {"circumradius / shortest edge",
             fmt::format("circumradius / shortest edge (regular: {})", plane ? "0.577" : "0.612"),
             {.kind = Kind::chosen},
             m.radius_edge,
             &CellMeasures::radius_edge},
            {"aspect (regular cell: 1)",
             "aspect: longest edge / inradius, scaled (regular: 1)",
             {.kind = Kind::chosen},
             m.aspect,
             &CellMeasures::aspect},
            {plane ? "smallest angle, degrees" : "smallest dihedral angle, deg",
             plane ? "smallest angle, degrees (regular: 60)" : "smallest dihedral angle, degrees (regular: 70.5)",
             {Kind::given, 0, plane ? 60.0 : 72.0, plane ? 1.5 : 2.0},
             m.min_angle,
             &CellMeasures::min_angle,
             false},
            {plane ? "largest angle, degrees" : "largest dihedral angle, deg",
             plane ? "largest angle, degrees (regular: 60)" : "largest dihedral angle, degrees (regular: 70.5)",
             {Kind::given, plane ? 60.0 : 70.0, 180, plane ? 3.0 : 2.5},
             m.max_angle,
             &CellMeasures::max_angle}};
}

}  // namespace barycert::report
