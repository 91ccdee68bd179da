// Cells of all shapes, located and sampled through their parts, against planes in integers.
#include <gtest/gtest.h>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;

/// A convex cell by the planes of its faces: a x + b y + c z <= d, in halves of the unit.
struct Judge {
    std::vector<std::array<std::int64_t, 4>> planes;

    Feature at(const std::array<std::int64_t, 3>& p) const {
        int on = 0;
        for (const auto& [a, b, c, d] : planes) {
            const std::int64_t side = a * p[0] + b * p[1] + c * p[2] - d;
            if (side > 0) return Feature::outside;
            on += side == 0 ? 1 : 0;
        }
        return on == 0 ? Feature::interior : on == 1 ? Feature::face : on == 2 ? Feature::edge : Feature::vertex;
    }
};

/// n^3 boxes of random sizes: voxels, hexahedra, polyhedra, two wedges, six pyramids, prisms of polygons.
class Boxes {
public:
    Boxes(int n, unsigned seed) : random_(seed) {
        for (auto& axis : axes_) {
            axis.push_back(0);
            for (int i = 0; i < n; ++i) axis.push_back(axis.back() + 2 * static_cast<int>(1 + random_() % 4));
        }
        const auto side = static_cast<std::size_t>(n + 1);
        for (std::size_t i = 0; i < side * side * side; ++i)
            places_.push_back({axes_[0][i % side], axes_[1][i / side % side], axes_[2][i / side / side]});
        for (std::size_t k = 0; k + 1 < side; ++k) {
            for (std::size_t j = 0; j + 1 < side; ++j) {
                for (std::size_t i = 0; i + 1 < side; ++i) add_box(i + side * (j + side * k), side);
            }
        }
        renumber();
        cut(mesh);
    }

    Mesh mesh;
    std::vector<Judge> judges;  ///< of each cell of the file

    std::array<double, 3> random_point() {
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            const int high = 2 * axes_[k].back();
            p[k] = random_() % 3 == 0 ? axes_[k][random_() % axes_[k].size()]
                                      : 0.5 * (static_cast<int>(random_() % static_cast<unsigned>(high + 9)) - 4);
        }
        return p;
    }

private:
    void add_box(std::size_t first, std::size_t side) {
        std::array<Index, 8> c{};  // x fastest
        for (std::size_t i = 0; i < 8; ++i)
            c[i] = static_cast<Index>(first + (i & 1U) + side * (i >> 1U & 1U) + side * side * (i >> 2U));
        const auto [a, b, d, e, f, g, h, i] = c;
        const std::vector<Index> hexahedron{a, b, e, d, f, g, i, h};
        switch (random_() % 5) {
            case 0:
                return add(11, {c.begin(), c.end()});
            case 1:
                return add(12, hexahedron);
            case 2:
                return add(12, hexahedron, true);
            case 3:
                add(13, {a, d, b, f, h, g});
                return add(13, {e, b, d, i, g, h});
            default:
                const auto centre = static_cast<Index>(places_.size());
                places_.push_back({});
                for (std::size_t k = 0; k < 3; ++k)
                    places_.back()[k] =
                        (places_[static_cast<std::size_t>(a)][k] + places_[static_cast<std::size_t>(i)][k]) / 2;
                for (const auto& base :
                     {std::array{a, b, e, d}, {f, g, i, h}, {a, b, g, f}, {d, e, i, h}, {a, d, h, f}, {b, e, i, g}})
                    add(14, {base[0], base[1], base[2], base[3], centre});
        }
    }

    void add(std::uint8_t type, const std::vector<Index>& nodes, bool polyhedron = false) {
        std::vector<std::vector<Index>> rings(1);
        for (const char c : mesh::cell_type(type).faces) {
            if (c == ' ') {
                rings.emplace_back();
            } else {
                rings.back().push_back(nodes[static_cast<std::size_t>(c - '0')]);
            }
        }
        const auto place = [&](Index node) { return places_[static_cast<std::size_t>(node)]; };
        Judge judge;
        for (const auto& ring : rings) {
            const auto p = place(ring[0]), q = place(ring[1]), r = place(ring[2]);
            const std::array<std::int64_t, 3> u{q[0] - p[0], q[1] - p[1], q[2] - p[2]},
                v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
            std::array<std::int64_t, 4> plane{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                              u[0] * v[1] - u[1] * v[0], 0};
            const auto value = [&](const std::array<int, 3>& at) {
                return 2 * (plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2]);
            };
            plane[3] = value(p);
            for (const Index node : nodes) {
                if (value(place(node)) <= plane[3]) continue;
                for (auto& x : plane) x = -x;
                break;
            }
            judge.planes.push_back(plane);
        }
        judges.push_back(judge);
        if (mesh.shapes.face_ends.empty() && polyhedron) mesh.shapes.face_ends.resize(mesh.shapes.count());
        add_shape(mesh, polyhedron ? std::uint8_t{vtk_polyhedron} : type, nodes,
                  polyhedron ? rings : std::vector<std::vector<Index>>());
    }

    void renumber() {
        std::vector<Index> number(places_.size());
        std::iota(number.begin(), number.end(), 0);
        std::ranges::shuffle(number, random_);
        mesh.points.resize(3 * places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                mesh.points[3 * static_cast<std::size_t>(number[i]) + k] = places_[i][k];
        }
        for (auto* nodes : {&mesh.shapes.nodes, &mesh.shapes.rings}) {
            for (Index& node : *nodes) node = number[static_cast<std::size_t>(node)];
        }
    }

    std::mt19937 random_;
    std::array<std::vector<int>, 3> axes_;
    std::vector<std::array<int, 3>> places_;
};

TEST(WholeCells, L1L2OwnersAndFeaturesAreThoseOfTheFilesCells) {
    std::size_t boundary = 0, edges = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        Boxes boxes(seed % 4 + 1, seed);
        const Mesh& mesh = boxes.mesh;
        std::vector<double> points;
        std::vector<std::vector<Location>> expected;
        for (int i = 0; i < 3000; ++i) {
            const std::array<double, 3> p = boxes.random_point();
            points.insert(points.end(), p.begin(), p.end());
            auto& all = expected.emplace_back();
            for (std::size_t cell = 0; cell < boxes.judges.size(); ++cell) {
                const Feature f =
                    boxes.judges[cell].at({static_cast<std::int64_t>(2 * p[0]), static_cast<std::int64_t>(2 * p[1]),
                                           static_cast<std::int64_t>(2 * p[2])});
                if (f != Feature::outside) all.push_back({static_cast<Index>(cell), f});
            }
            if (all.empty()) all.push_back({});
            boundary += all[0].feature == Feature::face ? 1 : 0;
            edges += all[0].feature == Feature::edge ? 1 : 0;
        }
        for (const Prove prove : {Prove::at_once, Prove::never}) {
            const Locator locator = Locator::build(mesh, {.prove = prove, .progress = {}}).value();
            const Table rows = locator.locate(points).value(), all = locator.locate_all(points).value();
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const std::vector<Location>& right = expected[i];
                const Location batch{mesh.cell_number(rows.cells[i]), rows.features[i]};
                Location single = locator.locate(&points[3 * i]).value();
                single.cell = mesh.cell_number(single.cell);
                ASSERT_EQ(batch, right[0]) << "seed " << seed << ", point " << i;
                ASSERT_EQ(single, right[0]) << "seed " << seed << ", point " << i;
                ASSERT_EQ(all.point_begin[i + 1] - all.point_begin[i], right.size());
                for (std::size_t k = 0; k < right.size(); ++k) {
                    const std::size_t row = all.point_begin[i] + k;
                    ASSERT_EQ((Location{mesh.cell_number(all.cells[row]), all.features[row]}), right[k]);
                }
            }
        }
    }
    EXPECT_GT(boundary, 1000U);
    EXPECT_GT(edges, 1000U);
}

TEST(WholeCells, V1ALinearFieldIsItself) {
    for (unsigned seed = 21; seed <= 26; ++seed) {
        Boxes boxes(3, seed);
        Field field{"f", 1, {}};
        const auto f = [](const double* p) { return 3 * p[0] - 5 * p[1] + 7 * p[2] + 11; };
        for (std::size_t i = 0; i < boxes.mesh.point_count(); ++i) field.data.push_back(f(&boxes.mesh.points[3 * i]));
        boxes.mesh.point_fields = {field};
        std::vector<double> points;
        for (int i = 0; i < 2000; ++i) {
            const auto p = boxes.random_point();
            points.insert(points.end(), p.begin(), p.end());
        }
        const Sampler sampler = Sampler::build(boxes.mesh).value();
        const Table rows = sampler.sample(points).value();
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            if (rows.cells[i] >= 0) {
                ASSERT_EQ(rows.values[i], f(&points[3 * i]));
            }
        }
    }
}

TEST(WholeCells, AFoldedCellIsTold) {
    std::vector<Index> order(8);
    std::iota(order.begin(), order.end(), 0);
    Mesh mesh = one_cell(12, order);
    cut(mesh);
    EXPECT_TRUE(check_mesh(mesh).certified());
    mesh.points[3 * 6] = -8;  // the corner opposite to node 0 beyond it
    mesh.points[3 * 6 + 1] = -8;
    const CheckReport report = check_mesh(mesh);
    EXPECT_FALSE(report.certified());
    ASSERT_NE(report.find(DefectKind::folded_cell), nullptr);
    EXPECT_EQ(report.find(DefectKind::folded_cell)->count, 1U);
}

}  // namespace
}  // namespace barycert::test
