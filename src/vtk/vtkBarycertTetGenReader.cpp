#include "vtkBarycertTetGenReader.h"

#include <string_view>

#include <vtkObjectFactory.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/io.hpp"
#include "vtk/mesh_grid.hpp"

using namespace barycert;

vtkStandardNewMacro(vtkBarycertTetGenReader);

vtkBarycertTetGenReader::vtkBarycertTetGenReader() {
    SetNumberOfInputPorts(0);
}

vtkBarycertTetGenReader::~vtkBarycertTetGenReader() {
    delete[] FileName;
}

void vtkBarycertTetGenReader::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    os << indent << "FileName: " << (FileName != nullptr ? FileName : "(none)") << "\n";
}

int vtkBarycertTetGenReader::CanReadFile(const char* name) {
    const std::string_view path = name != nullptr ? name : "";
    return path.ends_with(".node") || path.ends_with(".ele") ? 1 : 0;
}

int vtkBarycertTetGenReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
    if (FileName == nullptr || *FileName == '\0') {
        vtkErrorMacro("FileName is not set");
        return 0;
    }
    const Result<Mesh> mesh = read_tetgen(FileName, {.faces = false, .neighbours = false});
    if (!mesh) {
        vtkErrorMacro("" << mesh.error().message());
        return 0;
    }
    for (const Note& note : mesh->notes)
        if (note.important) vtkWarningMacro("" << message(note));
    in_vtk::fill_grid(*mesh, *vtkUnstructuredGrid::GetData(outputs));
    return 1;
}
