// Fields of a surface at the nearest points of its triangles.

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "barycert/base/arena.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/surface_locator.hpp"

namespace barycert::jobs {
namespace {

void refuse_what_is_of_meshes(const SampleJob& job) {
    const auto only_meshes = [&](bool given, const char* member) {
        if (given) refuse(job.mesh, std::string(member) + " is for meshes", "", "a surface", "leave it out");
    };
    only_meshes(!job.map.empty() || !job.save_map.empty(), "a map");
    only_meshes(!job.weights.empty(), "job.weights");
    only_meshes(job.all.has_value(), "job.all");
    only_meshes(!job.series.empty() || !job.field_files.empty(), "a field from a file of its own");
    only_meshes(job.options.rounding == Rounding::plain, "job.rounding");
    const Outside outside = job.options.outside.kind;
    if (outside != Outside::nan && outside != Outside::nearest)
        refuse(job.mesh, "a surface has no inside for job.outside", "nearest, or nearest=DISTANCE", "",
               "values are those at the nearest point");
}

/// Those that are asked for, in that order; else all.
std::vector<std::pair<const Field*, bool>> chosen_fields(const SampleJob& job, const Surface& s) {
    std::vector<std::pair<const Field*, bool>> all, chosen;
    for (const Field& f : s.point_fields) all.emplace_back(&f, false);
    for (const Field& f : s.cell_fields) all.emplace_back(&f, true);
    if (job.fields.empty()) return all;
    for (const std::string& name : job.fields) {
        const auto found = std::ranges::find(all, name, [](const auto& f) { return f.first->name; });
        if (found == all.end())
            refuse(job.mesh, "no field of that name", listed(all, [](const auto& f) { return f.first->name; }), name);
        chosen.push_back(*found);
    }
    return chosen;
}

Feature feature_of(const SurfaceNearest& n) {
    if (n.cell < 0) return Feature::outside;
    return n.nodes[2] >= 0 ? Feature::face : n.nodes[1] >= 0 ? Feature::edge : Feature::vertex;
}

}  // namespace

SampleReport sample_surface(const SampleJob& job, const Surface& s, double seconds) {
    refuse_what_is_of_meshes(job);
    Stopwatch watch;
    SampleReport report;
    report.command = "sample";
    report.mesh = job.mesh;
    report.surface = true;
    report.reason = "the nearest triangle, and the nearest point of it, are exact";
    report.output = job.output;
    report.points = job.points;
    report.nodes = s.point_count();
    report.cells = s.cell_count();
    report.notes = s.notes;
    report.outside = {.kind = Outside::nearest, .fill = 0, .limit = job.options.outside.limit};
    report.threads = base::threads_of(job.options.threads);
    report.seconds.mesh = seconds;
    const bool csv = job.output == "-" || io::has_suffix(job.output, ".csv");
    const std::unique_ptr<PointSource> points =
        open_points(
            job.points, 3,
            {.columns = job.columns, .keep = job.keep, .nonfinite_points = NonfinitePoints::error, .typed = !csv})
            .value();
    const Notes notes = points->notes();
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    const auto fields = chosen_fields(job, s);
    TableFormat format{.dimension = 3, .distances = true, .carried = points->carried()};
    for (const auto& [field, of_cells] : fields) format.fields.push_back({field->name, field->components});
    format.vtk_data = job.vtk_data.value_or(VtkData::raw);
    report.columns = format.columns();
    const std::unique_ptr<TableSink> sink = open_table(job.output, format).value();
    tell_stage(job, "sorting triangles");
    const SurfaceLocator locator = SurfaceLocator::build(s, {.threads = job.options.threads}).value();
    report.seconds.build = watch.lap();

    const std::size_t width = report.columns.size();
    constexpr std::size_t block = std::size_t{1} << 18;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> at, values, part, distances;
    std::vector<Column> carried;
    for (;;) {
        at.clear();
        const std::size_t count = points->read(block, at).value();
        if (count == 0) break;
        points->take_carried(carried);
        report.seconds.read += watch.lap();
        std::vector<SurfaceNearest> found(count);
        std::vector<SurfaceLocation> places(count);
        locator.nearest(at, report.outside.limit, found, job.options.threads).value();
        if (locator.turned() != Turned::open) locator.locate(at, places, job.options.threads).value();
        std::vector<Mesh::Index> cells(count);
        std::vector<Feature> features(count);
        values.assign(width * count, nan);
        distances.resize(count);
        std::size_t column = 0;
        for (const auto& [field, of_cells] : fields) {
            const auto components = static_cast<std::size_t>(field->components);
            part.resize(components * count);
            locator.values(*field, of_cells, at, found, part, job.options.threads).value();
            for (std::size_t i = 0; i < count; ++i)
                std::copy_n(&part[components * i], components, &values[width * i + column]);
            column += components;
        }
        for (std::size_t i = 0; i < count; ++i) {
            cells[i] = s.facet(found[i].cell);
            features[i] = feature_of(found[i]);
            // Negative inside.
            distances[i] = found[i].cell < 0 ? nan : places[i].winding != 0 ? -found[i].distance : found[i].distance;
            const bool on = found[i].cell >= 0 && found[i].distance == 0;
            report.counts.locations.add(on ? features[i] : Feature::outside);
            report.counts.without_value += found[i].cell < 0 ? 1 : 0;
            report.counts.snapped += found[i].cell >= 0 && !on ? 1 : 0;
            if (found[i].cell >= 0) report.counts.farthest = std::max(report.counts.farthest, found[i].distance);
        }
        report.seconds.sample += watch.lap();
        sink->write({3, report.rows, at, cells, features, values, distances, carried}).value();
        report.seconds.write += watch.lap();
        report.rows += count;
        tell_stage(job, "points", report.rows);
    }
    sink->commit().value();
    report.seconds.write += watch.lap();
    const JobSeconds& t = report.seconds;
    report.seconds.total = t.mesh + t.build + t.read + t.sample + t.write;
    return report;
}

}  // namespace barycert::jobs
