/// Points in, rows out, in every format of the command line; and what can be known of files before the work.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/points/rows.hpp"
#include "barycert/points/source.hpp"
#include "barycert/sample/sample.hpp"
#include "sampling.hpp"

namespace barycert::cli {

/// A file that is written or read, and what the user calls it.
struct NamedFile {
    std::string what, path;
};

/// True if the path ends so, in any case.
bool has_suffix(const std::string& path, std::string_view suffix);

/// The files of a mesh by its path: a VTK file, or TetGen's.
std::vector<NamedFile> files_of_mesh(const std::string& what, const std::string& path);

/// What both subcommands read.
std::vector<NamedFile> inputs_of(const SamplingArguments& arguments);

/// Errors: an output is an input or another output, or cannot be written; an input cannot be read.
Status check_files(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Points of CSV, NPY, .node, and, with VTK, .vtu, .vtp and .vtk files.
Result<std::unique_ptr<points::Source>> open_points(const std::string& path, int dimension);

/// Refuses what open_rows would refuse by its suffix alone.
Status check_rows_format(const std::string& path);

/// Rows to CSV, NPY and, with VTK, .vtu files. `fields` have the columns.
Result<std::unique_ptr<points::Sink>> open_rows(const std::string& path, int dimension,
                                                const std::vector<FieldChoice>& fields,
                                                const std::vector<std::string>& columns, const OutsidePolicy& outside);

}  // namespace barycert::cli
