// barycert sample, resample: the fields of a mesh at points, on a regular grid, or at the nodes of another mesh.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/figure.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"

namespace barycert::cli {
namespace {

OutsidePolicy policy_of(const std::string& text) {
    if (text == "nan") return {};
    if (text == "error") return {.kind = Outside::error};
    if (text == "extrapolate") return {.kind = Outside::extrapolate};
    if (text == "nearest") return {.kind = Outside::nearest};
    const std::string word = text.substr(0, text.find('=')),
                      number = text.substr(std::min(word.size() + 1, text.size()));
    const auto x = base::parse_double(number);
    if (word == "fill" && x) return {.kind = Outside::fill, .fill = *x};
    if (word == "nearest" && x && std::isfinite(*x) && *x >= 0) return {.kind = Outside::nearest, .limit = *x};
    const bool known = word == "fill" || word == "nearest";
    const std::string meant =
        known ? (text == "fill" ? "say with what" : '"' + number + "\" is no such number") + ": " + word + "=0.5"
              : base::did_you_mean(word, {"nan", "error", "fill", "nearest", "extrapolate"});
    throw CLI::ValidationError(
        "--outside",
        "expected nan, error, fill=NUMBER, nearest, nearest=DISTANCE (at least 0) or extrapolate, found \"" + text +
            '"' + (meant.empty() ? "" : "; " + meant));
}

void add_sampling_options(const Options& o, SamplingJob& job, Reports& reports) {
    o.step(job.step, &job.all_steps);
    o.field_files(job.field_files, "--field", &job.series);
    o.text("--fields", job.fields,
           "Fields to sample: A,B,...; columns have this order, fields of nodes before fields of cells, and these "
           "before lengths; cell:A is the cell field A if there is also a node field A; default: all. Of each, or of "
           "these again: A.x or A.0, a component; |A|, the length; grad(A), the gradient in the owner; mean(A), cell "
           "data averaged to nodes by volume, then interpolated",
           "NAMES");
    o.text("--weights", job.weights,
           "Write the correctly rounded weight of each node for each point, .npz: a sparse matrix for "
           "scipy.sparse.load_npz, to be multiplied with any field of the nodes");
    o.rounding(job.options.rounding, "correct: the exact value, rounded once (default); plain: computed in double");
    o.parsed(
        "--outside", "nan|error|fill=V|nearest[=D]|extrapolate",
        "Value of points outside every cell: nan (default); error: fail; fill=NUMBER; nearest[=DISTANCE]: the value at "
        "the nearest point of the mesh, NaN beyond DISTANCE; extrapolate: the function of the nearest cell",
        "", job.options.outside, [](const std::string& text) { return std::optional(policy_of(text)); });
    o.parsed("--within", "DISTANCE", "The same as --outside nearest=DISTANCE", "", job.options.outside,
             [](const std::string& text) { return std::optional(policy_of("nearest=" + text)); });
    o.curved(job.curved);
    o.cell_interpolation(job.cell_interpolation);
    o.threads(job.options.threads);
    o.vtk_data(job.vtk_data);
    reports.file(o, "--json", json_summary);
    reports.quiet(o, "Print no summary, no notes and no progress");
    reports.rows(job.output);
}

template <class Job, Result<SampleReport> (*files)(const Job&)>
int run_sampling(Arguments<Job>& a) {
    a.job.count_degenerate = !a.reports.is_quiet() || !a.reports.path("--json").empty();
    return a.reports.summarise(a.job, files, sample_json, sample_text);
}

int run_resample(Arguments<ResampleJob>& a) {
    const std::string of_picture = given_option(*a.app, figure_options);
    if (!of_picture.empty() && !is_figure_name(a.job.output))
        return fail({.code = "option.unfit",
                     .what = of_picture + " needs a picture",
                     .remedy = "leave it out, or name a file with one of " + pictures_help()});
    return run_sampling<ResampleJob, resample_files>(a);
}

}  // namespace

void add_sample(const Options& program) {
    const auto& [o, a] = program.command(
        "sample", "Sample the fields of a mesh at points, correctly rounded",
        R"(Rows: x,y,z,cell,feature, then one column per component of each field (NAME, or NAME.0, NAME.1, ...): node
fields, cell fields, lengths; then with --outside nearest or extrapolate the distance to the mesh, then labels of cells named
in --fields (texts, large integers), then columns of the points (--keep). cell: the number in the file, from
0, of the first cell that contains the point; -1 outside. feature: interior, face, edge, vertex or outside,
exact. TetGen's node attributes are named attribute0, attribute1, ... --points takes the output of another
run, whose rows are points.
MESH may be a surface: .stl .ply .off .obj .poly .smesh, or triangles in space in the files of Gmsh, Medit and VTK.
Then rows have the values at the nearest point of it, the triangle, the face, edge or vertex in which that lies, and the
distance, negative inside. Of --fields only names apply then, of --outside only nearest, which is the default there.
Files appear whole or not at all; rows already printed to stdout stay. Exit codes: 0 done, 2 usage or input
error.)",
        run_sampling<SampleJob, sample_files>);
    SampleJob& job = a.job;
    o.mesh(job.mesh);
    o.text("--points", job.points,
           "Points: " + base::suffix_list_read(base::Use::points) +
               ", or the nodes of another mesh; - is CSV from stdin, and so is any pipe");
    o.text("--columns", job.columns,
           "The columns of the coordinates, by name or by number from 1, such as 2,3,4 or lon,lat,depth; needed where "
           "the file does not name x,y,z and has more columns than the mesh has dimensions",
           "A,B,C");
    o.text("--keep", job.keep,
           "Columns of the points to copy into the rows: names; or all: every column but the coordinates and those "
           "that rows have anyway; NEW=NAME renames a column",
           "NAMES|all");
    auto* const line = o.taken("--line", "A:B", "Instead of --points: --count points from A to B",
                               "XA,YA,ZA:XB,YB,ZB, finite numbers", [&job](Text text) {
                                   const auto ends = segment_of(text, 2);
                                   if (!ends) return false;
                                   if (!job.line) job.line.emplace();
                                   job.line->from = (*ends)[0];
                                   job.line->to = (*ends)[1];
                                   return true;
                               });
    o.taken("--count", "N", "Of --line: how many points; default: 200", "a number of at least 1", [&job](Text text) {
         const auto n = count_of(text);
         if (n && !job.line) job.line.emplace();
         if (n) job.line->count = *n;
         return n.has_value();
     })->needs(line);
    o.text("--output", job.output, "Rows: " + base::suffix_list_written(base::Use::rows) + "; - is CSV on stdout");
    auto* const plot = o.text(
        "--plot", job.plot,
        "Picture of values over the length from point to point, a curve a field, broken outside the mesh; of a series "
        "over its times: " +
            pictures_help());
    o.text("--title", job.figure.title, "What stands above the plot; default: the mesh", "TEXT")->needs(plot);
    o.text("--unit", job.figure.unit, "Of the values, at the plot's axis", "TEXT")->needs(plot);
    add_sampling_options(o, job, a.reports);
    o.nonfinite(job.options.nonfinite_points);
    o.choice<std::optional<bool>>(
        "--on-boundary", job.all, {{"lowest", false}, {"all", true}},
        "If several cells contain a point: one row for the cell of lowest index (default), or one row per cell");
    o.text("--save-map", job.save_map, "Write the cell of each point to a file for --map");
    o.text("--map", job.map,
           "Instead of --points: take points and cells from this map; for other fields on the same mesh");
}

void add_resample(const Options& program) {
    const auto& [o, a] = program.command(
        "resample", "Sample the fields of a mesh on a regular grid, or onto another mesh, correctly rounded",
        R"(Grids go, by the suffix, to .vti (an array a field, and vtkValidPointMask and cell), .npy (an array of shape
nz,ny,nx, or nz,ny,nx,columns), .csv (rows as of `barycert sample`; - is stdout), .png .svg .pdf (one layer of one
column). With --onto to .vtu or .vtk (MESH2, its fields of nodes replaced by those sampled, vtkValidPointMask
and cell), .msh (Gmsh's, the same without the mask), STEM or STEM.node (TetGen's, with attributes), .csv, .npy.
Values are those of `barycert sample` at the same points, bit for bit. Exit codes: 0 done, 2 usage or input
error.)",
        run_resample);
    ResampleJob& job = a.job;
    o.mesh(job.mesh);
    o.parsed("--grid", "NXxNYxNZ", "Number of points along each axis, ends included; a single point lies in the middle",
             "numbers of points along the axes, min 1, such as 200x200x100", job.counts, numbers('x', count_of, 2, 3));
    o.parsed("--spacing", "H|HXxHYxHZ", "Distance of points along each axis, from the lower end of the bounds",
             "a positive number, or one for each axis, such as 0.1x0.1x0.2", job.spacing, numbers('x', positive, 1, 3));
    o.parsed("--bounds", "XMIN,XMAX,...", "Box of the grid; default: the box of the cells",
             "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX (2D: the first four), finite numbers", job.bounds,
             [](const std::string& text) {
                 const auto bounds = numbers(',', finite, 4, 6)(text);
                 return bounds && bounds->size() != 5 ? bounds : std::nullopt;
             });
    o.text("--onto", job.onto, "Sample at the nodes of this mesh", "MESH2");
    o.text("--output", job.output,
           "Grids: " + base::suffix_list_written(base::Use::grid) +
               "; with --onto, meshes: " + base::suffix_list_written(base::Use::mesh) + ", or rows: .csv .npy")
        ->required();
    o.figure(job.figure, "Picture: ");
    add_sampling_options(o, job, a.reports);
}

}  // namespace barycert::cli
