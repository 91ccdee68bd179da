/// Meshes cut into pieces, one a rank.
#pragma once

#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/mesh.hpp"
#include "core/base/random.hpp"

class vtkPointData;

namespace barycert::testing {

/// This process's number in the job, and how many there are.
int rank();
int ranks();

enum class Cut {
    slabs,        ///< along x
    backwards,    ///< the same, the last slab on the first rank
    scattered,    ///< every cell on a rank of its own luck
    round_robin,  ///< every next cell on the next rank
    one_rank,     ///< all on the last rank
    half,         ///< on every second rank, slabs
};
constexpr Cut all_cuts[] = {Cut::slabs, Cut::backwards, Cut::scattered, Cut::round_robin, Cut::one_rank, Cut::half};
const char* name(Cut cut);

/// The rank of each cell.
std::vector<int> ranks_of_cells(vtkUnstructuredGrid* whole, Cut cut);

/// The cells of that rank and, as ghosts (vtkGhostType), all others that have a node of theirs, if asked for. Nodes and
/// cells stand in any order. Values are those of the whole, but wrong on ghosts and on nodes that ghosts alone have.
vtkSmartPointer<vtkUnstructuredGrid> piece_of(vtkUnstructuredGrid* whole, const std::vector<int>& ranks, int rank,
                                              bool with_ghosts, base::Random& random);

/// The mesh with point arrays of several types, and cell arrays: numbers beyond doubles, global ids of the cells that
/// ascend with gaps.
vtkSmartPointer<vtkUnstructuredGrid> with_arrays(const Mesh& mesh, double plane = 0);
vtkSmartPointer<vtkUnstructuredGrid> with_arrays(vtkSmartPointer<vtkUnstructuredGrid> grid);

/// A mesh and points, the same on all ranks, and what each has of them.
struct Job {
    Job(Mesh of, int awkward);  ///< so many of each kind of awkward_points
    vtkSmartPointer<vtkUnstructuredGrid> piece(Cut cut, bool with_ghosts = true);

    Mesh mesh;
    vtkSmartPointer<vtkUnstructuredGrid> whole;  ///< with_arrays
    base::Random random{4};
    std::vector<double> points;
    vtkSmartPointer<vtkPolyData> mine;  ///< this rank's share of the points
};

/// A probe that was updated.
template <class Probe>
vtkSmartPointer<Probe> probed(vtkDataObject* source, vtkDataSet* input) {
    const auto probe = vtkSmartPointer<Probe>::New();
    if (source != nullptr) probe->SetSourceData(source);
    probe->SetInputData(input);
    probe->Update();
    return probe;
}

/// Every `ranks`-th point, from number `rank` on.
std::vector<double> share_of(const std::vector<double>& points, int rank, int ranks);

/// Names, types, roles and bytes of all arrays.
void expect_same(vtkPointData* got, vtkPointData* expected);

}  // namespace barycert::testing
