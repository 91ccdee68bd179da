#include "barycert/locate/walk_one.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "barycert/base/strict_math.hpp"

namespace barycert::locate {
namespace {

/// What a look at one cell tells, as a step of walk_lanes does, whose proofs these are.
struct Look {
    bool inside = false;  ///< certainly
    bool beyond = false;  ///< certainly, of the facet opposite to `face`
    bool far = false;     ///< by several times the height of the cell over that facet, about
    std::size_t face = 0;
};

template <std::size_t d>
Look look(const CellIndex& index, Place place, const double* p) {
    constexpr double epsilon = 0x1p-52, many = 4;
    const CellRecord& cell = index.cells[static_cast<std::size_t>(place)];
    double r[d + 1][d], n[d + 1], extent[d];
    for (std::size_t i = 0; i <= d; ++i) {
        const auto& at = index.nodes[static_cast<std::size_t>(cell.node[i])].at;
        for (std::size_t k = 0; k < d; ++k) r[i][k] = at[k] - p[k];
    }
    double product = 1, least = std::numeric_limits<double>::infinity(), most = 0;
    for (std::size_t k = 0; k < d; ++k) {
        extent[k] = std::abs(r[0][k]);
        for (std::size_t i = 1; i <= d; ++i) extent[k] = std::max(extent[k], std::abs(r[i][k]));
        product *= extent[k];
        least = std::min(least, extent[k]);
        most = std::max(most, extent[k]);
    }
    if constexpr (d == 3) {
        const auto cross = [&](std::size_t i, std::size_t j, double(&out)[3]) {
            out[0] = r[i][1] * r[j][2] - r[i][2] * r[j][1];
            out[1] = r[i][2] * r[j][0] - r[i][0] * r[j][2];
            out[2] = r[i][0] * r[j][1] - r[i][1] * r[j][0];
        };
        const auto dot = [&](std::size_t i, const double(&x)[3]) {
            return r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2];
        };
        double m01[3], m23[3];
        cross(0, 1, m01);
        cross(2, 3, m23);
        n[0] = dot(1, m23);
        n[1] = -dot(0, m23);
        n[2] = dot(3, m01);
        n[3] = -dot(2, m01);
    } else {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto &a = r[(i + 1) % 3], &b = r[(i + 2) % 3];
            n[i] = a[0] * b[1] - a[1] * b[0];
        }
    }
    const double denominator = d == 3 ? (n[0] + n[1]) + (n[2] + n[d]) : n[0] + n[1] + n[2];
    // A branch, as cells of a mesh are nearly all oriented alike: nothing waits for the denominator.
    if (denominator < 0) [[unlikely]] {
        for (double& x : n) x = -x;
    }
    Look out;
    const std::size_t first = n[1] < n[0] ? 1 : 0, other = d == 3 && n[d] < n[2] ? d : 2;
    const double lowest = std::min(std::min(n[0], n[1]), std::min(n[2], n[d]));
    out.face = std::min(n[2], n[d]) < std::min(n[0], n[1]) ? other : first;
    if (!(least >= 0x1p-300 && most <= 0x1p300)) return out;
    const double bound = (d == 3 ? 49 : 8.5) * epsilon * product;
    out.inside = lowest > bound;
    out.beyond = lowest < -bound;
    out.far = lowest < -many * std::abs(denominator);
    return out;
}

/// Where the last walk of this thread ended. A particle's next hint is that cell, and to look its place up would wait
/// for memory. What is kept of a locator that is gone does no harm: a walk may start at any place that there is.
struct LastEnd {
    const LocatorData* data = nullptr;
    Mesh::Index cell = -1;
    Place place = -1;
};
thread_local LastEnd last_end;

/// A place to walk from, and whether it is the hint's.
struct From {
    Place cell;
    bool hint;
};

From start_of(const LocatorData& data, const double* p, Mesh::Index hint) {
    const CellIndex& index = data.index;
    if (hint < 0 || static_cast<std::size_t>(hint) >= index.cell_count()) return {index.start(index.bins.of(p)), false};
    if (last_end.cell == hint && last_end.data == &data &&
        static_cast<std::size_t>(last_end.place) < index.cell_count())
        return {last_end.place, true};
    // Both are asked of memory at the same time. Cells that are far apart in the order of the curve may be neighbours:
    // then the bin's start is a little farther than the hint.
    constexpr Place near = 32;
    const Place place = data.places()[static_cast<std::size_t>(hint)];
    const std::uint32_t bin = index.bins.of(p), part = bin >> CellIndex::part_bits;
    const Place start = index.start(bin), in_bin = index.first[part + 1] - index.first[part];
    return std::abs(place - start) <= near + in_bin ? From{place, true} : From{start, false};
}

/// Asks for what the next look may read, and for the number of the cell, while this one is looked at.
void fetch_around(const CellIndex& index, Place cell) {
    for (const Place next : index.cells[static_cast<std::size_t>(cell)].next)
        __builtin_prefetch(&index.cells[static_cast<std::size_t>(std::max(next, 0))]);
    __builtin_prefetch(&index.original[static_cast<std::size_t>(cell)]);
}

/// If a hint turns out far, or does not lead there in some steps, the walk goes on from the start of the point's bin.
template <std::size_t d>
End walk(const CellIndex& index, const double* p, From from) {
    constexpr int patience = 4, max_steps = 256;
    constexpr std::size_t in_cache = std::size_t{1} << 15;
    const bool fetch = index.cell_count() > in_cache;
    Place cell = from.cell;
    for (int step = 0; step < max_steps; ++step) {
        if (fetch && (step > 0 || !from.hint)) fetch_around(index, cell);
        const Look at = look<d>(index, cell, p);
        if (at.inside) return {cell, true, false};
        if (!at.beyond) return {cell, false, false};
        const Place next = index.cells[static_cast<std::size_t>(cell)].next[at.face];
        if (from.hint && (at.far || step == patience || next < 0)) {
            from = {index.start(index.bins.of(p)), false};
            cell = from.cell;
        } else if (next < 0) {
            return {cell, false, true};
        } else {
            cell = next;
        }
    }
    return {cell, false, false};
}

template <std::size_t d>
End walk_and_note(const LocatorData& data, const double* p, Mesh::Index hint) {
    const End end = walk<d>(data.index, p, start_of(data, p, hint));
    last_end = {&data, data.index.original[static_cast<std::size_t>(end.cell)], end.cell};
    return end;
}

}  // namespace

End walk_one(const LocatorData& data, const double* point, Mesh::Index hint) {
    return data.index.dimension() == 2 ? walk_and_note<2>(data, point, hint) : walk_and_note<3>(data, point, hint);
}

}  // namespace barycert::locate
