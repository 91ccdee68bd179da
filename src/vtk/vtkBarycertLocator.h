/**
 * @class   vtkBarycertLocator
 * @brief   exact point location in meshes of any cells, and on surfaces
 *
 * FindCell returns the lowest id of all cells that contain the point exactly: neither the order of points nor the
 * number of threads nor a tolerance matters, and a point of the mesh is always found. Weights are those of all nodes of
 * the cell, in its order, each the exact one rounded once. Parametric coordinates of tetrahedra and triangles are
 * those of their nodes by these weights; of other cells those of their own EvaluatePosition, in double, with the subId.
 *
 * Data sets: any vtkDataSet. Cells are those that fill space; if there are none, the polygons: a mesh if they lie in
 * one plane across an axis, else a surface in space. Cells that are no simplices are cut into such, each cell and face
 * from its node of lowest number (Interpolation); of order 2 to 4 simplices are curved (CurvedCells), other cells are
 * taken by their corners, after a warning, and so are surfaces in space. Cells of a lower dimension, empty cells and
 * ghost cells (vtkGhostType: duplicate, refined, hidden) are no cells to FindCell and FindClosestPoint, nor are
 * triangles of zero area. A data set with cells whose corners are not known (convex point sets, parametric ones), or
 * with points that are not finite, is an error, and nothing is found: GetExact() is false then.
 *
 * FindClosestPoint and its variants are exact as well: the cell is the lowest of those nearest, and `inside` is 1 if
 * the point lies in it. Outside of curved and multilinear cells it is the nearest point of their sides. So is
 * IntersectWithLine on a surface, unless Tolerant: it has no tolerance, and gives what the closed segment meets, in
 * exact order, ties by cell; t is rounded once, and point and parametric coordinates are computed from it.
 * FindCellsWithinBounds, FindCellsAlongLine, FindCellsAlongPlane, GenerateRepresentation and all other
 * IntersectWithLine are those of vtkStaticCellLocator on all cells of the data set.
 *
 * Indexes are kept by data set and time of modification until the data set is deleted. So the instances that filters
 * make of a prototype for every execution build nothing twice. Instances have the settings of their prototype.
 *
 * Any number of threads may call FindCell, FindClosestPoint and FindClosestPointWithinRadius at the same time, each
 * with its own vtkGenericCell, and the variants without one; of the other methods, those that take a vtkGenericCell.
 *
 * For VTK 9.1 and 9.2: what is virtual here without override is an override there.
 */
#ifndef vtkBarycertLocator_h
#define vtkBarycertLocator_h

#include <memory>
#include <string>

#include <vtkAbstractCellLocator.h>

class vtkBarycertLocator : public vtkAbstractCellLocator {
public:
    static vtkBarycertLocator* New();
    vtkAbstractTypeMacro(vtkBarycertLocator, vtkAbstractCellLocator)
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// Off (the default): FindCell is exact and ignores its tolerance. On: a point outside all cells, but within the
    /// tolerance of one (tol2 is its square), is given to the nearest, with the weights of the nearest point.
    vtkSetMacro(Tolerant, bool);
    vtkGetMacro(Tolerant, bool);
    vtkBooleanMacro(Tolerant, bool);

    /// Interpolation in hexahedra, voxels, wedges, pyramids, quadrilaterals and pixels. PULLING (the default): their
    /// functions are linear on the simplices that they are cut into, and weights are 0 at the nodes of all but the one
    /// that holds the point. MULTILINEAR: they have their own isoparametric functions, and the sides that these give
    /// them.
    enum { PULLING = 0, MULTILINEAR = 1 };
    vtkSetClampMacro(Interpolation, int, PULLING, MULTILINEAR);
    vtkGetMacro(Interpolation, int);

    /// Triangles and tetrahedra of a higher order: as their maps have them (the default), with straight sides, or an
    /// error.
    enum { ISOPARAMETRIC = 0, STRAIGHT = 1, REFUSE = 2, EXACT = 3 };
    vtkSetClampMacro(CurvedCells, int, ISOPARAMETRIC, EXACT);
    vtkGetMacro(CurvedCells, int);

    /// Whether points can be located in the data set. Builds the locator if that was not done.
    bool GetExact();
    /// Why they cannot, or an empty string.
    std::string GetReason();

    vtkIdType FindCell(double x[3]) override;
    vtkIdType FindCell(double x[3], double tol2, vtkGenericCell* cell, double pcoords[3], double* weights) override {
        int sub_id = 0;
        return FindCell(x, tol2, cell, sub_id, pcoords, weights);
    }
    virtual vtkIdType FindCell(double x[3], double tol2, vtkGenericCell* cell, int& subId, double pcoords[3],
                               double* weights);

    void FindClosestPoint(const double x[3], double closestPoint[3], vtkIdType& cellId, int& subId,
                          double& dist2) override {
        FindClosestPoint(x, closestPoint, nullptr, cellId, subId, dist2);
    }
    void FindClosestPoint(const double x[3], double closestPoint[3], vtkGenericCell* cell, vtkIdType& cellId,
                          int& subId, double& dist2) override;
    vtkIdType FindClosestPointWithinRadius(double x[3], double radius, double closestPoint[3], vtkIdType& cellId,
                                           int& subId, double& dist2) override {
        int inside = 0;
        return FindClosestPointWithinRadius(x, radius, closestPoint, nullptr, cellId, subId, dist2, inside);
    }
    using vtkAbstractCellLocator::FindClosestPointWithinRadius;
    vtkIdType FindClosestPointWithinRadius(double x[3], double radius, double closestPoint[3], vtkGenericCell* cell,
                                           vtkIdType& cellId, int& subId, double& dist2, int& inside) override;

    using vtkAbstractCellLocator::IntersectWithLine;
    int IntersectWithLine(const double p1[3], const double p2[3], double tol, double& t, double x[3], double pcoords[3],
                          int& subId, vtkIdType& cellId, vtkGenericCell* cell) override;
    /// The first point of every cell that the line meets within GetTolerance(), along the line, and the cells; each may
    /// be null. Returns 0 if it meets none, -1 if p1 lies in a cell (of a surface: inside, as winding numbers tell, and
    /// not on it), else 1.
    int IntersectWithLine(const double p1[3], const double p2[3], vtkPoints* points, vtkIdList* cellIds) override;
    /// The same within `tol`, without looking where p1 lies: 1 if it meets any cell. Without a `cell` to work with, the
    /// last one takes the boxes of the cells for the cells, as VTK 9.2 does.
    virtual int IntersectWithLine(const double p1[3], const double p2[3], double tol, vtkPoints* points,
                                  vtkIdList* cellIds);
    virtual int IntersectWithLine(const double p1[3], const double p2[3], double tol, vtkPoints* points,
                                  vtkIdList* cellIds, vtkGenericCell* cell);

    void FindCellsWithinBounds(double* bbox, vtkIdList* cells) override;
    void FindCellsAlongLine(const double p1[3], const double p2[3], double tolerance, vtkIdList* cells) override;
    void FindCellsAlongPlane(const double origin[3], const double normal[3], double tolerance, vtkIdList* cells);
    bool InsideCellBounds(double x[3], vtkIdType cellId) override;

    void SetDataSet(vtkDataSet* data) override;
    /// Uses the index that is kept of the data set, or makes it.
    void BuildLocator() override;
    /// Makes the index anew, for data that were changed without Modified().
    virtual void ForceBuildLocator();
    void FreeSearchStructure() override;
    void GenerateRepresentation(int level, vtkPolyData* surface) override;
    /// Takes data set, settings and index of another one, which must be of this class.
    virtual void ShallowCopy(vtkAbstractCellLocator* other);

protected:
    vtkBarycertLocator();
    ~vtkBarycertLocator() override;
    vtkObjectBase* NewInstanceInternal() const override;
    void ReportReferences(vtkGarbageCollector* collector) override;

private:
    struct Internals;
    std::unique_ptr<Internals> internals_;
    bool Tolerant = false;
    int Interpolation = PULLING, CurvedCells = ISOPARAMETRIC;
};

#endif
