#include "app/jobs/surface_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/points_of_job.hpp"
#include "app/jobs/stream.hpp"
#include "app/jobs/surface_words.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_locator.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/finite.hpp"
#include "io/npz/weights_file.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::jobs {
namespace {

using FieldOfSurface = std::pair<const Field*, bool>;  ///< and whether of cells

/// Returns the fields that the job names, in that order; else all.
std::vector<FieldOfSurface> chosen_fields(const SampleJob& job, const Surface& s) {
    std::vector<FieldOfSurface> all, chosen;
    for (const Field& f : s.point_fields) all.emplace_back(&f, false);
    for (const Field& f : s.cell_fields) all.emplace_back(&f, true);
    if (job.fields.empty()) return all;
    const auto choose = [&](const std::string& name, bool needed) {
        const auto found = std::ranges::find(all, name, [](const auto& f) { return f.first->name; });
        if (found == all.end() && needed)
            refuse_member("field.unknown", "job.fields", job.mesh, "no field of that name",
                          listed(all, [](const auto& f) { return f.first->name; }), name,
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

/// Nearest points of a block, and what they give its rows. Blocks go side by side: each works on one thread.
class SurfaceRows {
public:
    SurfaceRows(const Surface& surface, const SurfaceLocator& locator, const std::vector<FieldOfSurface>& fields,
                double limit)
        : surface_(surface), locator_(locator), fields_(fields), limit_(limit), inner_edges_(surface) {}

    /// The rows of the block at its points; with `located` they have triangles, as a map has them.
    void fill(BlockOfRows& block, bool located, bool with_weights) const {
        Table& rows = block.rows;
        const auto finite = [&](std::size_t i) { return base::all_finite({&rows.points[3 * i], 3}); };
        std::vector<double> at = rows.points;  // those that are not finite as 0
        rows.counts = {};
        for (std::size_t i = 0; i < block.size; ++i) {
            if (finite(i)) continue;
            std::fill_n(&at[3 * i], 3, 0.0);
            ++rows.counts.locations.not_finite;
        }
        std::vector<SurfaceNearest> near(block.size);
        located ? locator_.nearest_on(rows.cells, at, near, 1).value() : locator_.nearest(at, limit_, near, 1).value();
        for (std::size_t i = 0; i < block.size; ++i) {
            if (!finite(i) || near[i].distance > limit_) near[i] = {};
        }
        fill_values(at, near, rows);
        fill_places(at, near, rows);
        block.located.clear();
        for (const SurfaceNearest& n : near) block.located.push_back(n.cell);
        if (with_weights) block.weights = weights_of(near);
    }

private:
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    void fill_values(const std::vector<double>& at, const std::vector<SurfaceNearest>& near, Table& rows) const {
        std::size_t width = 0, column = 0;
        for (const FieldOfSurface& field : fields_) width += static_cast<std::size_t>(field.first->components);
        rows.values.assign(width * near.size(), nan);
        std::vector<double> part;
        for (const auto& [field, of_cells] : fields_) {
            const auto components = static_cast<std::size_t>(field->components);
            part.resize(components * near.size());
            locator_.values(*field, of_cells, at, near, part, 1).value();
            for (std::size_t i = 0; i < near.size(); ++i)
                std::copy_n(&part[components * i], components, &rows.values[width * i + column]);
            column += components;
        }
    }

    void fill_places(const std::vector<double>& at, const std::vector<SurfaceNearest>& near, Table& rows) const {
        std::vector<SurfaceLocation> places(near.size());
        if (locator_.turned() != Turned::open) locator_.locate(at, places, 1).value();
        rows.cells.resize(near.size());
        rows.features.resize(near.size());
        rows.distances.resize(near.size());
        SampleCounts& counts = rows.counts;
        for (std::size_t i = 0; i < near.size(); ++i) {
            const SurfaceNearest& n = near[i];
            rows.cells[i] = surface_.facet(n.cell);
            rows.features[i] = inner_edges_.feature(n);
            // Negative inside.
            rows.distances[i] = n.cell < 0 ? nan : places[i].winding != 0 ? -n.distance : n.distance;
            counts.locations.add(n.on ? rows.features[i] : Feature::outside);
            counts.without_value += n.cell < 0 ? 1 : 0;
            counts.snapped += n.cell >= 0 && !n.on ? 1 : 0;
            if (n.cell >= 0) counts.farthest = std::max(counts.farthest, n.distance);
        }
    }

    static NodeWeights weights_of(const std::vector<SurfaceNearest>& near) {
        NodeWeights all{.begin = {0}, .nodes = {}, .weights = {}};
        for (const SurfaceNearest& n : near) {
            for (std::size_t k = 0; k < 3 && n.cell >= 0; ++k) {
                if (n.nodes[k] < 0 || n.weights[k] == 0) continue;
                all.nodes.push_back(n.nodes[k]);
                all.weights.push_back(n.weights[k]);
            }
            all.begin.push_back(all.nodes.size());
        }
        return all;
    }

    const Surface& surface_;
    const SurfaceLocator& locator_;
    const std::vector<FieldOfSurface>& fields_;
    double limit_;
    InnerEdges inner_edges_;
};

SampleReport report_of(const SampleJob& job, const Surface& surface) {
    SampleReport report;
    report.command = "sample";
    report.mesh = job.mesh;
    report.surface = true;
    report.reason = "the nearest triangle, and the nearest point of it, are exact";
    report.output = job.output;
    report.weights = job.weights;
    report.points = job.map.empty() ? job.points : job.map;
    report.from = job.map.empty() ? PointsFrom::points : PointsFrom::map;
    report.nodes = surface.point_count();
    report.cells = surface.cell_count();
    report.notes = surface.notes;
    report.outside = {.kind = Outside::nearest, .fill = 0, .limit = job.options.outside.limit};
    report.threads = base::threads_of(job.options.threads);
    return report;
}

/// The columns of the rows. Refused: one of the points that has the name of another.
TableFormat format_of(const SampleJob& job, const std::vector<FieldOfSurface>& fields,
                      std::vector<ColumnFormat> carried, SampleReport& report) {
    TableFormat format{.dimension = 3, .distances = true};
    format.carried = std::move(carried);
    for (const auto& [field, of_cells] : fields) format.fields.push_back({field->name, field->components});
    format.vtk_data = job.vtk_data.value_or(VtkData::raw);
    report.columns = format.columns();
    std::set<std::string> names(report.columns.begin(), report.columns.end());
    for (const ColumnFormat& column : format.carried) {
        if (is_name_of_rows(column.name) || !names.insert(column.name).second) refuse_kept(column.name);
    }
    return format;
}

RowSource rows_of_map(MapReader& map) {
    const auto read = [&map](std::size_t most, BlockOfRows& block) { block.size = map.read(most, block.rows).value(); };
    return {.located = true, .count = map.rows(), .read = read};
}

}  // namespace

SampleReport sample_surface(const SampleJob& job, const Surface& surface, double seconds_to_read) {
    Stopwatch whole, watch;
    SampleReport report = report_of(job, surface);
    report.seconds.mesh = seconds_to_read;
    const std::vector<FieldOfSurface> fields = chosen_fields(job, surface);
    std::unique_ptr<PointSource> points;
    std::optional<MapReader> map;
    std::vector<ColumnFormat> carried;
    if (job.map.empty()) {
        points = points_of(job, 3, job.options.nonfinite_points);
        std::ranges::copy(points->notes(), std::back_inserter(report.notes));
        carried = points->carried();
    } else {
        map.emplace(MapReader::open(job.map, surface).value());
    }
    const TableFormat format = format_of(job, fields, std::move(carried), report);
    RowOutputs outputs;
    if (!job.output.empty()) outputs.sink = open_rows(job.output, format);
    if (!job.save_map.empty()) outputs.map.emplace(MapWriter::open(job.save_map, surface).value());
    if (!job.weights.empty()) outputs.weights = io::WeightsFile::open(job.weights, surface.point_count()).value();
    report.seconds.read += watch.lap();
    tell_stage(job, "sorting triangles");
    const SurfaceLocator locator = SurfaceLocator::build(surface, {.threads = job.options.threads}).value();
    note_sides(locator.sides(), surface, job.mesh, report.notes);
    report.seconds.build = watch.lap();
    const SurfaceRows rows(surface, locator, fields, report.outside.limit);
    const RowSource source = map ? rows_of_map(*map) : rows_of_points(points);
    const auto work = [&](BlockOfRows& block) { rows.fill(block, source.located, outputs.weights != nullptr); };
    const auto write = [&](const BlockOfRows& block) {
        Stopwatch time;
        TableView view = block.rows.view();
        view.first_row = report.rows;
        outputs.write(view, block.located, block.weights, block.rows.cells);
        report.counts.add(block.rows.counts);
        report.rows += block.rows.row_count();
        report.seconds.write += time.lap();
        if (!block.last) tell_stage(job, "points", report.rows);
    };
    BlockPipeline(source, job.options.threads, report.seconds).run(work, write);
    watch.lap();
    outputs.commit();
    report.seconds.write += watch.lap();
    report.seconds.total = seconds_to_read + whole.lap();
    return report;
}

}  // namespace barycert::jobs
