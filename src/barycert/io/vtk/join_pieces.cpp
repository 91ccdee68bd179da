#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "barycert/io/vtk/collection.hpp"

namespace barycert::io {
namespace {

/// The first point with each key; points that come later stand for it.
template <class Key>
std::vector<std::int32_t> first_of_each(std::size_t points, Key key) {
    std::vector<std::int32_t> order(points), first(points);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        const auto ka = key(static_cast<std::size_t>(a)), kb = key(static_cast<std::size_t>(b));
        return ka != kb ? ka < kb : a < b;
    });
    for (std::size_t i = 0; i < points; ++i) {
        const auto point = static_cast<std::size_t>(order[i]);
        const bool same = i != 0 && key(point) == key(static_cast<std::size_t>(order[i - 1]));
        first[point] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
    }
    return first;
}

using PointBits = std::array<std::uint64_t, 3>;

PointBits bits_of_point(const RawGrid& grid, std::size_t point) {
    PointBits bits{};
    // Zeros of either sign are one place.
    for (std::size_t k = 0; k < 3; ++k) bits[k] = std::bit_cast<std::uint64_t>(grid.points[3 * point + k] + 0.0);
    return bits;
}

const Field* global_ids_of(const RawGrid& grid) {
    for (const RawArray& array : grid.point_arrays) {
        const bool named = grid.global_ids.empty() ? array.field.name.starts_with("GlobalNodeId")
                                                   : array.field.name == grid.global_ids;
        if (named && array.fault.empty() && !array.has_labels && array.is_integer && array.field.components == 1)
            return &array.field;
    }
    return nullptr;
}

/// Whether two points have the same values in all fields, NaNs of the same bits included.
bool same_values(const RawGrid& grid, std::size_t a, std::size_t b) {
    for (const RawArray& array : grid.point_arrays) {
        if (!array.fault.empty() || array.field.name == "vtkGhostType") continue;
        const auto n = static_cast<std::size_t>(array.field.components);
        for (std::size_t c = 0; c < n; ++c) {
            if (array.has_labels) {
                const auto& labels = std::get<std::vector<std::int64_t>>(array.labels);
                if (labels[a] != labels[b]) return false;
            } else if (std::bit_cast<std::uint64_t>(array.field.data[n * a + c]) !=
                       std::bit_cast<std::uint64_t>(array.field.data[n * b + c])) {
                return false;
            }
        }
    }
    return true;
}

template <class T>
void keep_points(std::vector<T>& values, std::size_t components, const std::vector<std::int32_t>& first) {
    std::size_t to = 0;
    for (std::size_t point = 0; point < first.size(); ++point) {
        if (static_cast<std::size_t>(first[point]) != point) continue;
        for (std::size_t c = 0; c < components; ++c) values[to++] = values[point * components + c];
    }
    values.resize(to);
}

/// Leaves out the points that stand for an earlier one.
void merge_points(RawGrid& grid, const std::vector<std::int32_t>& first) {
    std::vector<std::int32_t> number(first.size());
    std::int32_t next = 0;
    for (std::size_t point = 0; point < first.size(); ++point) {
        const auto own = static_cast<std::size_t>(first[point]);
        number[point] = own == point ? next++ : number[own];
    }
    for (std::int32_t& node : grid.connectivity) node = number[static_cast<std::size_t>(node)];
    keep_points(grid.points, 3, first);
    for (RawArray& array : grid.point_arrays) {
        if (!array.fault.empty()) continue;
        if (array.has_labels) {
            keep_points(std::get<std::vector<std::int64_t>>(array.labels), 1, first);
        } else {
            keep_points(array.field.data, static_cast<std::size_t>(array.field.components), first);
        }
    }
}

}  // namespace

void join_pieces(RawGrid& grid, const std::string& path) {
    const std::size_t points = grid.point_count();
    if (grid.piece_points.size() < 2 || !grid.checked_nodes) return;
    std::size_t shared = 0, apart = 0, differing = 0;
    const Field* const ids = global_ids_of(grid);
    std::vector<std::int32_t> first;
    if (ids == nullptr) {
        first = first_of_each(points, [&](std::size_t i) { return bits_of_point(grid, i); });
        // Those of one piece are as their writer wants them.
        for (std::size_t piece = 0; piece < grid.piece_points.size(); ++piece) {
            const std::size_t begin = grid.piece_points[piece],
                              end = piece + 1 < grid.piece_points.size() ? grid.piece_points[piece + 1] : points;
            for (std::size_t i = begin; i < end; ++i) shared += static_cast<std::size_t>(first[i]) < begin ? 1 : 0;
        }
        if (shared == 0) return;
        grid.notes.push_back({Note::Kind::guessed,
                              std::to_string(shared) +
                                  " nodes stand where another piece has one, and are kept apart: the file gives no "
                                  "GlobalNodeId, by which pieces could be joined",
                              path, true});
        return;
    }
    first = first_of_each(points, [&](std::size_t i) { return ids->data[i]; });
    for (std::size_t i = 0; i < points; ++i) {
        const auto own = static_cast<std::size_t>(first[i]);
        if (own == i) continue;
        if (bits_of_point(grid, i) != bits_of_point(grid, own)) {
            ++apart;
            first[i] = static_cast<std::int32_t>(i);
        } else {
            ++shared;
            differing += same_values(grid, i, own) ? 0 : 1;
        }
    }
    merge_points(grid, first);
    if (shared != 0) {
        grid.notes.push_back({Note::Kind::converted,
                              std::to_string(shared) + " nodes with the GlobalNodeId of a node of an earlier piece are "
                                                       "that node",
                              path});
    }
    if (differing != 0) {
        grid.notes.push_back({Note::Kind::left_out,
                              "values at " + std::to_string(differing) +
                                  " of these nodes that differ from those in the first piece that has the node",
                              path, true});
    }
    if (apart != 0) {
        grid.notes.push_back({Note::Kind::guessed,
                              std::to_string(apart) + " nodes are kept apart though they have the GlobalNodeId of a "
                                                      "node elsewhere: their coordinates differ",
                              path, true});
    }
}

}  // namespace barycert::io
