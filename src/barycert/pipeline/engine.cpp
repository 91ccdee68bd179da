#include "barycert/pipeline/engine.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <functional>
#include <utility>

#include "barycert/io.hpp"
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

bool gives_distances(const OutsidePolicy& policy) {
    return policy.kind == Outside::nearest || policy.kind == Outside::extrapolate;
}

/// Why points are found by walks, and where not.
std::string reason_of(const Locator& locator, std::uint64_t degenerate, const std::string& program) {
    const std::uint64_t contested = locator.contested_cells();
    if (locator.certified()) return "the mesh is certified";
    if (contested == 0 && degenerate != 0) return "cells meet in common faces; degenerate ones are left out";
    return fmt::format(
        "{} of {} cells may meet others beside common faces, and there every candidate is tested; "
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
    Result<std::vector<FieldChoice>> fields = sample::fields_named(engine->mesh_, run.job.fields);
    if (!fields) return fields.error();
    engine->fields_ = std::move(*fields);
    SampleSummary& summary = run.summary;
    summary.dimension = engine->mesh_.dimension;
    summary.nodes = engine->mesh_.point_count();
    summary.cells = engine->mesh_.cell_count();
    summary.seconds.mesh = watch.lap();
    return engine;
}

TableFormat Engine::format() const {
    return {mesh_.dimension, sampler_->fields(), gives_distances(run_.job.options.outside)};
}

Status Engine::build(bool prove) {
    Stopwatch watch;
    BuildOptions options;
    options.prove = prove;
    options.threads = run_.job.options.threads;
    options.progress = [&](const char* stage) { run_.stage(stage); };
    Result<Locator> locator = Locator::build(mesh_, options);
    if (!locator) return locator.error();
    locator_.emplace(std::move(*locator));
    Result<Sampler> sampler = Sampler::build(*locator_, fields_);
    if (!sampler) return sampler.error();
    sampler_.emplace(std::move(*sampler));
    SampleSummary& summary = run_.summary;
    summary.columns = sampler_->columns();
    if (run_.job.count_degenerate)
        summary.degenerate_cells = prove ? locator_->degenerate_cells() : count_degenerate(mesh_);
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

Status Engine::prepare_without_search(FoundBy method, const std::string& reason) {
    run_.summary.method = method;
    run_.summary.reason = reason;
    return build(false);
}

}  // namespace barycert::pipeline
