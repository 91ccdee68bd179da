#include "vtk_files_peer.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstring>

namespace barycert::bench {
namespace {

VtkGrid shared(vtkUnstructuredGrid* grid) {
    grid->Register(nullptr);
    return {grid, [](void* p) { static_cast<vtkUnstructuredGrid*>(p)->Delete(); }};
}

bool same_bits(vtkDataArray* array, const std::vector<double>& values) {
    if (array == nullptr || array->GetDataType() != VTK_DOUBLE) return false;
    if (static_cast<std::size_t>(array->GetNumberOfValues()) != values.size()) return false;
    return std::memcmp(array->GetVoidPointer(0), values.data(), values.size() * sizeof(double)) == 0;
}

}  // namespace

VtkGrid vtk_read(const std::string& path) {
    if (path.ends_with(".vtk")) {
        vtkNew<vtkUnstructuredGridReader> reader;
        reader->SetFileName(path.c_str());
        reader->ReadAllScalarsOn();
        reader->Update();
        return reader->GetErrorCode() == vtkErrorCode::NoError ? shared(reader->GetOutput()) : nullptr;
    }
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetErrorCode() == vtkErrorCode::NoError ? shared(reader->GetOutput()) : nullptr;
}

bool vtk_write(const VtkGrid& grid, const std::string& path, VtkData data) {
    auto* const input = static_cast<vtkUnstructuredGrid*>(grid.get());
    if (path.ends_with(".vtk")) {
        vtkNew<vtkUnstructuredGridWriter> writer;
        writer->SetFileName(path.c_str());
        writer->SetInputData(input);
        data == VtkData::ascii ? writer->SetFileTypeToASCII() : writer->SetFileTypeToBinary();
        return writer->Write() == 1;
    }
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(input);
    writer->EncodeAppendedDataOff();
    writer->SetHeaderTypeToUInt64();
    data == VtkData::ascii ? writer->SetDataModeToAscii() : writer->SetDataModeToAppended();
    writer->SetCompressorType(data == VtkData::zlib   ? vtkXMLWriter::ZLIB
                              : data == VtkData::lz4  ? vtkXMLWriter::LZ4
                              : data == VtkData::lzma ? vtkXMLWriter::LZMA
                                                      : vtkXMLWriter::NONE);
    return writer->Write() == 1;
}

bool vtk_is(const VtkGrid& shared_grid, const Mesh& mesh) {
    if (shared_grid == nullptr) return false;
    auto* const grid = static_cast<vtkUnstructuredGrid*>(shared_grid.get());
    if (static_cast<std::size_t>(grid->GetNumberOfCells()) != mesh.cell_count()) return false;
    if (grid->GetPoints() == nullptr || !same_bits(grid->GetPoints()->GetData(), mesh.points)) return false;
    for (const Field& field : mesh.point_fields) {
        if (!same_bits(grid->GetPointData()->GetArray(field.name.c_str()), field.data)) return false;
    }
    vtkNew<vtkIdList> nodes;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        grid->GetCellPoints(static_cast<vtkIdType>(cell), nodes);
        if (nodes->GetNumberOfIds() != 4) return false;
        for (std::size_t i = 0; i < 4; ++i) {
            if (nodes->GetId(static_cast<vtkIdType>(i)) != mesh.cells[4 * cell + i]) return false;
        }
    }
    return true;
}

}  // namespace barycert::bench
