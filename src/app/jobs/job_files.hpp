/// How all jobs open their meshes and fields, and what can be known of their files before the work. Errors within a job
/// are thrown as Exceptions: its public function returns the Error.
#pragma once

#include <tbb/global_control.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "files/named_file.hpp"

namespace barycert::jobs {

/// Seconds since it was made or last asked.
class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> time = now - last_;
        last_ = now;
        return time.count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// While it lives, no more threads than these; 0: as many as the machine has.
struct ThreadLimit {
    explicit ThreadLimit(int threads) {
        if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }
    std::optional<tbb::global_control> limit;
};

/// Throws a file_error of these parts: in the order of the message; empty ones are left out.
template <class... Parts>
[[noreturn]] void refuse(ErrorCode code, Parts&&... parts) {
    throw Exception(file_error(code, std::forward<Parts>(parts)...));
}

/// The same about a member of the job, as "job.points". Texts that name members are those of such an error.
template <class... Parts>
[[noreturn]] void refuse_member(ErrorCode code, std::string member, Parts&&... parts) {
    throw Exception(about(std::move(member), file_error(code, std::forward<Parts>(parts)...)));
}

/// text(item) of each, with commas between them.
template <class Items, class Text>
std::string listed(const Items& items, Text text, const char* if_empty = "none") {
    return items.empty() ? if_empty : base::joined(items, ", ", text);
}

using base::counted;

// Series: fields of which there is a file for each step.

/// A step of series: what the * of their files stands for, or the time in a .pvd file, and the file of each series; or
/// a step of the mesh.
struct Step {
    std::string label;
    std::vector<FieldInput> files = {};
    std::string time = {};                    ///< as text; empty: not known
    std::optional<std::size_t> of_mesh = {};  ///< its number in the series that the mesh is
};

/// The steps of all series of fields of a job in natural order (2 before 10), or that of a .pvd file; where it has
/// none, the steps of its mesh that are to have outputs of their own. A path may end in :COLUMN; of a mesh file the
/// array of the field's name is read without it. Refused: a pattern that matches no file, or has not one *; a step that
/// not all series have; all steps where there are none, or one output.
std::vector<Step> find_steps(const SamplingJob& job);

inline bool has_step_place(const std::string& output) {
    return output.find(base::step_place) != std::string::npos || output.find(base::time_place) != std::string::npos;
}
std::string output_of_step(const std::string& output, const Step& step);

inline void tell_stage(const MeshJob& job, const std::string& what, std::uint64_t done = 0) {
    if (job.progress) job.progress({.stage = what, .done = done});
}

/// Takes the cells of the mesh as straight, as far as the job lets it: `curved` says which are not.
void report_curved(const MeshJob& job, const Mesh& mesh, CurvedCells& curved);

ReadOptions read_options(int threads, const StepChoice& step, bool list_grids);

/// Reads the mesh of the job, and reports which of its cells are curved.
Mesh open_mesh(const MeshJob& job, int threads, const StepChoice& step, CurvedCells& curved, bool list_grids = true);

/// The same at the step of the job, with the fields from files.
Mesh open_mesh_with_fields(const MeshJob& job, int threads, MeshReport& report);

void report_mesh(const MeshJob& job, const Mesh& mesh, int threads, MeshReport& report);

/// Notes in the report what is not there yet.
void tell_once(Notes notes, MeshReport& report);

/// Whether curved cells are taken by their maps; notes where cells are straight or linear though maps are asked for.
inline void report_maps(const MeshJob& job, const Locator& locator, MeshReport& report) {
    report.curved.mapped = locator.has_curved_cells();
    tell_once(notes_of_maps(locator, job.cell_interpolation, job.mesh), report);
}

BuildOptions build_options(const MeshJob& job, int threads, Prove prove = Prove::at_once);
inline Locator build_locator(const MeshJob& job, const Mesh& mesh, int threads, Prove prove = Prove::at_once) {
    return Locator::build(mesh, build_options(job, threads, prove)).value();
}

/// Returns the files of the mesh and of fields, then `more`. Each VTK file is followed by the files that it names.
std::vector<base::NamedFile> input_files(const MeshJob& job, const std::vector<base::NamedFile>& more = {});

/// The outputs and the reports of the job, held against the inputs by base::check_outputs.
inline void check_outputs(const MeshJob& job, const std::vector<base::NamedFile>& inputs,
                          std::vector<base::NamedFile> outputs) {
    for (const auto& [what, path] : job.reports) outputs.push_back({what, path});
    base::check_outputs(inputs, std::move(outputs)).value();
}

/// Checks, before the work, what can be known of the files of a job with those outputs and, besides the mesh and
/// fields, those inputs. `unread`: inputs, too, but their readers tell what is wrong with them. Error: an output that
/// is an input or another output, or cannot be written; an input that cannot be read.
void check_files(const MeshJob& job, std::vector<base::NamedFile> more_inputs, std::vector<base::NamedFile> outputs,
                 const std::vector<base::NamedFile>& unread = {});

/// The same of sampling, where job.output may be a file for each step. Refused also: more steps than can be columns.
void check_files(const SamplingJob& job, const std::vector<Step>& steps, std::vector<base::NamedFile> more_inputs,
                 std::vector<base::NamedFile> outputs);

/// Refuses a choice of data for an output that is no file of VTK, and one that its format does not know.
void check_vtk_data(std::optional<VtkData> data, const std::string& path);

/// Refuses an output whose suffix is none of those `expected`.
[[noreturn]] void refuse_output(const std::string& path, const std::string& expected);

}  // namespace barycert::jobs
