// Results of some tool, held against the exact ones. The first byte: the format and what is said of the columns.
#include <array>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/small_meshes.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

std::string mesh_file(int dimension) {
    const std::string path = scratch_path("mesh" + std::to_string(dimension) + ".vtu");
    const Status written = write_vtu(small_mesh(dimension), path);
    expect(bool(written), "cannot write the mesh");
    return path;
}

}  // namespace

BARYCERT_FUZZ_TARGET(verify, {std::size_t{24} << 20, std::size_t{1} << 14}) {
    static std::array<InputFile, 4> files{InputFile("in.csv"), InputFile("in.npy"), InputFile("in.vtu"),
                                          InputFile("in.vtk")};
    static const std::array<std::string, 2> meshes{mesh_file(2), mesh_file(3)};
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    VerifyJob job;
    job.mesh = meshes[how / 4 % 2];
    job.results = files[how % 4].put(input);
    if ((how & 8) != 0) job.cell_base = 1;
    if ((how & 16) != 0) job.cell_column = "none";
    if ((how & 32) != 0) job.options.exact = true;
    if ((how & 64) != 0) job.options.outside_value = 0;
    if ((how & 128) != 0) job.columns = {"1,2,3"};
    job.options.threads = 1;
    const Result<VerifyReport> summary = verify_files(job);
    if (!summary) return expect_useful(summary.error(), lines_of(input));
    const Verdicts& v = summary->verdicts;
    expect(v.right + v.missed + v.invented + v.wrong_cell + v.wrong_value == v.rows, "rows without a verdict");
    expect(v.inside + v.outside == v.rows, "rows that are neither inside nor outside");
    expect(v.columns.size() == summary->columns.size(), "columns without errors");
}

}  // namespace barycert::fuzz
