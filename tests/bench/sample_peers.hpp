/// Others who find cells and interpolate, each behind an interface of plain arrays. All run on one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/mesh.hpp"

namespace barycert::bench {

/// VTK 9: two locators, vtkProbeFilter on points and on an image.
class VtkPeer {
public:
    enum class Which { static_locator, cell_tree };

    virtual ~VtkPeer() = default;

    /// Bytes that malloc has handed out for the locator, besides the mesh.
    virtual std::size_t build(Which which) = 0;
    virtual void drop(Which which) = 0;

    /// FindCell for each point, in their order: -1 where it finds none.
    virtual void find(Which which, std::vector<Mesh::Index>& cells) = 0;
    /// The same for points of the caller.
    virtual void find_all(Which which, std::span<const double> points, std::vector<Mesh::Index>& cells) = 0;
    /// The same as find, and the sum of the weights that FindCell gives times the nodal values; NaN where it finds
    /// none.
    virtual void interpolate(Which which, std::vector<double>& values) = 0;

    /// vtkProbeFilter at the points, which builds its own locator of that kind each time, as it does for its users.
    virtual void probe(Which which) = 0;
    /// vtkProbeFilter onto a vtkImageData of the grid, which needs no locator.
    virtual void probe_image() = 0;
    /// From now on the image has these values, which must stay; and vtkProbeFilter at the points in it.
    virtual void set_image(std::vector<double>& values) = 0;
    virtual void probe_in_image() = 0;
    /// The values of the last probe, NaN where its mask says that there is nothing; empty if the file is empty.
    virtual std::vector<double> probed() const = 0;
};

/// `values`: one a node. Mesh, values and points must outlive it. Only where VTK is there (BARYCERT_WITH_VTK).
std::unique_ptr<VtkPeer> make_vtk_peer(const Mesh& mesh, const std::vector<double>& values,
                                       std::span<const double> points, const Grid& grid);

/// CGAL's Delaunay_triangulation_3 of the nodes of the mesh: its own cells, up to the convex hull.
class CgalPeer {
public:
    explicit CgalPeer(const Mesh& mesh);
    ~CgalPeer();

    void build();
    void drop();
    /// A copy of the points along a space-filling curve (CGAL::spatial_sort).
    void sort(std::span<const double> points);
    /// Locates the sorted points, each from the cell of the one before. Exact.
    void walk();
    /// Locates points in their order, each from the cell of the one before.
    void follow(std::span<const double> points);
    /// The same without hints; and point i from the cell that follow() found last for point hint(i, number of points).
    void find_each(std::span<const double> points);
    void find_each_from(std::span<const double> points, std::size_t (*hint)(std::size_t, std::size_t));
    /// Nodes of the cell found for each point, in the order given to `sort`; -1 if it is outside the hull.
    std::vector<std::array<Mesh::Index, 4>> found() const;
    /// Linear interpolation in the cells found, in plain double; NaN outside the hull.
    void interpolate(const std::vector<double>& nodal, std::vector<double>& values) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// SciPy's LinearNDInterpolator on its own Delaunay triangulation (Qhull), through Python.
struct ScipyRun {
    std::string version = {};
    double build = 0, find = 0, interpolate = 0;  ///< seconds, medians; the first of one run
    std::vector<double> values = {};              ///< NaN outside the hull
    std::string why_not = {};                     ///< if it did not run
};
ScipyRun run_scipy(const Mesh& mesh, const std::vector<double>& nodal, std::span<const double> points, int repetitions);

}  // namespace barycert::bench
