// Settings of vtkBarycertProbe, and what it asks of the pipeline, beside vtkProbeFilter.

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProbeFilter.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGridAlgorithm.h>

#include "tests/vtk/grids.hpp"
#include "vtkBarycertProbe.h"

namespace barycert::testing {
namespace {

/// One tetrahedron of size 4 with x as a field of its nodes, and 7 as that of the cell.
vtkSmartPointer<vtkUnstructuredGrid> source_with_x() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4};
    mesh.cells = {0, 1, 2, 3};
    mesh.point_fields = {{.name = "x", .data = {0, 4, 0, 0}}};
    mesh.cell_fields = {{.name = "seven", .data = {7}}};
    return grid_of(mesh);
}

void give(vtkFieldData* data, const char* name, vtkIdType count) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    for (vtkIdType i = 0; i < count; ++i) array->InsertNextValue(static_cast<int>(100 + i));
    data->AddArray(array);
}

std::vector<std::string> names_in(vtkFieldData* data) {
    std::vector<std::string> names;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) names.emplace_back(data->GetArrayName(i));
    return names;
}

TEST(ProbeSettings, PassWhatVtkProbeFilterPasses) {
    vtkNew<vtkImageData> input;
    input->SetDimensions(3, 2, 2);
    give(input->GetPointData(), "of points", 12);
    give(input->GetPointData(), "x", 12);
    give(input->GetCellData(), "of cells", 2);
    give(input->GetFieldData(), "of all", 3);
    for (const int flags : {0, 1, 2, 3, 4, 5, 6, 7}) {
        SCOPED_TRACE(flags);
        vtkNew<vtkProbeFilter> theirs;
        vtkNew<vtkBarycertProbe> ours;
        const auto run = [&](auto* probe) {
            probe->SetSourceData(source_with_x());
            probe->SetInputData(input);
            probe->SetPassPointArrays(flags & 1);
            probe->SetPassCellArrays(flags >> 1 & 1);
            probe->SetPassFieldArrays(flags >> 2);
            probe->Update();
            return probe->GetOutput();
        };
        vtkDataSet* const a = run(theirs.Get());
        vtkDataSet* const b = run(ours.Get());
        EXPECT_EQ(names_in(b->GetPointData()), names_in(a->GetPointData()));
        EXPECT_EQ(names_in(b->GetCellData()), names_in(a->GetCellData()));
        EXPECT_EQ(names_in(b->GetFieldData()), names_in(a->GetFieldData()));
        EXPECT_EQ(b->GetPointData()->GetArray("x")->GetTuple1(1), 1);
    }
}

TEST(ProbeSettings, ToleranceCountsOnlyIfItIsNotComputed) {
    for (const bool computed : {true, false}) {
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(source_with_x());
        probe->SetInputData(points_of({1, 1, -0.25}));
        probe->SetComputeTolerance(computed);
        probe->SetTolerance(0.25);
        probe->Update();
        EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), computed ? 0 : 1);
        EXPECT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), computed ? 0 : 1);
    }
}

TEST(ProbeSettings, ToleranceCountsAcrossThePlane) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 4, 0, 0, 4};
    mesh.cells = {0, 1, 2};
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(surface_of(mesh, 2, 1));
    probe->SetInputData(points_of({1, 1, 1.25, 1, 1, 0.5, 1, -0.25, 1, 1, -0.5, 1}));
    probe->ComputeToleranceOff();
    probe->SetTolerance(0.25);
    probe->Update();
    vtkDataArray* const mask = probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask");
    EXPECT_EQ(std::vector<double>({mask->GetTuple1(0), mask->GetTuple1(1), mask->GetTuple1(2), mask->GetTuple1(3)}),
              std::vector<double>({1, 0, 1, 0}));
}

// The value at the nearest point is the middle of two floats; in the cell's function at the point itself it is more.
TEST(ProbeSettings, ToleranceRoundsWhatIsAtTheNearestPoint) {
    const auto source = source_with_x();
    vtkNew<vtkFloatArray> floats;
    floats->SetName("floats");
    for (const float value : {2.0F, 0x1p-22F, 0.0F, -1.0F}) floats->InsertNextValue(value);
    source->GetPointData()->AddArray(floats);
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(source);
    probe->SetInputData(points_of({1, 1, -0.25}));
    probe->ComputeToleranceOff();
    probe->SetTolerance(0.25);
    probe->Update();
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), 1);
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("floats")->GetTuple1(0), 1);
}

TEST(ProbeSettings, NameLargeIntegers) {
    for (const vtkIdType value : {vtkIdType{1} << 53, (vtkIdType{1} << 53) + 2}) {
        const auto source = source_with_x();
        vtkNew<vtkIdTypeArray> integers;
        integers->SetName("integers");
        for (int i = 0; i < 4; ++i) integers->InsertNextValue(value);
        source->GetPointData()->AddArray(integers);
        Messages messages;
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(source);
        probe->SetInputData(points_of({1, 1, 1}));
        probe->Update();
        EXPECT_EQ(messages.count("integers beyond 2^53"), value > vtkIdType{1} << 53 ? 1 : 0) << messages.all();
        EXPECT_EQ(vtkIdTypeArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("integers"))->GetValue(0),
                  value);
    }
}

TEST(ProbeSettings, ValidPointsAreThoseOfTheLastExecution) {
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(source_with_x());
    probe->SetInputData(points_of({9, 9, 9, 1, 1, 1, 0, 0, 0}));
    probe->Update();
    ASSERT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), 2);
    EXPECT_EQ(probe->GetValidPoints()->GetValue(0), 1);
    probe->SetInputData(vtkSmartPointer<vtkPolyData>::New());
    probe->Update();
    EXPECT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), 0);
}

TEST(ProbeSettings, ImagesMayBeTurned) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(4, 5, 6);
    image->SetOrigin(4, 0.25, 0.5);
    image->SetSpacing(0.5, 0.75, 0.25);
    const double axes[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    image->SetDirectionMatrix(axes);
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(source_with_x());
    probe->SetInputData(image);
    probe->Update();
    int inside = 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
        double x[3];
        image->GetPoint(i, x);
        const bool in = x[0] >= 0 && x[1] >= 0 && x[2] >= 0 && x[0] + x[1] + x[2] <= 4;
        EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("x")->GetTuple1(i), in ? x[0] : 0);
        inside += in ? 1 : 0;
    }
    EXPECT_GT(inside, 10);
}

TEST(ProbeSettings, CategoriesNeedScalars) {
    Messages messages;
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(source_with_x());
    probe->SetInputData(points_of({1, 1, 1}));
    probe->CategoricalDataOn();
    probe->Update();
    EXPECT_EQ(messages.count("CategoricalData takes point scalars"), 1) << messages.all();
}

// More points than are sampled at once, the first of them not finite.
TEST(ProbeSettings, BlocksOfPointsMeet) {
    constexpr vtkIdType count = (vtkIdType{1} << 20) + 1000;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(count);
    const auto at = [](vtkIdType i) { return static_cast<double>(i) * 0x1p-20; };
    for (vtkIdType i = 0; i < count; ++i) points->SetPoint(i, at(i), 0.5, 0.5);
    for (const bool all_finite : {true, false}) {
        if (!all_finite) points->SetPoint(0, std::numeric_limits<double>::quiet_NaN(), 0, 0);
        points->Modified();
        vtkNew<vtkPolyData> input;
        input->SetPoints(points);
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(source_with_x());
        probe->SetInputData(input);
        probe->Update();
        auto* const x = vtkDoubleArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("x"));
        ASSERT_NE(x, nullptr);
        vtkIdType wrong = 0;
        for (vtkIdType i = 0; i < count; ++i) wrong += x->GetValue(i) == at(i) ? 0 : 1;
        EXPECT_EQ(wrong, 0);
        EXPECT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), all_finite ? count : count - 1);
    }
}

/// Gives the mesh above, has two times, and remembers what piece it was asked for.
class PieceSource : public vtkUnstructuredGridAlgorithm {
public:
    static PieceSource* New();
    vtkTypeMacro(PieceSource, vtkUnstructuredGridAlgorithm)
    int piece = -1, pieces = -1;

protected:
    PieceSource() { SetNumberOfInputPorts(0); }
    int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
        const double times[2] = {1, 2};
        vtkInformation* const out = outputs->GetInformationObject(0);
        out->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 2);
        out->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), times, 2);
        out->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
        return 1;
    }
    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
        vtkInformation* const out = outputs->GetInformationObject(0);
        piece = out->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
        pieces = out->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
        vtkUnstructuredGrid::GetData(outputs)->ShallowCopy(source_with_x());
        return 1;
    }
};
vtkStandardNewMacro(PieceSource);

TEST(ProbeSettings, AskTheSourceForAllUnlessPiecesMatch) {
    for (const bool match : {false, true}) {
        vtkNew<PieceSource> source;
        vtkNew<PieceSource> where;
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceConnection(source->GetOutputPort());
        probe->SetInputConnection(where->GetOutputPort());
        probe->SetSpatialMatch(match);
        probe->UpdatePiece(1, 3, 0);
        EXPECT_EQ(where->piece, 1);
        EXPECT_EQ(where->pieces, 3);
        EXPECT_EQ(source->piece, match ? 1 : 0);
        EXPECT_EQ(source->pieces, match ? 3 : 1);
    }
}

TEST(ProbeSettings, HaveTheTimesOfTheSource) {
    vtkNew<PieceSource> source;
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceConnection(source->GetOutputPort());
    probe->SetInputData(points_of({1, 1, 1}));
    probe->UpdateInformation();
    vtkInformation* const out = probe->GetOutputInformation(0);
    EXPECT_EQ(out->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 2);
    EXPECT_EQ(out->Length(vtkStreamingDemandDrivenPipeline::TIME_RANGE()), 2);
}

}  // namespace
}  // namespace barycert::testing
