// Fields at points.

#include <fmt/format.h>

#include <set>

#include "app/jobs/profile.hpp"
#include "app/jobs/surface_words.hpp"
#include "barycert/map.hpp"
#include "barycert/surface_locator.hpp"
#include "core/base/finite.hpp"
#include "io/formats.hpp"
#include "io/npz/weights_file.hpp"
#include "io/polygons/triangles.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace {

using jobs::refuse_member;
using jobs::SampledMesh;

void check_job(const SampleJob& job, const std::vector<jobs::Step>& steps) {
    const int given = (job.points.empty() ? 0 : 1) + (job.map.empty() ? 0 : 1) + (job.line ? 1 : 0);
    if (given != 1)
        refuse_member(given == 0 ? ErrorCode("option.missing") : ErrorCode("option.conflict"), "job.points", "",
                      given == 0 ? "no points" : "job.points, job.map and job.line",
                      "one of job.points FILE, job.map FILE and job.line A:B", given == 0 ? "none" : "several",
                      "a map contains its points");
    if (job.line && !(job.columns.empty() && job.keep.empty()))
        refuse_member("option.conflict", "job.line", "",
                      std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.line",
                      "", "", "points of a line have no columns");
    if (!job.plot.empty() && !is_figure_name(job.plot)) jobs::refuse_output(job.plot, ".png, .svg or .pdf");
    if (!job.plot.empty() && (job.all_steps || jobs::has_step_place(job.output)))
        refuse_member("option.conflict", "job.plot", job.plot, "a plot of outputs of steps",
                      "the steps of a field as columns of one output", "",
                      "leave {step} out, and name the field as NAME@PATTERN");
    if (!job.plot.empty() && !job.weights.empty() && job.output.empty())
        refuse_member("option.missing", "job.output", job.plot,
                      "job.weights without job.output takes no fields to plot", "job.output FILE", "none");
    if (!job.map.empty() && !job.save_map.empty())
        refuse_member("option.conflict", "job.save_map", job.save_map, "job.save_map cannot be combined with job.map",
                      "", "", "copy the map");
    if (!job.map.empty() && !(job.columns.empty() && job.keep.empty()))
        refuse_member("option.conflict", "job.map", job.map,
                      std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.map",
                      "", "", "a map has points and cells alone: name the file of the points by job.points");
    if (job.map == "-" || job.save_map == "-")
        refuse_member("option.value", "job.map", "", "a map cannot come from stdin or go to stdout", "", "",
                      "name a file");
    if (job.output.empty() && job.weights.empty() && job.plot.empty())
        refuse_member("option.missing", "job.output", "", "no output",
                      "job.output FILE, job.weights FILE or job.plot FILE", "none");
    if (job.output.empty() && job.plot.empty() &&
        !(job.fields.empty() && job.field_files.empty() && job.series.empty() && job.keep.empty()))
        refuse_member("option.missing", "job.output", "", "fields or columns without job.output", "", "",
                      "weights depend on no field: leave fields out, or name job.output too");
    if (!job.output.empty() && job.output != "-" && !base::has_one_of(job.output, {".csv", ".npy", ".vtu"}))
        jobs::refuse_output(job.output, ".csv, .npy or .vtu, or - for CSV on stdout");
    std::vector<base::NamedFile> inputs;
    if (!job.map.empty()) inputs = {{"job.map", job.map}};
    if (!job.points.empty()) inputs = {{"job.points", job.points}};
    // Not the file itself, but the stem of a mesh.
    if (!job.points.empty() && job.points != "-" && !io::exists(job.points) && !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of job.points", mesh_files(job.points), true);
    jobs::check_files(job, steps, inputs,
                      {{"job.output", job.output}, {"job.save_map", job.save_map}, {"job.plot", job.plot}});
}

/// Rows of a map, which must stay. Rows of one point follow one another, their cells ascending.
jobs::RowSource rows_of_map(MapReader& map) {
    const auto read = [&map, cell = Mesh::Index{-1}, before = std::array<double, 3>()](
                          std::size_t most, jobs::BlockOfRows& block) mutable {
        block.size = map.read(most, block.rows).value();
        LocationCounts& locations = block.locations.emplace();
        const Table& rows = block.rows;
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const double* const at = rows.points.data() + d * i;
            const bool same = cell >= 0 && rows.cells[i] > cell && std::equal(at, at + d, before.begin());
            if (!same) locations.add(rows.features[i]);
            if (!same && !base::all_finite({at, d})) ++locations.not_finite;
            std::copy(at, at + d, before.begin());
            cell = rows.cells[i];
        }
    };
    // The reader tells that the map is of another mesh.
    const auto again = [&map](const SampledMesh& mesh) {
        map = MapReader::open(mesh.report.points, mesh.mesh(), jobs::build_options(mesh.job, 0)).value();
    };
    return {.located = true, .count = map.rows(), .read = read, .begin_again = again};
}

/// The outputs of the job; `carried`: columns of the points.
jobs::OpenRows outputs_of(SampledMesh& mesh, const SampleJob& job, const std::vector<ColumnFormat>& carried) {
    return [&mesh, &job, carried](const std::string& path) {
        const bool all = job.keep == std::vector<std::string>{"all"};
        jobs::Sink rows =
            path.empty() ? jobs::Sink() : open_user_rows(mesh, carried, all, [&](const TableFormat& format) {
                return jobs::open_rows(path, format);
            });
        return job.plot.empty() ? std::move(rows)
                                : jobs::plotted(std::move(rows), job, mesh.format().columns(), mesh.report);
    };
}

/// With the types of columns, unless they go as they are into CSV.
std::unique_ptr<PointSource> points_of(const SampleJob& job, int dimension, NonfinitePoints nonfinite) {
    if (job.line) {
        const std::size_t d = job.line->from.size();
        if (d != static_cast<std::size_t>(dimension) || d != job.line->to.size() || job.line->count < 1)
            refuse_member("option.value", "job.line", job.mesh, "job.line",
                          fmt::format("two points of {} coordinates, and a count of at least 1", dimension),
                          fmt::format("{} and {} coordinates, {} points", d, job.line->to.size(), job.line->count));
        return jobs::points_on(*job.line);
    }
    const bool csv = job.output == "-" || base::has_suffix(job.output, ".csv");
    const PointOptions options{.columns = job.columns, .keep = job.keep, .nonfinite_points = nonfinite, .typed = !csv};
    return open_points(job.points, dimension, options).value();
}

void at_points(SampledMesh& mesh, const SampleJob& job) {
    const auto open = [&] { return points_of(job, mesh.mesh().dimension, job.options.nonfinite_points); };
    jobs::Stopwatch watch;
    std::unique_ptr<PointSource> points = open();
    SampleReport& report = mesh.report;
    report.seconds.read += watch.lap();  // some files are read as a whole, and some twice
    std::ranges::copy(points->notes(), std::back_inserter(report.notes));
    report.points = job.line ? "line" : job.points;
    report.all = job.all.value_or(false);
    jobs::RowSource rows = jobs::rows_of_points(points);
    rows.begin_again = [&](const SampledMesh&) {
        if (io::is_read_once(job.points))
            refuse_member("series.differs", "job.points", job.points,
                          "the mesh changes from step to step, and points of a pipe can be read once", "", "",
                          "save the points to a file, or choose one step: job.step N");
        points = open();
    };
    sample_rows(mesh, rows, outputs_of(mesh, job, points->carried()), job.save_map);
}

void at_points_of_map(SampledMesh& mesh, const SampleJob& job) {
    MapReader map = MapReader::open(job.map, mesh.mesh(), jobs::build_options(job, 0)).value();
    const auto word = [](bool all) { return all ? "all" : "lowest"; };
    if (job.all && *job.all != map.all())
        refuse_member("map.cells", "job.all", job.map, "job.all differs from the map", word(map.all()), word(*job.all),
                      "leave the option out, or save another map");
    mesh.report.from = PointsFrom::map;
    mesh.report.points = job.map;
    mesh.report.all = map.all();
    mesh.prepare_without_search(FoundBy::map, "cells are those of the map");
    sample_rows(mesh, rows_of_map(map), outputs_of(mesh, job, {}));
}

// Fields of a surface at the nearest points of its triangles.

void refuse_what_is_of_meshes(const SampleJob& job) {
    const auto only_meshes = [&](bool given, const char* member) {
        if (given)
            refuse_member("option.unfit", std::string(member), job.mesh, std::string(member) + " is for meshes", "",
                          "a surface", "leave it out");
    };
    only_meshes(job.all.has_value(), "job.all");
    only_meshes(!job.plot.empty(), "job.plot");
    only_meshes(job.all_steps || (io::is_surface_file(job.mesh) && job.step.made()), "job.step");
    only_meshes(!job.series.empty(), "a series of fields");
    only_meshes(job.options.rounding == Rounding::plain, "job.rounding");
    const Outside outside = job.options.outside.kind;
    if (outside != Outside::nan && outside != Outside::nearest)
        refuse_member("option.unfit", "job.outside", job.mesh, "a surface has no inside for job.outside",
                      "nearest, or nearest=DISTANCE", "", "values are those at the nearest point");
}

/// Returns the fields that the job names, in that order; else all.
std::vector<std::pair<const Field*, bool>> chosen_fields(const SampleJob& job, const Surface& s) {
    std::vector<std::pair<const Field*, bool>> all, chosen;
    for (const Field& f : s.point_fields) all.emplace_back(&f, false);
    for (const Field& f : s.cell_fields) all.emplace_back(&f, true);
    if (job.fields.empty()) return all;
    const auto choose = [&](const std::string& name, bool needed) {
        const auto found = std::ranges::find(all, name, [](const auto& f) { return f.first->name; });
        if (found == all.end() && needed)
            refuse_member("field.unknown", "job.fields", job.mesh, "no field of that name",
                          jobs::listed(all, [](const auto& f) { return f.first->name; }), name,
                          "name fields as they are: expressions are for meshes");
        if (found != all.end()) chosen.push_back(*found);
        return found != all.end();
    };
    for (const std::string& text : job.fields) {
        // A name may have commas, too.
        if (!choose(text, false)) sample::for_names(text, [&](const std::string& name) { return choose(name, true); });
    }
    return chosen;
}

/// Points and their nearest points, block after block.
class SurfaceSampling {
public:
    SurfaceSampling(const SampleJob& job, const Surface& surface, double seconds_to_read)
        : job_(job), surface_(surface), inner_edges_(surface), fields_(chosen_fields(job, surface)) {
        report_.command = "sample";
        report_.mesh = job.mesh;
        report_.surface = true;
        report_.reason = "the nearest triangle, and the nearest point of it, are exact";
        report_.output = job.output;
        report_.weights = job.weights;
        report_.points = job.map.empty() ? job.points : job.map;
        report_.nodes = surface.point_count();
        report_.cells = surface.cell_count();
        report_.notes = surface.notes;
        report_.outside = {.kind = Outside::nearest, .fill = 0, .limit = job.options.outside.limit};
        report_.threads = base::threads_of(job.options.threads);
        report_.seconds.mesh = seconds_to_read;
    }

    SampleReport run() {
        open();
        jobs::tell_stage(job_, "sorting triangles");
        const SurfaceLocator locator = SurfaceLocator::build(surface_, {.threads = job_.options.threads}).value();
        jobs::note_sides(locator.sides(), surface_, job_.mesh, report_.notes);
        report_.seconds.build = watch_.lap();
        while (read(locator)) {
            report_.seconds.sample += watch_.lap();
            fill(locator);
            report_.seconds.sample += watch_.lap();
            write();
            report_.seconds.write += watch_.lap();
            report_.rows += cells_.size();
            jobs::tell_stage(job_, "points", report_.rows);
        }
        if (sink_) sink_->commit().value();
        if (save_) save_->commit().value();
        if (weights_) weights_->commit().value();
        report_.seconds.write += watch_.lap();
        const JobSeconds& t = report_.seconds;
        report_.seconds.total = t.mesh + t.build + t.read + t.sample + t.write;
        return std::move(report_);
    }

private:
    static constexpr std::size_t block = std::size_t{1} << 18;
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    void open() {
        TableFormat format{.dimension = 3, .distances = true};
        if (job_.map.empty()) {
            points_ = points_of(job_, 3, job_.options.nonfinite_points);
            std::ranges::copy(points_->notes(), std::back_inserter(report_.notes));
            format.carried = points_->carried();
        } else {
            map_.emplace(MapReader::open(job_.map, surface_).value());
            report_.from = PointsFrom::map;
        }
        for (const auto& [field, of_cells] : fields_) format.fields.push_back({field->name, field->components});
        format.vtk_data = job_.vtk_data.value_or(VtkData::raw);
        report_.columns = format.columns();
        std::set<std::string> names(report_.columns.begin(), report_.columns.end());
        for (const ColumnFormat& column : format.carried) {
            if (jobs::is_name_of_rows(column.name) || !names.insert(column.name).second) jobs::refuse_kept(column.name);
        }
        if (!job_.output.empty()) sink_ = open_table(job_.output, format).value();
        if (!job_.save_map.empty()) save_.emplace(MapWriter::open(job_.save_map, surface_).value());
        if (!job_.weights.empty()) weights_ = io::WeightsFile::open(job_.weights, surface_.point_count()).value();
    }

    /// The next points, and their nearest ones. False after the last.
    bool read(const SurfaceLocator& locator) {
        const int threads = job_.options.threads;
        rows_.points.clear();
        const std::size_t count = map_ ? map_->read(block, rows_).value() : points_->read(block, rows_.points).value();
        if (points_) points_->take_carried(rows_.carried);
        report_.seconds.read += watch_.lap();
        at_ = rows_.points;
        const auto finite = [&](std::size_t i) { return base::all_finite({&rows_.points[3 * i], 3}); };
        for (std::size_t i = 0; i < count; ++i) {
            if (!finite(i)) std::fill_n(&at_[3 * i], 3, 0.0);
        }
        near_.assign(count, {});
        map_ ? locator.nearest_on(rows_.cells, at_, near_, threads).value()
             : locator.nearest(at_, report_.outside.limit, near_, threads).value();
        for (std::size_t i = 0; i < count; ++i) {
            report_.counts.locations.not_finite += finite(i) ? 0 : 1;
            if (!finite(i) || near_[i].distance > report_.outside.limit) near_[i] = {};
        }
        return count != 0;
    }

    void fill(const SurfaceLocator& locator) {
        const int threads = job_.options.threads;
        const std::size_t count = near_.size(), width = report_.columns.size();
        std::vector<SurfaceLocation> places(count);
        if (locator.turned() != Turned::open) locator.locate(at_, places, threads).value();
        cells_.resize(count);
        rows_.features.resize(count);
        rows_.distances.resize(count);
        rows_.values.assign(width * count, nan);
        std::size_t column = 0;
        for (const auto& [field, of_cells] : fields_) {
            const auto components = static_cast<std::size_t>(field->components);
            part_.resize(components * count);
            locator.values(*field, of_cells, at_, near_, part_, threads).value();
            for (std::size_t i = 0; i < count; ++i)
                std::copy_n(&part_[components * i], components, &rows_.values[width * i + column]);
            column += components;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const SurfaceNearest& n = near_[i];
            cells_[i] = surface_.facet(n.cell);
            rows_.features[i] = inner_edges_.feature(n);
            // Negative inside.
            rows_.distances[i] = n.cell < 0 ? nan : places[i].winding != 0 ? -n.distance : n.distance;
            report_.counts.locations.add(n.on ? rows_.features[i] : Feature::outside);
            report_.counts.without_value += n.cell < 0 ? 1 : 0;
            report_.counts.snapped += n.cell >= 0 && !n.on ? 1 : 0;
            if (n.cell >= 0) report_.counts.farthest = std::max(report_.counts.farthest, n.distance);
        }
    }

    void write() {
        TableView view{
            3, report_.rows, rows_.points, cells_, rows_.features, rows_.values, rows_.distances, rows_.carried};
        if (sink_) sink_->write(view).value();
        if (!weights_ && !save_) return;
        std::vector<Mesh::Index> triangles, nodes;
        std::vector<std::uint8_t> counts;
        std::vector<double> weights;
        for (const SurfaceNearest& n : near_) {
            triangles.push_back(n.cell);
            const std::size_t before = nodes.size();
            for (std::size_t k = 0; k < 3 && n.cell >= 0; ++k) {
                if (n.nodes[k] < 0 || n.weights[k] == 0) continue;
                nodes.push_back(n.nodes[k]);
                weights.push_back(n.weights[k]);
            }
            counts.push_back(static_cast<std::uint8_t>(nodes.size() - before));
        }
        if (weights_) weights_->write(counts, nodes, weights, cells_).value();
        view.cells = triangles;
        if (save_) save_->write(view).value();
    }

    const SampleJob& job_;
    const Surface& surface_;
    jobs::InnerEdges inner_edges_;
    std::vector<std::pair<const Field*, bool>> fields_;  ///< and whether of cells
    jobs::Stopwatch watch_;
    SampleReport report_;
    std::unique_ptr<PointSource> points_;
    std::optional<MapReader> map_;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> save_;
    std::unique_ptr<io::WeightsFile> weights_;
    Table rows_;              ///< of the block
    std::vector<double> at_;  ///< the points, those that are not finite as 0
    std::vector<SurfaceNearest> near_;
    std::vector<Mesh::Index> cells_;  ///< as users count them
    std::vector<double> part_;
};

/// Nothing if the mesh is one, or cannot be read as a surface either.
std::optional<Result<SampleReport>> at_surface(const SampleJob& job) try {
    const base::RunFiles run_files;
    const jobs::ThreadLimit limit(job.options.threads);
    jobs::Stopwatch watch;
    const bool sure = io::is_polygons_file(job.mesh);
    const auto check = [&] {
        refuse_what_is_of_meshes(job);
        check_job(job, {});
    };
    if (sure) check();
    Result<std::variant<Mesh, Surface>> read =
        read_mesh_or_surface(job.mesh, {.threads = job.options.threads, .step = job.step});
    if (!read && io::is_surface_file(job.mesh)) return read.error();
    auto* const surface = read ? std::get_if<Surface>(&*read) : nullptr;
    if (surface == nullptr) return std::nullopt;
    if (!sure) check();
    jobs::add_fields(job.field_files, *surface);
    return SurfaceSampling(job, *surface, watch.lap()).run();
} catch (const Exception& problem) {
    return problem.error();
}

}  // namespace

Result<SampleReport> sample_files(const SampleJob& asked) {
    SampleJob job = asked;
    // Accepts all points of a map: they were accepted when it was made.
    if (!job.map.empty()) job.options.nonfinite_points = NonfinitePoints::nan;
    if (io::is_surface_file(job.mesh)) {
        if (const auto surface = at_surface(job)) return *surface;
    }
    Result<SampleReport> sampled = jobs::sample_mesh(
        job, "sample", [&](const auto& steps) { check_job(job, steps); },
        [&](SampledMesh& mesh) { job.map.empty() ? at_points(mesh, job) : at_points_of_map(mesh, job); },
        !(job.map.empty() && job.save_map.empty()) || job.all.value_or(false) || jobs::needs_listed_grids(job));
    if (!sampled && sampled.error().code == "mesh.off-plane") {
        // Triangles off the plane are found when they are read.
        if (const auto surface = at_surface(job)) return *surface;
    }
    return sampled;
}

}  // namespace barycert
