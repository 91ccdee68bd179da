/**
 * @class   vtkBarycertProbe
 * @brief   vtkProbeFilter with exact owners and correctly rounded values
 *
 * Input: where (any vtkDataSet; its points). Source: the mesh, any vtkDataSet as vtkBarycertLocator takes it. Output:
 * the structure of the input with the arrays of vtkProbeFilter: each point array of the source, each of its cell arrays
 * that has another name, and the mask of valid points.
 *
 * - The owner of a point is the lowest id of all cells that contain it exactly, ghost cells (vtkGhostType: duplicate,
 *   refined, hidden) left out. It does not depend on threads or on the kind of the input.
 * - A value of a point array is the exact interpolation in the owner, rounded once to the type of the array: real
 * numbers to nearest, ties to even; integers to nearest, halves away from zero, as VTK rounds. Where it is not linear
 * (Interpolation, CurvedCells), floats and integers are made of the rounded double. It is NaN (integers: 0) where a
 * value of a vertex is not finite. 64-bit integers beyond 2^53 become doubles first, after a warning. Arrays
 * that are not numeric are mixed by VTK.
 * - A cell array has the tuple of the owner.
 * - On a surface in space, only points on it are inside.
 * - Points outside have mask 0 and zeros, or NaN in arrays of real numbers (OutsideIsNaN).
 *
 * A source that the locator does not take is an error, and GetExact() is false then. Works on all threads of the
 * machine; the result does not depend on their number.
 */
#ifndef vtkBarycertProbe_h
#define vtkBarycertProbe_h

#include <limits>
#include <string>
#include <vector>

#include <vtkDataSetAlgorithm.h>
#include <vtkNew.h>

class vtkCharArray;
class vtkIdTypeArray;

class vtkBarycertProbe : public vtkDataSetAlgorithm {
public:
    static vtkBarycertProbe* New();
    vtkTypeMacro(vtkBarycertProbe, vtkDataSetAlgorithm)
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// The mesh.
    void SetSourceData(vtkDataObject* source) { SetInputData(1, source); }
    void SetSourceConnection(vtkAlgorithmOutput* output) { SetInputConnection(1, output); }
    vtkDataObject* GetSource() { return GetNumberOfInputConnections(1) > 0 ? GetInputDataObject(1, 0) : nullptr; }

    /// Whether the active point scalars of the source are categories: of the vertex of greatest weight (the first of
    /// equal ones), and not interpolated. Off by default.
    vtkSetMacro(CategoricalData, vtkTypeBool);
    vtkGetMacro(CategoricalData, vtkTypeBool);
    vtkBooleanMacro(CategoricalData, vtkTypeBool);

    /// Whether piece m of n of the source is all that piece m of n of the input needs. Off by default.
    vtkSetMacro(SpatialMatch, vtkTypeBool);
    vtkGetMacro(SpatialMatch, vtkTypeBool);
    vtkBooleanMacro(SpatialMatch, vtkTypeBool);

    /// Ids of the points that have a value, ascending, of the last execution.
    vtkIdTypeArray* GetValidPoints() { return ValidPoints; }

    /// Name of the array that has 1 for these and 0 for others: "vtkValidPointMask" by default.
    vtkSetStringMacro(ValidPointMaskArrayName);
    vtkGetStringMacro(ValidPointMaskArrayName);

    /// Which arrays of the input the output has besides: cells' (off), points' (off), field data (on).
    vtkSetMacro(PassCellArrays, vtkTypeBool);
    vtkBooleanMacro(PassCellArrays, vtkTypeBool);
    vtkGetMacro(PassCellArrays, vtkTypeBool);
    vtkSetMacro(PassPointArrays, vtkTypeBool);
    vtkBooleanMacro(PassPointArrays, vtkTypeBool);
    vtkGetMacro(PassPointArrays, vtkTypeBool);
    vtkSetMacro(PassFieldArrays, vtkTypeBool);
    vtkBooleanMacro(PassFieldArrays, vtkTypeBool);
    vtkGetMacro(PassFieldArrays, vtkTypeBool);

    /// On (the default): no tolerance, only points of the mesh are valid. Off: points within Tolerance (0 by default)
    /// of the mesh are valid too, and have the values of the nearest point; the distance to a mesh of triangles is that
    /// in its plane, and that to the plane.
    vtkSetMacro(ComputeTolerance, bool);
    vtkBooleanMacro(ComputeTolerance, bool);
    vtkGetMacro(ComputeTolerance, bool);
    vtkSetClampMacro(Tolerance, double, 0.0, VTK_DOUBLE_MAX);
    vtkGetMacro(Tolerance, double);

    /// How cells are taken, as in vtkBarycertLocator.
    enum { PULLING = 0, MULTILINEAR = 1 };
    vtkSetClampMacro(Interpolation, int, PULLING, MULTILINEAR);
    vtkGetMacro(Interpolation, int);
    enum { ISOPARAMETRIC = 0, STRAIGHT = 1, REFUSE = 2, EXACT = 3 };
    vtkSetClampMacro(CurvedCells, int, ISOPARAMETRIC, EXACT);
    vtkGetMacro(CurvedCells, int);

    /// Whether arrays of real numbers have NaN, not 0, where points are not valid. Off by default.
    vtkSetMacro(OutsideIsNaN, bool);
    vtkBooleanMacro(OutsideIsNaN, bool);
    vtkGetMacro(OutsideIsNaN, bool);

    /// Whether the last execution was exact.
    vtkGetMacro(Exact, bool);

protected:
    vtkBarycertProbe();
    ~vtkBarycertProbe() override;

    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
    int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                           vtkInformationVector* outputs) override;
    int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                            vtkInformationVector* outputs) override;

    const char* MaskName() const {
        return ValidPointMaskArrayName != nullptr ? ValidPointMaskArrayName : "vtkValidPointMask";
    }
    double OutsideValue() const { return OutsideIsNaN ? std::numeric_limits<double>::quiet_NaN() : 0; }
    void WarnOfInexact(const std::vector<std::string>& names);
    void ListValidPoints(vtkCharArray& mask);
    void PassArrays(vtkDataSet* input, vtkDataSet* output);

    bool Exact = false;

private:
    bool Sample(vtkDataSet* input, vtkDataSet* source, vtkDataSet* output);

    vtkTypeBool CategoricalData = 0, SpatialMatch = 0;
    vtkTypeBool PassCellArrays = 0, PassPointArrays = 0, PassFieldArrays = 1;
    bool ComputeTolerance = true, OutsideIsNaN = false;
    double Tolerance = 0;
    int Interpolation = PULLING, CurvedCells = ISOPARAMETRIC;
    char* ValidPointMaskArrayName = nullptr;
    vtkNew<vtkIdTypeArray> ValidPoints;
};

#endif
