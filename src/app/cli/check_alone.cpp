// What barycert-check has in place of what only barycert has: readers of other formats than TetGen's, writers and
// pictures are much of the time of building.

#include <string>
#include <utility>
#include <vector>

#include "app/cli/check_parts.hpp"
#include "app/cli/tetgen_alone.hpp"
#include "app/jobs/checked_mesh.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/result.hpp"
#include "barycert/tetgen_files.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {
namespace {

[[noreturn]] void refuse_part(const std::string& subject) {
    throw Exception(about(subject, Error{.code = "option.unfit",
                                         .what = "barycert-check does not know " + subject,
                                         .remedy = "`barycert check` does; among the sources: ./run barycert check"}));
}

/// What only barycert can do.
void check_parts(const CheckJob& job) {
    const std::pair<bool, const char*> parts[] = {{!job.plc.empty(), "job.plc"},
                                                  {!job.measures.empty(), "job.measures"},
                                                  {!job.picture.empty(), "job.picture"},
                                                  {!job.fix.empty(), "job.fix"},
                                                  {!job.fix_orientation.empty(), "job.fix_orientation"},
                                                  {job.merge_within.has_value(), "job.merge_within"},
                                                  {job.vtk_data.has_value(), "job.vtk_data"},
                                                  {job.plot, "job.plot"},
                                                  {job.step.made(), "job.step"}};
    for (const auto& [asked, subject] : parts) {
        if (asked) refuse_part(subject);
    }
    for (const auto& [what, path] : job.reports) {
        if (what == "--html" && !path.empty()) refuse_part(what);
    }
}

}  // namespace

Result<CheckedMesh> checked_files(const CheckJob& job) try {
    check_parts(job);
    refuse_other_formats(job.mesh, "barycert-check");
    const std::vector<std::string> files = tetgen_files(job.mesh);
    std::vector<base::NamedFile> outputs;
    for (const auto& [what, path] : job.reports) outputs.push_back({what, path});
    base::check_outputs(base::named_files("the mesh", files), std::move(outputs)).value();
    CheckedMesh checked;
    CheckOptions options = jobs::told_options(job);
    checked.mesh = read_tetgen(job.mesh, {.threads = job.options.threads}).value();
    jobs::take_curved(job, checked.mesh, options);
    jobs::check_cells(job, files, tetgen_stem(job.mesh), options, checked);
    return checked;
} catch (const Exception& e) {
    return e.error();
}

Result<std::string> checked_page(const CheckedMesh& /*checked*/, const FixedMesh* /*fixed*/) {
    refuse_part("--html");
}

Result<std::string> checked_plot(const CheckedMesh& /*checked*/, const std::string& /*path*/) {
    refuse_part("--plot");
}

}  // namespace barycert::cli
