/// An audit of a few cases, with something of everything: findings of all kinds, kernels that have no figure.
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
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"

namespace barycert::report_test {

/// A kernel that never answers: it has no figure of any error.
inline Kernel silent_kernel() {
    Kernel k;
    k.name = "tetrahedron.silent";
    k.simplex = Simplex::tetrahedron;
    k.declares_degenerate = true;
    k.weights = [](const double*, const double*, double*) { return 1; };
    k.value = [](const double*, const double*) { return 0.0; };
    return k;
}

/// A kernel that certifies and gives every simplex the same weights.
inline Kernel stubborn_kernel() {
    Kernel k = silent_kernel();
    k.name = "tetrahedron.stubborn";
    k.certifies = true;
    k.weights = [](const double*, const double*, double* w) {
        w[0] = w[1] = w[2] = w[3] = 0.25;
        return 0;
    };
    k.value = [](const double*, const double* f) { return (f[0] + f[1] + f[2] + f[3]) / 4; };
    return k;
}

inline AuditReport small_audit() {
    MeshSource meshes;
    for (const char* name : {"bracket", "plate"}) {
        meshes.add(name, read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".node",
                                     {.faces = false, .neighbours = false, .threads = 0})
                             .value());
    }
    AuditOptions options;
    options.kernels = kernels_matching("*");
    options.kernels.push_back(silent_kernel());
    options.kernels.push_back(stubborn_kernel());
    options.families = all_families();
    options.count = 30;
    options.threads = 2;
    return run_audit(options, meshes).value();
}

/// The same report for all tests of a process.
inline const AuditReport& audited() {
    static const AuditReport report = small_audit();
    return report;
}

}  // namespace barycert::report_test
