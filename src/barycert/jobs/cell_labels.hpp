/// Labels of cells (Mesh::cell_labels) among the fields that a job names.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// The labels that are named, in their order; they are removed from `names`, in which one text may hold several names,
/// with commas between them. A field goes before a label of its name; cell:NAME may stand for NAME. Errors: a label
/// that is named twice; one that does not fit the mesh; integers among which is the one that stands for "outside".
Result<std::vector<const Column*>> take_labels(const Mesh& mesh, std::vector<std::string>& names);

/// Says which labels there are, if there are some and nothing is named.
void note_labels(const Mesh& mesh, const std::vector<std::string>& names, Notes& notes);

}  // namespace barycert::jobs
