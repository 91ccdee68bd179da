// A program as somebody writes it with VTK for the jobs of bench_job: VTK's own readers, probe and writers, files to
// files.
//
//     job_vtk THREADS LOCATOR points MESH.vtu POINTS.vtp|.csv OUT.vtp|.csv    LOCATOR: tree, static
//     job_vtk THREADS LOCATOR image MESH.vtu SIDE OUT.vti
//     job_vtk THREADS LOCATOR read MESH.vtu
// and, for the bench itself:
//     job_vtk THREADS LOCATOR pack COORDINATES OUT.vtp    from doubles as they stand in memory
//     job_vtk THREADS LOCATOR unpack FILE.vtp|.vtu|.vti OUT    the field of a result as doubles, NaN where its mask is
//     0
//
// In C++17: VTK 9.1's vtkSMPTools.h does not compile as C++20.
#include <vtkCellTreeLocator.h>
#include <vtkDataObjectToTable.h>
#include <vtkDelimitedTextReader.h>
#include <vtkDelimitedTextWriter.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkTable.h>
#include <vtkTableToPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

bool ends_with(const std::string& path, const std::string& suffix) {
    return path.size() >= suffix.size() && path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0;
}

[[noreturn]] void fail(const std::string& what) {
    std::fprintf(stderr, "job_vtk: %s\n", what.c_str());
    std::exit(2);
}

template <class Reader>
vtkSmartPointer<vtkDataSet> read_by(const std::string& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkSmartPointer<vtkDataSet> read = reader->GetOutput();
    if (read->GetNumberOfPoints() == 0) fail("nothing in " + path);
    return read;
}

vtkSmartPointer<vtkDataSet> read(const std::string& path) {
    if (ends_with(path, ".vtu")) return read_by<vtkXMLUnstructuredGridReader>(path);
    if (ends_with(path, ".vti")) return read_by<vtkXMLImageDataReader>(path);
    if (ends_with(path, ".vtp")) return read_by<vtkXMLPolyDataReader>(path);
    vtkNew<vtkDelimitedTextReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetHaveHeaders(true);
    reader->DetectNumericColumnsOn();
    vtkNew<vtkTableToPolyData> to_points;
    to_points->SetInputConnection(reader->GetOutputPort());
    to_points->SetXColumn("x");
    to_points->SetYColumn("y");
    to_points->SetZColumn("z");
    to_points->PreserveCoordinateColumnsAsDataArraysOn();
    to_points->Update();
    vtkSmartPointer<vtkDataSet> points = to_points->GetOutput();
    if (points->GetNumberOfPoints() == 0) fail("nothing in " + path);
    return points;
}

/// As barycert writes: raw, neither compressed nor in base64.
template <class Writer>
void write_by(vtkDataObject* data, const std::string& path) {
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName(path.c_str());
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    if (writer->Write() == 0) fail("cannot write " + path);
}

void write(vtkDataSet* data, const std::string& path) {
    if (ends_with(path, ".vti")) return write_by<vtkXMLImageDataWriter>(data, path);
    if (ends_with(path, ".vtp")) return write_by<vtkXMLPolyDataWriter>(data, path);
    vtkNew<vtkDataObjectToTable> to_table;
    to_table->SetInputData(data);
    to_table->SetFieldType(vtkDataObjectToTable::POINT_DATA);
    vtkNew<vtkDelimitedTextWriter> writer;
    writer->SetInputConnection(to_table->GetOutputPort());
    writer->SetFileName(path.c_str());
    if (writer->Write() == 0) fail("cannot write " + path);
}

void probe(vtkDataSet* mesh, vtkDataSet* where, const std::string& locator, const std::string& out) {
    vtkNew<vtkProbeFilter> filter;
    filter->SetInputData(where);
    filter->SetSourceData(mesh);
    if (locator == "static") {
        filter->SetCellLocatorPrototype(vtkNew<vtkStaticCellLocator>());
    } else {
        filter->SetCellLocatorPrototype(vtkNew<vtkCellTreeLocator>());
    }
    if (ends_with(out, ".csv")) filter->PassPointArraysOn();  // the coordinates
    filter->Update();
    write(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0)), out);
}

void on_image(vtkDataSet* mesh, int side, const std::string& locator, const std::string& out) {
    double box[6];
    mesh->GetBounds(box);
    vtkNew<vtkImageData> image;
    image->SetDimensions(side, side, side);
    image->SetOrigin(box[0], box[2], box[4]);
    image->SetSpacing((box[1] - box[0]) / (side - 1), (box[3] - box[2]) / (side - 1), (box[5] - box[4]) / (side - 1));
    probe(mesh, image, locator, out);
}

std::vector<double> doubles_of(const std::string& path) {
    std::vector<double> numbers;
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) fail("cannot read " + path);
    double x = 0;
    while (std::fread(&x, sizeof x, 1, file) == 1) numbers.push_back(x);
    std::fclose(file);
    return numbers;
}

void pack(const std::string& from, const std::string& to) {
    const std::vector<double> coordinates = doubles_of(from);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(coordinates.size() / 3));
    for (std::size_t i = 0; i < coordinates.size() / 3; ++i)
        points->SetPoint(static_cast<vtkIdType>(i), coordinates.data() + 3 * i);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    write(data, to);
}

void unpack(const std::string& from, const std::string& to) {
    const vtkSmartPointer<vtkDataSet> data = read(from);
    vtkDataArray* const field = data->GetPointData()->GetArray("attribute0");
    vtkDataArray* const mask = data->GetPointData()->GetArray("vtkValidPointMask");
    if (field == nullptr || mask == nullptr) fail("no field in " + from);
    std::FILE* const file = std::fopen(to.c_str(), "wb");
    if (file == nullptr) fail("cannot write " + to);
    for (vtkIdType i = 0; i < field->GetNumberOfTuples(); ++i) {
        const double x = mask->GetTuple1(i) != 0 ? field->GetTuple1(i) : std::numeric_limits<double>::quiet_NaN();
        if (std::fwrite(&x, sizeof x, 1, file) != 1) fail("cannot write " + to);
    }
    if (std::fclose(file) != 0) fail("cannot write " + to);
}

}  // namespace

int main(int count, char** text) {
    const std::vector<std::string> words(text, text + count);
    if (count < 5) fail("see the top of job_vtk.cpp");
    vtkSMPTools::Initialize(std::atoi(text[1]));
    const std::string &locator = words[2], &what = words[3], &first = words[4];
    if (what == "points" && count == 7) {
        probe(read(first), read(words[5]), locator, words[6]);
    } else if (what == "image" && count == 7) {
        on_image(read(first), std::atoi(text[5]), locator, words[6]);
    } else if (what == "read" && count == 5) {
        read(first);
    } else if (what == "pack" && count == 6) {
        pack(first, words[5]);
    } else if (what == "unpack" && count == 6) {
        unpack(first, words[5]);
    } else {
        fail("see the top of job_vtk.cpp");
    }
    return 0;
}
