#include "mesh/mid_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"

namespace barycert::mesh {
namespace {

using Edge = std::array<std::size_t, 2>;
constexpr std::array<Edge, 6> tetrahedron_edges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 3> triangle_edges{{{0, 1}, {1, 2}, {0, 2}}};

struct Sequence {
    MidEdgeOrder order;
    std::array<std::size_t, 6> edges;  ///< of each node in turn; in the plane three, and zeros
};
/// The first of a dimension is taken where no cell can tell.
constexpr std::array<Sequence, 3> sequences_3d{{{MidEdgeOrder::tetgen15, {5, 3, 0, 1, 4, 2}},
                                                {MidEdgeOrder::vtk, {0, 1, 2, 3, 4, 5}},
                                                {MidEdgeOrder::gmsh, {0, 1, 2, 3, 5, 4}}}};
constexpr std::array<Sequence, 2> sequences_2d{{{MidEdgeOrder::triangle, {1, 2, 0}}, {MidEdgeOrder::vtk, {0, 1, 2}}}};

std::span<const Sequence> sequences_of(int dimension) {
    if (dimension == 2) return sequences_2d;
    return sequences_3d;
}

/// The edge whose midpoint is strictly nearest to `node`, or edges.size().
std::size_t nearest_edge(const Mesh& mesh, const Mesh::Index* corners, Mesh::Index node, std::span<const Edge> edges) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    double largest = 0;
    for (std::size_t i = 0; i <= dimension + 1; ++i) {
        const double* const p = mesh.point(i <= dimension ? corners[i] : node);
        for (std::size_t axis = 0; axis < dimension; ++axis) largest = std::max(largest, std::fabs(p[axis]));
    }
    const double scale = largest > 0x1p1000 ? 0.25 : 1;  // no sum below overflows, and no subnormal number is lost
    const auto coordinate = [&](Mesh::Index at, std::size_t axis) { return mesh.point(at)[axis] * scale; };
    std::array<double, 6> squares{};
    std::array<double, 18> offsets{};
    double unit = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < edges.size(); ++e) {
        double longest = 0;
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const double middle = coordinate(corners[edges[e][0]], axis) + coordinate(corners[edges[e][1]], axis);
            double& offset = offsets[e * dimension + axis] = std::fabs(middle - 2 * coordinate(node, axis));
            longest = std::max(longest, offset);
        }
        unit = std::min(unit, longest);
    }
    // In the unit of the nearest midpoint, whose square is 1 to 3; those far off may be infinite. Where a midpoint is
    // the node itself, all others are infinite.
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const double offset = offsets[e * dimension + axis];
            const double scaled = offset == 0 ? 0 : offset / unit;
            squares[e] += scaled * scaled;
        }
    }
    const auto last = squares.begin() + static_cast<std::ptrdiff_t>(edges.size());
    const auto min = std::min_element(squares.begin(), last);
    if (std::count(squares.begin(), last, *min) != 1) return edges.size();
    return static_cast<std::size_t>(min - squares.begin());
}

}  // namespace

std::span<const Edge> edges_of(int dimension) {
    if (dimension == 2) return triangle_edges;
    return tetrahedron_edges;
}

std::span<const std::size_t> edge_sequence(MidEdgeOrder order, int dimension) {
    const auto all = sequences_of(dimension);
    const auto found = std::ranges::find(all, order, &Sequence::order);
    if (found == all.end()) return {};
    return std::span(found->edges).first(edges_of(dimension).size());
}

std::optional<MidEdgeVote> detect_mid_edge_order(const Mesh& mesh) {
    const ExactEnvironment environment;
    const std::span<const Edge> edges = edges_of(mesh.dimension);
    const std::span<const Sequence> sequences = sequences_of(mesh.dimension);
    std::array<std::size_t, 3> votes{};
    std::size_t voters = 0;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const Mesh::Index* const corners = &mesh.cells[cell * mesh.corners()];
        std::array<std::size_t, 6> found{};  // zeros behind those of a triangle, as in a Sequence
        bool abstains = false;
        for (std::size_t k = 0; k < edges.size() && !abstains; ++k) {
            found[k] = nearest_edge(mesh, corners, mesh.mid_nodes[cell * edges.size() + k], edges);
            abstains = found[k] == edges.size();
        }
        if (abstains) continue;
        ++voters;
        for (std::size_t i = 0; i < sequences.size(); ++i) votes[i] += found == sequences[i].edges ? 1 : 0;
    }
    if (voters == 0) return MidEdgeVote{sequences[0].order, true};
    for (std::size_t i = 0; i < sequences.size(); ++i) {
        if (2 * votes[i] > voters) return MidEdgeVote{sequences[i].order, false};
    }
    return std::nullopt;
}

void normalise_mid_nodes(Mesh& mesh) {
    const std::span<const std::size_t> sequence = edge_sequence(mesh.mid_edge_order, mesh.dimension);
    if (sequence.empty() || mesh.mid_edge_order == MidEdgeOrder::vtk) return;
    for (std::size_t begin = 0; begin < mesh.mid_nodes.size(); begin += sequence.size()) {
        std::array<Mesh::Index, 6> from_file{};
        std::copy_n(&mesh.mid_nodes[begin], sequence.size(), from_file.begin());
        for (std::size_t k = 0; k < sequence.size(); ++k) mesh.mid_nodes[begin + sequence[k]] = from_file[k];
    }
}

}  // namespace barycert::mesh
