/// Series: fields of which there is a file for each step.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/jobs.hpp"

namespace barycert::jobs {

/// At most so many steps stand side by side as columns: they are all in memory.
inline constexpr std::size_t most_steps_of_columns = 256;

/// What the * of its files stands for, or its time in a .pvd file, and the file of each series; or a step of the mesh.
struct Step {
    std::string label;
    std::vector<FieldFile> files = {};
    std::string time = {};                    ///< as text; empty: not known
    std::optional<std::size_t> of_mesh = {};  ///< its number in the series that the mesh is
};

/// The steps of all series of fields of a job in natural order (2 before 10), or that of a .pvd file; where it has
/// none, the steps of its mesh that are to have outputs of their own. A path may end in :COLUMN; of a mesh file the
/// array of the field's name is read without it. Refused: a pattern without exactly one *, or that no file matches;
/// what read_series refuses; a step that not all series have; all steps asked for where there are none, or where the
/// outputs have one name.
std::vector<Step> find_steps(const SamplingJob& job);

/// Whether each step has outputs of its own.
bool has_step_place(const std::string& output);

/// The path with the label of the step in its place.
std::string output_of_step(const std::string& output, const Step& step);

/// Refuses an output of a step that is an input or another output. Precondition: has_step_place(output).
void check_step_outputs(const std::vector<base::NamedFile>& inputs, const std::string& output,
                        const std::vector<Step>& steps);

}  // namespace barycert::jobs
