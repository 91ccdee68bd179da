// vtkPBarycertProbe: its arrays and options; ranks that have nothing.

#include <gtest/gtest.h>

#include <cmath>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkDummyController.h>
#include <vtkFloatArray.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mpi/pieces.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkPBarycertProbe.h"

namespace barycert::testing {
namespace {

Job small_job() {
    return {box(3, {3, 2, 2}), 30};
}

TEST(Arrays, FollowTheOptions) {
    Job job = small_job();
    vtkNew<vtkDoubleArray> own, same;
    own->SetName("own");
    same->SetName("v");
    for (vtkIdType i = 0; i < job.mine->GetNumberOfPoints(); ++i) {
        own->InsertNextValue(static_cast<double>(i));
        same->InsertNextValue(-1);
    }
    job.mine->GetPointData()->AddArray(own);
    job.mine->GetPointData()->AddArray(same);
    const auto piece = job.piece(Cut::scattered);
    for (int options = 0; options < 8; ++options) {
        SCOPED_TRACE(options);
        const auto run = [&](auto probe, vtkUnstructuredGrid* source) {
            probe->SetSourceData(source);
            probe->SetInputData(job.mine);
            probe->SetCategoricalData(options & 1);
            probe->SetOutsideIsNaN((options & 2) != 0);
            probe->SetPassPointArrays(options & 4);
            probe->SetValidPointMaskArrayName("mask");
            probe->Update();
            return probe;
        };
        const auto ours = run(vtkSmartPointer<vtkPBarycertProbe>::New(), piece);
        const auto judge = run(vtkSmartPointer<vtkBarycertProbe>::New(), job.whole);
        expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
    }
}

TEST(Arrays, OfRanksWithoutCellsAreThoseOfTheOthers) {
    Job job = small_job();
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    const auto piece = job.piece(Cut::one_rank);
    const bool last = rank() == ranks() - 1;
    const auto expect = [&](vtkDataObject* source) {
        const auto ours = probed<vtkPBarycertProbe>(last ? piece.Get() : source, job.mine);
        expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
    };
    // No source at all; one without anything; nodes and triangles beside the tetrahedra, with other arrays; ghosts.
    expect(nullptr);
    expect(vtkSmartPointer<vtkUnstructuredGrid>::New());
    const auto lower = grid_of(own_mesh("plate"), 0);
    vtkNew<vtkFloatArray> other;
    other->SetName("v");
    other->SetNumberOfTuples(lower->GetNumberOfPoints());
    other->Fill(1);
    lower->GetPointData()->AddArray(other);
    expect(ranks() > 1 ? lower.Get() : nullptr);
    vtkNew<vtkUnstructuredGrid> ghosts;
    ghosts->ShallowCopy(job.whole);
    vtkNew<vtkUnsignedCharArray> flags;
    flags->SetName(vtkDataSetAttributes::GhostArrayName());
    flags->SetNumberOfTuples(ghosts->GetNumberOfCells());
    flags->Fill(vtkDataSetAttributes::DUPLICATECELL);
    ghosts->GetCellData()->AddArray(flags);
    expect(ghosts);
}

TEST(Arrays, OfNothingAreNothing) {
    Job job = small_job();
    vtkNew<vtkUnstructuredGrid> empty;
    Messages messages;
    const auto nowhere = probed<vtkPBarycertProbe>(empty, job.mine);
    EXPECT_EQ(nowhere->GetValidPoints()->GetNumberOfTuples(), 0);
    EXPECT_EQ(nowhere->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetNumberOfTuples(),
              job.mine->GetNumberOfPoints());
    const auto none = probed<vtkPBarycertProbe>(job.piece(Cut::slabs), vtkSmartPointer<vtkPolyData>::New());
    EXPECT_EQ(none->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(none->GetOutput()->GetPointData()->GetArray("v")->GetNumberOfTuples(), 0);
    EXPECT_EQ(messages.all(), "");
}

TEST(Arrays, OfTheMeshBeforeTheMaskOfAnEarlierProbe) {
    Job job = small_job();
    vtkNew<vtkDoubleArray> mask;
    mask->SetName("vtkValidPointMask");
    mask->SetNumberOfTuples(job.whole->GetNumberOfPoints());
    mask->Fill(0.5);
    job.whole->GetPointData()->AddArray(mask);
    const auto ours = probed<vtkPBarycertProbe>(job.piece(Cut::slabs), job.mine);
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
}

// The index stays; points and values change.
TEST(Arrays, AreMadeAgainWhenInputsChange) {
    Job job = small_job();
    const auto piece = job.piece(Cut::round_robin);
    const auto probe = probed<vtkPBarycertProbe>(piece, job.mine);
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    const auto others = points_of(share_of(job.points, ranks() - 1 - rank(), ranks()));
    probe->SetInputData(others);
    judge->SetInputData(others);
    for (vtkUnstructuredGrid* const grid : {piece.Get(), job.whole.Get()}) {
        vtkDataArray* const values = grid->GetPointData()->GetArray("float");
        for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i) values->SetTuple1(i, 2 * values->GetTuple1(i));
        values->Modified();
    }
    probe->Update();
    judge->Update();
    expect_same(probe->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
}

// Every process for itself.
TEST(Arrays, OfOneProcessNeedNoController) {
    Job job = small_job();
    vtkNew<vtkDummyController> dummy;
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    for (vtkMultiProcessController* const controller :
         {static_cast<vtkMultiProcessController*>(nullptr), static_cast<vtkMultiProcessController*>(dummy.Get())}) {
        vtkNew<vtkPBarycertProbe> probe;
        probe->SetController(controller);
        probe->SetSourceData(job.whole);
        probe->SetInputData(job.mine);
        probe->Update();
        expect_same(probe->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
        EXPECT_EQ(probe->GetBytesSent(), 0);
    }
}

}  // namespace
}  // namespace barycert::testing
