/**
 * @class   vtkBarycertCheck
 * @brief   proves that cells partition their domain, or that a surface is closed and meets itself nowhere
 *
 * Input: a mesh as vtkBarycertLocator takes it, whose cells are checked by the simplices that they are cut into; or a
 * surface: triangles and strips that lie in no plane across an axis, or with other polygons, which are checked as
 * facets of a PLC. Cells of a higher order are taken with straight sides; cells of a lower dimension, empty cells and
 * ghost cells (vtkGhostType: duplicate, refined, hidden) are left out. A data set with cells whose corners are not
 * known is an error. Signs, volumes, contacts and the certificate are exact.
 *
 * Output 0: the input with cell arrays
 * - orientation (exact sign of the volume), volume (signed, correctly rounded; of triangles the area), condition,
 *   radius_edge, aspect, min_angle, max_angle (of dihedral angles, in degrees), as `barycert check` has them; NaN, and
 *   orientation 0, in cells that are left out. Of a cell that is cut: the sum of the parts' volumes, the worst of
 *   other measures, and orientation 0 if parts are turned both ways;
 * - problems: bits of the defects that the cell is part of, in the order of check.hpp (the active scalars); and for
 *   each kind of defect that some cell is part of an array of its name (degenerate_cell, same_side, ...): 1 or 0.
 *   Of a surface there are these alone, and problems has 64 bits;
 * and field data certified (1 or 0) and barycert_check (the report of `barycert check`, line by line). A mesh that is
 * not certified is also told by a warning.
 *
 * Output 1, a vtkTable: a row a defect found, first those that break the certificate: defect, count, at_least (1: there
 * may be more), breaks (1: the mesh is not certified because of it), meaning, remedy, places (the first cells and
 * points, by their ids).
 *
 * Output 2, vtkPolyData: points where cells meet that must not, at most Contacts of them, each a point of both cells
 * (cell_a and cell_b), rounded; overlap is 1 where the interiors meet; exact is 1 where the rounded point lies in both.
 */
#ifndef vtkBarycertCheck_h
#define vtkBarycertCheck_h

#include <vtkDataSetAlgorithm.h>

class vtkPolyData;
class vtkTable;

class vtkBarycertCheck : public vtkDataSetAlgorithm {
public:
    static vtkBarycertCheck* New();
    vtkTypeMacro(vtkBarycertCheck, vtkDataSetAlgorithm)
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// Whether to test also if every interior facet of a mesh is locally Delaunay; the report tells. Off by default.
    vtkSetMacro(Delaunay, vtkTypeBool);
    vtkGetMacro(Delaunay, vtkTypeBool);
    vtkBooleanMacro(Delaunay, vtkTypeBool);

    /// Max number of places listed of each defect: 10 by default.
    vtkSetClampMacro(Examples, int, 0, 1000000);
    vtkGetMacro(Examples, int);

    /// Max number of points of output 2: 20 by default.
    vtkSetClampMacro(Contacts, int, 0, 1000000);
    vtkGetMacro(Contacts, int);

    /// Whether the mesh or surface of the last execution was certified.
    vtkGetMacro(Certified, bool);

    vtkTable* GetDefects();
    vtkPolyData* GetCommonPoints();

protected:
    vtkBarycertCheck() { SetNumberOfOutputPorts(3); }
    ~vtkBarycertCheck() override = default;

    int FillOutputPortInformation(int port, vtkInformation* info) override;
    int RequestDataObject(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
    vtkTypeBool Delaunay = 0;
    int Examples = 10, Contacts = 20;
    bool Certified = false;
};

#endif
