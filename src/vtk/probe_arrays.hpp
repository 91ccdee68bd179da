/// The arrays that a probe gives its output, and how rows of a sampler come into them.
#pragma once

#include "barycert/sampler.hpp"
#include "vtk/exact_index.hpp"

class vtkAbstractArray;
class vtkCharArray;
class vtkDataArray;
class vtkDataSetAttributes;

namespace barycert::in_vtk {

/// Where rows lie: sets the coordinates, on the axes of the mesh, of a row.
using PlaceOfRow = std::function<void(std::size_t row, double* point)>;

/// Which array of the points or cells of `source` has not one tuple for each; `categorical`: or that its point scalars
/// have not one component. Empty if all is well.
std::string fault_of_arrays(vtkDataSet& source, bool categorical);

/// The array of that name or, where that is null, in that role; null if there is none.
vtkAbstractArray* array_in(vtkDataSetAttributes& attributes, const char* name, int role);

/// Gives the array that many tuples, all zero; real numbers are `outside`.
void prepare(vtkAbstractArray& array, vtkIdType tuples, double outside);

class ProbeArrays {
public:
    /// Adds to the point data of `output` the arrays that vtkProbeFilter would, the mask last, without tuples. Copies
    /// the arrays of `source` that are sampled. `categorical`: the scalars are those of the vertex of greatest weight.
    ProbeArrays(const ExactIndex& index, vtkDataSet& source, vtkDataSet& output, bool categorical,
                const char* mask_name);

    /// Gives all of them that many tuples, all zero; real numbers are `outside`.
    void allocate(vtkIdType points, double outside);

    /// The fields to sample, in the order of the columns. They refer to this object.
    std::vector<FieldChoice> choices() const {
        std::vector<FieldChoice> all;
        for (const Field& field : fields_) all.push_back({.field = &field});
        if (!cells_.data.empty()) all.push_back({.field = &cells_, .of_cells = true});
        return all;
    }

    /// Lets points outside have the values of the nearest cell: the last choice is the number of that cell.
    void number_cells() {
        cells_.data.resize(index_.mesh.cell_count());
        for (std::size_t i = 0; i < cells_.data.size(); ++i) cells_.data[i] = static_cast<double>(i);
    }

    /// From now on, owners[point] is set to the cell of the mesh of every point with a value.
    void keep_owners(std::vector<Mesh::Index>& owners) { owners_ = &owners; }

    /// From now on, point i of rows stands in tuple first + i.
    void start_at(vtkIdType first) { first_tuple_ = first; }

    /// Writes rows whose points are ids[row], or first + row if there are no ids.
    void write(const TableView& rows, const vtkIdType* ids, vtkIdType first, const PlaceOfRow& place);

    vtkCharArray* mask() const { return mask_; }
    /// Names of arrays of integers of which some are no doubles: their values are rounded before.
    const std::vector<std::string>& inexact() const { return inexact_; }

private:
    struct Sampled {
        vtkDataArray* to;
        std::size_t field;   ///< in fields_
        std::size_t column;  ///< the first in a row
    };
    struct Copied {
        vtkAbstractArray *from, *to;
    };
    struct ProbedPoint {
        vtkIdType point;
        std::size_t row;
        Mesh::Index cell;
        bool inside;
    };

    void add_point_arrays(vtkDataSet& source, vtkDataSet& output, bool categorical);
    void add_cell_arrays(vtkDataSet& source, vtkDataSet& output);
    Sign side(const Sampled& array, int component, const ProbedPoint& row, const PlaceOfRow& place,
              double threshold) const;
    template <class T, class Set>
    void write_values(const Sampled& array, const TableView& rows, std::size_t stride, const PlaceOfRow& place,
                      const Set& set) const;
    void write_nodes(const PlaceOfRow& place) const;
    void write_cells() const;

    const ExactIndex& index_;
    vtkCharArray* mask_ = nullptr;
    std::vector<Field> fields_;
    Field cells_{"cell", 1, {}};  ///< the number of each cell
    std::vector<Sampled> sampled_;
    std::vector<Copied> nearest_;  ///< of nodes: those of the vertex of greatest weight
    std::vector<Copied> mixed_;    ///< of nodes, no numbers: VTK mixes them by weights
    std::vector<Copied> of_cells_;
    std::vector<vtkAbstractArray*> made_;  ///< all of the above
    std::vector<std::string> inexact_;
    std::vector<Mesh::Index>* owners_ = nullptr;
    vtkIdType first_tuple_ = 0;
    std::vector<ProbedPoint> rows_;  ///< those with a value, of the block that is being written
    std::size_t columns_ = 0;
};

/// Samples the arrays' choices at all points of `input`, outside at the nearest point that is within the tolerance, and
/// writes what is found. Memory for rows does not grow with the number of points.
Status sample_data_set(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, double tolerance,
                       ProbeArrays& arrays);
/// The same on a surface in space: at the nearest point of it, if that is within the tolerance.
Status sample_surface(const ExactIndex& index, vtkDataSet& input, double tolerance, ProbeArrays& arrays);

}  // namespace barycert::in_vtk
