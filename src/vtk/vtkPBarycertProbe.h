/**
 * @class   vtkPBarycertProbe
 * @brief   vtkBarycertProbe where mesh and points lie in pieces on many processes
 *
 * All processes of the Controller update it together, after changes on any of them that concern all: Update() where
 * each has inputs of its own, UpdatePiece(process, processes, 0) where readers share out pieces. On each the source is
 * a piece of the mesh, may have no cells, or is not set; the input has any points. The output has the structure of the
 * input and the arrays of vtkBarycertProbe, as if every process had the whole mesh:
 *
 * - The owner of a point is the cell of the lowest global id of all cells that contain it, on whatever process. Values
 *   have the same bits for any number of processes and pieces.
 * - Global ids are those of the sources' cells (vtkCellData::GetGlobalIds, integers). If cells of some process have
 * none, the cells are numbered by process and then as they come, ghost cells left out, after a warning on process 0:
 * then owners on seams depend on the pieces.
 * - Cells that are cut into simplices are cut by the global ids of their points (vtkPointData::GetGlobalIds). If the
 * points of some process have none, by their order there, after a warning on process 0: then values in such cells, and
 * owners of points between sides that are not flat, depend on the pieces.
 * - Ghost cells are left out: the process where they are no ghosts answers for them.
 * - All sources that have cells have the same arrays.
 *
 * What goes wrong on one process (a source that cannot be probed exactly, a node that is no number, an upstream filter
 * that fails, no memory) is an error on all, with the same text and the rank: the output is empty, GetErrorCode() is
 * not zero, and none of them waits.
 *
 * Unlike vtkBarycertProbe it has no tolerance. Composite data sets are an error: VTK would execute the filter once a
 * block, on each process another number of times.
 */
#ifndef vtkPBarycertProbe_h
#define vtkPBarycertProbe_h

#include "vtkBarycertProbe.h"

class vtkMultiProcessController;

class vtkPBarycertProbe : public vtkBarycertProbe {
public:
    static vtkPBarycertProbe* New();
    vtkTypeMacro(vtkPBarycertProbe, vtkBarycertProbe)
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// The processes: the global controller by default. Null: this one alone.
    void SetController(vtkMultiProcessController* controller);
    vtkGetObjectMacro(Controller, vtkMultiProcessController);

    /// Figures of the last execution, on this process: points that were sent to others and that others sent, one for
    /// each that was asked; bytes of messages to others, and of what all processes told each other.
    vtkGetMacro(PointsSent, vtkIdType);
    vtkGetMacro(PointsReceived, vtkIdType);
    vtkGetMacro(BytesSent, vtkIdType);
    vtkGetMacro(BytesGathered, vtkIdType);
    /// Processes that this one exchanged messages with.
    vtkGetMacro(NumberOfPartners, int);

protected:
    vtkPBarycertProbe();
    ~vtkPBarycertProbe() override { SetController(nullptr); }

    vtkExecutive* CreateDefaultExecutive() override;
    int FillInputPortInformation(int port, vtkInformation* info) override;
    int RequestDataObject(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
    int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                            vtkInformationVector* outputs) override;
    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
    vtkMultiProcessController* Controller = nullptr;
    vtkIdType PointsSent = 0, PointsReceived = 0, BytesSent = 0, BytesGathered = 0;
    int NumberOfPartners = 0;
};

#endif
