/// The mesh of a job of sampling with its fields, what finds points in it, and what samples the fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "files/input_file.hpp"
#include "mesh/part.hpp"

namespace barycert::jobs {

/// Whether points are so few that no index of the mesh is worth its while: whether to look at each cell once instead
/// (mesh/locate/cells_at_points.hpp), for so many points in so many cells. The turning point was measured: see
/// NOTES.md.
constexpr bool needs_no_index(std::size_t points, std::size_t cells) {
    return points != 0 && cells >= 20'000 && points <= cells / 100;
}

/// Writes what it does into the job's report. The job must stay, and so must this: sampler and locator use the mesh.
class SampledMesh {
public:
    /// `steps`: of the series of the job. `command`: of the report. `list_grids`: see ReadOptions.
    SampledMesh(const SamplingJob& of, std::vector<Step> all_steps, std::string command, bool list_grids = true);
    SampledMesh(const SampledMesh&) = delete;
    SampledMesh& operator=(const SampledMesh&) = delete;

    const SamplingJob& job;
    const std::vector<Step> steps;
    SampleReport report = {};

    /// Reads the mesh, unless it is given, and the files of fields, and chooses fields.
    void open(std::optional<Mesh> given = {});

    /// Returns the step of the mesh to read for a step: its own if the mesh is the series, else that of the job.
    /// first_step() does so for the first step.
    StepChoice step_of_mesh(const Step& step) const {
        return step.of_mesh ? StepChoice{.number = step.of_mesh} : job.step;
    }
    StepChoice first_step() const { return steps.empty() ? job.step : step_of_mesh(steps.front()); }

    /// The report, when all is done.
    SampleReport finish() {
        report.seconds.total = whole_.lap();
        return std::move(report);
    }

    const Mesh& mesh() const { return mesh_; }

    /// Whether each step has outputs of its own.
    bool step_by_step() const { return !steps.empty() && has_step_place(job.output); }
    bool has_further_steps() const { return step_by_step() && steps.size() > 1; }

    void tell(const std::string& what, std::uint64_t done = 0) const { tell_stage(job, what, done); }

    /// Prepares for points one by one. `all_points`: all that there are, if that is known. Few of them need no index of
    /// the mesh: then it is prepared for these points alone. A second call does nothing.
    void prepare(std::span<const double> all_points = {});

    /// Prepares where no owner is asked of a point alone: they are known, or the cells find their points.
    void prepare_without_search(FoundBy method, const std::string& reason) {
        report.method = method;
        report.reason = reason;
        build(mesh_, fields_, Prove::never);
    }

    /// Requires: prepared.
    const Locator& locator() const { return *locator_; }
    const Sampler& sampler() const { return *sampler_; }

    /// Calls each(output, first, anew) for every step that has an output of its own, else once; `anew`: the mesh is
    /// another than before, and is to be prepared. Refused: a file that cannot be read, or has other numbers of rows
    /// or components than that of the first step. Requires: prepared, after the first call.
    template <class Each>
    void for_outputs(Each each) {
        if (!step_by_step()) return each(job.output, true, true);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (i != 0) tell("steps", i);
            if (i != 0) go_to(steps[i]);
            each(output_of_step(job.output, steps[i]), i == 0, i == 0 || another_mesh_);
        }
    }

    /// Reads the meshes of all steps. Refused: one differs from the first, and `member`, the output `path`, is of one.
    void check_one_mesh(const std::string& path, const char* member);

    /// Frees what sampling does not read again: coordinates, cells, markers of nodes and values of node fields. Does
    /// nothing if cells are of second order, may have maps or are not listed, if points outside need the nearest cell,
    /// or if each step has outputs of its own. Requires: prepared; nobody else reads these parts any more.
    void let_go_of_mesh();

    /// The weights of rows as the locator names their cells, on the nodes of the mesh. Not after let_go_of_mesh().
    NodeWeights weights_of(const TableView& rows) const {
        NodeWeights weights = node_weights(*locator_, rows, job.options.outside).value();
        // Nodes of a part are in the order of the mesh.
        if (!part_) return weights;
        for (Mesh::Index& node : weights.nodes) node = part_->nodes[static_cast<std::size_t>(node)];
        return weights;
    }

    /// Sampled rows name cells as the locator counts them; afterwards, as the mesh does.
    void name_cells(Table& rows) const {
        if (!part_) return;
        for (Mesh::Index& cell : rows.cells) {
            if (cell >= 0) cell = part_->cells[static_cast<std::size_t>(cell)];
        }
    }

    /// The format of this job's rows, without labels.
    TableFormat format() const;

    /// The fields that are sampled.
    const std::vector<FieldChoice>& fields() const { return fields_; }

    /// The labels of cells that the job asked for.
    const std::vector<const Column*>& labels() const { return labels_; }

private:
    Mesh read(const StepChoice& step);
    bool is_another(const Mesh& mesh) const;
    std::string names_of_chosen() const;
    void add_fields_of_job();
    void go_to(const Step& step);
    void read_fields(const Step& step);
    void read_mesh_of(const Step& step);
    void choose_fields();
    std::vector<std::string> names_of_fields() const;
    std::vector<FieldChoice> fields_of_part();
    /// Whether cells may have maps (BuildOptions).
    bool may_be_mapped() const;
    std::optional<std::vector<Mesh::Index>> cells_near(std::span<const double> points);
    void build_sampler(const std::vector<FieldChoice>& fields) {
        sampler_ = Sampler::build(*locator_, fields).value();
        report.columns = sampler_->columns();
    }
    void build(const Mesh& mesh, const std::vector<FieldChoice>& fields, Prove prove);

    const bool list_grids_;
    Stopwatch whole_;
    Mesh mesh_;
    bool another_mesh_ = false;
    std::string names_of_first_;  ///< of the fields that are sampled in the first step
    std::vector<FieldPlace> places_of_series_;
    std::deque<Field> made_;  ///< of fields of the mesh, and for the part
    std::vector<FieldChoice> fields_;
    std::vector<const Column*> labels_;
    std::optional<mesh::Submesh> part_;  ///< what the locator is of, if not the mesh
    std::optional<Locator> locator_;
    std::optional<Sampler> sampler_;
};

/// Whether more than owners and values is asked of a grid: what its nodes and cells must be listed for.
bool needs_listed_grids(const SamplingJob& job);

/// A whole job: its files checked by check(steps), the mesh opened, points sampled by sample(mesh).
template <class Check, class Sample>
Result<SampleReport> sample_mesh(const SamplingJob& job, const char* command, Check check, Sample sample,
                                 bool list_grids = true) try {
    const base::RunFiles files;
    std::vector<Step> steps = find_steps(job);
    check(steps);
    const ThreadLimit limit(job.options.threads);
    SampledMesh mesh(job, std::move(steps), command, list_grids);
    mesh.open();
    sample(mesh);
    return mesh.finish();
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert::jobs
