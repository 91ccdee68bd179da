// A fault on one rank is an error on all, with the same text; and the next execution may be right.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <new>

#include <vtkCellData.h>
#include <vtkCompositeDataPipeline.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPassThrough.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGridAlgorithm.h>
#include <vtkVariantArray.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mpi/pieces.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkPBarycertProbe.h"

namespace barycert::testing {
namespace {

struct BrokenJob : Job {
    BrokenJob() : Job(box(3, {8, 2, 2}), 10) {}

    vtkSmartPointer<vtkUnstructuredGrid> mesh_here = piece(Cut::slabs, false);
    int broken = ranks() / 2;  ///< the rank that has the fault
    bool here = rank() == broken;

    std::string who() const { return ranks() > 1 ? "rank " + std::to_string(broken) + ": " : std::string(); }
};

// On all ranks, once.
void expect_error(vtkPBarycertProbe* probe, const std::string& text) {
    Messages messages;
    probe->Update();
    EXPECT_EQ(messages.count(text), 1) << messages.all();
    EXPECT_NE(probe->GetErrorCode(), vtkErrorCode::NoError);
    EXPECT_FALSE(probe->GetExact());
    EXPECT_EQ(probe->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(probe->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
}

void expect_fault(const std::function<void(vtkUnstructuredGrid*)>& spoil, const std::string& text) {
    BrokenJob job;
    vtkNew<vtkUnstructuredGrid> bad;
    bad->DeepCopy(job.mesh_here);
    if (job.here) spoil(bad);
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceData(bad);
    probe->SetInputData(job.mine);
    {
        Messages messages;
        probe->Update();
        EXPECT_EQ(messages.count(job.who() + "the source "), 1) << messages.all();
    }
    expect_error(probe, text);
    // And then the piece that is right.
    probe->SetSourceData(job.mesh_here);
    Messages messages;
    probe->Update();
    EXPECT_EQ(messages.all(), "");
    EXPECT_EQ(probe->GetErrorCode(), vtkErrorCode::NoError);
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    expect_same(probe->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
}

TEST(Faults, OfCells) {
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            const vtkIdType nodes[8] = {0, 1, 2, 3, 4, 5, 6, 7};
            grid->InsertNextCell(VTK_CONVEX_POINT_SET, 8, nodes);
        },
        " is a vtkConvexPointSet");
}

TEST(Faults, OfNodes) {
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            grid->GetPoints()->SetPoint(3, 0, std::numeric_limits<double>::quiet_NaN(), 0);
            grid->GetPoints()->Modified();
        },
        "the source cannot be probed exactly: ");
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            const vtkIdType nodes[4] = {0, 1, 2, 1000000};
            grid->InsertNextCell(VTK_TETRA, 4, nodes);
            // As many tuples as cells.
            vtkCellData* const cells = grid->GetCellData();
            for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
                cells->GetAbstractArray(i)->InsertNextTuple(0, cells->GetAbstractArray(i));
        },
        "the source cannot be probed exactly: ");
}

TEST(Faults, OfArrays) {
    // One rank alone has whatever arrays it has.
    if (ranks() == 1) return;
    const auto others = [](const char* text) {
        return "the source has other arrays than that of rank 0: " + std::string(text);
    };
    expect_fault([](vtkUnstructuredGrid* grid) { grid->GetPointData()->RemoveArray("float"); },
                 others("the array float of 1 float is missing here"));
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            vtkNew<vtkDoubleArray> array;
            array->DeepCopy(grid->GetPointData()->GetArray("float"));
            array->SetName("float");
            grid->GetPointData()->AddArray(array);
        },
        others("the array float of 1 float is here the array float of 1 double"));
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            vtkNew<vtkDoubleArray> array;
            array->SetName("more");
            array->SetNumberOfTuples(grid->GetNumberOfCells());
            array->Fill(0);
            grid->GetCellData()->AddArray(array);
        },
        others("the array more of 1 double is here only"));
}

TEST(Faults, OfArraysThatCannotBeSent) {
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            vtkNew<vtkVariantArray> array;
            array->SetName("any");
            array->SetNumberOfTuples(grid->GetNumberOfPoints());
            grid->GetPointData()->AddArray(array);
        },
        "the source has what cannot be sent from rank to rank: the array any of 1 variant");
}

TEST(Faults, OfArraysThatAreTooShort) {
    expect_fault([](vtkUnstructuredGrid* grid) { grid->GetPointData()->GetArray("v")->SetNumberOfTuples(2); },
                 "the source has an array v of 2 tuples, and ");
    expect_fault([](vtkUnstructuredGrid* grid) { grid->GetCellData()->GetArray("large")->SetNumberOfTuples(2); },
                 "the source has an array large of 2 tuples, and ");
}

TEST(Faults, OfGlobalIds) {
    expect_fault(
        [](vtkUnstructuredGrid* grid) {
            vtkNew<vtkDoubleArray> ids;
            ids->DeepCopy(grid->GetCellData()->GetGlobalIds());
            ids->SetName("ids");
            grid->GetCellData()->SetGlobalIds(ids);
        },
        "the source cannot be probed by several processes: the global ids of its cells are a vtkDoubleArray");
    expect_fault([](vtkUnstructuredGrid* grid) { grid->GetCellData()->GetGlobalIds()->SetNumberOfTuples(3); },
                 "the source cannot be probed by several processes: it has ");
}

TEST(Faults, OfPlanes) {
    const Mesh mesh = own_mesh("plate");
    base::Random random(1);
    const auto whole = with_arrays(mesh, 0.5);
    const auto piece = piece_of(whole, ranks_of_cells(whole, Cut::slabs), rank(), false, random);
    if (ranks() > 1 && rank() == 1) {
        for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i) {
            double x[3];
            piece->GetPoint(i, x);
            piece->GetPoints()->SetPoint(i, x[0], x[1], 0.75);
        }
    }
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceData(piece);
    probe->SetInputData(points_of({0.1, 0.1, 0.5}));
    if (ranks() > 1) expect_error(probe, "its polygons do not lie in one plane across an axis");
}

TEST(Faults, OfSettings) {
    BrokenJob job;
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceData(job.mesh_here);
    probe->SetInputData(job.mine);
    probe->ComputeToleranceOff();
    probe->SetTolerance(1);
    expect_error(probe, "this filter has no Tolerance: points are inside the mesh or not; leave ComputeTolerance on");
    probe->SetTolerance(0);
    probe->CategoricalDataOn();
    job.mesh_here->GetPointData()->SetActiveScalars("v");
    expect_error(probe, "CategoricalData takes point scalars of one component, of the source");
}

// One process has two blocks, others have one: with an executive that takes them apart, as ParaView's, too.
TEST(Faults, OfBlocks) {
    BrokenJob job;
    for (const bool of_source : {false, true}) {
        for (const bool executive : {false, true}) {
            vtkNew<vtkPBarycertProbe> probe;
            if (executive) probe->SetExecutive(vtkNew<vtkCompositeDataPipeline>());
            vtkNew<vtkMultiBlockDataSet> blocks;
            for (unsigned i = 0; i < (job.here ? 2U : 1U); ++i)
                blocks->SetBlock(i, of_source ? vtkDataObject::SafeDownCast(job.mesh_here) : job.mine.Get());
            if (of_source) {
                probe->SetSourceData(blocks);
                probe->SetInputData(job.mine);
            } else {
                probe->SetSourceData(job.mesh_here);
                probe->SetInputData(blocks);
            }
            expect_error(probe, "this filter takes no composite data sets; merge the blocks before");
        }
    }
}

struct Failing : vtkUnstructuredGridAlgorithm {
    static Failing* New();
    vtkTypeMacro(Failing, vtkUnstructuredGridAlgorithm)
    Failing() { SetNumberOfInputPorts(0); }
    int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override {
        return how == 0 ? 0 : 1;
    }
    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
        if (how == 1) return 0;
        if (how == 2) throw std::bad_alloc();
        if (how == 4) {
            vtkErrorMacro("the file is cut off");  // as VTK's readers do
            return 1;
        }
        vtkUnstructuredGrid::GetData(outputs)->ShallowCopy(piece);
        return 1;
    }
    int how = 0;
    vtkUnstructuredGrid* piece = nullptr;
};
vtkStandardNewMacro(Failing);

TEST(Faults, OfFiltersBefore) {
    BrokenJob job;
    for (const int how : {0, 1, 2, 4}) {
        SCOPED_TRACE(how);
        vtkNew<Failing> before;
        before->piece = job.mesh_here;
        before->how = job.here ? how : 3;
        vtkNew<vtkPBarycertProbe> probe;
        probe->SetSourceConnection(before->GetOutputPort());
        probe->SetInputData(job.mine);
        expect_error(probe, job.who() + "what comes before this filter failed: ");
        // VTK does not execute it again, and takes what it has for the piece.
        job.mine->GetPoints()->Modified();
        expect_error(probe, job.who() + "what comes before this filter failed: ");
        before->how = 3;
        before->Modified();
        probe->Update();
        EXPECT_EQ(probe->GetErrorCode(), vtkErrorCode::NoError);
        const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
        expect_same(probe->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
    }
    // The same for the filter before the points.
    vtkNew<Failing> before;
    before->piece = job.whole;
    before->how = job.here ? 1 : 3;
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceData(job.mesh_here);
    probe->SetInputConnection(before->GetOutputPort());
    expect_error(probe, job.who() + "what comes before this filter failed: ");
}

// The filter between the failing one and the probe has no error of its own.
TEST(Faults, OfFiltersFurtherBefore) {
    BrokenJob job;
    vtkNew<Failing> before;
    before->piece = job.mesh_here;
    before->how = job.here ? 4 : 3;
    vtkNew<vtkPassThrough> between;
    between->SetInputConnection(before->GetOutputPort());
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceConnection(between->GetOutputPort());
    probe->SetInputData(job.mine);
    expect_error(probe, job.who() + "what comes before this filter failed: ");
}

TEST(Faults, OfFilesThatAreNotThere) {
    BrokenJob job;
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName("no-such-file.vtu");
    vtkNew<vtkPBarycertProbe> probe;
    if (job.here)
        probe->SetSourceConnection(reader->GetOutputPort());
    else
        probe->SetSourceData(job.mesh_here);
    probe->SetInputData(job.mine);
    expect_error(probe, job.who() + "what comes before this filter failed: ");
}

}  // namespace
}  // namespace barycert::testing
