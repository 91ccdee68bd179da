/// A file of points, read in blocks, written as rows and read again.
#pragma once

#include <string_view>

namespace barycert::fuzz {

class InputFile;

/// The first byte of the input: the dimension, what is read of the columns, and whether rows are written as CSV, NPY or
/// VTU. The rest is put into the file.
void read_and_write_points(std::string_view input, InputFile& file);

}  // namespace barycert::fuzz
