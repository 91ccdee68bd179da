// A whole job, files to files: what `barycert sample` does.

#include <barycert/report.hpp>
#include <barycert/sample_job.hpp>

#include <cstdio>

using namespace barycert;

int main() {
    SampleJob job;
    job.mesh = "data/meshes/cube-hole";
    job.points = "data/meshes/lattice-eighths.node";
    job.fields = {"attribute0"};
    job.output = "rows.csv";
    job.options.outside = {.kind = Outside::nearest};
    const SampleReport summary = sample_files(job).value();
    std::printf("%s", sample_text(summary, false).c_str());
}
