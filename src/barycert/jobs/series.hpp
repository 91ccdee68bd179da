/// Series: fields of which there is a file for each step.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/jobs.hpp"

namespace barycert::jobs {

/// What a path of outputs has where the step is named.
using base::step_place;
using base::time_place;

/// At most so many steps stand side by side as columns: they are all in memory.
inline constexpr std::size_t most_steps_of_columns = 256;

/// One step: what the * of its files stands for, or its time in a .pvd file; and the file of each series, in their
/// order. Or a step of the mesh: its number.
struct Step {
    std::string label;
    std::vector<FieldFile> files = {};
    std::string time = {};                    ///< as text; empty: not known
    std::optional<std::size_t> of_mesh = {};  ///< its number in the series that the mesh is
};

/// The steps of all series of a job in natural order (2 before 10), or that of a .pvd file; none if there is no series.
/// A path may end in :COLUMN; of a mesh file the array of the field's name is read without it. Refused: a pattern
/// without exactly one *, or that no file matches; what read_series refuses; a step that not all series have.
std::vector<Step> find_steps(const std::vector<FieldFile>& series);

/// The same of a job; where it has no series of fields, the steps of its mesh that are to have outputs of their own.
/// Refused: all steps are asked for, and there are none, or no name for an output of each.
std::vector<Step> find_steps(const SamplingJob& job);

/// Whether each step has outputs of its own.
bool has_step_place(const std::string& output);

/// The path with the label of the step in its place.
std::string output_of_step(const std::string& output, const Step& step);

/// The name of a field of one step among those of others: NAME@LABEL.
std::string name_of_step(const std::string& name, const Step& step);

/// Refuses an output of a step that is an input or another output. Precondition: has_step_place(output).
void check_step_outputs(const std::vector<base::NamedFile>& inputs, const std::string& output,
                        const std::vector<Step>& steps);

}  // namespace barycert::jobs
