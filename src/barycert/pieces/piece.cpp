#include "barycert/pieces/piece.hpp"

#include <numeric>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "barycert/locate/near_feature.hpp"

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
    std::nth_element(begin, between, end,
                     [&](const Box& a, const Box& b) { return middle(a, widest) < middle(b, widest); });
    halve(begin, between, left, all);
    halve(between, end, most - left, all);
}

std::span<const Mesh::Index> corners_of(const IndexedPiece& piece, Mesh::Index cell) {
    const std::size_t n = piece.mesh.corners();
    return {piece.mesh.cells.data() + n * static_cast<std::size_t>(cell), n};
}

// Sets point and weights from the nodes whose hull has the nearest point in it.
void project_on(const IndexedPiece& piece, const Nearest& nearest, const double* x, Closest& found) {
    locate::NearFeature f;
    std::size_t count = 0;
    for (; count < 3 && nearest.nodes[count] >= 0; ++count)
        piece.place(piece.node(nearest.nodes[count]), f.at[count].data());
    f.count = static_cast<int>(count);
    const std::array<double, 3> weights = locate::weights_of({x[0], x[1], x[2]}, f);
    found.point = f.at[0];
    std::array<double, 3> point{};
    if (count > 1 && point_from_weights(f.simplex(), f.vertices().data(), weights.data(), point.data()))
        found.point = point;
    const std::span<const Mesh::Index> corners = corners_of(piece, found.cell);
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

Box Piece::box_of(std::size_t cell) const {
    Box box = empty_box;
    for (std::size_t k = 0; k < mesh.corners(); ++k) {
        std::array<double, 3> x{};
        place(node(mesh.cells[mesh.corners() * cell + k]), x.data());
        box.add({x, x});
    }
    return box;
}

bool Piece::flatten(int of) {
    const std::vector<double>& points = mesh.points;
    for (int axis = 2; axis >= 0; --axis) {
        if (of >= 0 && axis != of) continue;
        const auto at = [&](Mesh::Index node) {
            return points[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)];
        };
        const double its = at(mesh.cells.front());
        if (!std::all_of(mesh.cells.begin(), mesh.cells.end(), [&](Mesh::Index n) { return at(n) == its; })) continue;
        normal = axis;
        plane = its;
        axes = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis};
        std::vector<double> flat;
        flat.reserve(points.size() / 3 * 2);
        for (std::size_t i = 0; i < points.size(); i += 3)
            for (std::size_t a = 0; a < 2; ++a) flat.push_back(points[i + static_cast<std::size_t>(axes[a])]);
        mesh.dimension = 2;
        mesh.points = std::move(flat);
        return true;
    }
    return false;
}

std::vector<Mesh::Index> Piece::sort_cells(const std::vector<std::int64_t>& numbers) {
    if (std::is_sorted(numbers.begin(), numbers.end())) return {};
    std::vector<Mesh::Index> order(numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Mesh::Index a, Mesh::Index b) {
        return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)];
    });
    const auto corners = static_cast<std::ptrdiff_t>(mesh.corners());
    std::vector<Mesh::Index> cells;
    cells.reserve(mesh.cells.size());
    for (const Mesh::Index cell : order) {
        const auto from = mesh.cells.begin() + corners * cell;
        cells.insert(cells.end(), from, from + corners);
    }
    mesh.cells = std::move(cells);
    return order;
}

Result<Shape> agree_on_shape(Exchange& exchange, const PieceFacts& mine) {
    // Greatest is least with the other sign.
    const auto lacks_numbers = [&](int d) { return mine.dimension == d && !mine.numbered ? -1.0 : 0.0; };
    const auto& [low, high] = mine.triangles;
    std::array<double, 9> facts{static_cast<double>(-mine.dimension), lacks_numbers(2), lacks_numbers(3)};
    for (std::size_t a = 0; a < 3; ++a) {
        facts[3 + a] = low[a];
        facts[6 + a] = -high[a];
    }
    exchange.least(facts);
    const int highest = -static_cast<int>(facts[0]);
    if (highest == 0 || highest == 1) return Error{.what = "it has neither tetrahedra nor triangles"};
    Shape shape{.dimension = std::max(highest, 0),
                .by_numbers = highest < 0 || facts[static_cast<std::size_t>(highest) - 1] == 0};
    const bool ghosts_alone = facts[3] > -facts[6];
    if (highest != 2 || ghosts_alone) return shape;
    for (std::size_t a = 0; a < 3; ++a)
        if (facts[3 + a] == -facts[6 + a]) shape.normal = static_cast<int>(a);
    if (shape.normal < 0) return Error{.what = "its triangles do not lie in one plane across an axis"};
    return shape;
}

Status IndexedPiece::build() {
    Result<Locator> made = Locator::build(mesh, {.prove = Prove::when_it_pays});
    if (!made) return made.error();
    locator = std::move(*made);
    some_cells = size_of_some_cells(mesh);
    return Done{};
}

Mesh::Index IndexedPiece::owner(const double* x) const {
    std::array<double, 3> point{};
    if (!locator || !all_finite({x, 3}) || !project(x, point.data())) return -1;
    // Where points come one near the other, the last cell saves most of the search; elsewhere it lengthens it. The
    // answer does not depend on it.
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
    for (const Mesh::Index vertex : corners_of(*this, cell)) out = std::copy_n(node(vertex), mesh.dimension, out);
    const Result<Weights> its = barycentric_weights(simplex(), vertices.data(), point);
    return its ? its->weights : std::array<double, 4>{};
}

Closest IndexedPiece::closest(const double* x, double limit) const {
    const ExactEnvironment environment;
    Closest found;
    if (!locator || !all_finite({x, 3})) return found;
    std::array<double, 3> point{};
    const bool flat = mesh.dimension == 2;
    const bool in_plane = project(x, point.data());
    const Result<Nearest> nearest =
        locator->nearest(point.data(), flat ? std::numeric_limits<double>::infinity() : limit);
    if (!nearest || nearest->cell < 0) return found;
    const double distance = in_plane ? nearest->distance : std::hypot(nearest->distance, held(x[normal]) - plane);
    if (!(distance <= limit)) return found;
    found.cell = nearest->cell;
    found.distance = distance;
    if (nearest->nodes[0] >= 0) {
        project_on(*this, *nearest, x, found);
        return found;
    }
    found.inside = in_plane;
    found.weights = weights(found.cell, point.data());
    place(point.data(), found.point.data());
    return found;
}

}  // namespace barycert::pieces
