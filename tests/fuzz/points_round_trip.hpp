/// A file of points, read in blocks, written as rows and read again.
#pragma once

#include <string>

#include "barycert/io.hpp"

namespace barycert::fuzz {

/// All points of a file with what is carried, and what opened it.
struct AllPoints {
    std::vector<double> points;
    std::vector<ColumnFormat> formats;
    std::vector<Column> carried;
};

Result<AllPoints> all_points(const std::string& path, int dimension, const PointOptions& options, std::size_t block);

/// `lines`: of the file. `out`: a file of rows by its suffix, .csv, .npy or .vtu.
void read_and_write_points(const std::string& path, int dimension, const PointOptions& options, std::size_t lines,
                           const std::string& out);

}  // namespace barycert::fuzz
