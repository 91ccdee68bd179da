/// VTK's XML files from arrays.
#pragma once

#include <string>
#include <vector>

#include "barycert/io/vtk/out_array.hpp"
#include "barycert/table.hpp"

namespace barycert::io {

/// Arrays below an element such as PointData.
struct OutSection {
    std::string element;
    std::vector<OutArray> arrays;
};

/// A data set of one piece.
struct OutFile {
    std::string data_set;         ///< "UnstructuredGrid"
    std::string attributes = {};  ///< of its element, each with a blank before it
    std::string piece;            ///< attributes of the piece, likewise
    std::vector<OutSection> sections;
};

/// Names must be such that check_arrays passes them. Compressed blocks are made on all threads, and the same for any
/// number of them; memory for some of them is taken, on a pipe or device for all.
Status write_xml(const OutFile& file, const std::string& path, VtkData data);

}  // namespace barycert::io
