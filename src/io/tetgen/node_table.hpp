/// Points of a .node file.
#pragma once

#include <string>
#include <vector>

#include "barycert/point_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::io {

/// Points that are in memory, with what their file says of each.
struct PointTable : PointData {
    std::vector<std::string> unread;  ///< columns that nobody asked for, by name
    bool of_nodes = false;            ///< of a .node file
};

/// The nodes of a .node file as points, and the name of the file that was read.
struct NodeTable {
    PointTable points;
    std::string file;
};
NodeTable read_node_table(const std::string& path, int dimension, const PointOptions& options);

}  // namespace barycert::io
