#include "app/jobs/points_of_job.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>

#include "app/jobs/job_files.hpp"
#include "app/jobs/profile.hpp"
#include "barycert/point_files.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/table.hpp"
#include "files/format.hpp"

namespace barycert::jobs {

std::unique_ptr<PointSource> points_of(const SampleJob& job, int dimension, NonfinitePoints nonfinite) {
    if (job.line) {
        const std::size_t d = job.line->from.size();
        if (d != static_cast<std::size_t>(dimension) || d != job.line->to.size() || job.line->count < 1)
            refuse_member("option.value", "job.line", job.mesh, "job.line",
                          fmt::format("two points of {} coordinates, and a count of at least 1", dimension),
                          fmt::format("{} and {} coordinates, {} points", d, job.line->to.size(), job.line->count));
        return points_on(*job.line);
    }
    // Columns have types, unless they go as they are into CSV.
    const bool csv = job.output == "-" || base::kind_of(job.output) == base::FormatKind::csv;
    const PointOptions options{.columns = job.columns, .keep = job.keep, .nonfinite_points = nonfinite, .typed = !csv};
    return open_points(job.points, dimension, options).value();
}

}  // namespace barycert::jobs
