#include "barycert/jobs/job_files.hpp"

#include <algorithm>
#include <set>
#include <thread>
#include <utility>

#include "barycert/io/formats.hpp"

namespace barycert::jobs {
namespace {

Status check_steps(const SamplingJob& job, const std::vector<Step>& steps) {
    std::set<std::string> names;
    for (const std::vector<FieldFile>* const files : {&job.field_files, &job.series}) {
        for (const FieldFile& file : *files) {
            if (names.insert(file.name).second || files == &job.field_files) continue;
            return Error{.what = "a field of this name exists already",
                         .file = file.path,
                         .found = '"' + file.name + '"',
                         .remedy = "give it another name: job.field OTHER@" + file.path};
        }
    }
    if (has_step_place(job.output) || steps.size() <= most_steps_of_columns) return Done{};
    return Error{.what = "too many steps for columns of one output",
                 .file = job.output,
                 .expected = "at most " + std::to_string(most_steps_of_columns),
                 .found = std::to_string(steps.size()),
                 .remedy = "write each step to a file of its own: job.output 'rows-{step}.npy'"};
}

std::vector<base::NamedFile> all_inputs(const MeshJob& job, const std::vector<base::NamedFile>& more) {
    std::vector<base::NamedFile> inputs = input_files(job);
    for (const base::NamedFile& file : more) add_input(inputs, file.what, file.path);
    return inputs;
}

/// The reader of meshes has hints at what may be meant: it tells of those that cannot be read.
Status check(const MeshJob& job, const std::vector<base::NamedFile>& inputs, std::vector<base::NamedFile> to_read,
             std::vector<base::NamedFile> outputs) {
    std::erase_if(to_read, [](const base::NamedFile& f) { return f.what.starts_with("the mesh"); });
    for (const FieldFile& f : job.field_files) to_read.push_back({"field " + f.name, f.path});
    for (const auto& [what, path] : job.reports) outputs.push_back({what, path});
    if (Status readable = base::check_inputs(to_read); !readable) return readable;
    return base::check_outputs(inputs, std::move(outputs));
}

}  // namespace

int thread_count(int threads) {
    return threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void tell_stage(const MeshJob& job, const std::string& what, std::uint64_t done) {
    if (job.progress) job.progress({.stage = what, .done = done});
}

Result<Mesh> open_mesh(const MeshJob& job, int threads, const StepChoice& step, CurvedCells& curved) {
    tell_stage(job, "reading " + job.mesh);
    Result<Mesh> mesh = read_mesh(job.mesh, {.faces = false, .neighbours = false, .threads = threads, .step = step});
    if (!mesh) return mesh;
    const auto straight = take_as_straight(*mesh, job.mesh, job.curved);
    if (!straight) return straight.error();
    // Of steps, that with the largest deviation.
    if (straight->max_deviation >= curved.max_deviation) curved = *straight;
    return mesh;
}

Result<Locator> build_locator(const MeshJob& job, const Mesh& mesh, int threads, bool prove) {
    BuildOptions options;
    options.prove = prove;
    options.threads = threads;
    options.progress = [&](const char* stage) { tell_stage(job, stage); };
    return Locator::build(mesh, options);
}

void add_input(std::vector<base::NamedFile>& inputs, const std::string& what, const std::string& path) {
    if (!io::is_vtk_points_file(path)) return inputs.push_back({what, path});
    for (const std::string& file : vtk_mesh_files(path)) inputs.push_back({what, file});
}

std::vector<base::NamedFile> input_files(const MeshJob& job) {
    std::vector<base::NamedFile> inputs = base::named_files("the mesh", mesh_files(job.mesh));
    for (const FieldFile& f : job.field_files) add_input(inputs, "field " + f.name, f.path);
    return inputs;
}

Status check_files(const MeshJob& job, const std::vector<base::NamedFile>& more_inputs,
                   std::vector<base::NamedFile> outputs) {
    return check(job, all_inputs(job, more_inputs), more_inputs, std::move(outputs));
}

Status check_files(const SamplingJob& job, const std::vector<Step>& steps,
                   const std::vector<base::NamedFile>& more_inputs, std::vector<base::NamedFile> outputs) {
    if (!job.weights.empty() && !io::has_suffix(job.weights, ".npz"))
        return Error{.what = "unknown suffix of job.weights",
                     .file = job.weights,
                     .expected = ".npz",
                     .remedy = "choose another name"};
    if (Status data = check_vtk_data(job.vtk_data, job.output); !data) return data;
    std::vector<base::NamedFile> inputs = all_inputs(job, more_inputs);
    for (const FieldFile& f : job.series) add_input(inputs, "field " + f.name, f.path);
    if (!steps.empty()) {
        if (Status few = check_steps(job, steps); !few) return few;
        for (const Step& step : steps) {
            for (const FieldFile& f : step.files) add_input(inputs, "field " + f.name, f.path);
        }
        for (base::NamedFile& output : outputs) {
            if (output.what != "job.output" || !has_step_place(output.path)) continue;
            if (Status distinct = check_step_outputs(inputs, output.path, steps); !distinct) return distinct;
            output.path = output_of_step(output.path, steps.front());
        }
    }
    outputs.push_back({"job.weights", job.weights});
    return check(job, inputs, more_inputs, std::move(outputs));
}

Status check_vtk_data(std::optional<VtkData> data, const std::string& path) {
    if (!data) return Done{};
    const bool legacy = io::has_suffix(path, ".vtk");
    if (legacy && *data != VtkData::raw && *data != VtkData::ascii) {
        return Error{.what = "job.vtk_data: legacy files of VTK know no compression",
                     .file = path,
                     .expected = "raw or ascii",
                     .found = std::string(name(*data)),
                     .remedy = "name a .vtu file"};
    }
    if (legacy || io::has_suffix(path, ".vtu") || io::has_suffix(path, ".vtp") || io::has_suffix(path, ".vti"))
        return Done{};
    return Error{.what = "job.vtk_data is for files of VTK",
                 .file = path,
                 .expected = ".vtu, .vtk, .vtp or .vti",
                 .remedy = "leave it out, or name such a file"};
}

Error unknown_output(const std::string& path, const std::string& expected) {
    const std::size_t dot = path.find_last_of("./");
    const bool suffix = dot != std::string::npos && path[dot] == '.';
    return {.what = "unknown suffix of job.output",
            .file = path,
            .expected = expected,
            .found = suffix ? '"' + path.substr(dot) + '"' : "no suffix",
            .remedy = "choose another name"};
}

Status check_rows_format(const std::string& path) {
    if (path == "-" || io::has_suffix(path, ".csv") || io::has_suffix(path, ".npy")) return Done{};
    if (!io::has_suffix(path, ".vtu")) return unknown_output(path, ".csv, .npy or .vtu, or - for CSV on stdout");
    return Done{};
}

}  // namespace barycert::jobs
