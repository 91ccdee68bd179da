#include "app/jobs/stream.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/sampled_mesh.hpp"
#include "barycert/job.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "io/npz/weights_file.hpp"
#include "mesh/columns.hpp"
#include "mesh/locate/batch.hpp"

namespace barycert::jobs {
namespace {

/// Rows whose owners are known, to be sampled again: 29 bytes a row in 3D. Cells are those of the locator.
RowSource rows_again(const std::vector<Table>& known) {
    const auto read = [&known, next = std::size_t{0}](std::size_t, BlockOfRows& block) mutable {
        block.size = next == known.size() ? 0 : known[next].row_count();
        if (block.size != 0) block.rows = known[next++];
    };
    return {.located = true, .counted = true, .read = read};
}

/// Destinations of rows. A map and weights: a file, if not empty; `known`: filled, if not nullptr.
struct Targets {
    std::string path, map = {}, weights = {};
    std::vector<Table>* known = nullptr;
};

class RowStream {
public:
    RowStream(SampledMesh& mesh, const RowSource& source, const OpenRows& open, Targets targets)
        : mesh_(mesh), source_(source), open_(open), targets_(std::move(targets)) {
        options_.threads = 1;  // blocks go side by side
    }

    void go() {
        // The first block tells how to find its points, and all others.
        if (!source_.located) {
            const std::vector<double>& points = blocks_.first().rows.points;
            mesh_.prepare(blocks_.have_more() ? std::span<const double>() : points);
            blocks_.locate_in(mesh_.locator());
        }
        Stopwatch watch;
        open();
        seconds_.write += watch.lap();
        if (targets_.weights.empty()) mesh_.let_go_of_mesh();
        blocks_.run([&](BlockOfRows& block) { work(block); }, [&](BlockOfRows& block) { write(block); });
        watch.lap();
        outputs_.commit();
        seconds_.write += watch.lap();
    }

private:
    void open() {
        outputs_.sink = open_(targets_.path);
        const Mesh& mesh = mesh_.mesh();
        if (!targets_.map.empty())
            outputs_.map = MapWriter::open(targets_.map, mesh, mesh_.report.all, build_options(mesh_.job, 0)).value();
        if (!targets_.weights.empty())
            outputs_.weights = io::WeightsFile::open(targets_.weights, mesh.point_count()).value();
    }

    void work(BlockOfRows& block) const {
        Table& rows = block.rows;
        block.outside.reset();
        if (source_.located) look_outside(block);  // known before anything is computed
        if (block.outside) return;
        if (source_.located)
            mesh_.sampler().evaluate(rows.points, options_, rows, block.first).value();
        else if (mesh_.report.all)
            sample_all(rows);
        else
            mesh_.sampler().sample(rows.points, options_, rows, block.first).value();
        if (block.locations) rows.counts.locations = *block.locations;
        if (targets_.known != nullptr) block.located = rows.cells;
        if (outputs_.weights) block.weights = mesh_.weights_of(rows.view());
        mesh_.name_cells(rows);
        if (!source_.located) look_outside(block);
        block.nan_values = count_nan(rows.view());
    }

    void sample_all(Table& rows) const {
        Table all = mesh_.locator().locate_all(rows.points, options_.threads, options_.nonfinite_points).value();
        for (const Column& column : rows.carried) all.carried.push_back(mesh::repeated(column, all.point_begin));
        rows = std::move(all);
        const LocationCounts locations = rows.counts.locations;
        mesh_.sampler().evaluate(rows.points, options_, rows).value();
        rows.counts.locations = locations;
    }

    void look_outside(BlockOfRows& block) const {
        if (mesh_.job.options.outside.kind != Outside::error) return;
        const Table& rows = block.rows;
        block.outside = locate::first_outside(rows.cells, rows.points, static_cast<std::size_t>(rows.dimension));
    }

    Error refused(const BlockOfRows& block) const {
        const Table& rows = block.rows;
        const auto& begin = rows.point_begin;
        const std::size_t row = *block.outside, d = static_cast<std::size_t>(rows.dimension);
        std::size_t point = row;
        if (!begin.empty()) point = static_cast<std::size_t>(std::ranges::upper_bound(begin, row) - begin.begin()) - 1;
        return outside_error((source_.located ? "row " : "point ") + std::to_string(block.first + point),
                             std::span(rows.points).subspan(d * row, d), mesh_.report.points);
    }

    void write(const BlockOfRows& block) {
        Stopwatch time;
        if (block.outside) throw Exception(refused(block));
        const TableView rows = block.rows.view();
        if (!source_.counted) {
            mesh_.report.counts.add(block.rows.counts);
            mesh_.report.rows += rows.row_count();
        }
        mesh_.report.nan_values += block.nan_values;
        if (targets_.known != nullptr) {
            Table& known = targets_.known->emplace_back();
            known.dimension = block.rows.dimension;
            known.points = block.rows.points;
            known.cells = block.located;
            known.features = block.rows.features;
            known.carried = block.rows.carried;
        }
        outputs_.write(rows, rows.cells, block.weights, numbers_of(rows.cells));
        seconds_.write += time.lap();
        if (!block.last) mesh_.tell(source_.located ? "rows" : "points", block.first + block.size);
    }

    /// The cells as users know them, where the matrix of weights names them.
    std::vector<Mesh::Index> numbers_of(std::span<const Mesh::Index> cells) const {
        std::vector<Mesh::Index> numbers;
        if (!outputs_.weights) return numbers;
        for (const Mesh::Index cell : cells) numbers.push_back(mesh_.mesh().cell_number(cell));
        return numbers;
    }

    SampledMesh& mesh_;
    const RowSource& source_;
    const OpenRows& open_;
    Targets targets_;
    SampleOptions options_ = without_refusal(mesh_.job.options);
    JobSeconds& seconds_ = mesh_.report.seconds;
    BlockPipeline blocks_{source_, mesh_.job.options.threads, seconds_};
    RowOutputs outputs_;
};

}  // namespace

void RowOutputs::write(const TableView& rows, std::span<const Mesh::Index> cells, const NodeWeights& of_nodes,
                       std::span<const Mesh::Index> numbers) {
    if (map) {
        TableView named = rows;
        named.cells = cells;
        map->write(named).value();
    }
    if (weights) {
        std::vector<std::uint8_t> counts(of_nodes.row_count());
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] = static_cast<std::uint8_t>(of_nodes.begin[i + 1] - of_nodes.begin[i]);
        weights->write(counts, of_nodes.nodes, of_nodes.weights, numbers).value();
    }
    if (sink) sink->write(rows).value();
}

void RowOutputs::commit() {
    if (map) map->commit().value();
    if (weights) weights->commit().value();
    if (sink) sink->commit().value();
}

RowSource rows_of_points(std::unique_ptr<PointSource>& points) {
    const auto read = [&points](std::size_t most, BlockOfRows& block) {
        block.rows.dimension = points->dimension();
        block.rows.points.clear();
        block.size = points->read(most, block.rows.points).value();
        points->take_carried(block.rows.carried);
    };
    return {.count = points->count(), .read = read};
}

void sample_rows(SampledMesh& mesh, const RowSource& source, const OpenRows& open, const std::string& map) {
    const bool further = mesh.has_further_steps();
    const std::string& weights = mesh.job.weights;
    if (further && !weights.empty()) mesh.check_one_mesh(weights, "job.weights");
    if (further && weights.empty() && !map.empty()) mesh.check_one_mesh(map, "job.save_map");
    std::vector<Table> known;
    mesh.for_outputs([&](const std::string& output, bool first, bool anew) {
        const Targets targets{.path = output,
                              .map = first ? map : "",
                              .weights = first ? weights : "",
                              .known = anew && further ? &known : nullptr};
        if (anew) known.clear();
        if (anew && !first) source.begin_again(mesh);
        const RowSource again = rows_again(known);
        RowStream(mesh, anew ? source : again, open, targets).go();
    });
}

Error outside_error(const std::string& what, std::span<const double> where, const std::string& file) {
    return about("job.outside",
                 file_error("point.outside", file, what + ", counted from 0, is outside the mesh", "",
                            "(" + base::joined(where, ", ", base::shortest) + ")",
                            "choose what points outside get: job.outside nan, fill=V, nearest or extrapolate"));
}

void refuse_kept(const std::string& name) {
    refuse_member("column.duplicate", "job.keep", "", "a column to keep has the name of another column of the rows", "",
                  base::quoted(name),
                  "name the columns to keep, with another name for this one: job.keep OTHER=" + base::printable(name));
}

std::uint64_t count_nan(const TableView& rows) {
    if (rows.row_count() == 0 || base::all_finite(rows.values)) return 0;
    const std::size_t columns = rows.values.size() / rows.row_count();
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        if (rows.cells[i] < 0) continue;
        for (std::size_t c = 0; c < columns; ++c) count += std::isnan(rows.values[columns * i + c]) ? 1 : 0;
    }
    return count;
}

Sink open_user_rows(SampledMesh& mesh, const std::vector<ColumnFormat>& carried, bool all, const OpenFormat& open) {
    TableFormat format = mesh.format();
    const std::vector<std::string> columns = format.columns();
    std::set<std::string> names(columns.begin(), columns.end());
    mesh.report.carried.clear();
    const auto add = [&](const ColumnFormat& column) {
        format.carried.push_back(column);
        mesh.report.carried.push_back(column.name);
        return !is_name_of_rows(column.name) && names.insert(column.name).second;
    };
    for (const Column* const label : mesh.labels()) {
        if (!add(mesh::format_of(*label)))
            refuse_member("column.duplicate", "job.fields", "", "a label of cells has the name of another column", "",
                          base::quoted(label->name), "leave it, or the other one, out of job.fields");
    }
    const std::set<std::string> of_rows = names;
    std::vector<std::size_t> kept;
    std::vector<std::string> left_out;
    for (std::size_t i = 0; i < carried.size(); ++i) {
        const std::string& name = carried[i].name;
        if (all && (is_name_of_rows(name) || of_rows.contains(name))) {
            left_out.push_back(base::printable(name));
            continue;
        }
        if (!add(carried[i])) refuse_kept(name);
        kept.push_back(i);
    }
    if (!left_out.empty())
        tell_once({{Note::Kind::left_out,
                    fmt::format("columns {}: the rows have columns of these names; job.keep OTHER={} carries one "
                                "through under another name",
                                fmt::join(left_out, ","), left_out.front()),
                    mesh.report.points, false, "job.keep"}},
                  mesh.report);
    Sink sink = open(format);
    // A sink of its own only where users see something else.
    const bool same_columns = left_out.empty() && mesh.labels().empty();
    if (!sink || (same_columns && mesh.mesh().cell_numbers.empty())) return sink;
    const auto as_users_see_them = [&mesh, same_columns, kept, shown = std::vector<Column>(),
                                    cells = std::vector<Mesh::Index>()](TableView& rows) mutable {
        if (!same_columns) {
            shown.clear();
            for (const Column* const labels : mesh.labels()) shown.push_back(mesh::labels_at(*labels, rows.cells));
            for (const std::size_t i : kept) shown.push_back(rows.carried[i]);
            rows.carried = shown;
        }
        if (mesh.mesh().cell_numbers.empty()) return;
        cells.assign(rows.cells.begin(), rows.cells.end());
        for (Mesh::Index& cell : cells) cell = mesh.mesh().cell_number(cell);
        rows.cells = cells;
    };
    return changed(std::move(sink), as_users_see_them);
}

Sink open_rows(const std::string& path, const TableFormat& format) {
    if (path != "-" || isatty(STDOUT_FILENO) != 1) return open_table(path, format).value();
    // Texts on a terminal move no cursor.
    TableFormat shown = format;
    for (TableField& field : shown.fields) field.name = base::printable(field.name);
    for (ColumnFormat& column : shown.carried) column.name = base::printable(column.name);
    Sink sink = open_table(path, shown).value();
    if (shown.carried.empty()) return sink;
    return changed(std::move(sink), [carried = std::vector<Column>()](TableView& rows) mutable {
        carried.assign(rows.carried.begin(), rows.carried.end());
        for (Column& column : carried) {
            auto* const texts = std::get_if<std::vector<std::string>>(&column.values);
            for (std::size_t i = 0; texts != nullptr && i < texts->size(); ++i)
                (*texts)[i] = base::printable((*texts)[i]);
        }
        rows.carried = carried;
    });
}

}  // namespace barycert::jobs
