// Audits in a few lines, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

namespace barycert::audit {

inline const Kernel& kernel_named(const std::string& name) {
    for (const Kernel& k : catalogue()) {
        if (k.name == name) return k;
    }
    ADD_FAILURE() << "no kernel " << name;
    return catalogue().front();
}

inline const Family& family_named(const std::string& name) {
    for (const Family& f : all_families()) {
        if (f.name == name) return f;
    }
    ADD_FAILURE() << "no family " << name;
    return all_families().front();
}

/// The project's own 3D and 2D meshes.
inline const MeshSource& own_meshes() {
    static const MeshSource source = [] {
        MeshSource s;
        for (const char* name : {"cube-hole", "bracket", "lattice-box", "plate"}) {
            s.add(name, read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + name).value());
        }
        return s;
    }();
    return source;
}

inline AuditReport audit_of(std::vector<Kernel> kernels, std::vector<Family> families, std::uint64_t count,
                            const MeshSource& meshes = {}, int threads = 2) {
    AuditOptions options;
    options.kernels = std::move(kernels);
    options.families = std::move(families);
    options.count = count;
    options.threads = threads;
    return run_audit(options, meshes).value();
}

/// The statistics of one kernel in one family.
inline KernelStatistics statistics_of(const Kernel& kernel, const std::string& family, std::uint64_t count,
                                      const MeshSource& meshes = {}) {
    return audit_of({kernel}, {family_named(family)}, count, meshes).kernels.at(0).families.at(0).statistics;
}

inline KernelStatistics statistics_of(const std::string& kernel, const std::string& family, std::uint64_t count,
                                      const MeshSource& meshes = {}) {
    return statistics_of(kernel_named(kernel), family, count, meshes);
}

inline double share(const KernelStatistics& s, std::uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(s.cases);
}

inline std::uint64_t count_of(const KernelStatistics& s, Finding f) {
    return s.counts[static_cast<std::size_t>(f)];
}

}  // namespace barycert::audit
