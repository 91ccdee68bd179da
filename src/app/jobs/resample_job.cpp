// Fields on a regular grid, or at the nodes of another mesh.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/integrals.hpp"
#include "app/jobs/job_files.hpp"
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
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"
#include "files/output_file.hpp"
#include "io/formats.hpp"
#include "io/npy/npy.hpp"
#include "io/vti/vti.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert {

using base::FormatKind;
using base::Use;
namespace {

using jobs::refuse_member;
using jobs::SampledMesh;
using jobs::Sink;
using jobs::Stopwatch;

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

[[noreturn]] void refuse_label(const ColumnFormat& column, const std::string& path, const char* expected,
                               const char* remedy) {
    refuse_member("field.type", "job.fields", path, "the format has no place for a label of cells", expected,
                  base::quoted(column.name) + (column.type == Column::Type::text ? ", texts" : ", integers"), remedy);
}

/// VTK's image data: an array for each field, and what VTK's own probes give besides.
Sink open_vti(const std::string& path, const TableFormat& format, const Grid& grid) {
    std::vector<io::ArrayFormat> arrays;
    for (const TableField& f : format.fields) arrays.push_back({f.name, f.components, io::NumberType::float64});
    if (format.distances) arrays.push_back({"distance", 1, io::NumberType::float64});
    arrays.push_back({"vtkValidPointMask", 1, io::NumberType::int8});
    arrays.push_back({"cell", 1, io::NumberType::int32});
    for (const ColumnFormat& column : format.carried) {
        if (column.type == Column::Type::text)
            refuse_label(column, path, "numbers", "write .csv, or leave the label out of job.fields");
        const bool integer = column.type == Column::Type::integer;
        arrays.push_back({column.name, 1, integer ? io::NumberType::int64 : io::NumberType::float64});
    }
    const std::shared_ptr<io::VtiWriter> file =
        io::VtiWriter::open(path, {grid.counts, grid.origin, grid.spacing}, arrays, format.vtk_data).value();
    const auto write = [file, fields = format.fields, columns = format.columns().size(),
                        numbers = std::vector<double>(),
                        mask = std::vector<std::int8_t>()](const TableView& rows) mutable {
        std::size_t array = 0, first = 0;
        Status done = Done{};
        const auto put = [&](const auto& values) {
            if (done) done = file->write(array++, std::as_bytes(std::span(values)));
        };
        for (const TableField& field : fields) {
            const auto n = static_cast<std::size_t>(field.components);
            if (n == columns) {  // as they stand
                put(rows.values);
                break;
            }
            numbers.resize(n * rows.cells.size());
            for (std::size_t i = 0; i < rows.cells.size(); ++i)
                std::copy_n(&rows.values[columns * i + first], n, &numbers[n * i]);
            put(numbers);
            first += n;
        }
        if (!rows.distances.empty()) put(rows.distances);
        mask.resize(rows.cells.size());
        for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = rows.cells[i] >= 0 ? 1 : 0;
        put(mask);
        put(rows.cells);
        for (const Column& column : rows.carried) {  // texts were refused
            const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
            integers != nullptr ? put(*integers) : put(std::get<std::vector<double>>(column.values));
        }
        return done;
    };
    return jobs::sink_of(write, [file] { return file->commit(); });
}

/// One array of float64, z slowest: its bytes are the values as they come.
Sink open_array(const std::string& path, const Grid& grid, std::size_t columns) {
    std::vector<std::uint64_t> shape(grid.counts.rend() - grid.dimension, grid.counts.rend());
    if (columns > 1) shape.push_back(columns);
    const auto file = std::make_shared<base::OutputFile>(path);
    file->write(io::npy_header_of("'<f8'", shape));
    const auto write = [file](const TableView& rows) {
        file->write({reinterpret_cast<const char*>(rows.values.data()), rows.values.size_bytes()});
        return file->status();
    };
    return jobs::sink_of(write, [file] { return file->commit(); });
}

/// A picture of one column. It is kept in memory: its colours depend on all of it.
Sink open_picture(const ResampleJob& a, const std::string& path, const std::vector<std::string>& columns,
                  const Grid& grid, std::optional<FigureCounts>& counts) {
    // The two axes of a grid in a plane.
    std::vector<std::size_t> axes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (grid.counts[k] > 1 || grid.dimension == 2) axes.push_back(k);
    }
    if (axes.size() != 2)
        refuse_member("picture.too-large", "job.counts", path, "a picture shows one layer",
                      "one point along exactly one axis, such as job.counts 800x600x1",
                      fmt::format("{} points", fmt::join(grid.counts, " x ")),
                      "choose the layer with job.bounds: it lies in the middle of the bounds");
    constexpr std::int64_t max = 1000000;
    const std::size_t w = axes[0], h = axes[1];
    if (grid.counts[w] > max || grid.counts[h] > max)
        refuse_member("picture.too-large", "job.counts", path, "too many points for a picture",
                      "at most 1000000 along each axis", fmt::format("{} x {}", grid.counts[w], grid.counts[h]),
                      "choose a coarser grid");
    if (columns.size() != 1)
        refuse_member("field.component", "job.fields", path, "a picture shows one column",
                      "a field of one component, chosen by job.fields",
                      columns.empty() ? "no field" : fmt::format("{}", fmt::join(columns, ", ")),
                      columns.empty() ? "add one by job.field_files NAME=FILE" : "name one in job.fields");
    FigureGrid picture;
    picture.width = static_cast<std::size_t>(grid.counts[w]);
    picture.height = static_cast<std::size_t>(grid.counts[h]);
    picture.origin = {grid.origin[w], grid.origin[h]};
    if (grid.spacing[w] > 0 && grid.spacing[h] > 0) picture.spacing = {grid.spacing[w], grid.spacing[h]};
    FigureOptions options = a.figure;
    options.axis_names = {std::string{"xyz"[w]}, std::string{"xyz"[h]}};
    if (options.bar_title.empty()) options.bar_title = columns.front();
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (k != w && k != h && options.title.empty() && options.axes != Axes::none)
            options.title = fmt::format("{} = {}", "xyz"[k], base::shortest(grid.origin[k]));
    }
    const auto values = std::make_shared<std::vector<double>>();
    const auto valid = std::make_shared<std::vector<std::uint8_t>>();
    const auto write = [values, valid](const TableView& rows) -> Status {
        values->insert(values->end(), rows.values.begin(), rows.values.end());
        // A point outside is transparent only where it has got no value.
        for (std::size_t i = 0; i < rows.cells.size(); ++i)
            valid->push_back(rows.cells[i] >= 0 || std::isfinite(rows.values[i]) ? 1 : 0);
        return Done{};
    };
    return jobs::sink_of(write, [=, &counts]() mutable {
        picture.values = *values;
        picture.valid = *valid;
        return write_figure(path, {.dimension = 2, .grid = picture, .options = options}, &counts.emplace());
    });
}

/// The other mesh, and what was sampled at its nodes besides its fields.
struct SampledNodes {
    Mesh mesh;
    Field mask{"vtkValidPointMask", 1, {}}, cell{"cell", 1, {}}, distance{"distance", 1, {}};
};

Status write_tetgen_files(const Mesh& mesh, const std::string& path) {
    for (const Field& f : mesh.point_fields) {
        const std::size_t bad = base::first_not_finite(f.data), node = bad / static_cast<std::size_t>(f.components);
        if (bad == f.data.size()) continue;
        return about(
            "job.outside",
            file_error("field.not-finite", path,
                       fmt::format("field \"{}\" is not finite at node {}, counted from 0", f.name, node),
                       "finite attributes: a .node file cannot hold NaN or infinity", "",
                       "choose job.outside nearest, extrapolate or fill=V for nodes outside, or another format"));
    }
    return write_tetgen(mesh, tetgen_stem(path));
}

/// In 2D without a third coordinate.
std::array<double, 3> point_of(const Grid& grid, std::uint64_t i) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]);
    const std::array<std::uint64_t, 3> at{i % nx, i % grid.layer_size() / nx, i / grid.layer_size()};
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k)
        point[k] = grid.coordinate(k, static_cast<std::int64_t>(at[k]));
    return point;
}

/// A sink of the blocks of a grid, in order, whose views have no points: `path`, by its suffix. `picture` gets, with
/// the commit, what became of values. Refused: a format that cannot hold fields or grid.
Sink open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format, const Grid& grid,
                    std::optional<FigureCounts>& picture) {
    const std::vector<std::string> columns = format.columns();
    const bool png = is_figure_name(path), array = base::kind_of(path) == FormatKind::npy;
    if (!format.carried.empty() && (png || array))
        refuse_label(format.carried.front(), path, "fields",
                     "write .csv, or integers to .vti, or leave the label out of job.fields");
    if (png) return open_picture(job, path, columns, grid, picture);
    if (array && columns.empty())
        refuse_member("option.missing", "job.field_files", path, "no field to write", "", "",
                      "add one by job.field_files NAME=FILE; .vti and .csv can be written without fields");
    if (array) return open_array(path, grid, columns.size());
    if (base::kind_of(path) == FormatKind::vti) return open_vti(path, format, grid);
    // With the points of the grid, as rows of points from a file have them.
    const auto add_points = [grid, points = std::vector<double>()](TableView& block) mutable {
        const auto d = static_cast<std::size_t>(grid.dimension);
        points.clear();
        for (std::size_t i = 0; i < block.cells.size(); ++i) {
            const std::array<double, 3> point = point_of(grid, block.first_row + i);
            points.insert(points.end(), point.data(), point.data() + d);
        }
        block.points = points;
    };
    return jobs::changed(jobs::open_rows(path, format), add_points);
}

/// Takes one row a node, and writes the mesh when all is there. Refused: carried columns.
Sink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes) {
    if (!format.carried.empty())
        refuse_member("field.type", "job.fields", path, "a mesh has no labels of nodes", "fields",
                      "label " + base::quoted(format.carried.front().name),
                      "leave labels out of job.fields, or write rows: .csv or .npy");
    const io::MeshFormat kind = io::mesh_output_format(path).value();
    if (kind == io::MeshFormat::tetgen) io::note_lost_names(format.columns(), "a .node", notes);
    mesh.point_fields.clear();
    for (const TableField& f : format.fields) mesh.point_fields.push_back({f.name, f.components, {}});
    const auto of = std::make_shared<SampledNodes>();
    of->mesh = std::move(mesh);
    const auto write = [of](const TableView& rows) -> Status {
        append_rows(rows, of->mesh.point_fields);
        for (const Mesh::Index cell : rows.cells) {
            of->mask.data.push_back(cell >= 0 ? 1 : 0);
            of->cell.data.push_back(cell);
        }
        of->distance.data.insert(of->distance.data.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    };
    return jobs::sink_of(write, [of, path, kind, data = format.vtk_data]() -> Status {
        if (kind == io::MeshFormat::tetgen) return write_tetgen_files(of->mesh, path);
        // Where there is room for what else is known of nodes. Gmsh draws each field: there `cell` stands for the mask.
        std::vector<Field>& fields = of->mesh.point_fields;
        if (!of->distance.data.empty()) fields.push_back(std::move(of->distance));
        if (kind == io::MeshFormat::vtk) fields.push_back(std::move(of->mask));
        fields.push_back(std::move(of->cell));
        return write_mesh(of->mesh, path, {.comment = {}, .data = data});
    });
}

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
        return open_grid_sink(job, path, format, grid, report.picture);
    });
    double writing = 0;
    const bool none_outside = job.options.outside.kind == Outside::error;
    const std::string what = fmt::format("points of {}", grid.point_count());
    const auto sink = [&](const TableView& rows) -> Status {
        const auto outside = none_outside ? std::find(rows.cells.begin(), rows.cells.end(), -1) : rows.cells.end();
        if (outside != rows.cells.end()) {
            const std::uint64_t i = rows.first_row + static_cast<std::uint64_t>(outside - rows.cells.begin());
            const std::array<double, 3> at = point_of(grid, i);
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
                           : mesh_sink(further ? other : std::move(other), path, format, mesh.report.notes);
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
