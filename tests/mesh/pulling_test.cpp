#include <map>
#include <set>

#include "core/vtk_cell.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/consistency.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;
using mesh::cell_type;

constexpr std::array<std::uint8_t, 7> solids{10, 11, 12, 13, 14, 15, 16};
constexpr std::array<std::uint8_t, 3> polygons{7, 8, 9};

std::vector<Index> first_numbers(std::size_t count) {
    std::vector<Index> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// f(order) for all orders of up to 8 nodes, else for some.
template <class F>
void for_orders(std::size_t nodes, std::size_t some, F f) {
    std::vector<Index> order = first_numbers(nodes);
    std::mt19937 random(7);
    if (nodes <= 8) {
        do f(order);
        while (std::ranges::next_permutation(order).found);
        return;
    }
    for (; some != 0; --some) {
        std::ranges::shuffle(order, random);
        f(order);
    }
}

/// Sum of the measures of parts, all of which must have the sign of the first; 0 else.
std::int64_t filled(const Mesh& mesh) {
    std::int64_t sum = 0;
    for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
        const std::int64_t own = measure(mesh, part);
        if (own == 0 || (own > 0) != (measure(mesh, 0) > 0)) return 0;
        sum += own;
    }
    return std::abs(sum);
}

TEST(Pulling, FillsAConvexCellFromItsLowestNodeInAllNumberings) {
    const std::map<std::uint8_t, std::int64_t> measures{{10, 216},  {11, 1296}, {12, 1296}, {13, 648}, {14, 432},
                                                        {15, 1872}, {16, 1728}, {7, 96},    {8, 72},   {9, 72}};
    for (const auto& of_type : measures) {
        const std::uint8_t type = of_type.first;
        const std::int64_t expected = of_type.second;
        const std::size_t nodes = places_of(type).size();
        std::size_t wrong = 0, orders = 0;
        for_orders(nodes, 3000, [&](const std::vector<Index>& order) {
            Mesh mesh = one_cell(type, order);
            cut(mesh);
            wrong += filled(mesh) == expected ? 0 : 1;
            for (std::size_t part = 0; part < mesh.cell_count(); ++part)
                wrong +=
                    std::ranges::count(std::span(mesh.cells).subspan(part * mesh.corners(), mesh.corners()), 0) == 1
                        ? 0
                        : 1;
            ++orders;
        });
        EXPECT_EQ(wrong, 0U) << "type " << int{type} << ", " << orders << " orders";
        if (mesh::cell_type(type).dimension() == 2) continue;
        std::vector<Index> order = first_numbers(nodes);
        std::mt19937 random(11);
        for (int i = 0; i < 300; ++i) {
            std::ranges::shuffle(order, random);
            Mesh mesh = one_cell(type, order, true), plain = one_cell(type, order);
            cut(mesh);
            cut(plain);
            ASSERT_EQ(filled(mesh), expected) << "polyhedron like type " << int{type};
            ASSERT_EQ(mesh.cell_count(), plain.cell_count());
        }
    }
}

/// Which features of a convex cell have the point, by the planes (lines) of its faces.
Feature feature_by_planes(std::uint8_t type, const std::array<int, 3>& p) {
    const auto places = places_of(type);
    const bool flat = cell_type(type).dimension() == 2;
    const std::string faces = type == 7 ? "012345" : std::string(cell_type(type).faces);
    std::vector<std::vector<std::size_t>> rings(1);
    for (const char c : faces) {
        if (c == ' ') {
            rings.emplace_back();
        } else {
            rings.back().push_back(static_cast<std::size_t>(c <= '9' ? c - '0' : c - 'a' + 10));
        }
    }
    if (flat) {
        const auto ring = rings.front();
        rings.clear();
        for (std::size_t i = 0; i < ring.size(); ++i) rings.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
    std::array<std::int64_t, 3> middle{};  // times their number
    const auto n = static_cast<std::int64_t>(places.size());
    for (const auto& at : places) {
        for (std::size_t k = 0; k < 3; ++k) middle[k] += at[k];
    }
    const auto side = [&](const std::vector<std::size_t>& ring, const std::array<std::int64_t, 3>& q, std::int64_t by) {
        std::array<std::array<std::int64_t, 3>, 3> e{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t a = places[ring[0]][k];
            e[0][k] = places[ring[1]][k] - a;
            e[1][k] = flat ? (k == 2 ? 1 : 0) : places[ring[2]][k] - a;
            e[2][k] = q[k] - by * a;
        }
        return e[2][0] * (e[0][1] * e[1][2] - e[0][2] * e[1][1]) + e[2][1] * (e[0][2] * e[1][0] - e[0][0] * e[1][2]) +
               e[2][2] * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
    };
    int on = 0;
    for (const auto& ring : rings) {
        const std::int64_t inner = side(ring, middle, n), own = side(ring, {p[0], p[1], p[2]}, 1);
        if (own != 0 && (own > 0) != (inner > 0)) return Feature::outside;
        on += own == 0 ? 1 : 0;
    }
    if (on == 0) return Feature::interior;
    if (flat) return on == 1 ? Feature::edge : Feature::vertex;
    return on == 1 ? Feature::face : on == 2 ? Feature::edge : Feature::vertex;
}

/// Zero weights of a part at a point; nothing if that is outside.
std::optional<unsigned> zeros_at(Mesh mesh, std::size_t part, const std::array<int, 3>& p) {
    const std::int64_t whole = measure(mesh, part);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    unsigned zeros = 0;
    for (std::size_t corner = 0; corner < mesh.corners(); ++corner) {
        Mesh moved;
        moved.dimension = mesh.dimension;
        for (std::size_t i = 0; i < mesh.corners(); ++i) {
            const auto node = static_cast<std::size_t>(mesh.cells[part * mesh.corners() + i]);
            for (std::size_t k = 0; k < d; ++k) moved.points.push_back(i == corner ? p[k] : mesh.points[node * d + k]);
            moved.cells.push_back(static_cast<Index>(i));
        }
        const std::int64_t own = measure(moved, 0);
        if (own != 0 && (own > 0) != (whole > 0)) return std::nullopt;
        zeros |= own == 0 ? 1U << corner : 0U;
    }
    return zeros;
}

TEST(Pulling, FeaturesAreThoseOfTheWholeCell) {
    std::mt19937 random(3);
    std::vector<std::uint8_t> types(solids.begin(), solids.end());
    types.insert(types.end(), polygons.begin(), polygons.end());
    for (const std::uint8_t type : types) {
        std::set<Feature> seen;
        for (int round = 0; round < 24; ++round) {
            std::vector<Index> order = first_numbers(places_of(type).size());
            std::ranges::shuffle(order, random);
            const bool polyhedron = cell_type(type).dimension() == 3 && round % 3 == 0;
            Mesh mesh = one_cell(type, order, polyhedron);
            cut(mesh);
            for (int x = -3; x <= 9; ++x) {
                for (int y = -1; y <= 9; ++y) {
                    for (int z = mesh.dimension == 2 ? 0 : -1; z <= (mesh.dimension == 2 ? 0 : 7); ++z) {
                        const Feature expected = feature_by_planes(type, {x, y, z});
                        bool held = false;
                        for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
                            const auto zeros = zeros_at(mesh, part, {x, y, z});
                            if (!zeros) continue;
                            held = true;
                            ASSERT_EQ(mesh::feature_of_whole(mesh.shapes.inside[part], *zeros, mesh.dimension),
                                      expected)
                                << int{type} << " at " << x << ' ' << y << ' ' << z << ", part " << part;
                        }
                        ASSERT_EQ(held, expected != Feature::outside);
                        seen.insert(expected);
                    }
                }
            }
        }
        EXPECT_EQ(seen.size(), cell_type(type).dimension() == 3 ? 5U : 4U) << int{type};
    }
}

/// Triangles of parts on a face, by their nodes.
std::set<std::set<Index>> triangles_on(const Mesh& mesh, std::size_t cell, const std::set<Index>& face) {
    std::set<std::set<Index>> triangles;
    for (auto part = static_cast<std::size_t>(mesh.shapes.parts[cell]);
         part < static_cast<std::size_t>(mesh.shapes.parts[cell + 1]); ++part) {
        for (std::size_t k = 0; k < 4; ++k) {
            std::set<Index> own;
            for (std::size_t i = 0; i < 4; ++i) {
                if (i != k) own.insert(mesh.cells[4 * part + i]);
            }
            if (std::ranges::includes(face, own)) triangles.insert(own);
        }
    }
    return triangles;
}

TEST(Pulling, CellsOfAllTypesAgreeOnTheirCommonFace) {
    std::mt19937 random(5);
    std::size_t pairs = 0;
    for (const std::uint8_t a : solids) {
        for (const std::uint8_t b : solids) {
            const Mesh one = one_cell(a, first_numbers(places_of(a).size()), true);
            const Mesh two = one_cell(b, first_numbers(places_of(b).size()), true);
            const auto ring_of = [](const Mesh& mesh, std::size_t face) {
                const auto begin = face == 0 ? 0 : mesh.shapes.ring_ends[face - 1];
                return std::vector<Index>(mesh.shapes.rings.begin() + begin,
                                          mesh.shapes.rings.begin() + mesh.shapes.ring_ends[face]);
            };
            for (std::size_t f = 0; f < one.shapes.ring_ends.size(); ++f) {
                for (std::size_t g = 0; g < two.shapes.ring_ends.size(); ++g) {
                    std::vector<Index> own = ring_of(one, f), other = ring_of(two, g);
                    if (own.size() != other.size()) continue;
                    ++pairs;
                    std::ranges::reverse(other);
                    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(pairs % other.size()),
                                other.end());
                    const std::size_t n = one.point_count(), all = n + two.point_count() - own.size();
                    std::vector<Index> number = first_numbers(all);
                    std::ranges::shuffle(number, random);
                    std::vector<Index> of_two(two.point_count());
                    auto next = n;
                    for (std::size_t i = 0; i < of_two.size(); ++i) {
                        const auto at = std::ranges::find(other, static_cast<Index>(i)) - other.begin();
                        of_two[i] = at == static_cast<std::ptrdiff_t>(other.size())
                                        ? number[next++]
                                        : number[static_cast<std::size_t>(own[static_cast<std::size_t>(at)])];
                    }
                    // Each where it is convex: the numbers of the nodes decide.
                    const auto cut_alone = [&](std::uint8_t type, const Mesh& from, std::span<const Index> of) {
                        Mesh cell;
                        cell.points.resize(3 * all);
                        for (std::size_t i = 0; i < of.size(); ++i)
                            std::copy_n(&from.points[3 * i], 3, &cell.points[3 * static_cast<std::size_t>(of[i])]);
                        add_shape(cell, type, {of.begin(), of.end()});
                        cut(cell);
                        return cell;
                    };
                    const Mesh first = cut_alone(a, one, std::span(number).first(n));
                    const Mesh second = cut_alone(b, two, of_two);
                    std::set<Index> face;
                    for (const Index node : own) face.insert(number[static_cast<std::size_t>(node)]);
                    const auto triangles = triangles_on(first, 0, face);
                    ASSERT_EQ(triangles.size(), face.size() - 2);
                    ASSERT_EQ(triangles, triangles_on(second, 0, face)) << int{a} << " and " << int{b};
                }
            }
        }
    }
    EXPECT_GT(pairs, 500U);
}

// Their base is seen from inside, that of VTK's linear wedge from outside.
TEST(Pulling, WedgesOfLagrangeAreTurned) {
    for (const std::uint8_t type : {std::uint8_t{73}, std::uint8_t{80}}) {
        Mesh mesh;
        mesh::add_shape(mesh, type, first_numbers(6));
        EXPECT_EQ(mesh.shapes.types, std::vector<std::uint8_t>{13});
        EXPECT_EQ(mesh.shapes.nodes, (std::vector<Index>{0, 2, 1, 3, 5, 4}));
    }
}

TEST(Pulling, ACollapsedCellFillsWhatIsLeft) {
    // A hexahedron whose edge 4-5, then whose whole top, is one node.
    for (const auto& [nodes, expected] :
         {std::pair(std::vector<Index>{0, 1, 2, 3, 4, 4, 5, 5}, std::int64_t{648}), {{0, 1, 2, 3, 4, 4, 4, 4}, 432}}) {
        Mesh mesh;
        mesh.points = {0, 0, 0, 6, 0, 0, 6, 6, 0, 0, 6, 0, 0, 0, 6, 0, 6, 6};
        add_shape(mesh, 12, nodes);
        cut(mesh);
        EXPECT_EQ(filled(mesh), expected);
    }
    Mesh flat;
    flat.points = {0, 0, 0, 6, 0, 0, 6, 6, 0};
    add_shape(flat, 12, {0, 1, 1, 0, 0, 1, 1, 0});
    cut(flat);
    ASSERT_EQ(flat.cell_count(), 1U);  // degenerate, so that it is counted
    EXPECT_EQ(measure(flat, 0), 0);
}

TEST(Pulling, APolyhedronWhoseFacesDoNotCloseIsTold) {
    for (const std::uint8_t type : solids) {
        const std::size_t faces = static_cast<std::size_t>(std::ranges::count(cell_type(type).faces, ' ')) + 1;
        for (std::size_t missing = 0; missing < faces; ++missing) {
            Mesh whole = one_cell(type, first_numbers(places_of(type).size()), true), open;
            open.points = whole.points;
            add_shape(open, 14, {0, 1, 2, 3, 4});
            std::vector<std::vector<Index>> rings;
            for (std::size_t f = 0; f < faces; ++f) {
                const auto begin = f == 0 ? 0 : whole.shapes.ring_ends[f - 1];
                std::vector<Index> ring(whole.shapes.rings.begin() + begin,
                                        whole.shapes.rings.begin() + whole.shapes.ring_ends[f]);
                if (f % 2 == 0) std::ranges::reverse(ring);  // turned any way
                if (f != missing) rings.push_back(ring);
            }
            if (whole.point_count() < 5) open.points.resize(15);
            add_shape(open, vtk_polyhedron, whole.shapes.nodes, rings);
            EXPECT_EQ(mesh::pull(open), 1U) << int{type};
        }
    }
}

TEST(Pulling, PolyhedraWhoseFacesAreTurnedAnyWayAreFilled) {
    std::mt19937 random(9);
    for (const std::uint8_t type : solids) {
        for (int round = 0; round < 50; ++round) {
            Mesh mesh = one_cell(type, first_numbers(places_of(type).size()), true);
            for (std::size_t f = 0; f < mesh.shapes.ring_ends.size(); ++f) {
                const auto begin = f == 0 ? 0 : mesh.shapes.ring_ends[f - 1];
                if (random() % 2 == 0)
                    std::reverse(mesh.shapes.rings.begin() + begin,
                                 mesh.shapes.rings.begin() + mesh.shapes.ring_ends[f]);
            }
            Mesh plain = one_cell(type, first_numbers(places_of(type).size()));
            cut(mesh);
            cut(plain);
            EXPECT_EQ(filled(mesh), filled(plain));
        }
    }
}

// Two tetrahedra at one node, whose bases are one ring that has it twice.
TEST(Pulling, ARingMayPassANodeTwice) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 6, 0, 0, 0, 6, 0, -6, 0, 0, 0, -6, 0, 0, 0, 6, -1, -1, 6};
    add_shape(mesh, vtk_polyhedron, {0, 1, 2, 3, 4, 5, 6},
              {{0, 1, 2, 0, 3, 4}, {0, 1, 5}, {1, 2, 5}, {2, 0, 5}, {0, 3, 6}, {3, 4, 6}, {4, 0, 6}});
    cut(mesh);
    ASSERT_EQ(mesh.cell_count(), 2U);
    EXPECT_EQ(std::abs(measure(mesh, 0)), 216);
    EXPECT_EQ(std::abs(measure(mesh, 1)), 216);
}

TEST(Pulling, PartsThatAreNotThoseOfTheCellsAreTold) {
    Mesh mesh = one_cell(12, first_numbers(8));
    cut(mesh);
    ASSERT_EQ(mesh::inconsistency(mesh), nullptr);
    const auto n = static_cast<Index>(mesh.cell_count());
    const std::vector<std::vector<Index>> wrong{{}, {0}, {n}, {0, n - 1}, {1, n}, {0, n + 1}, {0, 0, n}, {0, n, n}};
    for (const std::vector<Index>& parts : wrong) {
        Mesh other = mesh;
        other.shapes.parts = parts;
        EXPECT_STREQ(mesh::inconsistency(other), "its cells are not the parts of its shapes");
        other.shapes = {};
        other.shapes.parts = parts;
        EXPECT_EQ(mesh::inconsistency(other) == nullptr, parts.empty());
    }
    add_shape(mesh, 10, {0, 1, 3, 4});
    for (const Index from : {Index{0}, n}) {
        mesh.shapes.parts = {0, from, n};
        EXPECT_STREQ(mesh::inconsistency(mesh), "its cells are not the parts of its shapes") << "none of cell " << from;
    }
}

TEST(Pulling, AStripIsItsTriangles) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 0, 2, 2, 0, 2, 2, 4, 0};
    add_shape(mesh, vtk_triangle_strip, {0, 1, 2, 3, 4});
    cut(mesh);
    ASSERT_EQ(mesh.cell_count(), 3U);
    EXPECT_EQ(filled(mesh), 12);
    const auto at = [&](std::array<int, 3> p) {
        for (std::size_t part = 0; part < 3; ++part) {
            if (const auto zeros = zeros_at(mesh, part, p))
                return mesh::feature_of_whole(mesh.shapes.inside[part], *zeros, 2);
        }
        return Feature::outside;
    };
    EXPECT_EQ(at({1, 1, 0}), Feature::interior);  // on the edge 1-2
    EXPECT_EQ(at({2, 1, 0}), Feature::interior);  // on the edge 2-3
    EXPECT_EQ(at({1, 0, 0}), Feature::edge);
    EXPECT_EQ(at({0, 1, 0}), Feature::edge);
    EXPECT_EQ(at({3, 1, 0}), Feature::edge);
    EXPECT_EQ(at({3, 0, 0}), Feature::edge);
    EXPECT_EQ(at({1, 2, 0}), Feature::edge);
    EXPECT_EQ(at({2, 2, 0}), Feature::vertex);
}

}  // namespace
}  // namespace barycert::test
