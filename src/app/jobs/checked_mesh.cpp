#include "app/jobs/checked_mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/mesh.hpp"
#include "files/suffix.hpp"

namespace barycert::jobs {

CheckOptions told_options(const CheckJob& job) {
    CheckOptions options = job.options;
    options.progress = [&job](const char* text) {
        if (job.progress) job.progress({.stage = std::string("checking: ") + text, .done = 0});
    };
    return options;
}

void take_curved(const CheckJob& job, const Mesh& mesh, CheckOptions& options) {
    if (job.curved == Curved::refuse) measure_curved(mesh, job.mesh, job.curved).value();
    options.curved = job.curved;
}

void check_cells(const CheckJob& job, const std::vector<std::string>& files, std::string name,
                 const CheckOptions& options, CheckedMesh& checked) {
    checked.name = std::move(name);
    const auto there = std::ranges::find_if(files, base::file_exists);
    checked.artifact = there == files.end() ? job.mesh : *there;
    checked.report = check_mesh(checked.mesh, options);
}

}  // namespace barycert::jobs
