#include "tests/mpi/pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include "tests/mesh/locate/points.hpp"
#include "tests/vtk/grids.hpp"

namespace barycert::testing {

int rank() {
    return vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
}

int ranks() {
    return vtkMultiProcessController::GetGlobalController()->GetNumberOfProcesses();
}

const char* name(Cut cut) {
    switch (cut) {
        case Cut::slabs:
            return "slabs";
        case Cut::backwards:
            return "backwards";
        case Cut::scattered:
            return "scattered";
        case Cut::round_robin:
            return "round robin";
        case Cut::one_rank:
            return "one rank";
        case Cut::half:
            return "half of the ranks";
    }
    return "";
}

std::vector<int> ranks_of_cells(vtkUnstructuredGrid* whole, Cut cut) {
    const vtkIdType count = whole->GetNumberOfCells();
    std::vector<int> of(static_cast<std::size_t>(count));
    base::Random random(7);
    double box[6];
    whole->GetBounds(box);
    for (vtkIdType i = 0; i < count; ++i) {
        double b[6];
        whole->GetCellBounds(i, b);
        const double share = ((b[0] + b[1]) / 2 - box[0]) / (box[1] - box[0]);
        const auto slab = [&](int n) { return std::min(static_cast<int>(share * n), n - 1); };
        int& its = of[static_cast<std::size_t>(i)];
        switch (cut) {
            case Cut::slabs:
                its = slab(ranks());
                break;
            case Cut::backwards:
                its = ranks() - 1 - slab(ranks());
                break;
            case Cut::scattered:
                its = static_cast<int>(random.below(static_cast<std::uint64_t>(ranks())));
                break;
            case Cut::round_robin:
                its = static_cast<int>(i % ranks());
                break;
            case Cut::one_rank:
                its = ranks() - 1;
                break;
            case Cut::half:
                its = 2 * slab((ranks() + 1) / 2);
                break;
        }
    }
    return of;
}

namespace {

template <class T>
void shuffle(std::vector<T>& items, base::Random& random) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

// Values of ghosts may be of another time, or none: of cells, and of nodes that ghosts alone have.
void spoil_ghosts(vtkUnstructuredGrid& piece, vtkUnsignedCharArray& ghosts) {
    std::vector<char> mine(static_cast<std::size_t>(piece.GetNumberOfPoints()), 0);
    vtkDataArray* const large = piece.GetCellData()->GetArray("large");
    vtkDataArray* const vectors = piece.GetPointData()->GetArray("v");
    for (vtkIdType i = 0; i < piece.GetNumberOfCells(); ++i) {
        vtkIdType size = 0;
        const vtkIdType* nodes = nullptr;
        piece.GetCellPoints(i, size, nodes);
        if (ghosts.GetValue(i) != 0) large->SetTuple2(i, -7, -7);
        for (vtkIdType k = 0; k < size && ghosts.GetValue(i) == 0; ++k) mine[static_cast<std::size_t>(nodes[k])] = 1;
    }
    for (vtkIdType i = 0; i < piece.GetNumberOfPoints(); ++i)
        if (mine[static_cast<std::size_t>(i)] == 0) vectors->SetTuple2(i, 1e9, -1e9);
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> piece_of(vtkUnstructuredGrid* whole, const std::vector<int>& ranks, int rank,
                                              bool with_ghosts, base::Random& random) {
    const vtkIdType nodes = whole->GetNumberOfPoints(), cells = whole->GetNumberOfCells();
    std::vector<char> touched(static_cast<std::size_t>(nodes), 0), used = touched;
    const auto nodes_of = [&](vtkIdType cell) {
        vtkIdType size = 0;
        const vtkIdType* ids = nullptr;
        whole->GetCellPoints(cell, size, ids);
        return std::span<const vtkIdType>(ids, static_cast<std::size_t>(size));
    };
    for (vtkIdType i = 0; i < cells; ++i)
        if (ranks[static_cast<std::size_t>(i)] == rank)
            for (const vtkIdType n : nodes_of(i)) touched[static_cast<std::size_t>(n)] = 1;
    std::vector<vtkIdType> mine, my_nodes;
    for (vtkIdType i = 0; i < cells; ++i) {
        const std::span<const vtkIdType> its = nodes_of(i);
        const bool near =
            std::any_of(its.begin(), its.end(), [&](vtkIdType n) { return touched[static_cast<std::size_t>(n)] != 0; });
        if (ranks[static_cast<std::size_t>(i)] != rank && !(with_ghosts && near)) continue;
        mine.push_back(i);
        for (const vtkIdType n : its) used[static_cast<std::size_t>(n)] = 1;
    }
    for (vtkIdType n = 0; n < nodes; ++n)
        if (used[static_cast<std::size_t>(n)] != 0) my_nodes.push_back(n);
    shuffle(mine, random);
    shuffle(my_nodes, random);

    const auto piece = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::vector<vtkIdType> number(static_cast<std::size_t>(nodes), -1);
    // Global ids, too.
    piece->GetPointData()->CopyAllOn();
    piece->GetCellData()->CopyAllOn();
    piece->GetPointData()->CopyAllocate(whole->GetPointData());
    piece->GetCellData()->CopyAllocate(whole->GetCellData());
    for (const vtkIdType n : my_nodes) {
        number[static_cast<std::size_t>(n)] = points->InsertNextPoint(whole->GetPoint(n));
        piece->GetPointData()->CopyData(whole->GetPointData(), n, number[static_cast<std::size_t>(n)]);
    }
    piece->SetPoints(points);
    piece->Allocate();
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (const vtkIdType cell : mine) {
        std::vector<vtkIdType> ids;
        for (const vtkIdType n : nodes_of(cell)) ids.push_back(number[static_cast<std::size_t>(n)]);
        const vtkIdType at =
            piece->InsertNextCell(whole->GetCellType(cell), static_cast<vtkIdType>(ids.size()), ids.data());
        piece->GetCellData()->CopyData(whole->GetCellData(), cell, at);
        ghosts->InsertNextValue(ranks[static_cast<std::size_t>(cell)] == rank ? 0
                                                                              : vtkDataSetAttributes::DUPLICATECELL);
    }
    if (with_ghosts) piece->GetCellData()->AddArray(ghosts);
    spoil_ghosts(*piece, *ghosts);
    return piece;
}

vtkSmartPointer<vtkUnstructuredGrid> with_arrays(const Mesh& mesh, double plane) {
    return with_arrays(grid_of(mesh, plane));
}

vtkSmartPointer<vtkUnstructuredGrid> with_arrays(vtkSmartPointer<vtkUnstructuredGrid> grid) {
    base::Random random(11);
    vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("v");
    vectors->SetNumberOfComponents(2);
    vectors->SetComponentName(0, "east");
    vectors->SetComponentName(1, "north");
    vtkNew<vtkFloatArray> floats;
    floats->SetName("float");
    vtkNew<vtkIntArray> integers;
    integers->SetName("integer");
    vtkNew<vtkSOADataArrayTemplate<double>> apart;
    apart->SetName("apart");
    apart->SetNumberOfComponents(3);
    vtkNew<vtkStringArray> texts;
    texts->SetName("text");
    vtkNew<vtkBitArray> bits;
    bits->SetName("bit");
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
        double t[3];
        for (double& x : t) x = random.uniform(-1, 1);
        vectors->InsertNextTuple(t);
        apart->InsertNextTuple(t);
        floats->InsertNextValue(static_cast<float>(t[0]));
        integers->InsertNextValue(static_cast<int>(1000 * t[1]));
        texts->InsertNextValue(std::string(static_cast<std::size_t>(i % 40), 'a') + std::to_string(i));
        bits->InsertNextValue(t[2] < 0 ? 0 : 1);
    }
    vtkPointData* const nodal = grid->GetPointData();
    for (vtkAbstractArray* const array :
         {static_cast<vtkAbstractArray*>(vectors.Get()), static_cast<vtkAbstractArray*>(floats.Get()),
          static_cast<vtkAbstractArray*>(integers.Get()), static_cast<vtkAbstractArray*>(apart.Get()),
          static_cast<vtkAbstractArray*>(texts.Get()), static_cast<vtkAbstractArray*>(bits.Get())})
        nodal->AddArray(array);
    nodal->SetActiveScalars("integer");
    vtkNew<vtkIdTypeArray> ids, large;
    ids->SetName("ids");
    large->SetName("large");
    large->SetNumberOfComponents(2);
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        ids->InsertNextValue(3 * i + 5);
        large->InsertNextTuple2(0, 0);
        large->SetTypedComponent(i, 0, i + (vtkIdType{1} << 60));
        large->SetTypedComponent(i, 1, -i);
    }
    grid->GetCellData()->AddArray(large);
    grid->GetCellData()->SetGlobalIds(ids);
    return grid;
}

Job::Job(Mesh of, int awkward)
    : mesh(std::move(of)),
      whole(with_arrays(mesh)),
      points(awkward_points(mesh, awkward, random)),
      mine(points_of(share_of(points, rank(), ranks()))) {}

vtkSmartPointer<vtkUnstructuredGrid> Job::piece(Cut cut, bool with_ghosts) {
    return piece_of(whole, ranks_of_cells(whole, cut), rank(), with_ghosts, random);
}

std::vector<double> share_of(const std::vector<double>& points, int rank, int ranks) {
    std::vector<double> mine;
    for (std::size_t i = static_cast<std::size_t>(rank); i < points.size() / 3; i += static_cast<std::size_t>(ranks))
        mine.insert(mine.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * i),
                    points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    return mine;
}

void expect_same(vtkPointData* got, vtkPointData* expected) {
    ASSERT_EQ(got->GetNumberOfArrays(), expected->GetNumberOfArrays());
    for (int i = 0; i < got->GetNumberOfArrays(); ++i) {
        vtkAbstractArray& a = *got->GetAbstractArray(i);
        vtkAbstractArray& b = *expected->GetAbstractArray(i);
        ASSERT_STREQ(a.GetName(), b.GetName());
        SCOPED_TRACE(a.GetName());
        ASSERT_EQ(a.GetDataType(), b.GetDataType());
        ASSERT_EQ(a.GetNumberOfComponents(), b.GetNumberOfComponents());
        ASSERT_EQ(a.GetNumberOfTuples(), b.GetNumberOfTuples());
        EXPECT_EQ(got->IsArrayAnAttribute(i), expected->IsArrayAnAttribute(i));
        for (int c = 0; c < a.GetNumberOfComponents(); ++c) EXPECT_STREQ(a.GetComponentName(c), b.GetComponentName(c));
        const auto plain = [](vtkAbstractArray& array) {
            const auto copy =
                vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(array.GetDataType()));
            copy->DeepCopy(&array);
            return copy;
        };
        const auto values = plain(a), others = plain(b);
        if (a.IsNumeric() != 0 && a.GetDataType() != VTK_BIT) {
            const auto width = static_cast<std::size_t>(a.GetDataTypeSize());
            for (vtkIdType k = 0; k < a.GetNumberOfValues(); ++k)
                ASSERT_EQ(std::memcmp(values->GetVoidPointer(k), others->GetVoidPointer(k), width), 0)
                    << k << ": " << a.GetVariantValue(k).ToString() << ", not " << b.GetVariantValue(k).ToString();
        } else {
            for (vtkIdType k = 0; k < a.GetNumberOfValues(); ++k)
                ASSERT_TRUE(a.GetVariantValue(k) == b.GetVariantValue(k))
                    << k << ": " << a.GetVariantValue(k).ToString() << ", not " << b.GetVariantValue(k).ToString();
        }
    }
}

}  // namespace barycert::testing
