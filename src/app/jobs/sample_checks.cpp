#include "app/jobs/sample_checks.hpp"

#include <initializer_list>
#include <string>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/weights.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "io/in_space.hpp"
#include "io/paths.hpp"
#include "io/table_format.hpp"

namespace barycert::jobs {

using base::Use;
namespace {

/// Members of a job that do not go together, or are missing.
struct Contradiction {
    bool holds;
    ErrorCode code;
    std::string member, given, what, expected = {}, found = {}, remedy = {};
};

/// Refuses the first that holds.
void refuse_first(std::initializer_list<Contradiction> all) {
    for (const Contradiction& c : all) {
        if (c.holds) refuse_member(c.code, c.member, c.given, c.what, c.expected, c.found, c.remedy);
    }
}

void refuse_contradictions(const SampleJob& job) {
    const int given = (job.points.empty() ? 0 : 1) + (job.map.empty() ? 0 : 1) + (job.line ? 1 : 0);
    const bool columns = !(job.columns.empty() && job.keep.empty());
    const std::string which_columns = job.keep.empty() ? "job.columns" : "job.keep";
    const bool plot = !job.plot.empty(), map = !job.map.empty();
    const bool output = !job.output.empty(), weights = !job.weights.empty();
    const bool fields = !(job.fields.empty() && job.field_files.empty() && job.series.empty() && job.keep.empty());
    const std::string one_of = "one of job.points FILE, job.map FILE and job.line A:B";
    refuse_first({
        {given == 0, "option.missing", "job.points", "", "no points", one_of, "none", "a map contains its points"},
        {given > 1, "option.conflict", "job.points", "", "job.points, job.map and job.line", one_of, "several",
         "a map contains its points"},
        {job.line && columns, "option.conflict", "job.line", "", which_columns + " cannot be combined with job.line",
         "", "", "points of a line have no columns"},
        {plot && (job.all_steps || has_step_place(job.output)), "option.conflict", "job.plot", job.plot,
         "a plot of outputs of steps", "the steps of a field as columns of one output", "",
         "leave {step} out, and name the field as NAME@PATTERN"},
        {plot && weights && !output, "option.missing", "job.output", job.plot,
         "job.weights without job.output takes no fields to plot", "job.output FILE", "none"},
        {map && !job.save_map.empty(), "option.conflict", "job.save_map", job.save_map,
         "job.save_map cannot be combined with job.map", "", "", "copy the map"},
        {map && columns, "option.conflict", "job.map", job.map, which_columns + " cannot be combined with job.map", "",
         "", "a map has points and cells alone: name the file of the points by job.points"},
        {job.map == "-" || job.save_map == "-", "option.value", "job.map", "",
         "a map cannot come from stdin or go to stdout", "", "", "name a file"},
        {!output && !weights && !plot, "option.missing", "job.output", "", "no output",
         "job.output FILE, job.weights FILE or job.plot FILE", "none"},
        {!output && !plot && fields, "option.missing", "job.output", "", "fields or columns without job.output", "", "",
         "weights depend on no field: leave fields out, or name job.output too"},
    });
    if (plot && !is_figure_name(job.plot)) refuse_output(job.plot, base::suffixes_written(Use::picture));
    if (output && job.output != "-" && !base::is_written_as(job.output, Use::rows))
        refuse_output(job.output, base::suffixes_written(Use::rows) + ", or - for CSV on stdout");
}

}  // namespace

void check_sample_job(const SampleJob& job, const std::vector<Step>& steps) {
    refuse_contradictions(job);
    std::vector<base::NamedFile> inputs;
    if (!job.map.empty()) inputs = {{"job.map", job.map}};
    if (!job.points.empty()) inputs = {{"job.points", job.points}};
    // Not the file itself, but the stem of a mesh.
    if (!job.points.empty() && job.points != "-" && !io::exists(job.points) && !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of job.points", mesh_files(job.points), true);
    check_files(job, steps, inputs,
                {{"job.output", job.output}, {"job.save_map", job.save_map}, {"job.plot", job.plot}});
}

void refuse_what_is_of_meshes(const SampleJob& job) {
    const auto only_meshes = [&](bool holds, const std::string& member, const std::string& name) -> Contradiction {
        return {holds, "option.unfit", member, job.mesh, name + " is for meshes", "", "a surface", "leave it out"};
    };
    const Outside outside = job.options.outside.kind;
    const bool one_step = io::is_surface_file(job.mesh) && job.step.made();
    refuse_first({
        only_meshes(job.all.has_value(), "job.all", "job.all"),
        only_meshes(!job.plot.empty(), "job.plot", "job.plot"),
        only_meshes(job.all_steps || one_step, "job.step", "job.step"),
        only_meshes(!job.series.empty(), "a series of fields", "a series of fields"),
        only_meshes(job.options.rounding == Rounding::plain, "job.rounding", "job.rounding"),
        {outside != Outside::nan && outside != Outside::nearest, "option.unfit", "job.outside", job.mesh,
         "a surface has no inside for job.outside", "nearest, or nearest=DISTANCE", "",
         "values are those at the nearest point"},
    });
}

}  // namespace barycert::jobs
