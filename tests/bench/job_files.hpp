/// The files that bench_job works on, made once and kept: meshes with a linear field and points, in the formats that
/// barycert and VTK read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::bench {

/// Files of one mesh: STEM.node and .ele of tetrahedra, STEM.vtu where VTK is there, and points in STEM-COUNT.npy, .csv
/// and, where VTK is there, .vtp. The field is called attribute0.
struct JobFiles {
    std::string stem;

    std::string vtu() const { return stem + ".vtu"; }
    std::string points(std::size_t count, const char* suffix) const {
        return stem + '-' + std::to_string(count) + suffix;
    }
};

/// The field: 1.5 x + 2.5 y - z, rounded.
double field_at(const double* point);

/// Makes what is missing: the mesh with its field, and uniform random points in its box.
void make_mesh_files(const JobFiles& files, Mesh mesh);
void make_point_files(const JobFiles& files, const Mesh& mesh, std::size_t count);

/// The mesh with one node moved through the facet across from it in one of its cells, so that some cells overlap. All
/// nodes of that cell are inside the box of the mesh.
Mesh with_bad_cells(Mesh mesh);

/// Doubles as they stand in memory.
void write_doubles(const std::string& path, const std::vector<double>& numbers);
std::vector<double> read_doubles(const std::string& path);

/// Reads rows that barycert wrote, .npy or .csv, or VTK to .csv: the coordinates and the field, NaN where the point is
/// outside. In a CSV file it looks for the columns x, y, z, attribute0 and, if the file is VTK's, vtkValidPointMask.
struct ReadRows {
    std::vector<double> points, values;
};
ReadRows read_rows(const std::string& path);

/// Whether VTK's program is there, and the words that call it.
bool with_vtk();
std::vector<std::string> vtk(int threads, const std::string& locator, const std::vector<std::string>& more);

}  // namespace barycert::bench
