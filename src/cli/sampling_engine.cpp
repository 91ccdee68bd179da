#include "sampling_engine.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <functional>

#include "barycert/check.hpp"
#include "barycert/predicates.hpp"
#include "command.hpp"
#include "sampling_fields.hpp"

namespace barycert::cli {
namespace {

/// From so many points a cell on the mesh is checked. On 203,693 cells and one thread the check cost 1.3 to 1.6 us a
/// cell, and a walk saved 1.0 to 1.3 us a point inside: so many points repay it.
constexpr double points_a_cell = 1.25;

bool is_degenerate(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<const double*, 4> at{};
    for (std::size_t i = 0; i <= d; ++i)
        at[i] = mesh.points.data() + d * static_cast<std::size_t>(mesh.cells[(d + 1) * cell + i]);
    const Result<Sign> sign = d == 2 ? orient2d(at[0], at[1], at[2]) : orient3d(at[0], at[1], at[2], at[3]);
    return sign && *sign == Sign::zero;
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

}  // namespace

Result<std::unique_ptr<SamplingEngine>> SamplingEngine::open(const SamplingArguments& a, Progress& progress) {
    Stopwatch watch;
    progress.stage("reading " + a.mesh);
    Result<Mesh> mesh = load_mesh(a.mesh, {.faces = false, .neighbours = false, .threads = a.options.threads});
    if (!mesh) return mesh.error();
    std::unique_ptr<SamplingEngine> engine(new SamplingEngine);
    engine->mesh_ = std::move(*mesh);
    if (Status added = add_fields(a.field_files, engine->mesh_); !added) return added.error();
    Result<std::vector<FieldChoice>> fields = choose_fields(engine->mesh_, a.fields);
    if (!fields) return fields.error();
    engine->fields_ = std::move(*fields);
    engine->certify_ = a.certify;
    engine->threads_ = a.options.threads;
    engine->seconds_mesh_ = watch.lap();
    return engine;
}

void SamplingEngine::check_mesh(Progress& progress) {
    Stopwatch watch;
    CheckOptions options;
    options.threads = threads_;
    options.examples = 0;
    options.contacts = 0;
    options.verdict_only = true;
    options.progress = [&](const char* stage) { progress.stage(fmt::format("checking the mesh: {}", stage)); };
    const CheckReport report = barycert::check_mesh(mesh_, options);
    certificate_ = report.certificate;
    seconds_certify_ += watch.lap();
}

Status SamplingEngine::build(const Certificate& certificate, Progress& progress) {
    Stopwatch watch;
    progress.stage("building the locator");
    sampler_.reset();
    locator_.reset();
    Result<Locator> locator = Locator::build(mesh_, certificate);
    if (!locator) return locator.error();
    locator_.emplace(std::move(*locator));
    Result<Sampler> sampler = Sampler::build(*locator_, fields_);
    if (!sampler) return sampler.error();
    sampler_.emplace(std::move(*sampler));
    seconds_build_ += watch.lap();
    return Done{};
}

Status SamplingEngine::prepare_for(std::uint64_t points, bool at_least, Progress& progress) {
    const bool checked = certificate_.verdict() != Verdict::not_checked;
    const std::size_t cells = mesh_.cell_count();
    const bool pays = static_cast<double>(points) >= points_a_cell * static_cast<double>(cells);
    if (locator_ && (checked || certify_ != Certify::automatic || !pays)) return Done{};
    std::string why =
        certify_ == Certify::always ? "as asked for by --certify always" : "as asked for by --certify never";
    if (certify_ == Certify::automatic)
        why = fmt::format("with {} point{}{} for {} cell{}", points, points == 1 ? "" : "s",
                          at_least ? " and more" : "", cells, cells == 1 ? "" : "s");
    if (certify_ == Certify::never || (certify_ == Certify::automatic && !pays)) {
        reason_ = "the mesh was not checked, " + why + (certify_ == Certify::never ? "" : ": too few to repay it");
        return build({}, progress);
    }
    check_mesh(progress);
    if (Status built = build(certificate_, progress); !built) return built;
    const bool walks = locator_->method() == Method::walk;
    method_ = walks ? FoundBy::walk : FoundBy::candidates;
    reason_ =
        walks ? "the mesh is certified; it was checked, " + why
              : fmt::format("the mesh is not certified: `{} check` tells why; it was checked, {}", command_name(), why);
    return Done{};
}

Status SamplingEngine::prepare_without_search(FoundBy method, const std::string& reason, Progress& progress) {
    method_ = method;
    reason_ = reason;
    if (certify_ == Certify::always) check_mesh(progress);
    return build(certificate_, progress);
}

void SamplingEngine::tell(SampleRun& run) const {
    run.dimension = mesh_.dimension;
    run.nodes = mesh_.point_count();
    run.cells = mesh_.cell_count();
    const bool certified = certificate_.verdict() == Verdict::certified;
    run.degenerate_cells = certified ? 0 : count_degenerate(mesh_);
    if (sampler_) run.columns = sampler_->columns();
    run.method = method_;
    run.reason = reason_;
    run.verdict = certificate_.verdict();
    run.seconds.mesh = seconds_mesh_;
    run.seconds.certify = seconds_certify_;
    run.seconds.build = seconds_build_;
}

}  // namespace barycert::cli
