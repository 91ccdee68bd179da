/// VTK's judges of a mesh: vtkCellValidator and vtkMeshQuality, both in floating point with tolerances.
#pragma once

#include <memory>
#include <vector>

#include "barycert/mesh.hpp"

class VtkPeers {
public:
    explicit VtkPeers(const barycert::Mesh& mesh);
    ~VtkPeers();

    /// Cells that vtkCellValidator finds something wrong with.
    long count_invalid();

    enum class Quality { aspect, min_angle, radius_ratio };
    /// One measure of vtkMeshQuality for every cell.
    std::vector<double> quality(Quality measure);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};
