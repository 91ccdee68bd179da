// What barycert-check has only a part of: all formats, repaired copies, pages and pictures.

#include <string>

#include "app/cli/check_parts.hpp"
#include "barycert/check_job.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"

namespace barycert::cli {

Result<CheckedMesh> checked_files(const CheckJob& job) {
    return check_files(job);
}

Result<std::string> checked_page(const CheckedMesh& c, const FixedMesh* fixed) {
    return c.report.surface ? check_html(c.report, c.surface, c.name) : check_html(c.report, c.mesh, c.name, fixed);
}

Result<std::string> checked_plot(const CheckedMesh& c, const std::string& path) {
    return check_plot(c.report, c.name, path);
}

}  // namespace barycert::cli
