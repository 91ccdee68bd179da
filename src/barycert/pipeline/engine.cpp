#include "barycert/pipeline/engine.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/locate/cells_at_points.hpp"
#include "barycert/pipeline/cell_labels.hpp"
#include "barycert/pipeline/few_points.hpp"
#include "barycert/pipeline/field_files.hpp"
#include "barycert/predicates.hpp"
#include "barycert/sample/points/field_choice.hpp"

namespace barycert::pipeline {
namespace {

bool is_degenerate(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<const double*, 4> at{};
    for (std::size_t i = 0; i <= d; ++i)
        at[i] = mesh.points.data() + d * static_cast<std::size_t>(mesh.cells[(d + 1) * cell + i]);
    const Sign sign = d == 2 ? orient2d(at[0], at[1], at[2]) : orient3d(at[0], at[1], at[2], at[3]);
    return sign == Sign::zero;
}

std::uint64_t count_degenerate(const Mesh& mesh) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, mesh.cell_count(), 1 << 14), std::uint64_t{0},
        [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t n) {
            for (std::size_t c = range.begin(); c != range.end(); ++c) n += is_degenerate(mesh, c) ? 1 : 0;
            return n;
        },
        std::plus<>());
}

/// Clearing alone would keep the memory.
template <class T>
void give_back(std::vector<T>& numbers) {
    std::vector<T>().swap(numbers);
}

bool gives_distances(const OutsidePolicy& policy) {
    return policy.kind == Outside::nearest || policy.kind == Outside::extrapolate;
}

std::string counted(std::uint64_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// Why points are found by walks, and where not.
std::string reason_of(const Locator& locator, std::uint64_t degenerate, const std::string& program) {
    const std::uint64_t contested = locator.contested_cells();
    if (locator.certified()) return "the mesh is certified";
    if (contested == 0 && degenerate != 0) return "cells meet in common faces; degenerate ones are left out";
    return fmt::format(
        "{} of {} cells may meet others beside common faces, and there other such cells are tested, too; "
        "`{} check` tells more",
        contested, locator.mesh().cell_count(), program);
}

}  // namespace

Result<std::unique_ptr<Engine>> Engine::open(Run& run) {
    Stopwatch watch;
    run.stage("reading " + run.job.mesh);
    const int threads = run.job.options.threads;
    Result<Mesh> mesh = read_mesh(run.job.mesh, {.faces = false, .neighbours = false, .threads = threads});
    if (!mesh) return mesh.error();
    std::unique_ptr<Engine> engine(new Engine(run));
    engine->mesh_ = std::move(*mesh);
    if (Status added = add_fields(run.job.field_files, engine->mesh_); !added) return added.error();
    std::vector<std::string> names = run.job.fields;
    Result<std::vector<const Column*>> of_cells = take_labels(engine->mesh_, names);
    if (!of_cells) return of_cells.error();
    engine->labels_ = std::move(*of_cells);
    // No name at all means every field; labels alone mean none.
    if (engine->labels_.empty() || !names.empty()) {
        Result<std::vector<FieldChoice>> fields = sample::fields_named(engine->mesh_, names);
        if (!fields) return fields.error();
        engine->fields_ = std::move(*fields);
    }
    SampleSummary& summary = run.summary;
    summary.notes = engine->mesh_.notes;
    note_labels(engine->mesh_, run.job.fields, summary.notes);
    summary.dimension = engine->mesh_.dimension;
    summary.nodes = engine->mesh_.point_count();
    summary.cells = engine->mesh_.cell_count();
    summary.seconds.mesh = watch.lap();
    return engine;
}

TableFormat Engine::format() const {
    TableFormat format{mesh_.dimension, sampler_->fields(), gives_distances(run_.job.options.outside)};
    format.vtk_data = run_.job.vtk_data.value_or(VtkData::raw);
    return format;
}

Status Engine::build(bool prove) {
    return build_on(mesh_, fields_, prove);
}

Status Engine::build_on(const Mesh& mesh, const std::vector<FieldChoice>& fields, bool prove) {
    Stopwatch watch;
    BuildOptions options;
    options.prove = prove;
    options.threads = run_.job.options.threads;
    options.progress = [&](const char* stage) { run_.stage(stage); };
    Result<Locator> locator = Locator::build(mesh, options);
    if (!locator) return locator.error();
    locator_.emplace(std::move(*locator));
    Result<Sampler> sampler = Sampler::build(*locator_, fields);
    if (!sampler) return sampler.error();
    sampler_.emplace(std::move(*sampler));
    SampleSummary& summary = run_.summary;
    summary.columns = sampler_->columns();
    if (run_.job.count_degenerate)
        summary.degenerate_cells = prove ? locator_->degenerate_cells() : count_degenerate(mesh);
    summary.seconds.build += watch.lap();
    return Done{};
}

Status Engine::prepare() {
    if (locator_) return Done{};
    if (Status built = build(true); !built) return built;
    SampleSummary& summary = run_.summary;
    summary.method = FoundBy::walk;
    summary.verdict = locator_->certified() ? Verdict::certified : Verdict::not_certified;
    summary.contested_cells = locator_->contested_cells();
    summary.reason = reason_of(*locator_, locator_->degenerate_cells(), run_.job.program);
    return Done{};
}

Status Engine::prepare_for_all(std::span<const double> points) {
    const ExactEnvironment environment;
    const std::size_t count = points.size() / static_cast<std::size_t>(mesh_.dimension), cells = mesh_.cell_count();
    const bool asked = !gives_distances(run_.job.options.outside);
    const bool fit = std::all_of(fields_.begin(), fields_.end(), [&](const FieldChoice& choice) {
        const std::size_t entities = choice.of_cells ? cells : mesh_.point_count();
        return choice.field->data.size() == entities * static_cast<std::size_t>(choice.field->components);
    });
    // What is wrong with fields or points is told by the usual way.
    if (!asked || !needs_no_index(count, cells) || !fit || !base::all_finite(points)) return prepare();
    Stopwatch watch;
    run_.stage("looking for the cells of the points");
    std::optional<std::vector<Mesh::Index>> near;
    locate::in_arena(run_.job.options.threads,
                     [&] { near = locate::cells_at_points(mesh_, points, most_cells(cells)); });
    if (!near) return prepare();
    part_ = mesh::part_of(mesh_, std::move(*near));
    std::vector<FieldChoice> fields;
    part_->mesh.point_fields.reserve(fields_.size());
    part_->mesh.cell_fields.reserve(fields_.size());
    for (const FieldChoice& choice : fields_) {
        auto& of_part = choice.of_cells ? part_->mesh.cell_fields : part_->mesh.point_fields;
        of_part.push_back(part_->field(*choice.field, choice.of_cells));
        fields.push_back({&of_part.back(), choice.of_cells});
    }
    SampleSummary& summary = run_.summary;
    summary.method = FoundBy::pass;
    summary.reason = fmt::format("no index for {}: {} of {} may hold some", counted(count, "point"),
                                 part_->cells.size(), counted(cells, "cell"));
    summary.seconds.build += watch.lap();
    return build_on(part_->mesh, fields, false);
}

void Engine::let_go_of_mesh() {
    if (gives_distances(run_.job.options.outside) || !mesh_.mid_nodes.empty()) return;
    // The index has corners and coordinates in an order of its own, and so has the sampler the values of nodes.
    give_back(mesh_.points);
    give_back(mesh_.cells);
    give_back(mesh_.point_markers);
    for (Field& field : mesh_.point_fields) give_back(field.data);
}

void Engine::name_cells(Table& rows) const {
    if (!part_) return;
    for (Mesh::Index& cell : rows.cells) {
        if (cell >= 0) cell = part_->cells[static_cast<std::size_t>(cell)];
    }
}

Status Engine::prepare_without_search(FoundBy method, const std::string& reason) {
    run_.summary.method = method;
    run_.summary.reason = reason;
    return build(false);
}

}  // namespace barycert::pipeline
