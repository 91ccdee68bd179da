#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <unordered_map>

#include "barycert/base/random.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

/// The first point with each key; points that come later stand for it.
template <class Key, class Hash = std::hash<Key>, class KeyAt>
std::vector<std::int32_t> first_of_each(std::size_t points, const KeyAt& key_at) {
    std::vector<std::int32_t> first(points);
    std::unordered_map<Key, std::int32_t, Hash> known(points);
    for (std::size_t i = 0; i < points; ++i)
        first[i] = known.try_emplace(key_at(i), static_cast<std::int32_t>(i)).first->second;
    return first;
}

using PointBits = std::array<std::uint64_t, 3>;
struct HashOfBits {
    std::size_t operator()(const PointBits& x) const {
        return base::mix64(base::mix64(base::mix64(x[0]) ^ x[1]) ^ x[2]);
    }
};

PointBits bits_of_point(const RawGrid& grid, std::size_t point) {
    PointBits bits{};
    // Zeros of either sign are one place.
    for (std::size_t k = 0; k < 3; ++k) bits[k] = std::bit_cast<std::uint64_t>(grid.points[3 * point + k] + 0.0);
    return bits;
}

const std::vector<double>* global_ids_of(const RawGrid& grid) {
    for (const RawArray& array : grid.point_arrays) {
        const bool named =
            grid.global_ids.empty() ? array.name.starts_with("GlobalNodeId") : array.name == grid.global_ids;
        if (named && array.fault.empty() && !array.has_labels() && array.is_wide_integer() && array.components == 1)
            return &array.numbers();
    }
    return nullptr;
}

/// Whether two points have the same values in all arrays, NaNs of the same bits included.
bool same_values(const RawGrid& grid, std::size_t a, std::size_t b) {
    return std::all_of(grid.point_arrays.begin(), grid.point_arrays.end(), [&](const RawArray& array) {
        if (!array.fault.empty() || array.name == "vtkGhostType") return true;
        const auto n = static_cast<std::size_t>(array.components);
        return std::visit(
            [&]<class T>(const std::vector<T>& values) {
                if constexpr (std::is_same_v<T, std::string>) {
                    return values[a] == values[b];
                } else {
                    return std::memcmp(&values[n * a], &values[n * b], n * sizeof(T)) == 0;
                }
            },
            array.values);
    });
}

/// Leaves out the points that stand for an earlier one.
void merge_points(RawGrid& grid, const std::vector<std::int32_t>& first) {
    std::vector<std::int32_t> number(first.size()), kept;
    for (std::size_t point = 0; point < first.size(); ++point) {
        const auto own = static_cast<std::size_t>(first[point]);
        number[point] = own == point ? static_cast<std::int32_t>(kept.size()) : number[own];
        if (own == point) kept.push_back(first[point]);
    }
    for (std::int32_t& node : grid.cells.connectivity) node = number[static_cast<std::size_t>(node)];
    keep_rows(grid.points, 3, kept);
    keep_rows(grid.point_arrays, kept);
}

}  // namespace

void join_pieces(RawGrid& grid, const std::string& path) {
    const std::size_t points = grid.point_count();
    if (grid.piece_points.size() < 2) return;
    std::size_t shared = 0, apart = 0, differing = 0;
    const auto note = [&](Note::Kind kind, std::size_t count, const char* before, const char* text) {
        if (count != 0)
            grid.notes.push_back({kind, before + std::to_string(count) + text, path, kind != Note::Kind::converted});
    };
    const std::vector<double>* const ids = global_ids_of(grid);
    std::vector<std::int32_t> first;
    if (ids == nullptr) {
        first = first_of_each<PointBits, HashOfBits>(points, [&](std::size_t i) { return bits_of_point(grid, i); });
        // Those of one piece are as their writer wants them.
        for (std::size_t piece = 0; piece < grid.piece_points.size(); ++piece) {
            const std::size_t begin = grid.piece_points[piece],
                              end = piece + 1 < grid.piece_points.size() ? grid.piece_points[piece + 1] : points;
            for (std::size_t i = begin; i < end; ++i) shared += static_cast<std::size_t>(first[i]) < begin ? 1 : 0;
        }
        return note(Note::Kind::guessed, shared, "",
                    " nodes stand where another piece has one, and are kept apart: the file gives no GlobalNodeId, by "
                    "which pieces could be joined");
    }
    first = first_of_each<double>(points, [&](std::size_t i) { return (*ids)[i]; });
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
    note(Note::Kind::converted, shared, "", " nodes with the GlobalNodeId of a node of an earlier piece are that node");
    note(Note::Kind::left_out, differing, "values at ",
         " of these nodes that differ from those in the first piece that has the node");
    note(Note::Kind::guessed, apart, "",
         " nodes are kept apart though they have the GlobalNodeId of a node elsewhere: their coordinates differ");
}

}  // namespace barycert::io
