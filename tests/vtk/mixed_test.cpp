// Data sets of cells of every type: owners, values and weights are those of barycert's own reader and sampler on the
// file that VTK writes of them, and, of cells that are cut, of the oracle.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellTypeSource.h>
#include <vtkGenericCell.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStaticCellLocator.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLDataSetWriter.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/sampler.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/shaped_mesh.hpp"
#include "tests/scratch.hpp"
#include "tests/vtk/grids.hpp"
#include "tests/vtk/mixed_grids.hpp"
#include "vtkBarycertLocator.h"
#include "vtkBarycertProbe.h"

namespace barycert::testing {
namespace {

/// As barycert reads it from a file.
Mesh read_back(vtkDataSet* data) {
    const test::Scratch folder;
    const char* const suffix = vtkImageData::SafeDownCast(data) != nullptr         ? ".vti"
                               : vtkRectilinearGrid::SafeDownCast(data) != nullptr ? ".vtr"
                               : vtkStructuredGrid::SafeDownCast(data) != nullptr  ? ".vts"
                               : vtkPolyData::SafeDownCast(data) != nullptr        ? ".vtp"
                                                                                   : ".vtu";
    const std::string path = folder.path(std::string("data") + suffix);
    vtkNew<vtkXMLDataSetWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(path.c_str());
    writer->Write();
    return read_vtk(path).value();
}

/// Nodes, middles of the nodes of cells, and of some of them, and places around: three coordinates each.
std::vector<double> places_around(vtkDataSet* data, std::size_t count) {
    base::Random random(5);
    double b[6];
    data->GetBounds(b);
    std::vector<double> all;
    vtkNew<vtkIdList> nodes;
    for (std::size_t i = 0; i < count; ++i) {
        double x[3] = {0, 0, 0};
        data->GetCellPoints(static_cast<vtkIdType>(random.below(static_cast<std::uint64_t>(data->GetNumberOfCells()))),
                            nodes);
        const auto size = static_cast<std::uint64_t>(nodes->GetNumberOfIds());
        const std::uint64_t some = i % 5 == 0 ? 1 : i % 5 == 1 ? 2 : i % 5 == 2 ? 4 : size;
        const std::uint64_t first = random.below(size);
        for (std::uint64_t k = 0; k < some; ++k) {
            double at[3];
            data->GetPoint(nodes->GetId(static_cast<vtkIdType>((first + k) % size)), at);
            for (int a = 0; a < 3; ++a) x[a] += at[a] / static_cast<double>(some);
        }
        for (int a = 0; a < 3; ++a) {
            if (i % 5 == 4) x[a] = random.uniform(b[2 * a] - 0.125, b[2 * a + 1] + 0.125);
            if (b[2 * a] == b[2 * a + 1]) x[a] = i % 11 == 10 ? b[2 * a] + 1 : b[2 * a];
        }
        all.insert(all.end(), x, x + 3);
    }
    return all;
}

struct Setting {
    int interpolation = vtkBarycertProbe::PULLING, curved = vtkBarycertProbe::ISOPARAMETRIC;
    BuildOptions options() const {
        return {.interpolation = static_cast<CellInterpolation>(interpolation), .curved = static_cast<Curved>(curved)};
    }
};
const std::vector<Setting> settings{
    {}, {vtkBarycertProbe::MULTILINEAR}, {vtkBarycertProbe::PULLING, vtkBarycertProbe::STRAIGHT}};

vtkSmartPointer<vtkBarycertProbe> probed(vtkDataSet* data, const std::vector<double>& points, Setting setting = {}) {
    const auto probe = vtkSmartPointer<vtkBarycertProbe>::New();
    probe->SetSourceData(data);
    probe->SetInputData(points_of(points));
    probe->SetInterpolation(setting.interpolation);
    probe->SetCurvedCells(setting.curved);
    probe->Update();
    return probe;
}

/// The point in the mesh's axes, x and y, for points that are inside.
std::vector<double> in_mesh(const Mesh& mesh, const double* x) {
    return {x, x + mesh.dimension};
}

/// Compares vtkBarycertProbe and vtkBarycertLocator with barycert's Sampler and node_weights. Polygons lie in z = 0.
/// Returns how many points are inside.
int expect_as_sampled(vtkDataSet* data, Setting setting, std::size_t count) {
    const Mesh mesh = read_back(data);
    const Sampler sampler = Sampler::build(mesh, {"f"}, setting.options()).value();
    EXPECT_EQ(sampler.locator().unmapped_cells(), 0U);
    const std::vector<double> points = places_around(data, count);
    const auto probe = probed(data, points, setting);
    EXPECT_TRUE(probe->GetExact());
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    auto* const f = vtkDoubleArray::SafeDownCast(out->GetArray("f"));
    auto* const id = vtkIdTypeArray::SafeDownCast(out->GetArray("id"));
    vtkDataArray* const mask = out->GetArray("vtkValidPointMask");
    vtkNew<vtkBarycertLocator> locator;
    locator->SetInterpolation(setting.interpolation);
    locator->SetCurvedCells(setting.curved);
    locator->SetDataSet(data);
    locator->BuildLocator();
    EXPECT_TRUE(locator->GetExact()) << locator->GetReason();
    if (f == nullptr || id == nullptr || mask == nullptr) return 0;
    vtkNew<vtkGenericCell> cell;
    int inside = 0;
    for (vtkIdType i = 0; i < id->GetNumberOfTuples(); ++i) {
        double x[3] = {points[static_cast<std::size_t>(3 * i)], points[static_cast<std::size_t>(3 * i + 1)],
                       points[static_cast<std::size_t>(3 * i + 2)]};
        SCOPED_TRACE(text_of(x, 3));
        Table row = sampler.sample(in_mesh(mesh, x)).value();
        if (mesh.dimension == 2 && x[2] != 0) row.cells[0] = -1;
        const bool in = row.cells[0] >= 0;
        const vtkIdType owner = mesh.cell_number(row.cells[0]);
        EXPECT_EQ(mask->GetTuple1(i), in ? 1 : 0);
        EXPECT_EQ(id->GetValue(i), in ? owner : 0);
        EXPECT_EQ(f->GetValue(i), in ? row.values[0] : 0);
        std::vector<double> weights(static_cast<std::size_t>(data->GetMaxCellSize()), -7);
        double pcoords[3] = {-7, -7, -7};
        int sub_id = -7;
        EXPECT_EQ(locator->FindCell(x), in ? owner : -1);
        const vtkIdType found = locator->FindCell(x, 0, cell, sub_id, pcoords, weights.data());
        EXPECT_EQ(found, in ? owner : -1);
        if (!in || found != owner) continue;
        ++inside;
        row.points = in_mesh(mesh, x);
        const NodeWeights expected = node_weights(sampler.locator(), row.view()).value();
        std::vector<double> dense(weights.size(), -7);
        std::fill_n(dense.begin(), cell->GetNumberOfPoints(), 0.0);
        for (std::size_t k = 0; k < expected.nodes.size(); ++k)
            dense[static_cast<std::size_t>(cell->PointIds->IsId(expected.nodes[k]))] = expected.weights[k];
        EXPECT_EQ(weights, dense);
        // Where the cell's own map has the point; VTK stops where a step is below 0.001. In prisms of five and six
        // sides its Newton's method may fail, and of strips its own two functions do not fit together.
        std::vector<double> own(weights.size());
        double back[3];
        cell->EvaluateLocation(sub_id, pcoords, back, own.data());
        const int type = cell->GetCellType();
        if (type == VTK_POLYHEDRON || type == VTK_TRIANGLE_STRIP || type == VTK_PENTAGONAL_PRISM ||
            type == VTK_HEXAGONAL_PRISM)
            continue;
        if (setting.curved == vtkBarycertProbe::STRAIGHT && cell->IsLinear() == 0) continue;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(back[a], x[a], 2e-3 * (1 + std::abs(x[a]))) << type;
        const bool multilinear =
            setting.interpolation == vtkBarycertLocator::MULTILINEAR && type >= VTK_PIXEL && type <= VTK_PYRAMID;
        if (!multilinear) continue;
        for (std::size_t k = 0; k < static_cast<std::size_t>(cell->GetNumberOfPoints()); ++k)
            EXPECT_NEAR(own[k], weights[k], 1e-3) << cell->GetCellType();
    }
    return inside;
}

void expect_as_sampled(vtkDataSet* data, std::size_t count = 300, int least = 60) {
    add_arrays(data);
    Messages messages;
    for (const Setting& setting : settings) {
        SCOPED_TRACE("interpolation " + std::to_string(setting.interpolation) + ", curved " +
                     std::to_string(setting.curved));
        EXPECT_GE(expect_as_sampled(data, setting, count), least);
    }
}

TEST(Mixed, CellsOfEachLinearTypeAreSampled) {
    for (const int type : {VTK_TRIANGLE, VTK_QUAD, VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID,
                           VTK_PENTAGONAL_PRISM, VTK_HEXAGONAL_PRISM}) {
        for (const double by : {0.0, 0.125}) {
            SCOPED_TRACE(std::to_string(type) + ", moved by " + std::to_string(by));
            vtkNew<vtkCellTypeSource> source;
            source->SetCellType(type);
            source->SetBlocksDimensions(3, 3, 2);
            source->Update();
            vtkNew<vtkUnstructuredGrid> grid;
            grid->DeepCopy(source->GetOutput());
            move_points(grid, by, source->GetCellDimension());
            expect_as_sampled(grid, 200);
        }
    }
}

TEST(Mixed, CellsOfHigherOrderAreSampled) {
    struct Kind {
        int type, order;
    };
    for (const auto& [type, order] : {Kind{VTK_QUADRATIC_TRIANGLE, 2},
                                      {VTK_QUADRATIC_TETRA, 2},
                                      {VTK_LAGRANGE_TRIANGLE, 3},
                                      {VTK_LAGRANGE_TETRAHEDRON, 3},
                                      {VTK_LAGRANGE_TETRAHEDRON, 4},
                                      {VTK_QUADRATIC_HEXAHEDRON, 2}}) {
        for (const double by : {0.0, 0.02}) {
            SCOPED_TRACE(std::to_string(type) + " of order " + std::to_string(order) + ", moved by " +
                         std::to_string(by));
            vtkNew<vtkCellTypeSource> source;
            source->SetCellType(type);
            source->SetCellOrder(order);
            source->SetBlocksDimensions(2, 2, 1);
            source->Update();
            vtkNew<vtkUnstructuredGrid> grid;
            grid->DeepCopy(source->GetOutput());
            move_points(grid, by / order, source->GetCellDimension());
            expect_as_sampled(grid, 100, 30);
        }
    }
}

TEST(Mixed, GridsOfSeveralTypesAreSampled) {
    for (const double by : {0.0, 0.125}) {
        SCOPED_TRACE(by);
        expect_as_sampled(mixed_block(4, by, true));
    }
    // Simplices of both orders beside each other.
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(VTK_QUADRATIC_TETRA);
    source->SetBlocksDimensions(2, 1, 1);
    source->Update();
    vtkNew<vtkUnstructuredGrid> grid;
    grid->CopyStructure(source->GetOutput());
    move_points(grid, 0.02);
    const vtkIdType far = grid->GetNumberOfPoints();
    for (const auto& x : {std::array{4, 0, 0}, {5, 0, 0}, {4, 1, 0}, {4, 0, 1}})
        grid->GetPoints()->InsertNextPoint(x[0], x[1], x[2]);
    const vtkIdType nodes[4] = {far, far + 1, far + 2, far + 3};
    grid->InsertNextCell(VTK_TETRA, 4, nodes);
    expect_as_sampled(grid);
}

TEST(Mixed, ImagesAndGridsAlongAxesAreSampled) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(5, 4, 3);
    image->SetOrigin(-1, 0.1, 2);
    image->SetSpacing(0.3, 0.5, 0.7);
    expect_as_sampled(image);
    vtkNew<vtkImageData> flat;
    flat->SetDimensions(5, 4, 1);
    expect_as_sampled(flat);
    vtkNew<vtkDoubleArray> x, y, z;
    for (const double v : {0.0, 0.1, 0.5, 2.0}) x->InsertNextValue(v);
    for (const double v : {-1.0, 0.25, 0.3}) y->InsertNextValue(v);
    for (const double v : {3.0, 4.5}) z->InsertNextValue(v);
    vtkNew<vtkRectilinearGrid> rectilinear;
    rectilinear->SetDimensions(4, 3, 2);
    rectilinear->SetXCoordinates(x);
    rectilinear->SetYCoordinates(y);
    rectilinear->SetZCoordinates(z);
    expect_as_sampled(rectilinear);
    vtkNew<vtkStructuredGrid> structured;
    structured->SetDimensions(4, 4, 3);
    vtkNew<vtkPoints> points;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) points->InsertNextPoint(i, j, k);
    structured->SetPoints(points);
    move_points(structured, 0.125);
    expect_as_sampled(structured);
}

/// A pentagon, a strip of four triangles, quadrilaterals and triangles in z = 0.
vtkSmartPointer<vtkPolyData> polygons() {
    const auto data = points_of({0, 0, 0, 2, 0, 0, 3, 1, 0, 1, 3, 0, -1, 1, 0,   4, 0, 0, 5, 1.5,
                                 0, 3, 3, 0, 5, 3, 0, 6, 0, 0, 7, 2, 0,  2, 4.5, 0, 4, 4, 0});
    vtkNew<vtkCellArray> polys, strips;
    const auto add = [](vtkCellArray* to, const std::vector<vtkIdType>& nodes) {
        to->InsertNextCell(static_cast<vtkIdType>(nodes.size()), nodes.data());
    };
    add(polys, {0, 1, 2, 3, 4});
    add(polys, {1, 5, 6, 2});
    add(polys, {2, 7, 3});
    add(polys, {3, 7, 12, 11});
    add(strips, {5, 9, 6, 10, 8, 7});
    data->SetPolys(polys);
    data->SetStrips(strips);
    return data;
}

TEST(Mixed, PolygonsInThePlaneAreSampled) {
    expect_as_sampled(polygons());
}

// The oracle has the last word on cells that are cut: the owner is that of the lowest part that holds the point.
TEST(Mixed, OwnersAndWeightsAreThoseOfTheOracle) {
    for (vtkSmartPointer<vtkDataSet> data :
         {vtkSmartPointer<vtkDataSet>(mixed_block(4, 0.125, true)), vtkSmartPointer<vtkDataSet>(polygons())}) {
        add_arrays(data);
        const Mesh mesh = read_back(data);
        const PointJudge judge(mesh);
        vtkNew<vtkBarycertLocator> locator;
        locator->SetDataSet(data);
        vtkNew<vtkGenericCell> cell;
        int inside = 0, shared = 0;
        const std::vector<double> points = places_around(data, 300);
        for (std::size_t i = 0; i < points.size(); i += 3) {
            double x[3] = {points[i], points[i + 1], points[i + 2]};
            if (mesh.dimension == 2 && x[2] != 0) continue;
            const std::vector<Held> holders = judge.holders(x);
            std::vector<double> weights(static_cast<std::size_t>(data->GetMaxCellSize()));
            double pcoords[3];
            const vtkIdType found = locator->FindCell(x, 0, cell, pcoords, weights.data());
            ASSERT_EQ(found, holders.empty() ? -1 : mesh.cell_number(holders.front().cell)) << text_of(x, 3);
            if (holders.empty()) continue;
            ++inside;
            shared += mesh.cell_number(holders.back().cell) != found ? 1 : 0;
            const OracleAnswer answer = ask_oracle(case_of(mesh, holders.front().cell, x));
            double sum = 0;
            for (std::size_t k = 0; k < mesh.corners(); ++k) {
                const vtkIdType node = mesh.cells[mesh.corners() * static_cast<std::size_t>(holders.front().cell) + k];
                const vtkIdType at = cell->PointIds->IsId(node);
                ASSERT_GE(at, 0);
                ASSERT_EQ(weights[static_cast<std::size_t>(at)], answer.weights[k]) << text_of(x, 3);
                sum += answer.weights[k];
            }
            // All others are 0.
            for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k) sum -= weights[static_cast<std::size_t>(k)];
            ASSERT_NEAR(sum, 0, 1e-15);
        }
        EXPECT_GT(inside, 100);
        EXPECT_GT(shared, 20);
    }
}

TEST(Mixed, ImagesMayBeTurnedAndLieAcrossAnyAxis) {
    vtkNew<vtkImageData> turned;
    turned->SetDimensions(4, 4, 4);
    const double axes[9] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
    turned->SetDirectionMatrix(axes);
    for (const int axis : {0, 1, 2, 3}) {
        vtkNew<vtkImageData> flat;
        flat->SetDimensions(axis == 0 ? 1 : 4, axis == 1 ? 1 : 4, axis == 2 ? 1 : 4);
        flat->SetOrigin(0.25, 0.5, 0.75);
        vtkDataSet* const data = axis == 3 ? turned.Get() : flat.Get();
        add_arrays(data);
        for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
            double box[6];
            data->GetCellBounds(cell, box);
            const auto probe = probed(data, {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2});
            EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask")->GetTuple1(0), 1);
            EXPECT_EQ(probe->GetOutput()->GetPointData()->GetArray("id")->GetTuple1(0), cell);
        }
    }
}

// A surface of quadrilaterals: the triangle that holds the point tells the weights of its polygon.
TEST(Mixed, PolygonsInSpaceAreASurface) {
    const auto data = points_of({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1});
    vtkNew<vtkCellArray> sides;
    for (const auto& s :
         {std::array<vtkIdType, 4>{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
        sides->InsertNextCell(4, s.data());
    data->SetPolys(sides);
    vtkNew<vtkDoubleArray> f;
    f->SetName("f");
    for (vtkIdType i = 0; i < 8; ++i) f->InsertNextValue(data->GetPoint(i)[0] + 2 * data->GetPoint(i)[1]);
    data->GetPointData()->AddArray(f);
    vtkNew<vtkIdTypeArray> id;
    id->SetName("id");
    for (vtkIdType i = 0; i < 6; ++i) id->InsertNextValue(i);
    data->GetCellData()->AddArray(id);
    const auto probe = probed(data, {0.25, 0.5, 1, 0.5, 0.5, 0.5, 1, 0.75, 0.125, 0.5, 0, 0});
    EXPECT_TRUE(probe->GetExact());
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    const auto column = [&](const char* name) {
        std::vector<double> all;
        for (int i = 0; i < 4; ++i) all.push_back(out->GetArray(name)->GetTuple1(i));
        return all;
    };
    EXPECT_EQ(column("vtkValidPointMask"), (std::vector<double>{1, 0, 1, 1}));
    EXPECT_EQ(column("id"), (std::vector<double>{1, 0, 3, 0}));
    EXPECT_EQ(column("f"), (std::vector<double>{1.25, 0, 2.5, 0.5}));

    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(data);
    double x[3] = {0.25, 0.5, 1}, pcoords[3], weights[4];
    vtkNew<vtkGenericCell> cell;
    ASSERT_EQ(locator->FindCell(x, 0, cell, pcoords, weights), 1);
    double sum[3] = {0, 0, 0};
    int zeros = 0;
    for (int k = 0; k < 4; ++k) {
        zeros += weights[k] == 0 ? 1 : 0;
        for (int a = 0; a < 3; ++a) sum[a] += weights[k] * data->GetPoint(cell->GetPointId(k))[a];
    }
    EXPECT_EQ(zeros, 1);
    EXPECT_EQ(std::vector<double>(sum, sum + 3), std::vector<double>(x, x + 3));
    EXPECT_NEAR(pcoords[0], 0.25, 1e-6);
    EXPECT_NEAR(pcoords[1], 0.5, 1e-6);
    // A line through two sides meets each of them once, also along the diagonals of both.
    const double from[3] = {0.5, 0.5, -1}, to[3] = {0.5, 0.5, 2};
    vtkNew<vtkPoints> points;
    vtkNew<vtkIdList> cells;
    EXPECT_EQ(locator->IntersectWithLine(from, to, points, cells), 1);
    ASSERT_EQ(cells->GetNumberOfIds(), 2);
    EXPECT_EQ(cells->GetId(0), 0);
    EXPECT_EQ(cells->GetId(1), 1);
    double t = 0;
    int sub_id = 0;
    EXPECT_EQ(locator->IntersectWithLine(from, to, 0, t, x, pcoords, sub_id), 1);
    EXPECT_EQ(t, 1.0 / 3);
    EXPECT_NEAR(pcoords[0], 0.5, 1e-6);
    EXPECT_NEAR(pcoords[1], 0.5, 1e-6);
    double closest[3], dist2 = 0;
    vtkIdType near = -1;
    const double above[3] = {0.25, 0.5, 3};
    locator->FindClosestPoint(above, closest, near, sub_id, dist2);
    EXPECT_EQ(near, 1);
    EXPECT_EQ(dist2, 4);
}

TEST(Mixed, CategoriesAndTextsFollowTheWeightsOfTheWholeCell) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(2, 2, 2);
    vtkNew<vtkIntArray> classes;
    classes->SetName("class");
    for (int i = 0; i < 8; ++i) classes->InsertNextValue(10 * i);
    image->GetPointData()->SetScalars(classes);
    for (const Setting& setting : settings) {
        vtkNew<vtkBarycertProbe> probe;
        probe->SetSourceData(image);
        probe->SetInputData(points_of({0.875, 0.75, 0.125, 0.5, 0.5, 0.5, 1, 1, 1}));
        probe->SetInterpolation(setting.interpolation);
        probe->CategoricalDataOn();
        probe->Update();
        vtkDataArray* const found = probe->GetOutput()->GetPointData()->GetArray("class");
        EXPECT_EQ(found->GetTuple1(0), 30);
        EXPECT_EQ(found->GetTuple1(1), 0);  // of equal ones the first
        EXPECT_EQ(found->GetTuple1(2), 70);
    }
}

TEST(Mixed, PointsBesideCurvedCellsGoToTheNearest) {
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(VTK_HEXAHEDRON);
    source->SetBlocksDimensions(1, 1, 1);
    source->Update();
    vtkNew<vtkUnstructuredGrid> grid;
    grid->DeepCopy(source->GetOutput());
    vtkNew<vtkBarycertLocator> locator;
    locator->TolerantOn();
    vtkNew<vtkGenericCell> cell;
    double b[6];
    grid->GetBounds(b);
    double x[3] = {b[0] - 0.125, (b[2] + b[3]) / 2, b[4] + 0.25 * (b[5] - b[4])}, pcoords[3], weights[8];
    for (const int interpolation : {vtkBarycertLocator::PULLING, vtkBarycertLocator::MULTILINEAR}) {
        locator->SetInterpolation(interpolation);
        locator->SetDataSet(grid);
        locator->BuildLocator();
        EXPECT_EQ(locator->FindCell(x, 0.1 * 0.1, cell, pcoords, weights), -1);
        ASSERT_EQ(locator->FindCell(x, 0.25 * 0.25, cell, pcoords, weights), 0);
        double sum[3] = {0, 0, 0};
        for (int k = 0; k < 8; ++k)
            for (int a = 0; a < 3; ++a) sum[a] += weights[k] * grid->GetPoint(cell->GetPointId(k))[a];
        EXPECT_EQ(sum[0], b[0]);
        EXPECT_EQ(sum[1], x[1]);
        EXPECT_EQ(sum[2], x[2]);
        double inside[3] = {b[0] + 0.25, x[1], x[2]}, closest[3], dist2 = -1;
        vtkIdType id = -1;
        int sub_id = 0, in = 0;
        EXPECT_EQ(locator->FindClosestPointWithinRadius(inside, 1, closest, cell, id, sub_id, dist2, in), 1);
        EXPECT_EQ(in, 1) << interpolation << " " << id << " " << inside[0] << " " << inside[1] << " " << inside[2];
        EXPECT_EQ(dist2, 0);
        EXPECT_EQ(locator->FindClosestPointWithinRadius(x, 1, closest, cell, id, sub_id, dist2, in), 1);
        EXPECT_EQ(in, 0);
        EXPECT_EQ(dist2, 0.125 * 0.125);
    }
}

TEST(Mixed, GhostsAndHiddenCellsAreLeftOut) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(4, 2, 2);
    add_arrays(image);
    image->AllocateCellGhostArray();
    image->GetCellGhostArray()->SetValue(0, vtkDataSetAttributes::DUPLICATECELL);
    vtkNew<vtkStructuredGrid> structured;
    structured->SetDimensions(4, 2, 2);
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < 16; ++i) points->InsertNextPoint(image->GetPoint(i));
    structured->SetPoints(points);
    add_arrays(structured);
    structured->BlankCell(0);
    for (vtkDataSet* const data : {static_cast<vtkDataSet*>(image.Get()), static_cast<vtkDataSet*>(structured.Get())}) {
        const auto probe = probed(data, {0.5, 0.5, 0.5, 1, 0.5, 0.5, 1.5, 0.5, 0.5});
        vtkPointData* const out = probe->GetOutput()->GetPointData();
        EXPECT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(0), 0);
        EXPECT_EQ(out->GetArray("id")->GetTuple1(1), 1);
        EXPECT_EQ(out->GetArray("id")->GetTuple1(2), 1);
    }
}

TEST(Mixed, CurvedCellsMayBeRefused) {
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(VTK_QUADRATIC_TETRA);
    source->SetBlocksDimensions(1, 1, 1);
    source->Update();
    vtkNew<vtkUnstructuredGrid> grid;
    grid->DeepCopy(source->GetOutput());
    const Setting refuse{vtkBarycertProbe::PULLING, vtkBarycertProbe::REFUSE};
    Messages messages;
    EXPECT_TRUE(probed(grid, {0.5, 0.5, 0.5}, refuse)->GetExact());
    move_points(grid, 0.02);
    EXPECT_EQ(messages.all(), "");
    EXPECT_FALSE(probed(grid, {0.5, 0.5, 0.5}, refuse)->GetExact());
    EXPECT_EQ(messages.count("the mesh is curved"), 1) << messages.all();
    EXPECT_TRUE(probed(grid, {0.5, 0.5, 0.5})->GetExact());
}

TEST(Mixed, WhatIsNotTakenAsAskedIsTold) {
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(VTK_QUADRATIC_HEXAHEDRON);
    source->SetBlocksDimensions(1, 1, 1);
    source->Update();
    {
        Messages messages;
        EXPECT_TRUE(probed(source->GetOutput(), {0.5, 0.5, 0.5})->GetExact());
        EXPECT_EQ(messages.count("1 cells of a higher order: they are taken by their corners"), 1) << messages.all();
    }
    // A folded hexahedron has no map; tetrahedra have none that is multilinear.
    vtkNew<vtkUnstructuredGrid> folded;
    folded->SetPoints(
        points_of({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0.1, 0.1, 0.1, 0, 1, 1})->GetPoints());
    const vtkIdType nodes[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    folded->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
    vtkNew<vtkUnstructuredGrid> tetrahedron;
    tetrahedron->SetPoints(folded->GetPoints());
    const vtkIdType four[4] = {0, 1, 2, 4};
    tetrahedron->InsertNextCell(VTK_TETRA, 4, four);
    const Setting multilinear{vtkBarycertProbe::MULTILINEAR};
    Messages messages;
    probed(folded, {0.25, 0.25, 0.25}, multilinear);
    probed(tetrahedron, {0.25, 0.25, 0.25}, multilinear);
    EXPECT_EQ(messages.count("multilinear interpolation is linear here"), 2) << messages.all();
    vtkNew<vtkBarycertLocator> locator;
    locator->SetInterpolation(vtkBarycertLocator::MULTILINEAR);
    locator->SetDataSet(tetrahedron);
    locator->BuildLocator();
    locator->BuildLocator();
    EXPECT_EQ(messages.count("multilinear interpolation is linear here"), 3) << messages.all();
}

// Cells without known corners are errors of the probe and the locator, and nothing is found.
TEST(Mixed, CellsWithoutKnownCornersAreErrors) {
    struct Bad {
        int type;
        std::vector<vtkIdType> nodes;
        std::string said;
    };
    for (const Bad& bad : {Bad{VTK_CONVEX_POINT_SET, {0, 1, 2, 3, 4}, "cell 1 is a vtkConvexPointSet"},
                           {VTK_HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 77}, "cell 1 has a vertex that is no point"},
                           {VTK_HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6}, "cell 1 has 7 nodes"}}) {
        vtkNew<vtkUnstructuredGrid> grid;
        grid->SetPoints(
            points_of({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1})->GetPoints());
        const vtkIdType four[4] = {0, 1, 3, 4};
        grid->InsertNextCell(VTK_TETRA, 4, four);
        grid->InsertNextCell(bad.type, static_cast<vtkIdType>(bad.nodes.size()), bad.nodes.data());
        Messages messages;
        EXPECT_FALSE(probed(grid, {0.1, 0.1, 0.1})->GetExact());
        EXPECT_EQ(messages.count(bad.said), 1) << messages.all();
        vtkNew<vtkBarycertLocator> locator;
        locator->SetDataSet(grid);
        locator->BuildLocator();
        EXPECT_FALSE(locator->GetExact());
        EXPECT_EQ(messages.count(bad.said), 2) << messages.all();
        double x[3] = {0.1, 0.1, 0.1}, closest[3], dist2 = 0;
        vtkIdType id = 0;
        int sub_id = 0;
        EXPECT_EQ(locator->FindCell(x), -1);
        locator->FindClosestPoint(x, closest, id, sub_id, dist2);
        EXPECT_EQ(id, -1);
    }
    vtkNew<vtkUnstructuredGrid> open;
    open->SetPoints(points_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})->GetPoints());
    vtkNew<vtkIdList> faces;
    for (const vtkIdType n : {3, 3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3}) faces->InsertNextId(n);
    open->InsertNextCell(VTK_POLYHEDRON, faces);
    Messages messages;
    EXPECT_FALSE(probed(open, {0.1, 0.1, 0.1})->GetExact());
    EXPECT_EQ(messages.count("the faces of cell 0 do not close"), 1) << messages.all();
}

}  // namespace
}  // namespace barycert::testing
