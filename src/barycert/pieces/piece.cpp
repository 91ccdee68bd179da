#include "barycert/pieces/piece.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace barycert::pieces {

Box Piece::box_of(std::size_t cell) const {
    Box box = no_box;
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
    std::array<double, 9> facts{static_cast<double>(-mine.dimension),
                                lacks_numbers(2),
                                lacks_numbers(3),
                                low[0],
                                low[1],
                                low[2],
                                -high[0],
                                -high[1],
                                -high[2]};
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

}  // namespace barycert::pieces
