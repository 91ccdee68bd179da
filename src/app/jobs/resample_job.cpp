// Fields on a regular grid, or at the nodes of another mesh.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/grid_sinks.hpp"
#include "app/jobs/integrals.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/mesh_sink.hpp"
#include "app/jobs/sampled_mesh.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "io/mesh_format.hpp"

namespace barycert {

using base::FormatKind;
using base::Use;
namespace {

using jobs::refuse_member;
using jobs::SampledMesh;
using jobs::Sink;
using jobs::Stopwatch;

Grid grid_of(const ResampleJob& a, const Mesh& mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Bounds3 box = bounds_of_cells(mesh);
    const auto refuse_axes = [&](const char* member, const std::string& expected, std::size_t found) {
        refuse_member("option.value", std::string(member), "", std::string(member) + " does not fit the mesh",
                      fmt::format("{} for a mesh of dimension {}", expected, d), std::to_string(found));
    };
    if (!a.bounds.empty() && a.bounds.size() != 2 * d)
        refuse_axes("job.bounds", fmt::format("{} numbers", 2 * d), a.bounds.size());
    for (std::size_t k = 0; !a.bounds.empty() && k < d; ++k) {
        box.low[k] = a.bounds[2 * k];
        box.high[k] = a.bounds[2 * k + 1];
    }
    if (!a.counts.empty()) {
        const bool one_layer = d == 2 && a.counts.size() == 3 && a.counts[2] == 1;
        if (a.counts.size() != d && !one_layer)
            refuse_axes("job.counts", fmt::format("{} numbers of points", d), a.counts.size());
        std::array<std::int64_t, 3> counts{1, 1, 1};
        std::copy_n(a.counts.begin(), d, counts.begin());
        return grid_over(mesh.dimension, counts, box.low, box.high).value();
    }
    if (a.spacing.size() != 1 && a.spacing.size() != d)
        refuse_axes("job.spacing", fmt::format("one number or {}", d), a.spacing.size());
    std::array<double, 3> spacing{};
    for (std::size_t k = 0; k < d; ++k) spacing[k] = a.spacing[a.spacing.size() == 1 ? 0 : k];
    return grid_spaced(mesh.dimension, spacing, box.low, box.high).value();
}

bool is_rows(const std::string& output) {
    return output == "-" || (base::is_written_as(output, Use::rows) && !base::is_written_as(output, Use::mesh));
}

void check_job(const ResampleJob& job, const std::vector<jobs::Step>& steps) {
    const int targets = (job.counts.empty() ? 0 : 1) + (job.spacing.empty() ? 0 : 1) + (job.onto.empty() ? 0 : 1);
    if (targets != 1)
        refuse_member(targets == 0 ? ErrorCode("option.missing") : ErrorCode("option.conflict"), "job.counts", "",
                      targets == 0 ? "no target" : "more than one target",
                      "one of job.counts, job.spacing and job.onto", targets == 0 ? "none" : "several",
                      "`barycert resample --help` explains them");
    if (!job.bounds.empty() && !job.onto.empty())
        refuse_member("option.conflict", "job.bounds", "", "job.bounds cannot be combined with job.onto", "", "",
                      "bounds are for job.counts and job.spacing: leave them out");
    if (!job.weights.empty() && job.onto.empty())
        refuse_member("option.missing", "job.weights", job.weights, "job.weights needs job.onto here", "", "",
                      "for the points of a grid, write them to a file first (job.output grid.csv), and use "
                      "`barycert sample --points grid.csv --weights`");
    if (job.onto.empty()) {
        if (job.figure.range && !is_figure_name(job.output))
            refuse_member("option.unfit", "job.range", job.output, "job.range needs a picture", "", "",
                          "use job.output FILE.png, or leave job.range out");
        if (job.output != "-" && !base::is_written_as(job.output, Use::grid))
            jobs::refuse_output(job.output, base::suffixes_written(Use::grid) + " for a grid, or - for CSV on stdout");
        return jobs::check_files(job, steps, {}, {{"job.output", job.output}});
    }
    if (job.figure.range)
        refuse_member("option.conflict", "job.range", "", "job.range cannot be combined with job.onto", "", "",
                      "it is for pictures: leave it out");
    std::vector<std::string> outputs{job.output};
    if (!is_rows(job.output)) {
        const Result<io::MeshFormat> format = io::mesh_output_format(job.output);
        if (!format)
            jobs::refuse_output(job.output,
                                "a mesh (" + base::suffix_list_written(Use::mesh) +
                                    ", a stem of TetGen's files), or rows (.csv .npy, - for CSV on stdout)");
        const std::string stem = tetgen_stem(job.output);
        if (*format == io::MeshFormat::tetgen) outputs = {stem + ".node", stem + ".ele"};
    }
    jobs::check_files(job, steps, base::named_files("the mesh of job.onto", mesh_files(job.onto), true),
                      base::named_files("job.output", outputs));
}

/// Notes what the other mesh's reader told, and the fields of nodes that the sampled ones replace.
void note_the_other(SampledMesh& mesh, const ResampleJob& job, const Mesh& other) {
    Notes& notes = mesh.report.notes;
    notes.insert(notes.end(), other.notes.begin(), other.notes.end());
    if (other.point_fields.empty()) return;
    notes.push_back({Note::Kind::left_out,
                     (other.point_fields.size() == 1 ? "field " : "fields ") +
                         jobs::listed(other.point_fields, &Field::name) + " of its nodes",
                     job.onto});
}

/// The fields as they are now, into the output of that name. Points of a new mesh are counted.
void onto_grid(SampledMesh& mesh, const ResampleJob& job, const std::string& path, bool new_mesh) {
    SampleReport& report = mesh.report;
    const Grid& grid = *report.grid;
    Stopwatch watch, within;
    const Sink output = open_user_rows(mesh, {}, false, [&](const TableFormat& format) {
        return jobs::open_grid_sink(job, path, format, grid, report.picture);
    });
    double writing = 0;
    const bool none_outside = job.options.outside.kind == Outside::error;
    const std::string what = fmt::format("points of {}", grid.point_count());
    const auto sink = [&](const TableView& rows) -> Status {
        const auto outside = none_outside ? std::find(rows.cells.begin(), rows.cells.end(), -1) : rows.cells.end();
        if (outside != rows.cells.end()) {
            const std::uint64_t i = rows.first_row + static_cast<std::uint64_t>(outside - rows.cells.begin());
            const std::array<double, 3> at = jobs::point_of(grid, i);
            return jobs::outside_error("point " + std::to_string(i) + " of the grid",
                                       std::span(at).first(static_cast<std::size_t>(grid.dimension)), "");
        }
        report.nan_values += jobs::count_nan(rows);
        within.lap();
        Status written = output->write(rows);
        writing += within.lap();
        mesh.tell(what, rows.first_row + rows.row_count());
        return written;
    };
    const SampleCounts counts = resample(mesh.sampler(), grid, jobs::without_refusal(job.options), sink).value();
    if (new_mesh) {
        report.counts.add(counts);
        report.rows += grid.point_count();
    }
    report.seconds.sample += watch.lap() - writing;
    output->commit().value();
    report.seconds.write += writing + watch.lap();
}

void onto_grid_in_steps(SampledMesh& mesh, const ResampleJob& job) {
    Grid& grid = mesh.report.grid.emplace(grid_of(job, mesh.mesh()));
    if (base::kind_of(job.output) == FormatKind::vti) grid = as_in_vti(grid);
    mesh.report.from = PointsFrom::grid;
    mesh.for_outputs([&](const std::string& path, bool, bool anew) {
        if (anew && mesh.mesh().is_listed()) {
            mesh.prepare_without_search(FoundBy::grid, "each cell finds the points that it holds");
        } else if (anew) {
            mesh.prepare();
        }
        if (anew && mesh.report.meshes == 2 && job.bounds.empty())
            mesh.report.notes.push_back(
                {Note::Kind::guessed,
                 "the grid of all steps lies in the box of the mesh of the first one: job.bounds names another box",
                 job.mesh, true, "job.bounds"});
        onto_grid(mesh, job, path, anew);
    });
}

void onto_mesh(SampledMesh& mesh, const ResampleJob& job) {
    mesh.tell("reading " + job.onto);
    Stopwatch watch;
    const bool to_rows = is_rows(job.output);
    Mesh other =
        read_mesh(job.onto, {.faces = !to_rows, .neighbours = !to_rows, .threads = job.options.threads}).value();
    const int d = mesh.mesh().dimension;
    if (other.dimension != d)
        refuse_member("mesh.dimension", "job.onto", job.onto, "the meshes have different dimensions",
                      fmt::format("{}, as {} has", d, job.mesh), std::to_string(other.dimension),
                      "resample between meshes of triangles, or between meshes of tetrahedra");
    SampleReport& report = mesh.report;
    report.onto_curved = measure_curved(other, job.onto, job.curved).value();
    report.from = PointsFrom::mesh;
    report.points = job.onto;
    const bool further = mesh.has_further_steps();
    auto points = memory_points(other.points, d);
    jobs::RowSource nodes = jobs::rows_of_points(points);
    nodes.begin_again = [&](const SampledMesh&) { points = memory_points(other.points, d); };
    report.seconds.read = watch.lap();
    note_the_other(mesh, job, other);
    jobs::note_cell_fields(mesh, further);
    // Files of the other mesh with the fields, or rows. A series would have integrals of each step.
    const auto open = [&](const std::string& path) {
        const auto open_sink = [&](const TableFormat& format) {
            return to_rows ? jobs::open_rows(path, format)
                           : jobs::mesh_sink(further ? other : std::move(other), path, format, mesh.report.notes);
        };
        const auto open_rows = [&] { return open_user_rows(mesh, {}, false, open_sink); };
        return further ? open_rows() : jobs::with_integrals(mesh, other, open_rows);
    };
    sample_rows(mesh, nodes, open);
}

}  // namespace

Result<SampleReport> resample_files(const ResampleJob& job) {
    return jobs::sample_mesh(
        job, "resample", [&](const auto& steps) { check_job(job, steps); },
        [&](SampledMesh& mesh) { job.onto.empty() ? onto_grid_in_steps(mesh, job) : onto_mesh(mesh, job); },
        !job.onto.empty() || jobs::needs_listed_grids(job));
}

}  // namespace barycert
