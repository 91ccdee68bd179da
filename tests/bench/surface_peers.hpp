/// VTK's filters that cut a mesh of tetrahedra.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::bench {

/// Triangles with points in doubles.
struct PeerSurface {
    std::vector<double> points;
    std::vector<std::array<long long, 3>> triangles;
};

class SurfacePeers {
public:
    explicit SurfacePeers(const Mesh& mesh);
    ~SurfacePeers();

    /// The field that is cut from now on.
    void set_field(const Field& field);

    // Each cuts and drops what it had before. Points in doubles, no normals, the field carried along.
    void contour_filter(double value);
    /// VTK's fast one for linear cells. Without merging, each triangle has points of its own.
    void linear_grid(double value, bool merge, bool sequential);
    void cutter(const std::array<double, 3>& normal, double offset);
    void plane_cutter(const std::array<double, 3>& normal, double offset);

    /// The result of the last cut.
    PeerSurface surface() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// From now on VTK uses so many threads; returns how it does so, such as "TBB, 2".
std::string use_vtk_threads(int threads);

}  // namespace barycert::bench
