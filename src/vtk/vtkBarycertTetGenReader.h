/**
 * @class   vtkBarycertTetGenReader
 * @brief   reads meshes of TetGen and Triangle
 *
 * FileName is the stem or any one of STEM.node and STEM.ele. Output: a vtkUnstructuredGrid of tetrahedra or, at z = 0,
 * triangles; quadratic ones where the file has nodes at mid-edges. Every coordinate and attribute is the decimal number
 * of the file rounded to the nearest double.
 *
 * Point arrays: attribute0, attribute1, ...; "marker". Cell arrays: attribute0 (TetGen: the region), attribute1, ...
 * Points and cells are in the order of the file, whatever numbers it counts from. STEM.face and STEM.neigh are not
 * read.
 *
 * What cannot be read without a guess is an error that names file and line.
 */
#ifndef vtkBarycertTetGenReader_h
#define vtkBarycertTetGenReader_h

#include <vtkUnstructuredGridAlgorithm.h>

class vtkBarycertTetGenReader : public vtkUnstructuredGridAlgorithm {
public:
    static vtkBarycertTetGenReader* New();
    vtkTypeMacro(vtkBarycertTetGenReader, vtkUnstructuredGridAlgorithm)
    void PrintSelf(ostream& os, vtkIndent indent) override;

    vtkSetStringMacro(FileName);
    vtkGetStringMacro(FileName);

    /// Whether the name ends as TetGen's files do. The contents are checked when the file is read.
    int CanReadFile(const char* name);

protected:
    vtkBarycertTetGenReader() { SetNumberOfInputPorts(0); }
    ~vtkBarycertTetGenReader() override { delete[] FileName; }

    int RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
    char* FileName = nullptr;
};

#endif
