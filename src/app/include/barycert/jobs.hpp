/// Whole jobs, files to files: what the command line and the bindings call.
///
/// A job names its files and options; one call reads the mesh and its fields, checks the mesh where that pays, streams
/// points through a Sampler and writes rows, grids, pictures or meshes. Memory is that of the mesh and some blocks of
/// points. Output files appear whole or not at all; rows on stdout cannot be taken back.
#pragma once

#include <map>

#include "barycert/check.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/io.hpp"
#include "barycert/verify.hpp"

namespace barycert {

/// A field from a file of its own: a row of numbers for each node, or for each cell.
struct FieldFile {
    enum class Of : std::uint8_t { either, points, cells };
    Of of = Of::either;
    std::string name, path;
    /// Of a CSV file the name or number (from 1) of the column, of a structured NPY file the field, of a mesh the
    /// array. Empty: all that a text or NPY file holds.
    std::string column = {};
};

/// What a job is doing.
struct JobProgress {
    std::string_view stage;  ///< such as "reading part.1" or "points"
    std::uint64_t done = 0;  ///< how many; 0: not counted
};

/// What all jobs on a mesh have.
struct MeshJob {
    std::string mesh;      ///< as for read_mesh
    StepChoice step = {};  ///< of a mesh that is a series (.pvd, .vtu.series); none: the first
    std::vector<FieldFile> field_files = {};
    Curved curved = Curved::isoparametric;                             ///< what becomes of curved cells
    CellInterpolation cell_interpolation = CellInterpolation::linear;  ///< of sampling and verification

    /// Where the caller will write reports, after what it calls them: checked with the files of the job.
    std::vector<std::pair<std::string, std::string>> reports = {};
    std::string program = "barycert";  ///< how the user calls the program, for commands in messages
    /// Called by one thread at a time, which need not be the caller's.
    std::function<void(const JobProgress&)> progress = {};
};

/// What reports of jobs on a mesh have.
struct MeshReport {
    std::string mesh;
    CurvedCells curved;  ///< of the mesh: taken with straight sides
    Notes notes;         ///< what was left out, converted or guessed: of the mesh, of fields, of points
    std::uint64_t nodes = 0, cells = 0;
    std::uint64_t simplices = 0;  ///< that the cells are cut into; 0: they are simplices
    int dimension = 3, threads = 1;
};

/// What sampling and resampling have.
struct SamplingJob : MeshJob {
    /// Of a mesh that is a series: without a `step`, where the output has {step} or {time} in its name, and there are
    /// no series of fields, every step is sampled into an output of its own, in which its number or time takes that
    /// place; points are located anew where the mesh is another one. With all_steps an Error where that is not so.
    bool all_steps = false;
    /// Fields that change from step to step: each path has one *, and each file that it matches is a step, in natural
    /// order (2 before 10); or it is a .pvd or .vtu.series file. Where the output has {step} or {time} in its name,
    /// each step has an output of its own, in which what the * stood for, or the time, takes that place; points are
    /// located once, and values of one step are in memory. Else the steps of NAME, 256 at most, are columns NAME@STEP.
    std::vector<FieldFile> series = {};
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: all
    std::string output;                    ///< the format goes by the suffix; "-" is CSV on stdout
    /// Where to write the weights of the points on the nodes of the mesh (sampler.hpp): .npz, a matrix that
    /// scipy.sparse.load_npz reads. Empty: nowhere. Not for grids. A SampleJob with weights needs no output.
    std::string weights = {};
    SampleOptions options = {};
    std::optional<VtkData> vtk_data = {};  ///< of an output in a format of VTK; not set: raw

    bool count_degenerate = true;  ///< of SampleReport: a pass over the cells
};

/// Points from one end to the other, as far apart as they can be: each coordinate rounded.
struct PointLine {
    std::vector<double> from, to;
    std::int64_t count = 200;  ///< at least 1; one is at the first end
};

/// Fields at points: rows to CSV, NPY or VTU files. Of a surface (read_surface): at the nearest point of it, with its
/// triangle, the feature in which it lies, and the distance, negative where the point is inside; options.outside.limit
/// bounds it. A map has the triangles then, and weights are those of the nearest points: nearest projection.
struct SampleJob : SamplingJob {
    std::string points;                  ///< as for open_points; or
    std::optional<PointLine> line = {};  ///< these
    /// A plot of the values along the way from point to point, or of a series over its times, for each point: .png,
    /// .svg, .pdf. At most six curves.
    std::string plot;
    FigureOptions figure = {};              ///< of it: title, unit, background, resolution
    std::vector<std::string> columns = {};  ///< PointOptions::columns
    std::vector<std::string> keep = {};     ///< PointOptions::keep: columns of the points that rows have, too
    std::string map;                        ///< a map (map.hpp) in place of points
    std::string save_map;                   ///< where to write one; empty: nowhere
    std::optional<bool> all{};  ///< a row for each cell that holds a point; not set: no, or as the map has it
};

/// Fields on a regular grid, or at the nodes of another mesh: exactly one of counts, spacing and onto is set.
struct ResampleJob : SamplingJob {
    std::vector<std::int64_t> counts = {};  ///< points along each axis
    std::vector<double> spacing = {};       ///< of points: one for all axes, or one each
    std::vector<double> bounds = {};        ///< low and high, axis after axis; empty: the box of the cells
    std::string onto;                       ///< a mesh; `curved` is of it, too
    FigureOptions figure = {};              ///< of a picture: its colours, axes, title, background
};

/// How the owners of points were found. `pass`: one look at each cell, and no index of the mesh. `axes`: by coordinates
/// along axes, in a mesh that is a grid.
enum class FoundBy : std::uint8_t { walk, candidates, map, grid, pass, axes };

constexpr std::string_view name(FoundBy f) {
    constexpr std::array<std::string_view, 6> names{"walk", "candidates", "map", "grid", "pass", "axes"};
    return names[static_cast<std::size_t>(f)];
}

/// Where points came from.
enum class PointsFrom : std::uint8_t { points, map, mesh, grid };

constexpr std::string_view name(PointsFrom f) {
    constexpr std::array<std::string_view, 4> names{"points", "map", "mesh", "grid"};
    return names[static_cast<std::size_t>(f)];
}

/// Wall times of the stages. Points are read, sampled and written at the same time: of these each has the time in which
/// somebody was busy with it, divided by the threads where several may be.
struct JobSeconds {
    double mesh = 0;    ///< reading the mesh and the files of fields
    double build = 0;   ///< of the locator and the sampler; of a contour the cut
    double read = 0;    ///< of points
    double sample = 0;  ///< owners, features and values; of a picture the index, too
    double write = 0;
    double total = 0;
};

/// A column of a cell field over the cells of its mesh, and over those of the mesh at whose nodes it was sampled,
/// between which it is linear (quadratic on second-order cells). Exact sums of value times volume (in the plane area;
/// of straight sides, whatever the orientation), rounded once; cells that overlap count twice.
struct FieldIntegral {
    std::string column;
    double source = 0, target = 0;
    std::uint64_t source_left_out = 0, target_left_out = 0;  ///< cells with a value that is not finite
};

/// What a job did: what its reports are made of.
struct SampleReport : MeshReport {
    std::string command;  ///< "sample" or "resample"
    std::string output, weights;
    std::string points;                ///< the file they came from; empty for a grid
    CurvedCells onto_curved;           ///< of the mesh of ResampleJob::onto
    std::vector<std::string> columns;  ///< of values
    std::vector<std::string> carried;  ///< columns that were carried through: labels of cells, columns of points
    std::string reason;                ///< why `method`: a clause
    std::optional<Grid> grid;          ///< of ResampleJob::counts and spacing
    std::optional<FigureCounts> picture;
    std::vector<FieldIntegral> integrals;  ///< of the cell fields that became values at nodes of another mesh
    OutsidePolicy outside;
    SampleCounts counts;  ///< locations: one a point
    JobSeconds seconds;
    std::uint64_t degenerate_cells = 0;  ///< method `pass`: of the cells near the points
    std::uint64_t contested_cells = 0;   ///< see Locator::contested_cells
    std::uint64_t rows = 0;
    /// Fields that are sampled and have values that are not finite; of series, those of the first step that has some.
    std::vector<NotFinite> not_finite;
    std::uint64_t nan_values = 0;    ///< of points inside: from values of nodes or cells that are not finite
    std::vector<std::string> steps;  ///< of series, in order; all else but nan_values and seconds is of one of them
    std::vector<double> times;       ///< of these steps, where the mesh is the series
    std::uint64_t meshes = 1;        ///< of such steps; in each of them points are located, and counted
    PointsFrom from = PointsFrom::points;
    FoundBy method = FoundBy::walk;
    Rounding rounding = Rounding::correct;
    Verdict verdict = Verdict::not_checked;  ///< certified: P1 to P4 of check.hpp are proved
    bool all = false;                        ///< a row for each cell that holds a point
    bool surface = false;  ///< `cells` are triangles in space, and rows are of the nearest points on them
};

/// Return an Error, and write nothing, if the job contradicts itself, an input cannot be read, an output is an input or
/// cannot be written, or the policy for points outside is `error` and a point is outside.
Result<SampleReport> sample_files(const SampleJob& job);
/// The plot alone, of what a sampler has: six columns at most.
Status write_line_plot(const std::string& path, const Sampler& sampler, const PointLine& line,
                       const FigureOptions& options);
Result<SampleReport> resample_files(const ResampleJob& job);

// A mesh checked, and repaired if asked; or a surface, or a PLC (.poly, .smesh): then options of meshes are errors.

struct CheckJob : MeshJob {
    CheckOptions options = {};  ///< but for plc and progress
    std::string plc;            ///< a PLC, whose facets are to be unions of faces of cells
    std::string measures;       ///< a .vtu file: the mesh with measures and defects of each cell; .vtp: the surface
    std::string picture;        ///< a .png file: see draw_checked(); of surfaces and PLCs
    bool plot = false;          ///< check_plot() will be called: of meshes alone
    /// Where to write a repaired copy, one of them at most: VTK's or Gmsh's file, or a stem of TetGen's. `fix` merges
    /// coincident nodes, drops degenerate and duplicate cells and turns negative ones; fix_orientation turns alone.
    std::string fix, fix_orientation;
    std::optional<double> merge_within = {};  ///< of `fix`: nodes of cells at most so far apart are merged
    std::optional<VtkData> vtk_data = {};     ///< of outputs in a format of VTK; not set: raw
};

/// A mesh repaired and written, and what the check says of the file when it is read again.
struct FixedMesh {
    std::string file;
    FixReport done;
    Notes notes = {};  ///< what of the mesh the file cannot hold
    CheckReport after;
};

/// A mesh that was checked, and what was done with it.
struct CheckedMesh {
    Mesh mesh;             ///< or
    Surface surface;       ///< if report.surface is there; of a PLC, the triangles that its facets are cut into
    std::string name;      ///< what the user calls it, without the suffix of TetGen's files
    std::string artifact;  ///< the file that it is in: of several the first that is there
    CheckReport report;
    std::optional<FixedMesh> fixed;  ///< without `after` where there is no copy
    bool copied = false;             ///< the copy was written and checked
    Status written = Done{};         ///< the first output that could not be written, or why there is no copy

    /// Of the copy, if there is one.
    bool certified() const { return (copied ? fixed->after : report).certified(); }
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, or an output is an
/// input or cannot be written. What goes wrong once the mesh is checked does not cost the report: CheckedMesh::written.
Result<CheckedMesh> check_files(const CheckJob& job);

// The results that some tool wrote into a file, held against the exact ones.

/// A rule of --fail-on: more such rows than that fail.
struct VerifyLimit {
    RowVerdict verdict = RowVerdict::missed;
    std::uint64_t most = 0;
};

/// The kinds of rows that limits are of.
inline constexpr std::array<RowVerdict, 4> kinds_of_wrong{RowVerdict::missed, RowVerdict::invented,
                                                          RowVerdict::wrong_cell, RowVerdict::wrong_value};

/// NAME or NAME>NUMBER, with NAME missed, invented, wrong_cell or wrong_value.
Result<VerifyLimit> parse_verify_limit(std::string_view text);

struct VerifyJob : MeshJob {
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: those that the results have
    /// Points with columns, as for open_points: .csv .npy .vtu .vtp .vti .vtk ...; "-" is CSV from stdin.
    std::string results;
    std::vector<std::string> columns = {};  ///< those of the coordinates: PointOptions::columns

    /// Columns of values by those of the sampler (T, v.0, ...). Others are looked for under their own name, and as
    /// NAME:0 and NAME_0, as ParaView writes them.
    std::map<std::string, std::string> values = {};
    /// The column that names cells, from cell_base. Empty: `cell`, if there is one; "none": none.
    std::string cell_column;
    int cell_base = 0;
    /// The column that is 0 outside. Empty: vtkValidPointMask, if there is one; "none": none.
    std::string mask_column;

    VerifyOptions options = {};            ///< but for tolerance
    std::optional<double> tolerance = {};  ///< not set: 1e-9, or 1e-6 where values are single precision throughout
    std::vector<VerifyLimit> limits = {};  ///< empty: none of any kind
};

/// What a verification did: what its reports are made of.
struct VerifyReport : MeshReport {
    std::string results;
    bool certified = false;
    std::uint64_t contested_cells = 0;
    std::vector<std::string> columns;      ///< of the sampler: what was compared
    std::vector<std::string> found_in;     ///< the column of the results for each
    std::string cell_column, mask_column;  ///< empty: none
    std::vector<double> ranges;            ///< what errors are relative to
    std::vector<RelativeTo> relative_to;   ///< what these are
    double tolerance = 0;
    bool exact = false;
    std::optional<double> outside_value;
    Verdicts verdicts;                ///< cells of examples are the file's own numbers
    std::vector<VerifyLimit> limits;  ///< of the job, or 0 of every kind
    std::string program;
    JobSeconds seconds;

    /// Whether rows could be of that kind: wrong_cell takes a column of cells, wrong_value one of values.
    bool compared(RowVerdict verdict) const {
        if (verdict == RowVerdict::wrong_cell) return !cell_column.empty();
        return verdict != RowVerdict::wrong_value || !columns.empty();
    }
    std::vector<VerifyLimit> exceeded() const {
        std::vector<VerifyLimit> all = limits;
        std::erase_if(all, [&](const VerifyLimit& l) { return verdicts.of(l.verdict) <= l.most; });
        return all;
    }
};

/// Returns an Error if an input cannot be read, the results have no column that could be compared, or there is a limit
/// on what is not compared: nothing could exceed it.
Result<VerifyReport> verify_files(const VerifyJob& job);

// Pictures.

/// The colours of a picture of values.
struct ColourRange {
    std::string field;
    double low = 0, high = 0;         ///< NaN if no value is finite
    std::uint64_t without_value = 0;  ///< triangles, drawn in grey
};

/// The largest difference of a texture coordinate from the correctly rounded perspective-correct one, and where.
struct TexelError {
    double texels = 0;
    std::int32_t column = 0, row = 0;  ///< row counted from the bottom
};

/// What was drawn.
struct RenderReport : MeshReport {
    std::string picture;  ///< gradient, texture, cube, clip, mesh, scene
    std::string input;    ///< the scene, mesh or image; empty if there is none
    std::string output;
    RasterSize size;
    int samples = 1;  ///< of a pixel, across and up; counts are of these
    RenderCounts counts;
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    Rounding rounding = Rounding::plain;
    std::optional<ColourRange> colours;
    std::optional<TexelError> texel_error;
    double seconds = 0;  ///< from the options to the file
};

/// What a RenderJob draws: the scene of a file; a triangle with a red, a green and a blue corner; an image on a square
/// or triangle; a checkerboard on a cube in perspective, with the largest error of its texture coordinates; a triangle
/// and segments before and after clipping by a box; the boundary of a mesh of tetrahedra, or a mesh of triangles.
enum class PictureKind : std::uint8_t { scene, gradient, texture, cube, clip, mesh };

constexpr std::string_view name(PictureKind p) {
    constexpr std::array<std::string_view, 6> names{"scene", "gradient", "texture", "cube", "clip", "mesh"};
    return names[static_cast<std::size_t>(p)];
}

/// What of a mesh a picture shows: its boundary, in the plane its cells; or, where slices, iso-surfaces or marked cells
/// are named, these. Cells that threshold or box leave out are not there, nor is what lies before the plane.
struct SceneChoice {
    bool surface = true;   ///< false: no boundary
    bool edges = false;    ///< of cells, on what is drawn
    bool outline = false;  ///< where the boundary bends by 30 degrees or more; in the plane all of it
    /// Cut open: what has normal.x above the offset is left out. What is cut is closed by the section.
    std::optional<Plane> plane = {};
    /// Cells with a node inside are left out.
    std::optional<std::pair<std::array<double, 3>, std::array<double, 3>>> box = {};
    struct Threshold {
        std::string field;  ///< as `field` of the job
        double low = 0, high = 0;
    };
    std::optional<Threshold> threshold = {};  ///< cells whose value, or those at whose nodes, are all within
    std::string iso_field;
    std::vector<double> iso = {};  ///< values of its iso-surfaces
    std::vector<Plane> slices = {};
    /// A field of nodes of as many components as there are coordinates; in colours of the field if there is no surface.
    std::string arrows;
    std::int64_t arrow_count = 400;        ///< about so many
    std::vector<double> points = {};       ///< coordinates of discs, in colours of the field there
    double point_size = 6;                 ///< pixels across
    BuildOptions location = {};            ///< of these points
    std::vector<Mesh::Index> marked = {};  ///< cells by their numbers, in red
};

/// A picture as a file. Of MeshJob, `mesh` and what belongs to it are for PictureKind::mesh alone.
struct RenderJob : MeshJob {
    PictureKind picture = PictureKind::scene;
    std::string output;         ///< .png; of a mesh also .svg or .pdf
    FigureOptions figure = {};  ///< size, method, rounding and samples of all pictures; the rest of that of a mesh
    SceneChoice show = {};      ///< of a mesh
    std::string points;         ///< a file of points to be among those of `show`, as for open_points
    std::vector<std::string> columns = {};                     ///< of its coordinates: PointOptions::columns
    std::string scene;                                         ///< a file (.json)
    Interpolation interpolation = Interpolation::perspective;  ///< of a cube
    std::string image;                                         ///< of a texture: .png; empty: one of 2 by 2 texels
    bool triangle = false;                                     ///< what that is put on; else a square
    std::pair<double, double> coordinates{0, 1};               ///< u and v at its lower left and upper right
    Wrap wrap = Wrap::clamp;
    Filter filter = Filter::nearest;
    std::string field;  ///< of a mesh: NAME, point:NAME, cell:NAME, each perhaps with .K for component K; empty: grey
    int threads = 0;    ///< 0: as many as the machine has
};

/// Of a mesh it draws facets that one cell alone has; their colours are those of nodes, or of that cell. Returns an
/// Error if the job contradicts itself, an input cannot be read, a mesh has no such field or component or no cells, as
/// render and write_figure do, or if the file cannot be written.
Result<RenderReport> render_files(const RenderJob& job);

/// The same of a mesh in memory, to the file `path`: .png, .svg, .pdf or .html.
Status write_mesh_figure(const std::string& path, const Mesh& mesh, const SceneChoice& show, const std::string& field,
                         const FigureOptions& options);

// Iso-surfaces, iso-lines and slices of meshes.

struct ContourJob : MeshJob {
    // Either: the field of nodes and its value; a field of several components as NAME.0, NAME.1, ...
    std::string field;
    std::optional<double> value = {};
    // Or a plane; then `field`, which may be one of cells, is what a picture shows, or what a surface carries along.
    std::optional<Plane> plane = {};

    std::vector<std::string> fields = {};  ///< to carry along, see Sampler::build; empty: all. Not for pictures
    std::string output;                    ///< .vtp, .ply, .off; .png, .svg, .pdf; segments as .vtp or .ply
    std::int64_t width = 800;              ///< of a picture of a section, in pixels, without axes and bar
    FigureOptions figure = {};             ///< of a picture
    bool edges = false;                    ///< of cells, on a picture
    bool outline = false;                  ///< of the mesh, on a picture of an iso-surface
    std::string colours;  ///< the field, of nodes or cells, that colours it; named as `field`; empty: grey
    std::optional<VtkData> vtk_data = {};  ///< of a .vtp file; not set: raw
    int threads = 0;                       ///< 0: as many as the machine has
};

/// Where the pixels of a picture of a plane lie. The middle of pixel (i, j), counted from the lower left, is
/// origin + i * step_right + j * step_up, each operation rounded: up to rounding on the plane. Seen from where the
/// normal points to, z upwards (y, if the normal has no other component than z).
struct PixelGrid {
    std::int64_t width = 0, height = 0;
    std::array<double, 3> origin{}, step_right{}, step_up{};
    double pixel = 0;  ///< the length of both steps, up to rounding

    std::array<double, 3> middle(std::int64_t i, std::int64_t j) const;
};

/// What a job did: what its reports are made of.
struct ContourReport : MeshReport {
    std::string field, output;
    std::optional<double> value;
    std::optional<Plane> plane;
    std::uint64_t points = 0, parts = 0;  ///< of the surface; parts are triangles, in the plane segments
    CutCounts counts;
    std::vector<std::string> fields;  ///< in the file
    SurfaceFile file;
    /// Of what is cut, the field or normal.x: its least and greatest number at nodes of cells. NaN if there is none.
    double low = 0, high = 0;
    std::optional<PixelGrid> pixels;  ///< of a picture of a section; with one sample a pixel values are those there
    SampleCounts samples;
    std::optional<RasterSize> view;  ///< of a picture that is drawn
    FigureCounts drawn;
    std::string colours;
    JobSeconds seconds;
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, an output is an input
/// or cannot be written, or there is nothing to draw in a picture. An empty surface is written; the report tells.
Result<ContourReport> contour_files(const ContourJob& job);

}  // namespace barycert
