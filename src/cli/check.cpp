// barycert check: is a mesh a partition of its domain? Proved in exact arithmetic, or the reasons why not.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/mesh_format.hpp"
#include "barycert/report.hpp"
#include "barycert/report/check/check_words.hpp"
#include "ci.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace barycert::cli {
namespace {

struct CheckArguments {
    std::string mesh, plc, json, html, vtu, fix, fix_orientation;
    StepChoice step;
    std::optional<VtkData> vtk_data;
    std::optional<double> merge_within;
    double near = CheckOptions().near;
    std::uint64_t examples = 10, contacts = 20;
    int threads = 0;
    Curved curved = Curved::straight;
    bool delaunay = false, quiet = false;
    CiOptions ci;

    /// One of them at most: both are one way of writing.
    const std::string& fixed() const { return fix.empty() ? fix_orientation : fix; }
    const char* fix_option() const { return fix.empty() ? "--fix-orientation" : "--fix"; }
};

/// A report that is text: in a file, or on stdout in place of the table.
struct TextOutput {
    const char* option;
    const char* help;
    std::string CheckArguments::*path;
    std::string (*text)(const CheckReport&, const Mesh&, const CheckArguments&, const FixedMesh*);
};
constexpr std::array<TextOutput, 2> text_outputs{{
    {"--json", "Write the report as JSON; - is stdout and suppresses the table", &CheckArguments::json,
     [](const CheckReport& report, const Mesh&, const CheckArguments& a, const FixedMesh* fixed) {
         return check_json(report, a.mesh, measure_environment(), fixed);
     }},
    {"--html",
     "Write the report as an HTML page with histograms and pictures of cells; - is stdout and suppresses the table",
     &CheckArguments::html,
     [](const CheckReport& report, const Mesh& mesh, const CheckArguments& a, const FixedMesh* fixed) {
         return check_html(report, mesh, tetgen_stem(a.mesh), fixed);
     }},
}};

std::vector<base::NamedFile> outputs(const CheckArguments& a) {
    std::vector<base::NamedFile> files{{"--vtu", a.vtu}};
    for (const TextOutput& t : text_outputs) files.push_back({t.option, a.*t.path});
    if (a.fixed().empty()) return files;
    if (const auto fixed = written_mesh_files(a.fixed()); fixed) {
        for (const std::string& path : *fixed) files.push_back({a.fix_option(), path});
    }
    return files;
}

bool is_vtk(const std::string& path) {
    return path.ends_with(".vtu") || path.ends_with(".vtk");
}

/// What can be checked of the outputs before the work.
Status check_files(const CheckArguments& a, bool table) {
    if (a.vtu == "-")
        return Error{.what = "--vtu cannot write to stdout", .remedy = "name a file: its data are binary"};
    if (!a.vtu.empty() && !io::has_suffix(a.vtu, ".vtu"))
        return Error{.what = "--vtu writes VTU files",
                     .file = a.vtu,
                     .expected = "a name that ends in .vtu",
                     .remedy = "choose another name; --fix writes other formats"};
    if (a.fixed() == "-")
        return Error{.what = fmt::format("{} cannot write to stdout", a.fix_option()),
                     .remedy = "name a file, .vtu .vtk .msh, or a stem of TetGen's files"};
    if (const auto fixed = written_mesh_files(a.fixed()); !a.fixed().empty() && !fixed) return fixed.error();
    if (a.merge_within && a.fix.empty())
        return Error{.what = "--merge-within is for --fix", .remedy = "leave it out, or give --fix FILE"};
    if (a.vtk_data && a.vtu.empty() && !is_vtk(a.fixed()))
        return Error{.what = "--vtk-data is for VTK's files",
                     .remedy = "leave it out, or give --vtu FILE, or --fix FILE.vtu"};
    std::vector<base::NamedFile> inputs = base::named_files("the mesh", mesh_files(a.mesh));
    if (!a.plc.empty()) {
        for (base::NamedFile& file : base::named_files("the PLC of --conforms-to", plc_files(a.plc)))
            inputs.push_back(std::move(file));
    }
    std::vector<base::NamedFile> written = outputs(a);
    add_ci_outputs(a.ci, table, written);
    return base::check_outputs(inputs, std::move(written));
}

/// write_tetgen leaves no file of another mesh beside its own. Told before the work.
Status check_nothing_in_the_way(const Mesh& mesh, const CheckArguments& a) {
    const std::string& path = a.fixed();
    if (const auto files = written_mesh_files(path); files && files->size() == 1) return Done{};
    const std::string stem = tetgen_stem(path);
    for (const auto& [suffix, written] :
         {std::pair(".face", !mesh.faces.empty()), {".neigh", !mesh.neighbours.empty()}}) {
        std::error_code ignored;
        if (!written && std::filesystem::exists(stem + suffix, ignored))
            return Error{.what = "a file of another mesh exists",
                         .file = stem + suffix,
                         .remedy = fmt::format("remove it, or give {} another name", a.fix_option())};
    }
    return Done{};
}

/// The mesh with the measures of its cells as fields, and their numbers in the file where those are others.
Status write_measures(const CheckReport& report, Mesh mesh, const std::string& path, VtkData data) {
    if (!mesh.cell_numbers.empty()) {
        const bool taken = std::any_of(mesh.cell_fields.begin(), mesh.cell_fields.end(),
                                       [](const Field& field) { return field.name == "cell"; });
        mesh.cell_fields.push_back(
            {taken ? "cell in file" : "cell", 1, {mesh.cell_numbers.begin(), mesh.cell_numbers.end()}});
    }
    for (Field& field : measure_fields(report.measures)) mesh.cell_fields.push_back(std::move(field));
    return write_vtu(mesh, path, data);
}

/// Writes the repaired copy, reads it again and checks it.
Result<FixedMesh> fix(const CheckArguments& a, const Mesh& mesh, CheckOptions options) {
    FixedMesh fixed{.file = a.fixed(), .done = {}, .notes = {}, .after = {}};
    const bool all = !a.fix.empty();
    const Result<Mesh> copy =
        fix_mesh(mesh, {.nodes = all, .merge_within = a.merge_within.value_or(0), .cells = all, .threads = a.threads},
                 fixed.done);
    if (!copy) return copy.error();
    if (copy->cell_count() == 0 && mesh.cell_count() != 0)
        return Error{.what = "no copy is written, as it would have no cells",
                     .file = fixed.file,
                     .found = fmt::format("{}", fmt::join(report::fix_sentences(fixed), "; ")),
                     .remedy = "look at the mesh, and where nodes were merged choose a smaller distance"};
    fixed.notes = io::left_out_by(*io::mesh_output_format(fixed.file), *copy);
    const VtkData data = a.vtk_data.value_or(VtkData::raw);
    if (const Status ok = write_mesh(*copy, fixed.file, {.comment = {}, .data = data}); !ok) return ok.error();
    const Result<Mesh> read = read_mesh(fixed.file, {.faces = true, .neighbours = true, .threads = a.threads});
    if (!read) return read.error();
    options.delaunay = false;
    options.plc = nullptr;
    fixed.after = check_mesh(*read, options);
    return fixed;
}

/// The file to point at: of several the first that is there.
std::string mesh_artifact(const std::string& mesh) {
    for (const std::string& path : mesh_files(mesh)) {
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored)) return path;
    }
    return mesh;
}

int run_check(const CheckArguments& a) {
    const bool table =
        !a.quiet && !a.ci.on_stdout() &&
        std::none_of(text_outputs.begin(), text_outputs.end(), [&](const TextOutput& t) { return a.*t.path == "-"; });
    if (const Status ok = check_files(a, table); !ok) return fail(ok.error());
    Progress progress(!a.quiet && stderr_is_terminal());
    progress.stage("checking: reading");
    const Result<Mesh> mesh =
        read_mesh(a.mesh, {.faces = true, .neighbours = true, .threads = a.threads, .step = a.step});
    progress.clear();
    if (!mesh) return fail(mesh.error());
    if (const Status ok = check_curved(*mesh, a.mesh, a.curved); !ok) return fail(ok.error());
    if (!a.fixed().empty()) {
        if (const Status ok = check_nothing_in_the_way(*mesh, a); !ok) return fail(ok.error());
    }
    Result<Plc> plc = Plc();
    if (!a.plc.empty()) {
        if (mesh->dimension == 2)
            return fail({.what = "--conforms-to needs a mesh of tetrahedra",
                         .file = a.mesh,
                         .found = "triangles in the plane",
                         .remedy = "leave the option out"});
        plc = read_plc(a.plc);
        if (!plc) return fail(plc.error());
    }
    CheckOptions options;
    if (!a.plc.empty()) options.plc = &*plc;
    options.threads = a.threads;
    options.delaunay = a.delaunay;
    options.examples = a.examples;
    options.contacts = a.contacts;
    options.near = a.near;
    options.progress = [&](const char* stage) { progress.stage(fmt::format("checking: {}", stage)); };
    const CheckReport report = check_mesh(*mesh, options);
    std::vector<Status> written;
    std::optional<FixedMesh> fixed;
    if (!a.fixed().empty()) {
        Result<FixedMesh> made = fix(a, *mesh, options);
        if (made)
            fixed = std::move(*made);
        else
            written.push_back(made.error());
    }
    const FixedMesh* const told = fixed ? &*fixed : nullptr;
    progress.clear();

    // Files first: whoever reads the table may stop reading (`| head`). A file that could not be written does not cost
    // the user the table, the fruit of the whole run.
    const std::string name = tetgen_stem(a.mesh);
    for (const TextOutput& t : text_outputs) {
        // Without the copy these would say less than was asked for.
        if (!(a.*t.path).empty() && (a.fixed().empty() || fixed))
            written.push_back(write_output(a.*t.path, t.text(report, *mesh, a, told)));
    }
    if (!a.vtu.empty()) written.push_back(write_measures(report, *mesh, a.vtu, a.vtk_data.value_or(VtkData::raw)));
    if (table) {
        const TerminalStyle style{.colour = colour_on_stdout(), .command = command_name()};
        written.push_back(
            write_output("-", check_text(report, *mesh, name, style) + (fixed ? fix_text(*fixed, style) : "")));
    }
    if (a.ci.asked())
        write_ci(a.ci, check_outcomes(report, *mesh, name, mesh_artifact(a.mesh), measure_environment()), written);
    if (!a.quiet && !table) tell_curved(report.curved);
    if (!a.quiet) tell_important(mesh->notes);
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    return (fixed ? fixed->after : report).certified() ? exit_clean : exit_findings;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand(
        "check", "Prove in exact arithmetic that a mesh is a partition of its domain, or report why it is not");
    sub->footer(
        "Exit codes: 0 certified, 1 not certified, 2 usage or input error; with --fix by the copy,\nwhile --junit, "
        "--sarif and --annotations tell of the mesh as it was.\nCertified: any two "
        "cells meet in a common "
        "face or not at all, and the files .neigh and .face, if present, agree with\nthe cells. Second-order cells are "
        "checked with straight sides.");
    const auto a = std::make_shared<CheckArguments>();
    file_option(
        *sub, "MESH", a->mesh,
        "A mesh: TetGen's .node/.ele (with .face and .neigh if present) or Triangle's, Gmsh's .msh, Medit's .mesh "
        ".meshb, VTK's .vtu .vtk .vtp .pvtu .vtm .pvd .vtu.series .vtp.series")
        ->required();
    step_options(*sub, a->step);
    sub->add_flag("--delaunay", a->delaunay, "Also test exactly whether every interior facet is locally Delaunay");
    file_option(*sub, "--conforms-to", a->plc,
                "Also test whether the facets of this PLC (.poly .smesh .off .stl .ply) are unions of faces of cells")
        ->type_name("PLC");
    sub->add_option("--examples", a->examples, "Max number of places listed per defect")
        ->capture_default_str()
        ->check(CLI::Range(0, 1000000).description(""))
        ->type_name("N");
    sub->add_option("--contacts", a->contacts, "Max number of overlapping or touching pairs listed with a witness")
        ->capture_default_str()
        ->check(CLI::Range(0, 1000000).description(""))
        ->type_name("N");
    curved_option(*sub, a->curved);
    threads_option(*sub, a->threads);
    for (const TextOutput& t : text_outputs) file_option(*sub, t.option, (*a).*t.path, t.help);
    file_option(*sub, "--vtu", a->vtu, "Write the mesh with measures and defects of each cell as VTU, for ParaView");
    auto* const all =
        file_option(*sub, "--fix", a->fix,
                    "Write a copy with what has one right answer repaired, and check it: coincident nodes merged, "
                    "degenerate and duplicate cells dropped, negative cells turned: .vtu .vtk .msh, or TetGen's "
                    "STEM.node, STEM.ele (.face, .neigh)");
    sub->add_option("--merge-within", a->merge_within, "With --fix, merge nodes of cells at most so far apart")
        ->check(finite_at_least(0))
        ->type_name("DISTANCE");
    file_option(*sub, "--fix-orientation", a->fix_orientation, "Likewise, but turn negative cells and repair no more")
        ->excludes(all);
    sub->add_option("--near", a->near,
                    "Tell boundary nodes at most RATIO times the shortest boundary edge at either apart; 0: none")
        ->capture_default_str()
        ->check(finite_at_least(0))
        ->type_name("RATIO");
    vtk_data_option(*sub, a->vtk_data);
    add_ci_options(*sub, a->ci, "what breaks the certificate");
    sub->add_flag("--quiet", a->quiet, "Print no table and no progress");
    sub->callback([a, &exit_code] { exit_code = run_check(*a); });
}

}  // namespace barycert::cli
