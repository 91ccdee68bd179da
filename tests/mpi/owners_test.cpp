// vtkPBarycertProbe: the bytes of vtkBarycertProbe on the whole mesh, however it is cut; owners against the oracle.

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "tests/core/same_everywhere.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mpi/pieces.hpp"
#include "tests/vtk/grids.hpp"
#include "tests/vtk/mixed_grids.hpp"
#include "vtkPBarycertProbe.h"

namespace barycert::testing {
namespace {

void expect_as_of_the_whole(vtkUnstructuredGrid* whole, vtkDataSet* piece, vtkDataSet* input) {
    const auto ours = probed<vtkPBarycertProbe>(piece, input);
    const auto judge = probed<vtkBarycertProbe>(whole, input);
    EXPECT_TRUE(ours->GetExact());
    expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
    ASSERT_EQ(ours->GetValidPoints()->GetNumberOfTuples(), judge->GetValidPoints()->GetNumberOfTuples());
    for (vtkIdType i = 0; i < judge->GetValidPoints()->GetNumberOfTuples(); ++i)
        ASSERT_EQ(ours->GetValidPoints()->GetValue(i), judge->GetValidPoints()->GetValue(i));
}

std::vector<double> in_space(const Mesh& mesh, const std::vector<double>& points, double plane) {
    if (mesh.dimension == 3) return points;
    std::vector<double> all;
    for (std::size_t i = 0; i < points.size(); i += 2)
        all.insert(all.end(), {points[i], points[i + 1], i % 10 == 8 ? plane + 1 : plane});
    return all;
}

TEST(Owners, AreThoseOfTheWholeHoweverItIsCut) {
    for (const char* const stem : {"lattice-box", "cube-hole", "flange", "plate"}) {
        const Mesh mesh = own_mesh(stem);
        const auto whole = with_arrays(mesh, 0.25);
        base::Random random(3);
        const std::vector<double> points = in_space(mesh, awkward_points(mesh, 40, random), 0.25);
        for (const Cut cut : all_cuts) {
            for (const bool ghosts : {false, true}) {
                SCOPED_TRACE(std::string(stem) + ", " + name(cut) + (ghosts ? ", ghosts" : ""));
                const auto piece = piece_of(whole, ranks_of_cells(whole, cut), rank(), ghosts, random);
                expect_as_of_the_whole(whole, piece, points_of(share_of(points, rank(), ranks())));
            }
        }
    }
}

// The oracle says what the lowest global id is; and many points must lie on seams.
TEST(Owners, OnSeamsAreTheLowestGlobalIds) {
    const Mesh mesh = box(3, {4, 2, 2});
    const auto whole = with_arrays(mesh);
    const PointJudge judge(mesh);
    base::Random random(5);
    for (const Cut cut : all_cuts) {
        for (const bool ghosts : {false, true}) {
            SCOPED_TRACE(std::string(name(cut)) + (ghosts ? ", ghosts" : ""));
            const std::vector<int> of = ranks_of_cells(whole, cut);
            const std::vector<double> points = awkward_points(mesh, 60, random);
            const std::vector<double> mine = share_of(points, rank(), ranks());
            const auto probe = probed<vtkPBarycertProbe>(piece_of(whole, of, rank(), ghosts, random), points_of(mine));
            auto* const ids = vtkIdTypeArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("ids"));
            vtkDataArray* const mask = probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask");
            ASSERT_TRUE(ids != nullptr && mask != nullptr);
            int on_seams = 0;
            for (std::size_t i = 0; i < mine.size() / 3; ++i) {
                const std::vector<Held> holders = judge.holders(mine.data() + 3 * i);
                const auto at = static_cast<vtkIdType>(i);
                ASSERT_EQ(mask->GetTuple1(at), holders.empty() ? 0 : 1) << text_of(mine.data() + 3 * i, 3);
                if (holders.empty()) continue;
                ASSERT_EQ(ids->GetValue(at), 3 * holders.front().cell + 5) << text_of(mine.data() + 3 * i, 3);
                const int owner = of[static_cast<std::size_t>(holders.front().cell)];
                for (const Held& held : holders)
                    if (of[static_cast<std::size_t>(held.cell)] != owner) {
                        ++on_seams;
                        break;
                    }
            }
            int all = 0;
            vtkMultiProcessController::GetGlobalController()->AllReduce(&on_seams, &all, 1, vtkCommunicator::SUM_OP);
            const bool one_piece = ranks() == 1 || cut == Cut::one_rank || (cut == Cut::half && ranks() == 2);
            EXPECT_TRUE(one_piece || all > 20) << all;
        }
    }
}

TEST(Owners, DoNotDependOnWhereThePointsAre) {
    Job job(own_mesh("lattice-box"), 20);
    const auto piece = job.piece(Cut::scattered);
    // All on each rank; all on the last; all on the first, which has no cells.
    expect_as_of_the_whole(job.whole, piece, points_of(job.points));
    expect_as_of_the_whole(job.whole, piece, points_of(rank() == ranks() - 1 ? job.points : std::vector<double>()));
    const auto far = job.piece(Cut::one_rank);
    expect_as_of_the_whole(job.whole, far, points_of(rank() == 0 ? job.points : std::vector<double>()));
}

TEST(Owners, OfImagesAreThoseOfTheirPoints) {
    Job job(own_mesh("lattice-box"), 0);
    double b[6];
    job.whole->GetBounds(b);
    vtkNew<vtkImageData> image;
    image->SetOrigin(b[0], b[2], b[4]);
    image->SetSpacing((b[1] - b[0]) / 8, (b[3] - b[2]) / 8, (b[5] - b[4]) / 8);
    image->SetExtent(rank(), rank() + 1, 0, 8, -1, 9);
    for (const Cut cut : all_cuts) expect_as_of_the_whole(job.whole, job.piece(cut), image);
}

// So many that ranks tell finer boxes of their pieces than one.
TEST(Owners, OfManyPointsAreThoseOfTheWhole) {
    Job job(own_mesh("flange"), 200);
    double b[6];
    job.whole->GetBounds(b);
    for (int i = 0; i < 6000; ++i)
        for (int a = 0; a < 3; ++a) job.points.push_back(job.random.uniform(b[2 * a], b[2 * a + 1]));
    for (const Cut cut : all_cuts) {
        SCOPED_TRACE(name(cut));
        const auto piece = job.piece(cut);
        const auto mine = points_of(share_of(job.points, rank(), ranks()));
        expect_as_of_the_whole(job.whole, piece, mine);
        // No rank is asked for the same point twice, and in slabs few are asked for it at all.
        const auto probe = probed<vtkPBarycertProbe>(piece, mine);
        const vtkIdType most = mine->GetNumberOfPoints() * (ranks() - 1);
        EXPECT_LE(probe->GetPointsSent(), most);
        EXPECT_TRUE(ranks() < 4 || cut != Cut::slabs || probe->GetPointsSent() < most / 2) << probe->GetPointsSent();
    }
}

// Every rank has the whole mesh, none of it as ghosts.
TEST(Owners, OfCopiesAreTheCellsThemselves) {
    const Job job(own_mesh("cube-hole"), 20);
    expect_as_of_the_whole(job.whole, job.whole, job.mine);
}

// As it should not be: then at least all ranks have the same values.
TEST(Owners, OfCopiesThatDifferAreThoseOfTheLowestRank) {
    const Job job(own_mesh("cube-hole"), 20);
    vtkNew<vtkUnstructuredGrid> copy;
    copy->DeepCopy(job.whole);
    vtkDataArray* const values = copy->GetPointData()->GetArray("float");
    if (rank() > 0) values->Fill(rank());
    expect_as_of_the_whole(job.whole, copy, job.mine);
}

// The mesh has subnormal size: its boxes are nothing where numbers are flushed.
TEST(Owners, AreTheSameInEveryEnvironment) {
    for (const double unit : {0x1p-1070, 0x1p-10}) {
        for (const Cut cut : {Cut::slabs, Cut::scattered}) {
            Job job(mapped(box(3, {4, 2, 2}), {unit, unit, unit}, {0, 0, 0}), 20);
            const auto piece = job.piece(cut);
            expect_as_of_the_whole(job.whole, piece, job.mine);
            testing_environments::expect_same_everywhere(name(cut), [&](testing_environments::Answers& out) {
                vtkNew<vtkUnstructuredGrid> copy;
                copy->DeepCopy(piece);
                const auto probe = probed<vtkPBarycertProbe>(copy, job.mine);
                auto* const v = vtkDoubleArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("v"));
                auto* const ids = vtkIdTypeArray::SafeDownCast(probe->GetOutput()->GetPointData()->GetArray("ids"));
                ASSERT_TRUE(v != nullptr && ids != nullptr);
                for (vtkIdType i = 0; i < v->GetNumberOfValues(); ++i) out.add(v->GetValue(i));
                for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i) out.add(ids->GetValue(i));
                out.add(probe->GetNumberOfPartners());
                out.add(probe->GetPointsSent());
            });
        }
    }
}

// Cells of several types, of which ranks have some: cut by the global ids of points, or as their maps have them.
TEST(Owners, OfMixedCellsAreThoseOfTheWhole) {
    const auto whole = with_arrays(mixed_block(5, 0.125, false));
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName("node");
    for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i) numbers->InsertNextValue(2 * i - 7);
    whole->GetPointData()->SetGlobalIds(numbers);
    base::Random random(8);
    std::vector<double> points;
    for (int i = 0; i < 3000; ++i)
        for (const double high : {5.0, 5.0, 2.0}) points.push_back(random.uniform(-0.125, high + 0.125));
    for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
        points.insert(points.end(), whole->GetPoint(i), whole->GetPoint(i) + 3);
    const auto mine = points_of(share_of(points, rank(), ranks()));
    for (const int interpolation : {vtkBarycertProbe::PULLING, vtkBarycertProbe::MULTILINEAR}) {
        const auto run = [&](auto probe, vtkDataSet* source) {
            probe->SetSourceData(source);
            probe->SetInputData(mine);
            probe->SetInterpolation(interpolation);
            probe->Update();
            return probe;
        };
        const auto judge = run(vtkSmartPointer<vtkBarycertProbe>::New(), whole);
        EXPECT_GT(judge->GetValidPoints()->GetNumberOfTuples(), mine->GetNumberOfPoints() / 2);
        for (const Cut cut : all_cuts) {
            for (const bool ghosts : {false, true}) {
                SCOPED_TRACE(std::string(name(cut)) + (ghosts ? ", ghosts" : ""));
                Messages messages;
                const auto piece = piece_of(whole, ranks_of_cells(whole, cut), rank(), ghosts, random);
                const auto ours = run(vtkSmartPointer<vtkPBarycertProbe>::New(), piece);
                expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
                EXPECT_EQ(messages.count("global ids"), 0) << messages.all();
            }
        }
    }
    // Without the ids of points values may differ, and it is told.
    Messages messages;
    const auto piece = piece_of(whole, ranks_of_cells(whole, Cut::slabs), rank(), false, random);
    piece->GetPointData()->SetGlobalIds(nullptr);
    EXPECT_TRUE(probed<vtkPBarycertProbe>(piece, mine)->GetExact());
    EXPECT_EQ(messages.count("the points of some source have no global ids"), rank() == 0 && ranks() > 1 ? 1 : 0)
        << messages.all();
}

// Cells in slabs of their order, without ids: numbers by rank are those of the whole.
TEST(Owners, WithoutGlobalIdsAreByRankAndItSaysSo) {
    Job job(own_mesh("lattice-box"), 40);
    vtkUnstructuredGrid* const whole = job.whole;
    const auto all = static_cast<std::int64_t>(job.mesh.cell_count());
    vtkNew<vtkUnstructuredGrid> piece;
    piece->SetPoints(whole->GetPoints());
    piece->GetPointData()->ShallowCopy(whole->GetPointData());
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("ids");
    piece->Allocate();
    for (std::int64_t i = all * rank() / ranks(); i < all * (rank() + 1) / ranks(); ++i) {
        piece->InsertNextCell(whole->GetCellType(i), whole->GetCell(i)->GetPointIds());
        ids->InsertNextValue(3 * i + 5);
    }
    piece->GetCellData()->AddArray(ids);
    Messages messages;
    const auto ours = probed<vtkPBarycertProbe>(piece, job.mine);
    EXPECT_EQ(messages.count("no global ids"), rank() == 0 && ranks() > 1 ? 1 : 0) << messages.all();
    whole->GetCellData()->RemoveArray("large");
    const auto judge = probed<vtkBarycertProbe>(whole, job.mine);
    expect_same(ours->GetOutput()->GetPointData(), judge->GetOutput()->GetPointData());
}

}  // namespace
}  // namespace barycert::testing
