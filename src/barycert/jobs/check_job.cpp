// A mesh checked, its measures written, and a repaired copy of it.

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/job_files.hpp"

namespace barycert {
namespace {

using jobs::refusal;

/// Both are one way of writing.
const std::string& copy_of(const CheckJob& job) {
    return job.fix.empty() ? job.fix_orientation : job.fix;
}

std::string member_of_copy(const CheckJob& job) {
    return job.fix.empty() ? "job.fix_orientation" : "job.fix";
}

/// What can be checked of files before the work.
Status check_job(const CheckJob& job) {
    const std::string& copy = copy_of(job);
    if (job.measures == "-")
        return Error{.what = "job.measures cannot write to stdout", .remedy = "name a file: its data are binary"};
    if (!job.measures.empty() && !io::has_suffix(job.measures, ".vtu"))
        return refusal(job.measures, "job.measures writes VTU files", "a name that ends in .vtu", "",
                       "choose another name; job.fix writes other formats");
    if (copy == "-")
        return refusal("", member_of_copy(job) + " cannot write to stdout", "", "",
                       "name a file, .vtu .vtk .msh, or a stem of TetGen's files");
    Result<std::vector<std::string>> written = std::vector<std::string>();
    if (!copy.empty()) written = written_mesh_files(copy);
    if (!written) return written.error();
    if (job.merge_within && job.fix.empty())
        return Error{.what = "job.merge_within is for job.fix", .remedy = "leave it out, or give job.fix FILE"};
    if (job.vtk_data && job.measures.empty() && !copy.ends_with(".vtu") && !copy.ends_with(".vtk"))
        return Error{.what = "job.vtk_data is for VTK's files",
                     .remedy = "leave it out, or give job.measures FILE, or job.fix FILE.vtu"};
    std::vector<base::NamedFile> plc, outputs = base::named_files(member_of_copy(job), *written);
    if (!job.plc.empty()) plc = base::named_files("the PLC of job.plc", plc_files(job.plc));
    outputs.insert(outputs.begin(), {"job.measures", job.measures});
    return jobs::check_outputs(job, jobs::input_files(job, plc), std::move(outputs));
}

/// write_tetgen leaves no file of another mesh beside its own. Told before the work.
Status check_nothing_in_the_way(const CheckJob& job, const Mesh& mesh) {
    const std::string& path = copy_of(job);
    if (path.empty()) return Done{};
    if (const auto files = written_mesh_files(path); files && files->size() == 1) return Done{};
    for (const auto& [suffix, written] :
         {std::pair(".face", !mesh.faces.empty()), {".neigh", !mesh.neighbours.empty()}}) {
        std::error_code ignored;
        const std::string file = tetgen_stem(path) + suffix;
        if (!written && std::filesystem::exists(file, ignored))
            return refusal(file, "a file of another mesh exists", "", "",
                           "remove it, or give " + member_of_copy(job) + " another name");
    }
    return Done{};
}

/// The mesh with the measures of its cells as fields, and their numbers in the file where those are others.
Status write_measures(const CheckJob& job, const CheckReport& report, Mesh mesh) {
    if (!mesh.cell_numbers.empty()) {
        const bool taken = std::any_of(mesh.cell_fields.begin(), mesh.cell_fields.end(),
                                       [](const Field& field) { return field.name == "cell"; });
        mesh.cell_fields.push_back(
            {taken ? "cell in file" : "cell", 1, {mesh.cell_numbers.begin(), mesh.cell_numbers.end()}});
    }
    for (Field& field : measure_fields(report.measures)) mesh.cell_fields.push_back(std::move(field));
    return write_vtu(mesh, job.measures, job.vtk_data.value_or(VtkData::raw));
}

/// Writes the repaired copy, reads it again and checks it.
Status write_copy(const CheckJob& job, CheckOptions options, CheckedMesh& checked) {
    checked.fixed = FixedMesh{.file = copy_of(job), .done = {}, .notes = {}, .after = {}};
    FixedMesh& fixed = *checked.fixed;
    const bool all = !job.fix.empty();
    const Result<Mesh> copy =
        fix_mesh(checked.mesh,
                 {.nodes = all, .merge_within = job.merge_within.value_or(0), .cells = all, .threads = options.threads},
                 fixed.done);
    if (!copy) return copy.error();
    if (copy->cell_count() == 0 && checked.mesh.cell_count() != 0)
        return refusal(fixed.file, "no copy is written, as it would have no cells", "", "",
                       "look at the mesh, and where nodes were merged choose a smaller distance");
    fixed.notes = io::left_out_by(*io::mesh_output_format(fixed.file), *copy);
    const VtkData data = job.vtk_data.value_or(VtkData::raw);
    if (const Status ok = write_mesh(*copy, fixed.file, {.comment = {}, .data = data}); !ok) return ok;
    const Result<Mesh> read = read_mesh(fixed.file, {.faces = true, .neighbours = true, .threads = options.threads});
    if (!read) return read.error();
    options.delaunay = false;
    options.plc = nullptr;
    fixed.after = check_mesh(*read, options);
    checked.copied = true;
    return Done{};
}

}  // namespace

Result<CheckedMesh> check_files(const CheckJob& job) {
    if (const Status ok = check_job(job); !ok) return ok.error();
    jobs::tell_stage(job, "checking: reading");
    CheckedMesh checked;
    Result<Mesh> mesh =
        read_mesh(job.mesh, {.faces = true, .neighbours = true, .threads = job.options.threads, .step = job.step});
    if (!mesh) return mesh.error();
    if (job.curved == Curved::refuse) {
        const auto straight = take_as_straight(*mesh, job.mesh, job.curved);
        if (!straight) return straight.error();
    }
    if (const Status ok = check_nothing_in_the_way(job, *mesh); !ok) return ok.error();
    Result<Plc> plc = Plc();
    CheckOptions options = job.options;
    if (!job.plc.empty()) {
        if (mesh->dimension == 2)
            return refusal(job.mesh, "job.plc needs a mesh of tetrahedra", "", "triangles in the plane",
                           "leave the option out");
        plc = read_plc(job.plc);
        if (!plc) return plc.error();
        options.plc = &*plc;
    }
    options.progress = [&](const char* text) { jobs::tell_stage(job, std::string("checking: ") + text); };
    checked.mesh = std::move(*mesh);
    checked.name = tetgen_stem(job.mesh);
    const std::vector<std::string> files = mesh_files(job.mesh);
    std::error_code ignored;
    const auto there = std::find_if(files.begin(), files.end(),
                                    [&](const std::string& path) { return std::filesystem::exists(path, ignored); });
    checked.artifact = there == files.end() ? job.mesh : *there;
    checked.report = check_mesh(checked.mesh, options);
    if (!copy_of(job).empty()) checked.written = write_copy(job, options, checked);
    if (!job.measures.empty()) {
        const Status written = write_measures(job, checked.report, checked.mesh);
        if (checked.written) checked.written = written;
    }
    return checked;
}

}  // namespace barycert
