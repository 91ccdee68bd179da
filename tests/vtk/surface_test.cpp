// vtkBarycertLocator and vtkBarycertProbe on surfaces in space, against brute force in rational numbers and VTK.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSelectEnclosedPoints.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnsignedCharArray.h>

#include "barycert/surface_locator.hpp"
#include "tests/mesh/check/surfaces.hpp"
#include "tests/vtk/grids.hpp"
#include "vtkBarycertLocator.h"
#include "vtkBarycertProbe.h"

namespace barycert::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

vtkSmartPointer<vtkBarycertLocator> locator_on(const Surface& s) {
    const auto locator = vtkSmartPointer<vtkBarycertLocator>::New();
    locator->SetDataSet(poly_data_of(s));
    locator->BuildLocator();
    EXPECT_TRUE(locator->GetExact()) << locator->GetReason();
    return locator;
}

/// The exact number rounds to this one: it is no nearer to its neighbours.
bool rounds_to(const mpq_class& exact, double x) {
    const mpq_class off = abs(exact - mpq_class(x));
    return off <= abs(exact - mpq_class(std::nextafter(x, -infinity))) &&
           off <= abs(exact - mpq_class(std::nextafter(x, infinity)));
}

std::vector<RationalTriangle> triangles_of(const Surface& s) {
    std::vector<RationalTriangle> all;
    for (std::size_t t = 0; t < s.cell_count(); ++t) all.push_back(triangle_of(s, t));
    return all;
}

/// Nodes, middles of two nodes and of three, and places around.
std::vector<std::array<double, 3>> places(const Surface& s, std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto [low, high] = std::ranges::minmax(s.points);
    std::vector<std::array<double, 3>> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t t = random() % s.cell_count();
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> corner{};
            for (std::size_t c = 0; c < 3; ++c)
                corner[c] = s.points[3 * static_cast<std::size_t>(s.cells[3 * t + c]) + k];
            const double middle = (corner[0] + corner[1]) / 2, part = static_cast<double>(random() % 257) / 128 - 0.5;
            all[i][k] = i % 4 == 0   ? corner[0]
                        : i % 4 == 1 ? middle
                        : i % 4 == 2 ? middle / 2 + corner[2] / 2
                                     : low + part * (high - low);
        }
    }
    return all;
}

std::vector<std::pair<Surface, std::string>> surfaces() {
    return {{torus(12, 8), "torus"},
            {surface_of(random_voxels(3, 0.5, 3)), "voxels"},
            {random_soup(6, 20, 40, 1), "soup"},
            {random_soup(40, 20, 40, 2), "wide soup"}};
}

// A bow-tie in a tilted plane: no triangles, and nobody asks them.
TEST(SurfaceInVtk, OfPolygonsThatCannotBeCut) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const std::array<double, 3>& p : {std::array<double, 3>{0, 0, 0}, {1, 1, 1}, {1, 0, 1}, {0, 1, 0}})
        points->InsertNextPoint(p.data());
    vtkNew<vtkPolyData> bow;
    bow->SetPoints(points);
    bow->AllocateExact(1, 4);
    const std::array<vtkIdType, 4> nodes{0, 1, 2, 3};
    bow->InsertNextCell(VTK_QUAD, 4, nodes.data());
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(bow);
    locator->BuildLocator();
    std::array<double, 3> at{0.5, 0.5, 0.5}, closest{};
    vtkNew<vtkGenericCell> cell;
    vtkIdType id = 0;
    int sub_id = 0;
    double distance = 0;
    EXPECT_EQ(locator->FindCell(at.data()), -1);
    locator->FindClosestPoint(at.data(), closest.data(), cell, id, sub_id, distance);
    EXPECT_EQ(id, -1);
}

TEST(Surface, FindClosestPointIsTheLowestOfTheNearest) {
    for (const auto& [s, what] : surfaces()) {
        SCOPED_TRACE(what);
        const auto locator = locator_on(s);
        const SurfaceLocator own = SurfaceLocator::build(s, {}, false).value();
        const std::vector<RationalTriangle> triangles = triangles_of(s);
        vtkNew<vtkGenericCell> cell;
        int on = 0;
        for (std::array<double, 3> x : places(s, 80, 5)) {
            mpq_class best = -1;
            vtkIdType lowest = -1;
            for (std::size_t t = 0; t < triangles.size(); ++t) {
                if (is_flat(triangles[t])) continue;
                const mpq_class square = square_to(triangles[t], rational(x.data()));
                if (best >= 0 && square >= best) continue;
                best = square;
                lowest = static_cast<vtkIdType>(t);
            }
            double closest[3], dist2 = -1;
            vtkIdType id = -1;
            int sub_id = -1, inside = -1;
            locator->FindClosestPoint(x.data(), closest, cell, id, sub_id, dist2);
            ASSERT_EQ(id, lowest);
            EXPECT_EQ(sub_id, 0);
            EXPECT_NEAR(dist2, best.get_d(), 1e-14 * best.get_d());
            EXPECT_EQ(cell->GetPointId(2), s.cells[static_cast<std::size_t>(3 * id + 2)]);
            const SurfaceNearest nearest = own.nearest(x.data(), infinity).value();
            EXPECT_TRUE(std::equal(closest, closest + 3, nearest.point.begin()));
            // The radius is that of rounded distances.
            const double radius = nearest.distance;
            const auto within = [&](double r) {
                return locator->FindClosestPointWithinRadius(x.data(), r, closest, cell, id, sub_id, dist2, inside);
            };
            EXPECT_EQ(within(radius), 1);
            EXPECT_EQ(id, lowest);
            EXPECT_EQ(inside, best == 0 ? 1 : 0);
            on += inside;
            if (best == 0) continue;
            EXPECT_EQ(within(std::nextafter(radius, 0)), 0);
            EXPECT_EQ(id, -1);
        }
        EXPECT_GT(on, 20);
    }
}

TEST(Surface, FindCellIsTheLowestThatHoldsThePoint) {
    for (const auto& [s, what] : surfaces()) {
        SCOPED_TRACE(what);
        const auto locator = locator_on(s);
        const std::vector<RationalTriangle> triangles = triangles_of(s);
        vtkNew<vtkGenericCell> cell;
        int on = 0, off = 0;
        for (std::array<double, 3> x : places(s, 200, 6)) {
            const Rational3 at = rational(x.data());
            vtkIdType lowest = -1;
            for (std::size_t t = 0; t < triangles.size() && lowest < 0; ++t)
                if (!is_flat(triangles[t]) && lies_on(triangles[t], at)) lowest = static_cast<vtkIdType>(t);
            double pcoords[3], weights[3];
            ASSERT_EQ(locator->FindCell(x.data()), lowest);
            ASSERT_EQ(locator->FindCell(x.data(), 1, cell, pcoords, weights), lowest);
            (lowest < 0 ? off : on) += 1;
            if (lowest < 0) continue;
            const auto exact = weights_in(triangles[static_cast<std::size_t>(lowest)], at);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(rounds_to(exact[k], weights[k]));
            EXPECT_EQ(pcoords[0], weights[1]);
            EXPECT_EQ(pcoords[1], weights[2]);
            EXPECT_EQ(pcoords[2], 0);
            EXPECT_TRUE(locator->InsideCellBounds(x.data(), lowest));
        }
        EXPECT_GT(on, 40);
        EXPECT_GT(off, 20);
    }
}

/// The first parameter that segment and triangle have in common, -1 if none.
mpq_class first_common(const RationalTriangle& t, const Rational3& p, const Rational3& q) {
    std::vector<mpq_class> all{0, 1};
    const Rational3 n = outer(t[1] - t[0], t[2] - t[0]), d = q - p;
    if (sgn(inner(n, p - t[0])) * sgn(inner(n, q - t[0])) > 0) return -1;  // on one side of its plane
    for (std::size_t i = 0; i < 3; ++i) {
        const Rational3& c = t[i];
        all.push_back(inner(c - p, d) / inner(d, d));
        // With the plane, and with the planes through the edges across it.
        for (const Rational3& normal : {n, outer(n, t[(i + 1) % 3] - c)}) {
            const mpq_class u = inner(normal, p - c), v = inner(normal, q - c);
            if (u != v) all.push_back(u / (u - v));
        }
    }
    std::ranges::sort(all);
    for (const mpq_class& s : all)
        if (s >= 0 && s <= 1 && lies_on(t, between(p, q, s))) return s;
    return -1;
}

TEST(Surface, LinesMeetTrianglesInTheirExactOrder) {
    int hit = 0, ties = 0;
    for (const auto& [s, what] : surfaces()) {
        SCOPED_TRACE(what);
        const auto locator = locator_on(s);
        const std::vector<RationalTriangle> triangles = triangles_of(s);
        const auto ends = places(s, 100, 7);
        vtkNew<vtkGenericCell> cell;
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        vtkNew<vtkIdList> ids;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            const double *const a = ends[i].data(), *const b = ends[i + 1].data();
            if (ends[i] == ends[i + 1]) continue;
            std::vector<std::pair<mpq_class, vtkIdType>> expected;
            for (std::size_t t = 0; t < triangles.size(); ++t) {
                if (is_flat(triangles[t])) continue;
                const mpq_class first = first_common(triangles[t], rational(a), rational(b));
                if (first >= 0) expected.emplace_back(first, static_cast<vtkIdType>(t));
            }
            std::ranges::sort(expected);
            const auto expect_all = [&] {
                ASSERT_EQ(ids->GetNumberOfIds(), static_cast<vtkIdType>(expected.size()));
                ASSERT_EQ(points->GetNumberOfPoints(), ids->GetNumberOfIds());
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    ASSERT_EQ(ids->GetId(static_cast<vtkIdType>(k)), expected[k].second);
                    double x[3];
                    points->GetPoint(static_cast<vtkIdType>(k), x);
                    for (int axis = 0; axis < 3; ++axis)
                        EXPECT_NEAR(x[axis], std::lerp(a[axis], b[axis], expected[k].first.get_d()), 1e-13);
                }
            };
            // Whatever the tolerance.
            const int met = expected.empty() ? 0 : 1;
            EXPECT_EQ(locator->IntersectWithLine(a, b, 1, points, ids), met);
            expect_all();
            EXPECT_EQ(locator->IntersectWithLine(a, b, 0, points, ids, cell), met);
            expect_all();
            EXPECT_EQ(std::abs(locator->IntersectWithLine(a, b, points, ids)), met);
            expect_all();
            EXPECT_EQ(std::abs(locator->IntersectWithLine(a, b, nullptr, nullptr)), met);
            double t = -1, x[3], pcoords[3];
            int sub_id = -1;
            vtkIdType id = 0;
            EXPECT_EQ(locator->IntersectWithLine(a, b, 0, t, x, pcoords, sub_id), met);
            EXPECT_EQ(locator->IntersectWithLine(a, b, 0, t, x, pcoords, sub_id, id), met);
            EXPECT_EQ(locator->IntersectWithLine(a, b, 0, t, x, pcoords, sub_id, id, cell), met);
            EXPECT_EQ(id, expected.empty() ? -1 : expected[0].second);
            if (expected.empty()) continue;
            ++hit;
            ties += expected.size() > 1 && expected[0].first == expected[1].first ? 1 : 0;
            EXPECT_TRUE(rounds_to(expected[0].first, t));
            EXPECT_EQ(sub_id, 0);
            const auto weights = weights_in(triangles[static_cast<std::size_t>(id)],
                                            between(rational(a), rational(b), expected[0].first));
            EXPECT_NEAR(pcoords[0], weights[1].get_d(), 1e-10);
            EXPECT_NEAR(pcoords[1], weights[2].get_d(), 1e-10);
        }
    }
    EXPECT_GT(hit, 200);
    EXPECT_GT(ties, 40);
}

TEST(Surface, AgreesWithVtkAwayFromTies) {
    const Surface s = torus(30, 17);
    const auto data = poly_data_of(s);
    const auto locator = locator_on(s);
    vtkNew<vtkStaticCellLocator> other;
    other->SetDataSet(data);
    other->BuildLocator();
    vtkNew<vtkSelectEnclosedPoints> enclosed;
    enclosed->Initialize(data);
    vtkNew<vtkPoints> points;
    vtkNew<vtkIdList> ids;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    const double away[3] = {5.1, 4.3, 3.7};
    int same_face = 0, in = 0;
    for (int i = 0; i < 400; ++i) {
        double x[3] = {place(random), place(random), place(random) / 3};
        double closest[3], theirs[3], dist2 = 0, their_dist2 = 0;
        vtkIdType id = -1, their_id = -1;
        int sub_id = 0;
        locator->FindClosestPoint(x, closest, id, sub_id, dist2);
        other->FindClosestPoint(x, theirs, their_id, sub_id, their_dist2);
        EXPECT_NEAR(dist2, their_dist2, 1e-12);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(closest[k], theirs[k], 1e-7);
        same_face += id == their_id ? 1 : 0;
        double t = 0, u = 0, pcoords[3];
        const int met = locator->IntersectWithLine(x, away, 0, t, closest, pcoords, sub_id, id);
        EXPECT_EQ(met, other->IntersectWithLine(x, away, 0, u, theirs, pcoords, sub_id, their_id));
        if (met != 0) {
            EXPECT_NEAR(t, u, 1e-12);
        }
        // From inside the line leaves an odd number of times.
        const int inside = enclosed->IsInsideSurface(x);
        EXPECT_EQ(locator->IntersectWithLine(x, away, points, ids), inside != 0 ? -1 : met);
        EXPECT_EQ(ids->GetNumberOfIds() % 2, inside);
        in += inside;
    }
    EXPECT_GT(same_face, 200);
    EXPECT_GT(in, 40);
    EXPECT_LT(in, 360);
}

TEST(Surface, TolerantLinesAndPointsAreThoseOfVtkAndNearest) {
    const Surface s = surface_of(Voxels{1, {1}});
    const auto locator = locator_on(s);
    vtkNew<vtkGenericCell> cell;
    double x[3] = {0.25, 0.5, -0.01}, pcoords[3], weights[3];
    EXPECT_EQ(locator->FindCell(x, 1, cell, pcoords, weights), -1);
    locator->TolerantOn();
    const vtkIdType found = locator->FindCell(x, 0.02 * 0.02, cell, pcoords, weights);
    double below[3] = {0.25, 0.5, 0};
    EXPECT_EQ(found, locator->FindCell(below));
    EXPECT_EQ(locator->FindCell(x, 0.005 * 0.005, cell, pcoords, weights), -1);
    // A line that ends just before the face.
    const double from[3] = {0.25, 0.5, -1}, to[3] = {0.25, 0.5, -1e-9};
    double t = 0;
    int sub_id = 0;
    EXPECT_EQ(locator->IntersectWithLine(from, to, 1e-3, t, x, pcoords, sub_id), 0);
    locator->TolerantOff();
    EXPECT_EQ(locator->IntersectWithLine(from, to, 1e-3, t, x, pcoords, sub_id), 0);
    EXPECT_EQ(locator->IntersectWithLine(from, below, 0, t, x, pcoords, sub_id), 1);
    EXPECT_EQ(t, 1);
    // One that passes the face by less than the tolerance.
    const double above[3] = {-1e-4, 0.5, 0.5}, under[3] = {-1e-4, 0.5, -0.5};
    EXPECT_EQ(locator->IntersectWithLine(above, under, 1e-3, t, x, pcoords, sub_id), 0);
    locator->TolerantOn();
    vtkNew<vtkStaticCellLocator> other;
    other->SetDataSet(poly_data_of(s));
    other->BuildLocator();
    for (const double tolerance : {0.0, 1e-3, 0.5}) {
        EXPECT_EQ(locator->IntersectWithLine(above, under, tolerance, t, x, pcoords, sub_id),
                  other->IntersectWithLine(above, under, tolerance, t, x, pcoords, sub_id));
    }
}

TEST(Surface, ThreadsMayAskTogether) {
    const Surface s = torus(40, 20);
    const auto points = places(s, 400, 8);
    struct Answer {
        vtkIdType owner = -1, nearest = -1, first = -1;
        double dist2 = 0, t = 0;
        bool operator==(const Answer&) const = default;
    };
    const auto ask_all = [&](vtkBarycertLocator* locator, std::vector<Answer>& all) {
        vtkNew<vtkGenericCell> cell;
        for (std::array<double, 3> x : points) {
            Answer answer;
            double pcoords[3], weights[3], at[3];
            const double end[3] = {0.1, 0.2, 3};
            int sub_id = 0;
            answer.owner = locator->FindCell(x.data(), 0, cell, pcoords, weights);
            locator->FindClosestPoint(x.data(), at, cell, answer.nearest, sub_id, answer.dist2);
            locator->IntersectWithLine(x.data(), end, 0, answer.t, at, pcoords, sub_id, answer.first, cell);
            all.push_back(answer);
        }
    };
    std::vector<Answer> alone;
    ask_all(locator_on(s), alone);
    // Nobody has built this one.
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(poly_data_of(s));
    std::vector<std::vector<Answer>> all(6);
    std::vector<std::thread> threads;
    for (std::vector<Answer>& one : all) threads.emplace_back([&] { ask_all(locator, one); });
    for (std::thread& one : threads) one.join();
    for (const std::vector<Answer>& one : all) EXPECT_EQ(one, alone);
}

TEST(Surface, LeavesOtherCellsOutAndKeepsIds) {
    const Surface s = torus(12, 8);
    const auto whole = poly_data_of(s);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(whole->GetPoints());
    vtkNew<vtkIdList> nodes;
    whole->GetCellPoints(0, nodes);
    grid->InsertNextCell(VTK_VERTEX, 1, nodes->GetPointer(0));
    grid->InsertNextCell(VTK_TRIANGLE, nodes);  // a ghost
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName("vtkGhostType");
    for (vtkIdType i = 0; i < whole->GetNumberOfCells(); ++i) {
        whole->GetCellPoints(i, nodes);
        grid->InsertNextCell(VTK_TRIANGLE, nodes);
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
        ghosts->InsertNextValue(i == 1 ? vtkDataSetAttributes::DUPLICATECELL : 0);
    grid->GetCellData()->AddArray(ghosts);
    const auto all = locator_on(s);
    vtkNew<vtkBarycertLocator> some;
    some->SetDataSet(grid);
    for (std::array<double, 3> x : places(s, 60, 2)) {
        double at[3], dist2 = 0, t = 0, pcoords[3];
        const double end[3] = {0.1, 0.2, 3};
        int sub_id = 0;
        vtkIdType id = -1, shifted = -1;
        all->FindClosestPoint(x.data(), at, id, sub_id, dist2);
        some->FindClosestPoint(x.data(), at, shifted, sub_id, dist2);
        EXPECT_EQ(shifted, id + 2);
        EXPECT_EQ(some->FindCell(x.data()), all->FindCell(x.data()) < 0 ? -1 : all->FindCell(x.data()) + 2);
        if (all->IntersectWithLine(x.data(), end, 0, t, at, pcoords, sub_id, id) == 0) continue;
        EXPECT_EQ(some->IntersectWithLine(x.data(), end, 0, t, at, pcoords, sub_id, shifted), 1);
        EXPECT_EQ(shifted, id + 2);
    }
}

TEST(Surface, OfBadInputSaysSo) {
    double x[3] = {0.25, 0.25, 0.25}, nan[3] = {0, std::nan(""), 0}, at[3], dist2 = 0, t = 0, pcoords[3];
    vtkIdType id = 7;
    int sub_id = 0;
    {
        // No triangle but flat ones.
        Surface flat;
        flat.points = {0, 0, 0, 1, 1, 1, 2, 2, 2};
        flat.cells = {0, 1, 2, 0, 0, 1};
        const auto locator = locator_on(flat);
        EXPECT_EQ(locator->FindCell(flat.points.data()), -1);
        locator->FindClosestPoint(x, at, id, sub_id, dist2);
        EXPECT_EQ(id, -1);
        EXPECT_EQ(locator->IntersectWithLine(x, flat.points.data(), 0, t, at, pcoords, sub_id), 0);
    }
    const Surface s = torus(8, 6);
    const auto locator = locator_on(s);
    locator->FindClosestPoint(nan, at, id = 7, sub_id, dist2);
    EXPECT_EQ(id, -1);
    EXPECT_EQ(locator->FindClosestPointWithinRadius(x, -1, at, id, sub_id, dist2), 0);
    EXPECT_EQ(locator->FindCell(nan), -1);
    Messages messages;
    EXPECT_EQ(locator->IntersectWithLine(x, nan, 0, t, at, pcoords, sub_id), 0);
    EXPECT_EQ(messages.count("cannot intersect with this line"), 1) << messages.all();
    EXPECT_EQ(locator->IntersectWithLine(x, x, 0, t, at, pcoords, sub_id), 0);
    EXPECT_EQ(messages.count("the ends of a segment"), 1) << messages.all();
    // A node that is no number: VTK's locator answers, after a warning.
    Surface bad = s;
    bad.points[4] = std::nan("");
    vtkNew<vtkBarycertLocator> other;
    other->SetDataSet(poly_data_of(bad));
    EXPECT_FALSE(other->GetExact());
    EXPECT_NE(other->GetReason().find("not finite"), std::string::npos) << other->GetReason();
}

TEST(Surface, FollowsTheDataSet) {
    Surface s = torus(8, 6);
    const auto data = poly_data_of(s);
    vtkNew<vtkBarycertLocator> locator;
    locator->SetDataSet(data);
    double node[3];
    data->GetPoint(5, node);
    EXPECT_GE(locator->FindCell(node), 0);
    // A copy of it has the same index, and another one once it changes.
    vtkNew<vtkPolyData> copy;
    copy->DeepCopy(data);
    vtkNew<vtkBarycertLocator> second;
    second->SetDataSet(copy);
    EXPECT_EQ(second->FindCell(node), locator->FindCell(node));
    copy->GetPoints()->SetPoint(5, 4, 4, 4);
    copy->GetPoints()->Modified();
    second->Update();
    EXPECT_EQ(second->FindCell(node), -1);
    EXPECT_GE(locator->FindCell(node), 0);
}

// Values.

/// With a field of doubles, floats and integers at nodes, and numbers of cells.
vtkSmartPointer<vtkPolyData> with_fields(const Surface& s, Field& field) {
    const auto data = poly_data_of(s);
    field = {"f", 2, {}};
    vtkNew<vtkDoubleArray> doubles;
    vtkNew<vtkFloatArray> floats;
    vtkNew<vtkIntArray> whole, cells;
    doubles->SetName("f");
    doubles->SetNumberOfComponents(2);
    floats->SetName("g");
    whole->SetName("n");
    cells->SetName("cell");
    for (std::size_t i = 0; i < s.point_count(); ++i) {
        const double a = std::sqrt(static_cast<double>(i)), b = static_cast<double>(i) / 7;
        field.data.insert(field.data.end(), {a, b});
        doubles->InsertNextTuple2(a, b);
        floats->InsertNextValue(static_cast<float>(i % 5));
        whole->InsertNextValue(static_cast<int>(i % 7));
    }
    for (std::size_t i = 0; i < s.cell_count(); ++i) cells->InsertNextValue(static_cast<int>(i));
    for (vtkDataArray* const array :
         {static_cast<vtkDataArray*>(doubles), static_cast<vtkDataArray*>(floats), static_cast<vtkDataArray*>(whole)})
        data->GetPointData()->AddArray(array);
    data->GetCellData()->AddArray(cells);
    return data;
}

void expect_values(const Surface& s, double tolerance) {
    Field field;
    const auto data = with_fields(s, field);
    std::vector<double> where;
    for (const std::array<double, 3>& x : places(s, 300, 9)) where.insert(where.end(), x.begin(), x.end());
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(data);
    probe->SetInputData(points_of(where));
    if (tolerance > 0) {
        probe->ComputeToleranceOff();
        probe->SetTolerance(tolerance);
    }
    probe->Update();
    EXPECT_TRUE(probe->GetExact());
    vtkPointData* const out = probe->GetOutput()->GetPointData();
    const SurfaceLocator locator = SurfaceLocator::build(s, {}, false).value();
    std::vector<SurfaceNearest> nearest(where.size() / 3);
    std::vector<double> values(2 * nearest.size());
    ASSERT_TRUE(locator.nearest(where, tolerance, nearest));
    ASSERT_TRUE(locator.values(field, false, where, nearest, values));
    int valid = 0, snapped = 0;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const auto id = static_cast<vtkIdType>(i);
        const SurfaceNearest& n = nearest[i];
        ASSERT_EQ(out->GetArray("vtkValidPointMask")->GetTuple1(id), n.cell >= 0 ? 1 : 0);
        if (n.cell < 0) {
            EXPECT_EQ(out->GetArray("f")->GetComponent(id, 0), 0);
            continue;
        }
        ++valid;
        snapped += n.distance > 0 ? 1 : 0;
        for (int c = 0; c < 2; ++c)
            EXPECT_EQ(out->GetArray("f")->GetComponent(id, c), values[2 * i + static_cast<std::size_t>(c)]);
        EXPECT_EQ(out->GetArray("cell")->GetTuple1(id), n.cell);
        // A value at a point on the surface is rounded once: from the exact sum.
        mpq_class g = 0, whole = 0;
        const RationalTriangle t = triangle_of(s, static_cast<std::size_t>(n.cell));
        const auto weights = weights_in(t, rational(&where[3 * i]));
        for (std::size_t k = 0; k < 3; ++k) {
            const Mesh::Index node = s.cells[3 * static_cast<std::size_t>(n.cell) + k];
            g += weights[k] * (node % 5);
            whole += weights[k] * (node % 7);
        }
        if (n.distance > 0) continue;
        const auto got = static_cast<float>(out->GetArray("g")->GetTuple1(id));
        for (const float other : {std::nextafter(got, -1.F), std::nextafter(got, 9.F)})
            EXPECT_LE(abs(g - mpq_class(got)), abs(g - mpq_class(other)));
        const mpq_class half(1, 2), off = mpq_class(out->GetArray("n")->GetTuple1(id)) - whole;
        EXPECT_TRUE(off > -half && off <= half) << off;
    }
    EXPECT_EQ(probe->GetValidPoints()->GetNumberOfTuples(), valid);
    EXPECT_GT(valid, 60);
    EXPECT_EQ(snapped > 10, tolerance > 0);
}

TEST(Surface, ProbeHasItsValues) {
    for (const auto& [s, what] : surfaces()) {
        SCOPED_TRACE(what);
        expect_values(s, 0);
        expect_values(s, 0.5 * *std::ranges::max_element(s.points));
    }
}

TEST(Surface, ProbeTakesImagesNamesAndCategories) {
    Surface s = surface_of(Voxels{1, {1}});
    const auto data = poly_data_of(s);
    vtkNew<vtkIntArray> kinds;
    kinds->SetName("kind");
    for (std::size_t i = 0; i < s.point_count(); ++i) kinds->InsertNextValue(static_cast<int>(i * i));
    data->GetPointData()->SetScalars(kinds);
    vtkNew<vtkImageData> image;
    image->SetDimensions(9, 9, 9);
    image->SetSpacing(0.25, 0.25, 0.25);
    image->SetOrigin(-0.5, -0.5, -0.5);
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(data);
    probe->SetInputData(image);
    probe->CategoricalDataOn();
    probe->Update();
    vtkDataArray* const mask = probe->GetOutput()->GetPointData()->GetArray("vtkValidPointMask");
    int valid = 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
        double x[3];
        image->GetPoint(i, x);
        const bool in = std::all_of(x, x + 3, [](double c) { return c >= 0 && c <= 1; });
        const bool on = in && std::any_of(x, x + 3, [](double c) { return c == 0 || c == 1; });
        EXPECT_EQ(mask->GetTuple1(i), on ? 1 : 0);
        valid += on ? 1 : 0;
        const double kind = probe->GetOutput()->GetPointData()->GetArray("kind")->GetTuple1(i);
        EXPECT_EQ(kind, std::round(std::sqrt(kind)) * std::round(std::sqrt(kind)));
    }
    EXPECT_EQ(valid, 125 - 27);
}

}  // namespace
}  // namespace barycert::testing
