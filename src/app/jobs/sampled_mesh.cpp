#include "app/jobs/sampled_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "barycert/certificate.hpp"
#include "barycert/environment.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/consistency.hpp"
#include "mesh/locate/cells_at_points.hpp"
#include "mesh/part.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/surface/parts.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::jobs {
namespace {

using sample::gives_distances;

std::uint64_t count_degenerate(const Mesh& mesh) {
    return base::parallel_reduce(
        mesh.cell_count(), 1 << 14, std::uint64_t{0},
        [&](std::size_t begin, std::size_t end, std::uint64_t& count) {
            for (std::size_t c = begin; c != end; ++c) {
                if (surface::orientation(mesh, mesh.cells.data() + mesh.corners() * c) == Sign::zero) ++count;
            }
        },
        [](std::uint64_t& all, std::uint64_t part) { all += part; });
}

/// The name of a field of one step among those of others.
std::string name_of_step(const std::string& name, const Step& step) {
    return name + '@' + step.label;
}

/// Why points are found by walks, and where not.
std::string reason_of(const Locator& locator, std::uint64_t degenerate, bool curved, const std::string& program) {
    const std::uint64_t contested = locator.contested_cells();
    if (!locator.mesh().is_listed()) return "the coordinates along each axis increase";
    if (locator.certified()) return curved ? "the mesh is certified for straight sides" : "the mesh is certified";
    if (contested == 0 && degenerate != 0) return "cells meet in common faces; degenerate ones are left out";
    return fmt::format(
        "{} of {} {} may meet others beside common faces, and there other such cells are tested, too; `{} check` "
        "tells more",
        contested, locator.mesh().cell_count(), locator.mesh().shapes.inside.empty() ? "cells" : "parts of cells",
        program);
}

}  // namespace

bool needs_listed_grids(const SamplingJob& job) {
    const auto asks_for_cells = [](const std::string& field) {
        return field.find("grad(") != std::string::npos || field.find("mean(") != std::string::npos;
    };
    return !job.weights.empty() || gives_distances(job.options.outside) || job.options.rounding == Rounding::plain ||
           std::ranges::any_of(job.fields, asks_for_cells);
}

SampledMesh::SampledMesh(const SamplingJob& of, std::vector<Step> all_steps, std::string command, bool list_grids)
    : job(of), steps(std::move(all_steps)), list_grids_(list_grids) {
    for (const Step& step : steps) {
        report.steps.push_back(step.label);
        if (step.of_mesh) report.times.push_back(base::parse_double(step.time).value_or(0));
    }
    report.command = std::move(command);
    report.output = job.output;
    report.weights = job.weights;
    report.rounding = job.options.rounding;
    report.outside = job.options.outside;
}

void SampledMesh::open(std::optional<Mesh> given) {
    Stopwatch watch;
    if (given) {
        mesh_ = std::move(*given);
        report_curved(job, mesh_, report.curved);
    } else {
        mesh_ = read(first_step());
    }
    add_fields_of_job();
    choose_fields();
    names_of_first_ = names_of_chosen();
    report_mesh(job, mesh_, job.options.threads, report);
    const std::vector<Column>& labels = mesh_.cell_labels;
    if (!labels.empty() && job.fields.empty())
        report.notes.push_back({Note::Kind::left_out,
                                (labels.size() == 1 ? "label of cells " : "labels of cells ") +
                                    listed(labels, &Column::name) +
                                    "; name fields and labels in job.fields to have them",
                                {},
                                false,
                                "job.fields"});
    report.seconds.mesh += watch.lap();
}

Mesh SampledMesh::read(const StepChoice& step) {
    return open_mesh(job, job.options.threads, step, report.curved, list_grids_);
}

void SampledMesh::add_fields_of_job() {
    add_fields(job.field_files, mesh_);
    for (const Step& step : steps) {
        for (FieldInput file : step.files) {
            if (!step_by_step()) file.name = name_of_step(file.name, step);
            places_of_series_.push_back(add_field(std::move(file), mesh_, step_by_step()));
        }
        if (step_by_step()) break;
    }
    give_each_a_name(mesh_);
}

/// Reads what another step has, and samples that from now on.
void SampledMesh::go_to(const Step& step) try {
    Stopwatch watch;
    step.of_mesh ? read_mesh_of(step) : read_fields(step);
    report.seconds.mesh += watch.lap();
    sampler_.reset();
    made_.clear();
    choose_fields();
    if (const std::string names = names_of_chosen(); names != names_of_first_)
        tell_once({{Note::Kind::left_out,
                    fmt::format("in step {} the fields of the first step: there they are {}, here {}", step.label,
                                names_of_first_, names),
                    job.mesh, true}},
                  report);
    if (!another_mesh_) build_sampler(part_ ? fields_of_part() : fields_);
    report.seconds.build += watch.lap();
} catch (const Exception& e) {
    if (!step.of_mesh) throw;
    Error error = e.error();
    error.what = "step " + step.label + ": " + error.what;
    throw Exception(error);
}

bool SampledMesh::is_another(const Mesh& mesh) const {
    return mesh.points != mesh_.points || mesh.cells != mesh_.cells || mesh.mid_nodes != mesh_.mid_nodes ||
           mesh.shapes != mesh_.shapes || mesh.axes != mesh_.axes || mesh.cell_numbers != mesh_.cell_numbers;
}

void SampledMesh::check_one_mesh(const std::string& path, const char* member) {
    for (const Step& step : steps) {
        if (!step.of_mesh || &step == &steps.front() || !is_another(read(step_of_mesh(step)))) continue;
        refuse_member("series.differs", std::string(member), path,
                      "the mesh changes from step to step, and " + std::string(member) + " is of one mesh", "",
                      "another mesh in step " + step.label, "choose one step: job.step N");
    }
}

void SampledMesh::read_mesh_of(const Step& step) {
    Mesh mesh = read(step_of_mesh(step));
    if (mesh.dimension != mesh_.dimension)
        refuse_member("mesh.dimension", "job.step", job.mesh, "step " + step.label + " has cells of another dimension",
                      std::to_string(mesh_.dimension) + ", as the first one has", std::to_string(mesh.dimension));
    another_mesh_ = is_another(mesh);
    if (another_mesh_) {
        sampler_.reset();
        locator_.reset();
        part_.reset();
        ++report.meshes;
        mesh_ = std::move(mesh);
    } else {  // where the locator is, the mesh stays
        mesh_.point_fields = std::move(mesh.point_fields);
        mesh_.cell_fields = std::move(mesh.cell_fields);
        mesh_.cell_labels = std::move(mesh.cell_labels);
        mesh_.notes = std::move(mesh.notes);
    }
    add_fields_of_job();
    tell_once(mesh_.notes, report);
}

void SampledMesh::read_fields(const Step& step) {
    Notes notes;
    for (std::size_t i = 0; i < step.files.size(); ++i) {
        const FieldPlace place = places_of_series_[i];
        Field& field = (place.of_cells ? mesh_.cell_fields : mesh_.point_fields)[place.number];
        FieldInput file = step.files[i];
        file.of = place.of_cells ? FieldFile::Of::cells : FieldFile::Of::points;
        Field read = read_field(mesh_, file, notes);
        if (place.of_cells) by_parts(mesh_, file, read);
        const auto shape = [](const Field& f) {
            const auto components = static_cast<std::size_t>(f.components);
            return fmt::format("{} rows of {}", f.data.size() / components, counted(components, "component"));
        };
        if (read.data.size() != field.data.size() || read.components != field.components)
            refuse("series.differs", step.files[i].path, "the steps of field \"" + step.files[i].name + "\" differ",
                   shape(field) + ", as in the first step", shape(read));
        field.data = std::move(read.data);
    }
    tell_once(std::move(notes), report);
}

/// With columns for all steps, what is asked of a series is asked of each step.
std::vector<std::string> SampledMesh::names_of_fields() const {
    if (step_by_step() || steps.empty()) return job.fields;
    return with_other_names(job.fields, [&](const std::string& text) -> std::optional<std::vector<std::string>> {
        for (const FieldFile& series : steps.front().files) {
            if (!sample::with_other_name(text, series.name, series.name)) continue;
            std::vector<std::string> names;
            for (const Step& step : steps)
                names.push_back(*sample::with_other_name(text, series.name, name_of_step(series.name, step)));
            return names;
        }
        return std::nullopt;
    });
}

void SampledMesh::choose_fields() {
    fields_.clear();
    if (job.output.empty() && !job.weights.empty()) return;
    std::vector<std::string> names = names_of_fields();
    labels_ = take_labels(mesh_, names);
    // No name at all means every field; labels alone mean none.
    if (!labels_.empty() && names.empty()) return;
    fields_ = sample::quantities_named(mesh_, names).value();
    for (const FieldChoice& choice : fields_) count_not_finite(*choice.field, choice.of_cells, report.not_finite);
    // Quantities that depend on all cells, up to the last mean, are made before only some of the cells are looked at.
    for (FieldChoice& choice : fields_) {
        const auto is_mean = [](const QuantityStep& step) { return step.kind == QuantityStep::Kind::mean; };
        const auto last = std::find_if(choice.steps.rbegin(), choice.steps.rend(), is_mean);
        const auto count = static_cast<std::size_t>(choice.steps.rend() - last);
        if (count == 0) continue;
        if (const char* const wrong = mesh::inconsistency_of_cells(mesh_, mesh::FieldValues::any); wrong != nullptr)
            refuse("mesh.inconsistent", job.mesh, std::string("the mesh is inconsistent: ") + wrong);
        sample::make_fields(mesh_, choice, count, made_);
    }
}

std::string SampledMesh::names_of_chosen() const {
    return listed(fields_, [](const FieldChoice& choice) { return base::quoted(sample::name_of(choice)); });
}

TableFormat SampledMesh::format() const {
    TableFormat format{mesh_.dimension, sampler_->fields(), gives_distances(job.options.outside)};
    format.vtk_data = job.vtk_data.value_or(VtkData::raw);
    return format;
}

void SampledMesh::build(const Mesh& mesh, const std::vector<FieldChoice>& fields, Prove prove) {
    Stopwatch watch;
    locator_ = build_locator(job, mesh, job.options.threads, may_be_mapped() ? Prove::at_once : prove);
    report_maps(job, *locator_, report);
    build_sampler(fields);
    if (job.count_degenerate)
        report.degenerate_cells += prove == Prove::never ? count_degenerate(mesh) : locator_->degenerate_cells();
    report.seconds.build += watch.lap();
}

std::vector<FieldChoice> SampledMesh::fields_of_part() {
    std::vector<FieldChoice> fields = fields_;
    for (FieldChoice& choice : fields)
        choice.field = &made_.emplace_back(mesh::rows_of(*choice.field, choice.of_cells ? part_->cells : part_->nodes));
    return fields;
}

void SampledMesh::prepare(std::span<const double> all_points) {
    if (locator_) return;
    if (auto near = cells_near(all_points)) {
        part_ = mesh::part_of(mesh_, std::move(*near));
        report.method = FoundBy::pass;
        report.reason = fmt::format("no index for {}: {} of {} may hold some",
                                    counted(all_points.size() / static_cast<std::size_t>(mesh_.dimension), "point"),
                                    part_->cells.size(), counted(mesh_.cell_count(), "cell"));
        return build(part_->mesh, fields_of_part(), Prove::never);
    }
    build(mesh_, fields_, Prove::at_once);
    report.method = mesh_.is_listed() ? FoundBy::walk : FoundBy::axes;
    report.contested_cells += locator_->contested_cells();
    // The verdict on several meshes is that all are certified, or why one is not.
    if (report.verdict == Verdict::not_certified) return;
    report.verdict = locator_->certified() ? Verdict::certified : Verdict::not_certified;
    report.reason = reason_of(*locator_, locator_->degenerate_cells(),
                              report.curved.cells != 0 && !report.curved.mapped, job.program);
}

bool SampledMesh::may_be_mapped() const {
    const bool curved = report.curved.cells != 0 || std::ranges::any_of(mesh_.shapes.types, mesh::is_curved_simplex);
    return job.cell_interpolation != CellInterpolation::linear || (curved && job.curved != Curved::straight);
}

/// If points are few, the cells that may hold some of them.
std::optional<std::vector<Mesh::Index>> SampledMesh::cells_near(std::span<const double> points) {
    const ExactEnvironment environment;
    const std::size_t count = points.size() / static_cast<std::size_t>(mesh_.dimension), cells = mesh_.cell_count();
    const bool fit = std::ranges::all_of(fields_, [&](const FieldChoice& choice) {
        return mesh::check_field(choice.field, choice.of_cells ? cells : mesh_.point_count(), "").has_value();
    });
    // The usual way reports faults of fields and points.
    if (gives_distances(job.options.outside) || may_be_mapped() || !needs_no_index(count, cells) || !fit ||
        !mesh_.is_listed() || !base::all_finite(points))
        return std::nullopt;
    // If more cells may hold a point, an index is made all the same.
    const std::size_t most = cells / 8;
    Stopwatch watch;
    tell("looking for the cells of the points");
    auto found =
        base::in_arena(job.options.threads, cells, [&] { return locate::cells_at_points(mesh_, points, most); });
    report.seconds.build += watch.lap();
    return found;
}

void SampledMesh::let_go_of_mesh() {
    if (gives_distances(job.options.outside) || !mesh_.mid_nodes.empty() || step_by_step() || may_be_mapped() ||
        !mesh_.is_listed())
        return;
    // The index has corners and coordinates in an order of its own, and so has the sampler the values of nodes.
    // Clearing alone would keep the memory.
    mesh_.points = std::vector<double>();
    mesh_.cells = std::vector<Mesh::Index>();
    mesh_.point_markers = std::vector<std::int64_t>();
    for (Field& field : mesh_.point_fields) field.data = std::vector<double>();
}

}  // namespace barycert::jobs
