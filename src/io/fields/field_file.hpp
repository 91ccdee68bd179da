/// Fields in files of their own.
#pragma once

#include <string>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// One field from a file of its own: any number of rows, all of as many components.
///
/// Text: a row a line, numbers between blanks, tabs, commas or semicolons, rounded to nearest; nan and inf are taken as
/// they are. Blank lines, and what follows a #, are passed over. With `column`, CSV, whose first line settles the
/// separator as in files of points: the column of that name or number (from 1), or NAME.0, NAME.1, ... NPY (by the
/// suffix): an array of shape (rows,) or (rows, components) of floats or integers, of either byte order and either
/// order of axes; with `column` a field of a structured array, or the number of a column from 1. Errors: a word that is
/// no number; rows of different lengths; an integer that is no double; no such column or array.
Result<Field> read_field_file(const std::string& name, const std::string& path, const std::string& column,
                              Notes& notes);

}  // namespace barycert::io
