// Second-order cells whose sides are not straight.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "core/shape_functions.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/straight_nodes.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace {

using mesh::Straight;

/// A node of a cell, and the corners between which it is in the straight one.
struct HigherNode {
    const double* at = nullptr;
    std::array<const double*, 4> corners{};
    std::array<int, 4> times{};
    std::size_t count = 0;
};

/// Its distance from there, over the longest distance of the corners; more than 0 unless it is there exactly.
double deviation_of(const HigherNode& node, std::size_t d) {
    double largest = 0;
    for (std::size_t c = 0; c < node.count; ++c) {
        for (std::size_t k = 0; k < d; ++k) largest = std::max(largest, std::fabs(node.corners[c][k]));
    }
    const double scale = largest > 0x1p1000 ? 0x1p-8 : 1;  // no sum below overflows, and no subnormal number is lost
    int over = 0;
    std::array<double, 3> off{};
    for (std::size_t c = 0; c < node.count; ++c) over += node.times[c];
    for (std::size_t k = 0; k < d; ++k) {
        double left = 0;  // what sums are rounded by
        off[k] = -over * (node.at[k] * scale);
        for (std::size_t c = 0; c < node.count; ++c) {
            for (int i = 0; i < node.times[c]; ++i) {
                const double term = node.corners[c][k] * scale, sum = off[k] + term, of_term = sum - off[k];
                left += (off[k] - (sum - of_term)) + (term - of_term);
                off[k] = sum;
            }
        }
        off[k] += left;
    }
    double longest = 0;
    for (std::size_t b = 1; b < node.count; ++b) {
        for (std::size_t a = 0; a < b; ++a) {
            std::array<double, 3> edge{};
            for (std::size_t k = 0; k < d; ++k) edge[k] = node.corners[b][k] * scale - node.corners[a][k] * scale;
            longest = std::max(longest, std::hypot(edge[0], edge[1], edge[2]));
        }
    }
    return std::hypot(off[0], off[1], off[2]) / (over * longest);
}

/// A unit of decimal digits beyond that part of the edge does not resolve it: a corner of a square whose coordinates
/// are whole numbers is half a unit off the middle of its diagonal, and no rounding.
constexpr double max_rounded_part = 1e-3;

/// Looks at nodes, and adds up what they are.
class NodesOfCell {
public:
    NodesOfCell(std::size_t d, const mesh::Written& written, bool exact) : d_(d), written_(written), exact_(exact) {}

    /// Returns whether it is off by a curve.
    bool add(const HigherNode& node) {
        Straight worst = Straight::exactly;
        for (std::size_t k = 0; k < d_; ++k) {
            mesh::StraightPlace place;
            bool finite = std::isfinite(node.at[k]);
            for (std::size_t c = 0; c < node.count; ++c) {
                finite = finite && std::isfinite(node.corners[c][k]);
                place.add(node.corners[c][k], node.times[c]);
            }
            if (!finite) return false;
            worst = std::max(worst, mesh::straightness(node.at[k], place, written_));
        }
        if (worst == Straight::exactly) return false;
        const double deviation = deviation_of(node, d_);
        const bool curve =
            exact_ || worst == Straight::no || (worst == Straight::written && deviation > max_rounded_part);
        double& most = curve ? curved_ : rounded_;
        most = std::max(most, deviation);
        (curve ? some_curved_ : some_rounded_) = true;
        return curve;
    }

    CurvedCells found() const {
        return {.cells = some_curved_ ? 1U : 0U,
                .max_deviation = curved_,
                .rounded_cells = some_rounded_ ? 1U : 0U,
                .max_rounded = rounded_};
    }

private:
    std::size_t d_;
    const mesh::Written& written_;
    bool exact_, some_curved_ = false, some_rounded_ = false;
    double curved_ = 0, rounded_ = 0;
};

/// Calls use(node, bit) for each node of a cell of a higher order, whole as users know it, but those at its corners.
/// Its bits are those of `curved_cells`.
template <class Use>
void for_higher_nodes(const Mesh& mesh, std::size_t whole, const Use& use) {
    const std::size_t nodes = mesh.point_count();
    const auto point = [&](Mesh::Index node) -> const double* {
        return node < 0 || static_cast<std::size_t>(node) >= nodes ? nullptr : mesh.point(node);
    };
    HigherNode node;
    const auto add = [&](Mesh::Index corner, int times) {
        if (times == 0) return;
        node.corners[node.count] = point(corner);
        node.times[node.count++] = times;
    };
    const auto done = [&](Mesh::Index own, unsigned bit) {
        node.at = point(own);
        const auto end = node.corners.begin() + static_cast<std::ptrdiff_t>(node.count);
        if (node.at != nullptr && std::find(node.corners.begin(), end, nullptr) == end) use(node, bit);
        node.count = 0;
    };
    if (mesh.shapes.types.empty()) {
        const auto edges = mesh::edges_of(mesh.dimension);
        const auto corners = mesh.corners_of(whole);
        for (std::size_t e = 0; e < edges.size(); ++e) {
            add(corners[edges[e][0]], 1);
            add(corners[edges[e][1]], 1);
            done(mesh.mid_nodes[edges.size() * whole + e], 1U << e);
        }
        return;
    }
    const std::span<const Mesh::Index> own = mesh.shapes.nodes_of(whole);
    const auto* const reference = mesh::is_curved_simplex(mesh.shapes.types[whole])
                                      ? core::isoparametric::simplex_reference(mesh.dimension, own.size())
                                      : nullptr;
    if (reference == nullptr) return;
    for (std::size_t i = mesh.corners(); i < own.size(); ++i) {
        for (std::size_t c = 0; c < mesh.corners(); ++c) add(own[c], reference->indices[i][c]);
        done(own[i], 1);
    }
}

CurvedCells sum(const CurvedCells& x, const CurvedCells& y) {
    return {.cells = x.cells + y.cells,
            .max_deviation = std::max(x.max_deviation, y.max_deviation),
            .rounded_cells = x.rounded_cells + y.rounded_cells,
            .max_rounded = std::max(x.max_rounded, y.max_rounded)};
}

CurvedCells measure(const Mesh& mesh, const mesh::Written& written, bool exact, std::vector<std::uint8_t>* each) {
    const std::vector<Mesh::Index>& parts = mesh.shapes.parts;
    return base::parallel_reduce(
        mesh.whole_count(), 1 << 12, CurvedCells{},
        [&](std::size_t begin, std::size_t end, CurvedCells& found) {
            const ExactEnvironment of_task;
            for (std::size_t whole = begin; whole != end; ++whole) {
                NodesOfCell cell(static_cast<std::size_t>(mesh.dimension), written, exact);
                unsigned bits = 0;
                for_higher_nodes(mesh, whole, [&](const HigherNode& node, unsigned bit) {
                    if (cell.add(node)) bits |= bit;
                });
                const auto first = parts.empty() ? whole : static_cast<std::size_t>(parts[whole]);
                if (each != nullptr && bits != 0) (*each)[first] = static_cast<std::uint8_t>(bits);
                found = sum(found, cell.found());
            }
        },
        [](CurvedCells& all, const CurvedCells& part) { all = sum(all, part); });
}

std::string counted_cells(std::uint64_t count) {
    return base::counted(count, "cell");
}

std::string part_of_edge(double deviation) {
    return base::rounded_text(deviation, std::chars_format::general, 2) + " of the edge off its middle";
}

/// Describes how many cells are curved and how far; not what became of them.
std::string deviations(const CurvedCells& c) {
    const std::string which = counted_cells(c.cells) + (c.cells == 1 ? " is curved" : " are curved");
    if (std::isinf(c.max_deviation)) return which + ": mid-edge nodes lie off edges of length 0";
    return which + ": mid-edge nodes lie up to " + part_of_edge(c.max_deviation);
}

}  // namespace

CurvedCells curved_cells(const Mesh& mesh, std::vector<std::uint8_t>* each, bool exact) {
    const ExactEnvironment environment;
    if (each != nullptr) each->clear();
    const bool listed = mesh.is_listed() && (mesh.dimension == 2 || mesh.dimension == 3);
    const bool quadratic = listed && mesh.shapes.types.empty() && !mesh.mid_nodes.empty() &&
                           mesh.mid_nodes.size() == mesh.cell_count() * mesh::edges_of(mesh.dimension).size();
    const bool mixed = listed && mesh.shapes.parts.size() == mesh.shapes.count() + 1 &&
                       std::ranges::any_of(mesh.shapes.types, mesh::is_curved_simplex);
    CurvedCells found;
    if (quadratic || mixed) {
        mesh::Written written;
        found = measure(mesh, written, exact, nullptr);
        if (found.cells != 0) {
            if (!exact) written = mesh::how_written(mesh.points);
            if (each != nullptr) each->assign(mesh.cell_count(), 0);
            if (each != nullptr || written.single || written.digits != 0) found = measure(mesh, written, exact, each);
            if (each != nullptr && found.cells == 0) each->clear();
        }
    }
    found.by_corners = mesh.by_corners;
    found.rounded_too = mixed;
    return found;
}

std::string message(const CurvedCells& curved) {
    constexpr std::string_view straight = "; sides were taken as straight", kept = "; they are taken as they are";
    std::string text;
    if (curved.cells != 0) text = deviations(curved) + std::string(curved.mapped ? kept : straight);
    if (curved.rounded_cells != 0)
        text.append(text.empty() ? "" : "; ")
            .append(counted_cells(curved.rounded_cells) + ": mid-edge nodes lie up to ")
            .append(part_of_edge(curved.max_rounded) + ", by rounding")
            .append(curved.mapped && curved.rounded_too ? kept : straight);
    if (curved.by_corners != 0)
        text.append(text.empty() ? "" : "; ")
            .append(counted_cells(curved.by_corners) + " of a higher order ")
            .append(curved.by_corners == 1 ? "is taken by its corners" : "are taken by their corners")
            .append(": nodes and values amid edges and sides are left out");
    return text;
}

Result<CurvedCells> measure_curved(const Mesh& mesh, const std::string& file, Curved curved) {
    const CurvedCells found = curved_cells(mesh, nullptr, curved == Curved::exact);
    if (curved != Curved::refuse || found.cells == 0) return found;
    return file_error("mesh.curved", file, "the mesh is curved",
                      "every node of a higher order where a straight cell has it", deviations(found),
                      "mesh it with straight sides, or let them be taken as straight: `straight` in place of `refuse`");
}

}  // namespace barycert
