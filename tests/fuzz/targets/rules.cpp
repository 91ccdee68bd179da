// Rules of --fail-on.
#include <cmath>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/figure.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/job.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(rules) {
    const Result<Threshold> threshold = parse_threshold(input);
    if (threshold) expect(!std::isnan(threshold->limit), "a limit that nothing exceeds");
    const Result<VerifyLimit> limit = parse_verify_limit(input);
    for (const Error* const error : {threshold ? nullptr : &threshold.error(), limit ? nullptr : &limit.error()})
        expect(error == nullptr || !error->what.empty(), "an error that does not say what");
}

}  // namespace barycert::fuzz
