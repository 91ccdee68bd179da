// Second-order cells whose sides are not straight.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "barycert/base/arena.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh/mid_edges.hpp"
#include "barycert/mesh/pulling.hpp"

namespace barycert {
namespace {

/// A unit of the last place of coordinates: `relative` to a coordinate, or `absolute`, whichever is more. Three nodes
/// that were each rounded by half of it are off the middle by (1/2 + 1/2 + 1) / 2 = 1 unit at most.
struct LastPlace {
    double relative = 0, absolute = 0;
    bool known() const { return relative > 0 || absolute > 0; }
};

LastPlace last_place(const std::vector<double>& coordinates) {
    bool single = true, decimal = true;
    int digits = 1, lowest = std::numeric_limits<int>::max();
    for (const double x : coordinates) {
        if (x == 0 || !std::isfinite(x)) continue;
        single = single && static_cast<double>(static_cast<float>(x)) == x;
        if (decimal) {
            std::array<char, 32> text{};  // d.ddde-xx, and zero bytes
            std::to_chars(text.data(), text.data() + text.size(), std::fabs(x), std::chars_format::scientific);
            const auto e = std::ranges::find(text, 'e');
            // Less the point, if there is one.
            const int count = std::max(1, static_cast<int>(e - text.begin()) - 1);
            digits = std::max(digits, count);
            lowest = std::min(lowest, std::atoi(&*e + 1) - count + 1);
            decimal = digits <= 15;
        }
        if (!single && !decimal) return {};
    }
    LastPlace last;
    if (single) last.relative = 0x1p-23;
    // Programs write at least 5 digits: fewer come from round numbers, and say nothing about the others.
    if (decimal) last.absolute = std::pow(10, lowest);
    if (decimal && digits >= 5) last.relative = std::max(last.relative, std::pow(10, 1 - digits));
    return last;
}

constexpr double max_rounded_part = 1e-3;  ///< of an edge: units beyond it would not resolve the edge
/// Of an edge: what arithmetic leaves of nodes on lines (Gmsh: up to 2e-12), and a motion there and back (4e-13).
constexpr double computed_part = 1e-10;

/// Adds the deviation of one node to those of its cell. Returns whether it is one by a curve.
bool look_at_edge(const double* a, const double* b, const double* m, std::size_t d, const LastPlace& last,
                  CurvedCells& bend) {
    double largest = 0;
    for (std::size_t k = 0; k < d; ++k) largest = std::max({largest, std::fabs(a[k]), std::fabs(b[k])});
    const double scale = largest > 0x1p1000 ? 0.25 : 1;  // no sum below overflows, and no subnormal number is lost
    largest *= scale;
    std::array<double, 3> off{}, edge{};
    double most = 0;
    for (std::size_t k = 0; k < d; ++k) {
        off[k] = a[k] * scale + b[k] * scale - 2 * (m[k] * scale);
        edge[k] = b[k] * scale - a[k] * scale;
        most = std::max(most, std::fabs(off[k]));
    }
    // With u = 2^-53 and coordinates up to L: (a + b) / 2 and a + (b - a) / 2 are off by up to 2uL; coordinates of 16
    // digits by up to 5e-16 L < 5uL each, 10uL for the three; the terms above are off by 2uL. That is below 16uL, twice
    // that here, as `off` is twice the distance. Subnormal numbers are rounded by their unit.
    const double nothing = std::max(0x1p-48 * largest, std::numeric_limits<double>::denorm_min());
    if (!(most > nothing) || !std::isfinite(most)) return false;
    const double deviation = std::hypot(off[0], off[1], off[2]) / (2 * std::hypot(edge[0], edge[1], edge[2]));
    const bool written =
        most <= 2 * std::max(last.relative * largest, last.absolute * scale) && deviation <= max_rounded_part;
    const bool rounded = written || deviation <= computed_part;
    double& most_so_far = rounded ? bend.max_rounded : bend.max_deviation;
    most_so_far = std::max(most_so_far, deviation);
    return !rounded;
}

CurvedCells sum(const CurvedCells& x, const CurvedCells& y) {
    return {x.cells + y.cells, std::max(x.max_deviation, y.max_deviation), x.rounded_cells + y.rounded_cells,
            std::max(x.max_rounded, y.max_rounded), false};
}

CurvedCells measure(const Mesh& mesh, const LastPlace& last, std::vector<std::uint8_t>* each) {
    const auto edges = mesh::edges_of(mesh.dimension);
    const std::size_t d = static_cast<std::size_t>(mesh.dimension), nodes = mesh.point_count();
    const auto point = [&](Mesh::Index node) -> const double* {
        const auto at = static_cast<std::size_t>(node);
        return node < 0 || at >= nodes ? nullptr : &mesh.points[d * at];
    };
    return base::parallel_reduce(
        mesh.cell_count(), 1 << 12, CurvedCells{},
        [&](std::size_t begin, std::size_t end, CurvedCells& found) {
            const ExactEnvironment of_task;
            for (std::size_t cell = begin; cell != end; ++cell) {
                CurvedCells bend;
                unsigned bits = 0;
                for (std::size_t e = 0; e < edges.size(); ++e) {
                    const double* const a = point(mesh.cells[(d + 1) * cell + edges[e][0]]);
                    const double* const b = point(mesh.cells[(d + 1) * cell + edges[e][1]]);
                    const double* const m = point(mesh.mid_nodes[edges.size() * cell + e]);
                    if (a == nullptr || b == nullptr || m == nullptr) continue;
                    if (look_at_edge(a, b, m, d, last, bend)) bits |= 1U << e;
                }
                bend.cells = bend.max_deviation > 0 ? 1 : 0;
                bend.rounded_cells = bend.max_rounded > 0 && bend.cells == 0 ? 1 : 0;
                if (each != nullptr) (*each)[cell] = static_cast<std::uint8_t>(bits);
                found = sum(found, bend);
            }
        },
        [](CurvedCells& all, const CurvedCells& part) { all = sum(all, part); });
}

/// What CurvedCells says, without what became of it.
std::string deviations(const CurvedCells& c) {
    const bool curved = c.cells != 0;
    const std::uint64_t cells = curved ? c.cells : c.rounded_cells;
    const char* const verb = !curved ? "" : cells == 1 ? " is curved" : " are curved";
    const std::string which = fmt::format("{} cell{}{}", cells, cells == 1 ? "" : "s", verb);
    if (curved && std::isinf(c.max_deviation)) return which + ": mid-edge nodes lie off edges of length 0";
    return fmt::format("{}: mid-edge nodes lie up to {:.2g} of the edge off its middle{}", which,
                       curved ? c.max_deviation : c.max_rounded, curved ? "" : ", by rounding");
}

}  // namespace

CurvedCells curved_cells(const Mesh& mesh, std::vector<std::uint8_t>* each) {
    const ExactEnvironment environment;
    if (each != nullptr) each->clear();
    if (mesh.mid_nodes.empty() || (mesh.dimension != 2 && mesh.dimension != 3) ||
        mesh.mid_nodes.size() != mesh.cell_count() * mesh::edges_of(mesh.dimension).size())
        return {};
    CurvedCells found = measure(mesh, {}, nullptr);
    if (found.cells == 0) return found;
    const LastPlace last = last_place(mesh.points);
    if (!last.known() && each == nullptr) return found;
    if (each != nullptr) each->assign(mesh.cell_count(), 0);
    found = measure(mesh, last, each);
    if (each != nullptr && found.cells == 0) each->clear();
    return found;
}

std::string message(const CurvedCells& curved) {
    if (curved.cells == 0 && curved.rounded_cells == 0) return "";
    return deviations(curved) + (curved.mapped ? "; they are taken as they are" : "; sides were taken as straight");
}

Result<CurvedCells> measure_curved(const Mesh& mesh, const std::string& file, Curved curved) {
    const CurvedCells found = curved_cells(mesh);
    if (curved != Curved::refuse) return found;
    if (std::ranges::any_of(mesh.shapes.types, mesh::is_curved_simplex))
        return file_error(file, "simplices of a higher order, which may be curved", "cells with straight sides", {},
                          "let them be taken as straight: `straight` in place of `refuse`");
    if (found.cells == 0) return found;
    return file_error(file, "the mesh is curved", "every mid-edge node at the middle of its edge", deviations(found),
                      "mesh it with straight sides, or let them be taken as straight: `straight` in place of `refuse`");
}

}  // namespace barycert
