#include "mesh/pieces/piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/weights.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/mapped/nearest_side.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/pieces/exchange.hpp"
#include "mesh/pulling.hpp"
#include "mesh/sample/points/near_piece.hpp"

namespace barycert::pieces {
namespace {

constexpr std::size_t side = 16;  ///< of the cube of bins

// Halved first, for boxes may be as large as doubles are.
double middle(const Box& box, std::size_t axis) {
    return box.low[axis] / 2 + box.high[axis] / 2;
}
double half_width(const Box& box, std::size_t axis) {
    return box.high[axis] / 2 - box.low[axis] / 2;
}

std::size_t bin_of(const Box& box, const Box& around) {
    std::size_t bin = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = half_width(around, a);
        const double share = width > 0 ? (middle(box, a) / 2 - around.low[a] / 2) / width : 0;
        const auto place = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(side));
        bin = side * bin + std::min(place, side - 1);
    }
    return bin;
}

// Each around as many of the boxes (but one): halves along the axis on which their middles spread most.
void halve(std::vector<Box>::iterator begin, std::vector<Box>::iterator end, std::size_t most, std::vector<Box>& all) {
    if (begin == end) return;
    Box around = empty_box, middles = empty_box;
    for (auto box = begin; box != end; ++box) {
        const std::array<double, 3> at{middle(*box, 0), middle(*box, 1), middle(*box, 2)};
        middles.add({at, at});
        around.add(*box);
    }
    if (most <= 1 || end - begin == 1) {
        all.push_back(around);
        return;
    }
    std::size_t widest = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (half_width(middles, a) > half_width(middles, widest)) widest = a;
    const std::size_t left = most / 2;
    const auto between = begin + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(end - begin) * left / most);
    std::ranges::nth_element(begin, between, end, {}, [&](const Box& box) { return middle(box, widest); });
    halve(begin, between, left, all);
    halve(between, end, most - left, all);
}

// Sets point and weights from the nodes whose hull has the nearest point in it.
void project_on(const IndexedPiece& piece, const Nearest& nearest, const double* x, Closest& found) {
    locate::NearFeature f;
    std::size_t count = 0;
    for (; count < 3 && nearest.nodes[count] >= 0; ++count)
        piece.place(piece.mesh.point(nearest.nodes[count]), f.at[count].data());
    f.count = static_cast<int>(count);
    const std::array<double, 3> weights = locate::weights_of({x[0], x[1], x[2]}, f);
    found.point = f.at[0];
    std::array<double, 3> point{};
    if (count > 1 && point_from_weights(f.simplex(), f.vertices().data(), weights.data(), point.data()))
        found.point = point;
    const std::span<const Mesh::Index> corners = piece.mesh.corners_of(static_cast<std::size_t>(found.cell));
    for (std::size_t k = 0; k < count; ++k) {
        const auto at = std::find(corners.begin(), corners.end(), nearest.nodes[k]);
        if (at != corners.end()) found.weights[static_cast<std::size_t>(at - corners.begin())] = weights[k];
    }
}

// The edge of a square or cube that would hold about 8 cells if they were spread over the box of the mesh.
double size_of_some_cells(const Mesh& mesh) {
    const Bounds3 box = bounds_of_cells(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    double size = 8 / static_cast<double>(mesh.cell_count());
    for (std::size_t a = 0; a < d; ++a) size *= box.high[a] - box.low[a];
    return std::pow(size, 1.0 / mesh.dimension);
}

}  // namespace

std::vector<Box> cover(const Box& around, std::size_t count, const std::function<Box(std::size_t)>& box_at,
                       std::size_t most) {
    std::vector<Box> bins(side * side * side, empty_box), all;
    for (std::size_t i = 0; i < count; ++i) {
        const Box box = box_at(i);
        bins[bin_of(box, around)].add(box);
    }
    std::erase_if(bins, empty);
    halve(bins.begin(), bins.end(), most, all);
    return all;
}

std::size_t Piece::whole_of(Mesh::Index cell) const {
    const std::vector<Mesh::Index>& parts = mesh.shapes.parts;
    if (parts.empty()) return static_cast<std::size_t>(cell);
    return static_cast<std::size_t>(std::upper_bound(parts.begin(), parts.end(), cell) - parts.begin()) - 1;
}

std::vector<Mesh::Index> Piece::nodes_of(std::size_t whole) const {
    if (mesh.shapes.count() == 0) {
        const sample::CellNodes nodes(mesh, whole);
        return {nodes.begin(), nodes.end()};
    }
    const std::span nodes = mesh.shapes.nodes_of(whole);
    return {nodes.begin(), nodes.end()};
}

Box Piece::box_of(std::size_t whole) const {
    namespace iso = core::isoparametric;
    Box box = empty_box;
    const auto add = [&](const double* point) {
        std::array<double, 3> x{};
        place(point, x.data());
        box.add({x, x});
    };
    const std::vector<Mesh::Index> nodes = nodes_of(whole);
    for (const Mesh::Index i : nodes) add(mesh.point(i));
    const bool simplex = mesh.shapes.count() == 0 || mesh::is_curved_simplex(mesh.shapes.types[whole]);
    const iso::Reference* const reference = iso::simplex_reference(mesh.dimension, nodes.size());
    if (!simplex || reference == nullptr) return box;
    iso::Places places;
    std::transform(nodes.begin(), nodes.end(), places.at.begin(), [&](Mesh::Index i) { return mesh.point(i); });
    const std::array<double, 6> hull = iso::hull_box(*reference, places);
    add(hull.data());
    add(hull.data() + 3);
    return box;
}

bool Piece::flatten(int of) {
    const std::vector<double>& points = mesh.points;
    for (int axis = 2; axis >= 0; --axis) {
        if (of >= 0 && axis != of) continue;
        const auto at = [&](Mesh::Index node) {
            return points[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
        };
        const double its = at(mesh.shapes.nodes.empty() ? mesh.cells.front() : mesh.shapes.nodes.front());
        const std::array<const std::vector<Mesh::Index>*, 3> all{&mesh.cells, &mesh.mid_nodes, &mesh.shapes.nodes};
        const auto flat = [&](const auto* nodes) {
            return std::ranges::all_of(*nodes, [&](Mesh::Index n) { return at(n) == its; });
        };
        if (!std::ranges::all_of(all, flat)) continue;
        normal = axis;
        plane = its;
        axes = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis};
        std::vector<double> in_plane;
        in_plane.reserve(points.size() / 3 * 2);
        for (std::size_t i = 0; i < points.size(); i += 3)
            for (std::size_t a = 0; a < 2; ++a) in_plane.push_back(points[i + static_cast<std::size_t>(axes[a])]);
        mesh.dimension = 2;
        mesh.points = std::move(in_plane);
        return true;
    }
    return false;
}

std::optional<std::size_t> Piece::cut(const std::vector<std::int64_t>& numbers) {
    std::vector<Mesh::Index> order(numbers.size()), rank(numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](Mesh::Index i) { return numbers[static_cast<std::size_t>(i)]; });
    for (std::size_t i = 0; i < order.size(); ++i)
        rank[static_cast<std::size_t>(order[i])] = static_cast<Mesh::Index>(i);
    return mesh::cut_into_simplices(mesh, rank);
}

Result<Shape> agree_on_shape(Exchange& exchange, const PieceFacts& mine) {
    // Greatest is least with the other sign.
    const auto of = [&](int d, double its, double none) { return mine.dimension == d ? its : none; };
    const auto& [low, high] = mine.polygons;
    std::array<double, 15> facts{static_cast<double>(-mine.dimension)};
    for (std::size_t a = 0; a < 3; ++a) {
        facts[1 + a] = low[a];
        facts[4 + a] = -high[a];
    }
    for (const int d : {2, 3}) {
        double* const its = &facts[static_cast<std::size_t>(4 * d - 1)];
        its[0] = of(d, mine.numbered ? 0 : -1, 0);
        its[1] = of(d, mine.nodes_numbered ? 0 : -1, 0);
        its[2] = of(d, mine.low_type, 255);
        its[3] = of(d, -mine.high_type, 0);
    }
    exchange.least(facts);
    const int highest = -static_cast<int>(facts[0]);
    if (highest == 0 || highest == 1) return Error{.code = "rank.source", .what = only_lower};
    Shape shape{.dimension = std::max(highest, 0), .by_numbers = true};
    if (highest < 0) return shape;
    const double* const its = &facts[static_cast<std::size_t>(4 * highest - 1)];
    shape.by_numbers = its[0] == 0;
    shape.nodes_by_numbers = its[1] == 0;
    shape.mixed = PieceFacts::mixed(static_cast<int>(its[2]), -static_cast<int>(its[3]));
    const bool ghosts_alone = facts[1] > -facts[4];
    if (highest != 2 || ghosts_alone) return shape;
    for (std::size_t a = 0; a < 3; ++a)
        if (facts[1 + a] == -facts[4 + a]) shape.normal = static_cast<int>(a);
    if (shape.normal < 0)
        return Error{.code = "rank.source", .what = "its polygons do not lie in one plane across an axis"};
    return shape;
}

Status IndexedPiece::build(const Shape& shape) {
    if (const Result<CurvedCells> curved = measure_curved(mesh, {}, shape.curved); !curved) return curved.error();
    Result<Locator> made = Locator::build(
        mesh, {.prove = Prove::when_it_pays, .interpolation = shape.interpolation, .curved = shape.curved});
    if (!made) return made.error();
    locator = std::move(*made);
    some_cells = size_of_some_cells(mesh);
    return Done{};
}

bool IndexedPiece::straight(Mesh::Index cell) const {
    return mesh.mid_nodes.empty() && !(mapped() && locate::LocatorData::of(*locator).mapped->is_mapped(cell));
}

Mesh::Index IndexedPiece::owner(const double* x) const {
    std::array<double, 3> point{};
    if (!locator || !all_finite({x, 3}) || !project(x, point.data())) return -1;
    // Where points come one near the other, the last cell saves most of the search; elsewhere it lengthens it. It
    // cannot change the answer: it is a hint to Locator::locate(), which finds the same cell with any hint or none, one
    // of a piece that is gone included.
    struct Last {
        const IndexedPiece* piece = nullptr;
        std::array<double, 3> point{};
        Mesh::Index cell = -1;
    };
    thread_local Last last;
    const auto count = static_cast<Mesh::Index>(mesh.cell_count());
    bool near = last.piece == this && last.cell < count;
    for (std::size_t a = 0; a < 3; ++a) near = near && std::abs(point[a] - last.point[a]) <= some_cells;
    const Result<Location> location = locator->locate(point.data(), near ? last.cell : -1);
    if (!location) return -1;
    if (location->cell >= 0) last = {this, point, location->cell};
    return location->cell;
}

std::array<double, 4> IndexedPiece::weights(Mesh::Index cell, const double* point) const {
    std::array<double, 12> vertices{};
    double* out = vertices.data();
    for (const Mesh::Index vertex : mesh.corners_of(static_cast<std::size_t>(cell)))
        out = std::copy_n(mesh.point(vertex), mesh.dimension, out);
    const Result<Weights> its = barycentric_weights(simplex(), vertices.data(), point);
    return its ? its->weights : std::array<double, 4>{};
}

Closest IndexedPiece::closest(const double* x, double limit) const {
    const ExactEnvironment environment;
    Closest found;
    if (!locator || !all_finite({x, 3})) return found;
    std::array<double, 3> point{};
    const bool in_plane = project(x, point.data());
    const double off_plane = in_plane ? 0 : held(x[normal]) - plane;
    place(point.data(), found.point.data());
    found.cell = owner(found.point.data());
    found.distance = std::abs(off_plane);
    found.inside = in_plane;
    if (found.cell >= 0 && straight()) found.weights = weights(found.cell, point.data());
    if (found.cell >= 0) return found.distance <= limit ? found : Closest();
    const bool flat = mesh.dimension == 2;
    const double most = flat ? std::numeric_limits<double>::infinity() : limit;
    const locate::LocatorData& data = locate::LocatorData::of(*locator);
    locate::NearestInMaps near;
    if (data.mapped != nullptr) {
        near = locate::nearest_in_maps(data, point.data(), most);
    } else if (const Result<Nearest> straight = locator->nearest(point.data(), most)) {
        near.nearest = *straight;
    }
    if (near.nearest.cell < 0) return {};
    found.cell = near.nearest.cell;
    found.distance = std::hypot(near.nearest.distance, off_plane);
    found.inside = false;
    if (!(found.distance <= limit)) return {};
    if (near.on) {
        place(near.on->at.place().data(), found.point.data());
    } else {
        project_on(*this, near.nearest, x, found);
    }
    return found;
}

}  // namespace barycert::pieces
