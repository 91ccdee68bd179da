#include "app/jobs/job_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/workers.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"

namespace barycert::jobs {

using base::FormatKind;
using base::Use;
namespace {

/// At most so many steps stand side by side as columns: they are all in memory.
constexpr std::size_t most_steps_of_columns = 256;

void check_steps(const SamplingJob& job, const std::vector<Step>& steps) {
    std::set<std::string> names;
    for (const FieldFile& file : job.field_files) names.insert(file.name);
    for (const FieldFile& file : job.series) {
        if (!names.insert(file.name).second)
            refuse_member("field.duplicate", "job.field", file.path, "a field of this name exists already", "",
                          '"' + file.name + '"', "give it another name: job.field OTHER@" + file.path);
    }
    if (!has_step_place(job.output) && steps.size() > most_steps_of_columns)
        refuse_member("option.value", "job.output", job.output, "too many steps for columns of one output",
                      "at most " + std::to_string(most_steps_of_columns), std::to_string(steps.size()),
                      "write each step to a file of its own: job.output 'rows-{step}.npy'");
}

void add_input(std::vector<base::NamedFile>& inputs, const std::string& what, const std::string& path) {
    if (!io::is_vtk_file(path)) return inputs.push_back({what, path});
    for (const std::string& file : vtk_mesh_files(path)) inputs.push_back({what, file});
}

void add_fields_to(std::vector<base::NamedFile>& inputs, const auto& files) {
    for (const FieldFile& f : files) add_input(inputs, "field " + f.name, f.path);
}

/// Refuses an output of a step that is an input or another output. Requires: has_step_place(output).
void check_step_outputs(const std::vector<base::NamedFile>& inputs, const std::string& output,
                        const std::vector<Step>& steps) {
    // By device and inode: there may be thousands of each. A file that does not exist is no input.
    std::map<std::pair<dev_t, ino_t>, std::string> known;
    const auto add = [&](const std::string& path, const std::string& what) -> const std::string* {
        struct stat status {};
        if (path == "-" || ::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return nullptr;
        const auto [at, inserted] = known.emplace(std::pair(status.st_dev, status.st_ino), what);
        return inserted ? nullptr : &at->second;
    };
    for (const base::NamedFile& in : inputs) add(in.path, in.what);
    std::set<std::string> names;
    for (const Step& step : steps) {
        const std::string path = output_of_step(output, step);
        if (!names.insert(path).second)
            refuse_member("file.overwrite", "job.output", path, "two steps have the same output", "", "",
                          "put {step} into the name of job.output");
        if (const std::string* const before = add(path, "job.output of another step"))
            refuse_member("file.overwrite", "job.output", path, "job.output would overwrite " + *before, "", "",
                          "choose another name for the output");
    }
}

}  // namespace

void report_curved(const MeshJob& job, const Mesh& mesh, CurvedCells& curved) {
    const CurvedCells straight = measure_curved(mesh, job.mesh, job.curved).value();
    // Keeps, of several steps, the one with the largest deviation.
    if (straight.max_deviation >= curved.max_deviation) curved = straight;
}

ReadOptions read_options(int threads, const StepChoice& step, bool list_grids) {
    return {.faces = false, .neighbours = false, .threads = threads, .step = step, .list_grids = list_grids};
}

Mesh open_mesh(const MeshJob& job, int threads, const StepChoice& step, CurvedCells& curved, bool list_grids) {
    tell_stage(job, "reading " + job.mesh);
    Mesh mesh = read_mesh(job.mesh, read_options(threads, step, list_grids)).value();
    report_curved(job, mesh, curved);
    return mesh;
}

Mesh open_mesh_with_fields(const MeshJob& job, int threads, MeshReport& report) {
    Mesh mesh = open_mesh(job, threads, job.step, report.curved);
    add_fields(job.field_files, mesh);
    report_mesh(job, mesh, threads, report);
    return mesh;
}

void report_mesh(const MeshJob& job, const Mesh& mesh, int threads, MeshReport& report) {
    report.mesh = job.mesh;
    report.nodes = mesh.point_count();
    report.cells = mesh.whole_count();
    report.simplices = mesh.shapes.types.empty() ? 0 : mesh.cell_count();
    report.dimension = mesh.dimension;
    report.notes = mesh.notes;
    report.threads = base::threads_for(threads);
}

BuildOptions build_options(const MeshJob& job, int threads, Prove prove) {
    return {.prove = prove,
            .interpolation = job.cell_interpolation,
            .curved = job.curved,
            .threads = threads,
            .progress = [&job](const char* stage) { tell_stage(job, stage); }};
}

void tell_once(Notes notes, MeshReport& report) {
    for (Note& note : notes) {
        const auto same = [&](const Note& told) { return told.kind == note.kind && told.text == note.text; };
        if (std::ranges::none_of(report.notes, same)) report.notes.push_back(std::move(note));
    }
}

std::vector<base::NamedFile> input_files(const MeshJob& job, const std::vector<base::NamedFile>& more) {
    std::vector<base::NamedFile> inputs = base::named_files("the mesh", mesh_files(job.mesh));
    add_fields_to(inputs, job.field_files);
    for (const base::NamedFile& file : more) add_input(inputs, file.what, file.path);
    return inputs;
}

void check_files(const MeshJob& job, std::vector<base::NamedFile> more_inputs, std::vector<base::NamedFile> outputs,
                 const std::vector<base::NamedFile>& unread) {
    std::vector<base::NamedFile> inputs = input_files(job, more_inputs);
    inputs.insert(inputs.end(), unread.begin(), unread.end());
    std::erase_if(more_inputs, &base::NamedFile::of_mesh);
    for (const FieldFile& f : job.field_files) more_inputs.push_back({"field " + f.name, f.path});
    base::check_inputs(more_inputs).value();
    check_outputs(job, inputs, std::move(outputs));
}

void check_files(const SamplingJob& job, const std::vector<Step>& steps, std::vector<base::NamedFile> more_inputs,
                 std::vector<base::NamedFile> outputs) {
    if (!job.weights.empty() && !base::is_written_as(job.weights, Use::weights))
        refuse_member("file.suffix", "job.weights", job.weights, "unknown suffix of job.weights",
                      base::suffixes_written(Use::weights), "", "choose another name");
    check_vtk_data(job.vtk_data, job.output);
    std::vector<base::NamedFile> of_steps;
    add_fields_to(of_steps, job.series);
    for (const Step& step : steps) add_fields_to(of_steps, step.files);
    if (!steps.empty()) {
        check_steps(job, steps);
        std::vector<base::NamedFile> inputs = input_files(job, more_inputs);
        inputs.insert(inputs.end(), of_steps.begin(), of_steps.end());
        for (base::NamedFile& output : outputs) {
            if (output.what != "job.output" || !has_step_place(output.path)) continue;
            check_step_outputs(inputs, output.path, steps);
            output.path = output_of_step(output.path, steps.front());
        }
    }
    outputs.push_back({"job.weights", job.weights});
    check_files(job, std::move(more_inputs), std::move(outputs), of_steps);
}

void check_vtk_data(std::optional<VtkData> data, const std::string& path) {
    if (!data) return;
    const FormatKind kind = base::kind_of(path);
    const bool legacy = kind == FormatKind::vtk;
    if (legacy && *data != VtkData::raw && *data != VtkData::ascii)
        refuse_member("option.unfit", "job.vtk_data", path, "job.vtk_data: legacy files of VTK know no compression",
                      "raw or ascii", std::string(name(*data)), "name a .vtu file");
    if (!legacy && kind != FormatKind::vtu && kind != FormatKind::vtp && kind != FormatKind::vti)
        refuse_member("option.unfit", "job.vtk_data", path, "job.vtk_data is for files of VTK",
                      ".vtu, .vtk, .vtp or .vti", "", "leave it out, or name such a file");
}

void refuse_output(const std::string& path, const std::string& expected) {
    throw Exception(
        about("job.output", io::unknown_suffix(path, "unknown suffix of job.output", expected, "choose another name")));
}

}  // namespace barycert::jobs
