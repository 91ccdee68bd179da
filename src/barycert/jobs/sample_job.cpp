// Fields at points.

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/base/finite.hpp"
#include "barycert/base/input_file.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/jobs/user_rows.hpp"
#include "barycert/map.hpp"

namespace barycert {
namespace {

using jobs::SampledMesh;

Status check_job(const SampleJob& job, const std::vector<jobs::Step>& steps) {
    if (job.points.empty() == job.map.empty())
        return Error{.what = job.points.empty() ? "no points" : "job.points and job.map",
                     .expected = "one of job.points FILE and job.map FILE",
                     .found = job.points.empty() ? "neither" : "both",
                     .remedy = "a map contains its points"};
    if (!job.map.empty() && !job.save_map.empty())
        return Error{
            .what = "job.save_map cannot be combined with job.map", .file = job.save_map, .remedy = "copy the map"};
    if (!job.map.empty() && !(job.columns.empty() && job.keep.empty()))
        return Error{
            .what = std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.map",
            .file = job.map,
            .remedy = "a map has points and cells alone: name the file of the points by job.points"};
    if (job.map == "-" || job.save_map == "-")
        return Error{.what = "a map cannot come from stdin or go to stdout", .remedy = "name a file"};
    if (job.output.empty()) {
        if (job.weights.empty())
            return Error{
                .what = "no output", .expected = "job.output FILE, job.weights FILE, or both", .found = "neither"};
        if (!job.fields.empty() || !job.field_files.empty() || !job.series.empty() || !job.keep.empty())
            return Error{.what = "fields or columns without job.output",
                         .remedy = "weights depend on no field: leave fields out, or name job.output too"};
    } else if (Status known = jobs::check_rows_format(job.output); !known) {
        return known;
    }
    std::vector<base::NamedFile> inputs{{"job.map", job.map}};
    if (job.map.empty()) inputs = {{"job.points", job.points}};
    std::error_code ignored;
    // Not the file itself, but the stem of a mesh.
    if (job.map.empty() && job.points != "-" && !std::filesystem::exists(job.points, ignored) &&
        !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of job.points", mesh_files(job.points));
    return jobs::check_files(job, steps, inputs, {{"job.output", job.output}, {"job.save_map", job.save_map}});
}

/// Points of a file, which a step with another mesh reads again.
class PointsOfFile final : public jobs::PointRows {
public:
    static Result<std::unique_ptr<PointSource>> open(const SampleJob& job, const Mesh& mesh) {
        const bool csv = job.output == "-" || io::has_suffix(job.output, ".csv");
        return open_points(job.points, mesh.dimension,
                           {.columns = job.columns,
                            .keep = job.keep,
                            .nonfinite_points = job.options.nonfinite_points,
                            .typed = !csv});
    }
    PointsOfFile(const SampleJob& job, std::unique_ptr<PointSource> points) : PointRows(std::move(points)), job_(job) {}

    Status begin_again(const SampledMesh& mesh) override {
        std::error_code ignored;
        if (job_.points == "-" || std::filesystem::is_fifo(job_.points, ignored))
            return Error{.what = "the mesh changes from step to step, and points of a pipe can be read once",
                         .file = job_.points,
                         .remedy = "save the points to a file, or choose one step: job.step N"};
        auto again = open(job_, mesh.mesh());
        if (!again) return again.error();
        points_ = std::move(*again);
        return Done{};
    }

private:
    const SampleJob& job_;
};

/// Rows of a map. Those of one point follow one another, their cells ascending.
class MapRows final : public jobs::RowSource {
public:
    explicit MapRows(MapReader map) : map_(std::move(map)) {}

    bool located() const override { return true; }
    std::optional<std::uint64_t> count() const override { return map_.rows(); }
    Status read(std::size_t most, jobs::Block& block) override {
        const Result<std::size_t> count = map_.read(most, block.rows);
        if (!count) return count.error();
        block.size = *count;
        return Done{};
    }
    /// The reader tells that the map is of another mesh.
    Status begin_again(const SampledMesh& mesh) override {
        auto map = MapReader::open(mesh.report.points, mesh.mesh());
        if (!map) return map.error();
        map_ = std::move(*map);
        return Done{};
    }
    void count(const jobs::Block& block, SampleReport& report) override {
        SampleCounts counts = block.rows.counts;
        counts.locations = {};
        const TableView rows = block.rows.view();
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const double* const at = rows.points.data() + d * i;
            const bool same = cell_ >= 0 && rows.cells[i] > cell_ && std::equal(at, at + d, at_.begin());
            if (!same) counts.locations.add(rows.features[i]);
            if (!same && !base::all_finite({at, d})) ++counts.locations.not_finite;
            std::copy(at, at + d, at_.begin());
            cell_ = rows.cells[i];
        }
        report.counts.add(counts);
        report.rows += block.size;
    }

private:
    MapReader map_;
    Mesh::Index cell_ = -1;
    std::array<double, 3> at_{};
};

/// The outputs of the job; `carried`: columns of the points.
class SampleOutput final : public jobs::RowsOutput {
public:
    SampleOutput(SampledMesh& mesh, const SampleJob& job, std::vector<ColumnFormat> carried)
        : mesh_(mesh), job_(job), carried_(std::move(carried)) {}

    Result<std::unique_ptr<TableSink>> open(const TableFormat& format, const std::string& path) override {
        if (path.empty()) return std::unique_ptr<TableSink>();
        jobs::KeptColumns kept{{}, carried_, {}};
        if (job_.keep == std::vector<std::string>{"all"}) kept = keep_all(mesh_, format, carried_, job_.points);
        Notes& notes = mesh_.report.notes;
        for (Note& left : kept.left_out) {
            if (std::find(notes.begin(), notes.end(), left) == notes.end()) notes.push_back(std::move(left));
        }
        const Result<TableFormat> shown = user_format(mesh_, format, kept.columns);
        if (!shown) return shown.error();
        auto sink = jobs::open_rows(path, *shown);
        if (!sink) return sink;
        return user_rows(mesh_, std::move(*sink), kept.kept);
    }

private:
    SampledMesh& mesh_;
    const SampleJob& job_;
    std::vector<ColumnFormat> carried_;
};

Status at_points(SampledMesh& mesh, const SampleJob& job) {
    jobs::Stopwatch watch;
    auto points = PointsOfFile::open(job, mesh.mesh());
    if (!points) return points.error();
    SampleReport& report = mesh.report;
    report.seconds.read += watch.lap();  // some files are read as a whole, and some twice
    const Notes notes = (*points)->notes();
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    report.points = job.points;
    report.all = job.all.value_or(false);
    SampleOutput output(mesh, job, (*points)->carried());
    PointsOfFile rows(job, std::move(*points));
    return sample_rows(mesh, rows, output, job.save_map);
}

Status at_points_of_map(SampledMesh& mesh, const SampleJob& job) {
    auto map = MapReader::open(job.map, mesh.mesh());
    if (!map) return map.error();
    if (job.all && *job.all != map->all())
        return Error{.what = "job.all differs from the map",
                     .file = job.map,
                     .expected = map->all() ? "all" : "lowest",
                     .found = *job.all ? "all" : "lowest",
                     .remedy = "leave the option out, or save another map"};
    mesh.report.from = PointsFrom::map;
    mesh.report.points = job.map;
    mesh.report.all = map->all();
    if (Status ready = mesh.prepare_without_search(FoundBy::map, "cells are those of the map"); !ready) return ready;
    SampleOutput output(mesh, job, {});
    MapRows rows(std::move(*map));
    return sample_rows(mesh, rows, output);
}

}  // namespace

Result<SampleReport> sample_files(const SampleJob& asked) {
    const base::RunFiles files;
    SampleJob job = asked;
    // What a map holds was let in when it was made.
    if (!job.map.empty()) job.options.nonfinite_points = NonfinitePoints::nan;
    auto steps = jobs::find_steps(job);
    if (!steps) return steps.error();
    if (Status ok = check_job(job, *steps); !ok) return ok.error();
    const jobs::ThreadLimit limit(job.options.threads);
    SampledMesh mesh(job, std::move(*steps), "sample");
    Status done = mesh.open();
    if (done) done = job.map.empty() ? at_points(mesh, job) : at_points_of_map(mesh, job);
    if (!done) return done.error();
    return mesh.finish();
}

}  // namespace barycert
