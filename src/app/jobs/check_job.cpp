// A mesh checked, its measures written, and a repaired copy of it.

#include "barycert/check_job.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/checked_mesh.hpp"
#include "app/jobs/job_files.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "io/in_space.hpp"
#include "io/mesh_format.hpp"
#include "io/mesh_notes.hpp"
#include "io/paths.hpp"
#include "io/polygons/triangles.hpp"

namespace barycert {

using base::FormatKind;
namespace {

using jobs::refuse;
using jobs::refuse_member;

/// Both are one way of writing.
base::NamedFile copy_of(const CheckJob& job) {
    if (job.fix.empty()) return {"job.fix_orientation", job.fix_orientation};
    return {"job.fix", job.fix};
}

void check_job(const CheckJob& job) {
    const base::NamedFile of_copy = copy_of(job);
    const auto& [member, copy] = std::tie(of_copy.what, of_copy.path);
    if (job.measures == "-")
        refuse_member("option.value", "job.measures", "", "job.measures cannot write to stdout", "", "",
                      "name a file: its data are binary");
    if (!job.measures.empty() && base::kind_of(job.measures) != FormatKind::vtu &&
        base::kind_of(job.measures) != FormatKind::vtp)
        refuse_member("file.suffix", "job.measures", job.measures,
                      "job.measures writes VTU files, and of surfaces VTP files", "a name that ends in .vtu", "",
                      "choose another name; job.fix writes other formats");
    if (copy == "-")
        refuse_member("option.value", member, "", member + " cannot write to stdout", "", "",
                      "name a file, " + base::suffix_list_written(base::Use::mesh) + ", or a stem of TetGen's files");
    if (!job.picture.empty() && base::kind_of(job.picture) != FormatKind::png)
        refuse_member("file.suffix", "job.picture", job.picture, "unknown suffix of job.picture", ".png", "",
                      "choose another name");
    std::vector<base::NamedFile> plc, outputs{{"job.measures", job.measures}, {"job.picture", job.picture}};
    if (!copy.empty()) {
        const std::vector<std::string> written = written_mesh_files(copy).value();
        for (const std::string& path : written) outputs.push_back({member, path});
    }
    if (job.merge_within && job.fix.empty())
        refuse_member("option.missing", "job.merge_within", "", "job.merge_within is for job.fix", "", "",
                      "leave it out, or give job.fix FILE");
    if (job.vtk_data && job.measures.empty() && !base::is_vtk(base::kind_of(copy)))
        refuse_member("option.unfit", "job.vtk_data", "", "job.vtk_data is for VTK's files", "", "",
                      "leave it out, or give job.measures FILE, or job.fix FILE.vtu");
    if (!job.plc.empty()) plc = base::named_files("the PLC of job.plc", plc_files(job.plc));
    jobs::check_outputs(job, jobs::input_files(job, plc), std::move(outputs));
}

/// write_tetgen leaves no file of another mesh beside its own. Told before the work.
void check_nothing_in_the_way(const CheckJob& job, const Mesh& mesh) {
    const base::NamedFile copy = copy_of(job);
    const auto& [member, path] = std::tie(copy.what, copy.path);
    if (path.empty() || written_mesh_files(path).value().size() == 1) return;
    for (const auto& [suffix, written] :
         {std::pair(".face", !mesh.faces.empty()), {".neigh", !mesh.neighbours.empty()}}) {
        const std::string file = tetgen_stem(path) + suffix;
        if (!written && io::exists(file))
            refuse_member("file.overwrite", member, file, "a file of another mesh exists", "", "",
                          "remove it, or give " + member + " another name");
    }
}

/// The mesh with the measures of its cells as fields, and their numbers in the file where those are others.
Status write_measures(const CheckJob& job, const CheckReport& report, Mesh mesh) {
    if (!mesh.cell_numbers.empty()) {
        const bool taken = std::ranges::find(mesh.cell_fields, "cell", &Field::name) != mesh.cell_fields.end();
        mesh.cell_fields.push_back(
            {taken ? "cell in file" : "cell", 1, {mesh.cell_numbers.begin(), mesh.cell_numbers.end()}});
    }
    mesh.shapes = {};  // these are of their simplices
    for (Field& field : measure_fields(report.measures)) mesh.cell_fields.push_back(std::move(field));
    return write_vtu(mesh, job.measures, job.vtk_data.value_or(VtkData::raw));
}

/// Notes what of the mesh the file has no place for, except what follows from the cells, such as neighbours.
Notes left_out_of(const std::string& path, const Mesh& mesh) {
    const io::MeshFormat format = *io::mesh_output_format(path);
    Notes notes;
    const auto leave_out = [&](std::string text) { notes.push_back({Note::Kind::left_out, std::move(text)}); };
    if (format == io::MeshFormat::tetgen) {
        for (const auto& [fields, file] : {std::pair(&mesh.point_fields, "a .node"), {&mesh.cell_fields, "an .ele"}}) {
            std::vector<TableField> columns;
            for (const Field& f : *fields) columns.push_back({f.name, f.components});
            io::note_lost_names(column_names(columns), file, notes);
        }
    }
    const bool groups = std::ranges::any_of(mesh.cell_fields, [](const Field& f) { return f.name == "gmsh:physical"; });
    for (const Column& labels : mesh.cell_labels) {
        const bool own = labels.name == "gmsh:tag" || (groups && labels.name == "gmsh:physical_name");
        if (format == io::MeshFormat::tetgen || (format == io::MeshFormat::gmsh && !own))
            leave_out("labels of cells, for which the format has no place: " + labels.name);
    }
    if (format != io::MeshFormat::tetgen && !mesh.faces.empty())
        leave_out("faces, for which the format has no place: " + std::to_string(mesh.face_count()));
    return notes;
}

void write_copy(const CheckJob& job, CheckOptions options, CheckedMesh& checked) {
    checked.fixed = FixedMesh{.file = copy_of(job).path, .done = {}, .notes = {}, .after = {}};
    FixedMesh& fixed = *checked.fixed;
    const bool all = !job.fix.empty();
    const FixOptions fix{
        .nodes = all, .merge_within = job.merge_within.value_or(0), .cells = all, .threads = options.threads};
    const Mesh copy = fix_mesh(checked.mesh, fix, fixed.done).value();
    if (copy.cell_count() == 0 && checked.mesh.cell_count() != 0)
        refuse("mesh.fix-empty", fixed.file, "no copy is written, as it would have no cells", "", "",
               "look at the mesh, and where nodes were merged choose a smaller distance");
    fixed.notes = left_out_of(fixed.file, copy);
    if (checked.mesh.shapes.count() != 0)
        fixed.notes.push_back({Note::Kind::converted, "cells are written as the simplices that they are cut into"});
    write_mesh(copy, fixed.file, {.comment = {}, .data = job.vtk_data.value_or(VtkData::raw)}).value();
    const Mesh read = read_mesh(fixed.file, {.threads = options.threads}).value();
    options.delaunay = false;
    options.plc = nullptr;
    fixed.after = check_mesh(read, options);
    checked.copied = true;
}

void refuse_options_of_meshes(const CheckJob& job, const char* what) {
    const auto refuse_one = [&](bool given, const std::string& member) {
        if (given) refuse_member("option.unfit", member, job.mesh, member + " is for meshes", "", what, "leave it out");
    };
    refuse_one(job.options.delaunay, "job.delaunay");
    refuse_one(io::is_surface_file(job.mesh) && job.step.made(), "job.step");
    refuse_one(!job.plc.empty(), "job.plc");
    refuse_one(!copy_of(job).path.empty(), copy_of(job).what);
    refuse_one(job.plot, "job.plot");
    if (!job.measures.empty() && base::kind_of(job.measures) != FormatKind::vtp)
        refuse_member("file.suffix", "job.measures", job.measures, "job.measures writes VTP files of surfaces",
                      "a name that ends in .vtp", "", "choose another name");
}

/// The triangles with the sets of their defects, as cells of meshes have them, and the polygons that they are of.
void write_marks(const CheckJob& job, CheckedMesh& checked) {
    Surface surface = checked.surface;
    const std::vector<DefectSet>& defects = checked.report.measures.defects;
    surface.cell_fields.push_back({"problems", 1, {defects.begin(), defects.end()}});
    if (!surface.facets.empty())
        surface.cell_fields.push_back({"facet", 1, {surface.facets.begin(), surface.facets.end()}});
    const Result<SurfaceFile> written = write_surface(surface, job.measures, job.vtk_data.value_or(VtkData::raw));
    if (!written) checked.written = written.error();
}

/// Checks the surface, or the PLC that it is of.
void check_it(const CheckJob& job, const CheckOptions& options, CheckedMesh& checked, const std::optional<Plc>& plc) {
    refuse_options_of_meshes(job, plc ? "a PLC" : "a surface");
    checked.name = checked.artifact = job.mesh;
    checked.mesh.index_base = checked.surface.index_base;
    CheckOptions of_facets = options;
    of_facets.turned_facets = io::is_polygons_file(job.mesh) && !io::is_plc_file(job.mesh);
    checked.report = plc ? check_plc(*plc, of_facets) : check_surface(checked.surface, options);
    if (!job.measures.empty()) write_marks(job, checked);
    if (job.picture.empty()) return;
    const Result<Image> image = draw_checked(checked.report, checked.surface);
    const Status drawn = image ? write_png(job.picture, *image) : Status(image.error());
    if (checked.written) checked.written = drawn;
}

}  // namespace

Result<CheckedMesh> check_files(const CheckJob& job) try {
    check_job(job);
    jobs::tell_stage(job, "checking: reading");
    CheckedMesh checked;
    CheckOptions options = jobs::told_options(job);
    std::optional<Plc> polygons;
    if (io::is_plc_file(job.mesh)) {
        polygons = read_plc(job.mesh).value();
        checked.surface = io::surface_of(*polygons, job.mesh);
    } else {
        std::variant<Mesh, Surface> read =
            read_mesh_or_surface(job.mesh, {.threads = job.options.threads, .step = job.step}).value();
        if (auto* const surface = std::get_if<Surface>(&read)) {
            checked.surface = std::move(*surface);
            // Polygons that are no triangles may be at fault themselves.
            if (!checked.surface.facets.empty() && io::is_polygons_file(job.mesh))
                polygons = read_plc(job.mesh).value();
        } else {
            checked.mesh = std::move(std::get<Mesh>(read));
        }
    }
    if (polygons || !checked.surface.cells.empty()) {
        check_it(job, options, checked, polygons);
        return checked;
    }
    if (!job.picture.empty())
        refuse_member("option.unfit", "job.picture", job.picture, "job.picture is of surfaces", "", "a mesh",
                      "ParaView shows cells: job.measures FILE.vtu");
    if (base::kind_of(job.measures) == FormatKind::vtp)
        refuse_member("file.suffix", "job.measures", job.measures, "job.measures writes VTU files of meshes",
                      "a name that ends in .vtu", "", "choose another name");
    const Mesh& mesh = checked.mesh;
    jobs::take_curved(job, mesh, options);
    check_nothing_in_the_way(job, mesh);
    Plc plc;
    if (!job.plc.empty()) {
        if (mesh.dimension == 2)
            refuse_member("option.unfit", "job.plc", job.mesh, "job.plc needs a mesh of tetrahedra", "",
                          "triangles in the plane", "leave the option out");
        plc = read_plc(job.plc).value();
        checked.mesh.notes.insert(checked.mesh.notes.end(), plc.notes.begin(), plc.notes.end());
        options.plc = &plc;
    }
    jobs::check_cells(job, mesh_files(job.mesh), tetgen_stem(job.mesh), options, checked);
    try {
        if (!copy_of(job).path.empty()) write_copy(job, options, checked);
    } catch (const Exception& e) {
        checked.written = e.error();
    }
    if (!job.measures.empty()) {
        const Status written = write_measures(job, checked.report, mesh);
        if (checked.written) checked.written = written;
    }
    return checked;
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
