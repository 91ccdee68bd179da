// barycert resample: the fields of a mesh on a regular grid, or at the nodes of another mesh.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "barycert/jobs.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {
namespace {

void add_targets(CLI::App& sub, ResampleJob& a) {
    sub.add_option_function<std::string>(
           "--grid",
           [&a](const std::string& text) {
               constexpr const char* expected = "numbers of points along the axes, min 1, such as 200x200x100";
               a.counts = numbers_of<std::int64_t>("--grid", text, 'x', count_of, expected);
               if (a.counts.size() < 2 || a.counts.size() > 3)
                   throw CLI::ValidationError("--grid", fmt::format("expected {}, found \"{}\"", expected, text));
           },
           "Number of points along each axis, ends included; a single point lies in the middle")
        ->type_name("NXxNYxNZ");
    sub.add_option_function<std::string>(
           "--spacing",
           [&a](const std::string& text) {
               constexpr const char* expected = "a positive number, or one for each axis, such as 0.1x0.1x0.2";
               a.spacing = numbers_of<double>("--spacing", text, 'x', positive, expected);
               if (a.spacing.size() > 3)
                   throw CLI::ValidationError("--spacing", fmt::format("expected {}, found \"{}\"", expected, text));
           },
           "Distance of points along each axis, from the lower end of the bounds")
        ->type_name("H|HXxHYxHZ");
    sub.add_option_function<std::string>(
           "--bounds",
           [&a](const std::string& text) {
               constexpr const char* expected = "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX (2D: the first four), finite numbers";
               a.bounds = numbers_of<double>("--bounds", text, ',', finite, expected);
               if (a.bounds.size() != 4 && a.bounds.size() != 6)
                   throw CLI::ValidationError("--bounds", fmt::format("expected {}, found \"{}\"", expected, text));
           },
           "Box of the grid; default: the box of the cells")
        ->type_name("XMIN,XMAX,...");
    file_option(sub, "--onto", a.onto, "Sample at the nodes of this mesh")->type_name("MESH2");
}

}  // namespace

void add_resample(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand(
        "resample", "Sample the fields of a mesh on a regular grid, or onto another mesh, correctly rounded");
    sub->footer(
        "Grids go, by the suffix, to .vti (an array a field, and vtkValidPointMask and cell), .npy (an array of shape\n"
        "nz,ny,nx, or nz,ny,nx,columns), .csv (rows as of `barycert sample`; - is stdout), .png (one layer of one\n"
        "column). With --onto to .vtu or .vtk (MESH2, its fields of nodes replaced by those sampled, "
        "vtkValidPointMask\n"
        "and cell), .msh (Gmsh's, the same without the mask), STEM or STEM.node (TetGen's, with attributes), .csv, "
        ".npy.\n"
        "Values are those of `barycert sample` at the same points, bit for bit. Exit codes: 0 done, 2 usage or input\n"
        "error.");
    const auto a = std::make_shared<ResampleJob>();
    const auto quiet = std::make_shared<bool>(false);
    file_option(*sub, "MESH", a->mesh, mesh_help)->required();
    add_targets(*sub, *a);
    file_option(*sub, "--output", a->output, "Grids: .vti .npy .csv .png; with --onto: .vtu .vtk .msh .node .csv .npy")
        ->required();
    sub->add_option_function<std::string>(
           "--range",
           [a](const std::string& text) {
               constexpr const char* expected = "MIN,MAX, finite numbers, MIN < MAX";
               const auto ends = numbers_of<double>("--range", text, ',', finite, expected);
               if (ends.size() != 2 || !(ends[0] < ends[1]))
                   throw CLI::ValidationError("--range", fmt::format("expected {}, found \"{}\"", expected, text));
               a->range = {ends[0], ends[1]};
           },
           "Picture: the values of the first and the last colour; default: min and max of the values drawn")
        ->type_name("MIN,MAX");
    add_sampling_options(*sub, *a, *quiet);
    sub->callback([=, &exit_code] { exit_code = run_sampling(*a, *quiet, [&] { return resample_files(*a); }); });
}

}  // namespace barycert::cli
