/// VTK's files, which barycert::vtk reads and writes: it is a library of its own, and readers and writers by suffix
/// find it here once use_vtk_files() was called.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct VtkFiles {
    Result<Mesh> (*read_mesh)(const std::string& path);
    Status (*write_mesh)(const Mesh& mesh, const std::string& path);
    Result<std::vector<double>> (*read_points)(const std::string& path, int dimension);
    Result<std::unique_ptr<TableSink>> (*open_table)(const std::string& path, const TableFormat& format);
};

/// nullptr where there is no VTK.
const VtkFiles* vtk_files();
void set_vtk_files(const VtkFiles* files);

/// What to tell who names a VTK file where there is no VTK.
Error vtk_missing(const std::string& path);

}  // namespace barycert::io
