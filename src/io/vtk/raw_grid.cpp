#include "io/vtk/raw_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/result.hpp"
#include "core/base/random.hpp"
#include "core/vtk_cell.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/vtk/numbers.hpp"
#include "mesh/part.hpp"

namespace barycert::io {

void FileText::check(NumberFault fault, const char* begin, const std::string& what, std::uint64_t count,
                     NumberFault* inexact) const {
    // A number stands in a line of its own.
    const char* const at = fault.place != nullptr ? fault.place : begin;
    const std::string number = "number " + std::to_string(fault.index) + " (from 0) of " + what;
    switch (fault.kind) {
        case NumberFault::Kind::none:
            return;
        case NumberFault::Kind::too_few:
            refuse("file.truncated", at, what, std::to_string(count) + " numbers", std::to_string(fault.index),
                   cut_off);
        case NumberFault::Kind::no_number:
            refuse("file.number", at, number, "a number of the type of the array", in_quotes(fault.text),
                   about_real(fault.text, {}, {}).remedy);
        case NumberFault::Kind::not_exact:
            if (inexact == nullptr)
                refuse("file.number", at, number, "a number that fits what it stands for", fault.text);
            *inexact = std::move(fault);
    }
}

void read_numbers(RawArray& array, bool of_points, bool may_label,
                  const std::function<void(NumbersTo values, NumberFault& inexact)>& read) {
    const bool one = array.components == 1;
    NumberFault inexact, beyond;
    if (!(of_points && one && array.name == marker_name && array.type == NumberType::int64)) {
        read(array.numbers(), inexact);
        if (!inexact) return;
        array.values = std::vector<double>();
        array.fault = "it holds " + inexact.text + ", which is not exactly a double";
        if (!may_label || !one || !array.is_wide_integer()) return;
    }
    std::vector<std::int64_t> labels;
    read(labels, beyond);
    if (beyond) return;
    array.values = std::move(labels);
    array.fault.clear();
}

bool takes_texts(RawArray& array, bool may_label) {
    array.type = NumberType::text;
    if (!may_label) {
        array.fault = "it holds text, which points of a mesh cannot carry";
    } else if (array.components != 1) {
        array.fault = "it holds texts of several components";
    }
    return array.fault.empty();
}

std::size_t first_wrong_node(const std::vector<std::int32_t>& nodes, std::size_t count) {
    const auto good = [&](std::size_t first, std::size_t last) {
        // The sign of any of these numbers: below 0, or at `count` or above.
        std::uint32_t signs = 0;
        for (std::size_t i = first; i < last; ++i) {
            const auto node = static_cast<std::uint32_t>(nodes[i]);
            signs |= node | (static_cast<std::uint32_t>(count) - 1 - node);
        }
        return signs >> 31U != 0 ? first : last;
    };
    std::size_t i = first_bad(nodes.size(), std::size_t{1} << 18, good);
    while (i < nodes.size() && static_cast<std::uint32_t>(nodes[i]) < count) ++i;
    return i;
}

namespace {

/// The type of a cell in that section, by its number of nodes.
std::uint8_t type_in(Section section, std::int64_t nodes) {
    if (section == vertices) return nodes == 1 ? vtk_vertex : vtk_poly_vertex;
    if (section == lines) return nodes == 2 ? vtk_line : vtk_poly_line;
    if (section == strips) return vtk_triangle_strip;
    return nodes == 3 ? vtk_triangle : nodes == 4 ? vtk_quad : vtk_polygon;
}

constexpr const char* missing = "it is missing in a piece of the file";

void add_new(std::vector<std::string>& names, const std::vector<std::string>& more) {
    std::ranges::copy_if(more, std::back_inserter(names),
                         [&](const std::string& name) { return std::ranges::count(names, name) == 0; });
}

/// A type that holds numbers of both types.
NumberType common_type(NumberType a, NumberType b) {
    if (a == b) return a;
    for (const NumberType type : {NumberType::float32, NumberType::float64}) {
        if (a == type || b == type) return type;
    }
    return std::min(a, b) >= NumberType::int64 ? NumberType::int64 : NumberType::int32;
}

/// Whether both became of one kind. Numbers that a field holds exactly become labels, where another piece has them.
bool agree(RawArray& a, RawArray& b) {
    if (a.components != b.components) return false;
    if (a.has_labels() != b.has_labels()) {
        // Numbers of uint64 that are no int64 were refused as labels, and may be among the plain ones.
        RawArray& plain = a.has_labels() ? b : a;
        if (!plain.is_wide_integer()) return false;
        plain.make_labels();
    }
    return a.values.index() == b.values.index();
}

void append_array(RawArray& to, RawArray& from) {
    if (to.fault.empty()) to.fault = from.fault;
    if (to.fault.empty() && !agree(to, from)) to.fault = "its type differs between pieces of the file";
    if (!to.fault.empty()) {
        to.values = std::vector<double>();
        return;
    }
    to.type = common_type(to.type, from.type);
    std::visit([&](auto& values) { move_behind(values, std::get<std::decay_t<decltype(values)>>(from.values)); },
               to.values);
}

/// `before`: rows that there are.
void append_arrays(std::vector<RawArray>& to, std::vector<RawArray>& from, std::size_t before) {
    for (RawArray& array : to) {
        if (array.fault.empty() && std::ranges::count(from, array.name, &RawArray::name) == 0) array.fault = missing;
    }
    for (RawArray& array : from) {
        if (const auto known = std::ranges::find(to, array.name, &RawArray::name); known != to.end()) {
            append_array(*known, array);
        } else {
            if (before != 0 && array.fault.empty()) array.fault = missing;
            to.push_back(std::move(array));
        }
    }
}

/// Where other pieces alone say which of their cells are ghosts, none of these is.
void flag_no_ghosts(std::vector<RawArray>& arrays, std::size_t cells, const std::vector<RawArray>& others) {
    const auto flags = std::ranges::find_if(others, &RawArray::is_ghost_flags);
    if (flags == others.end() || cells == 0 || std::ranges::count(arrays, flags->name, &RawArray::name) != 0) return;
    arrays.push_back({.name = flags->name, .values = std::vector<double>(cells), .type = flags->type});
}

/// The first point with each key; points that come later stand for it.
template <class Key, class Hash = std::hash<Key>, class KeyAt>
std::vector<std::int32_t> first_of_each(std::size_t points, const KeyAt& key_at) {
    std::vector<std::int32_t> first(points);
    std::unordered_map<Key, std::int32_t, Hash> known(points);
    for (std::size_t i = 0; i < points; ++i)
        first[i] = known.try_emplace(key_at(i), static_cast<std::int32_t>(i)).first->second;
    return first;
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
        if (!array.fault.empty() || array.name == ghost_name) return true;
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
    for (auto* const nodes : {&grid.cells.connectivity, &grid.faces.rings}) {
        for (std::int32_t& node : *nodes) node = number[static_cast<std::size_t>(node)];
    }
    mesh::keep_rows(grid.points, 3, kept);
    keep_rows(grid.point_arrays, kept);
}

}  // namespace

bool RawFaces::append(std::span<const std::int64_t> stream, std::size_t points) {
    std::size_t at = 0;
    const auto take = [&](std::int64_t& number) {
        if (at == stream.size()) return false;
        number = stream[at++];
        return number >= 0;
    };
    std::int64_t faces = 0, nodes = 0, node = 0;
    if (!take(faces)) return false;
    for (; faces != 0; --faces) {
        if (!take(nodes)) return false;
        for (; nodes != 0; --nodes) {
            if (!take(node) || static_cast<std::size_t>(node) >= points) return false;
            rings.push_back(static_cast<std::int32_t>(node));
        }
        ring_ends.push_back(static_cast<std::int64_t>(rings.size()));
    }
    face_ends.push_back(static_cast<std::int64_t>(ring_ends.size()));
    return at == stream.size();
}

void RawFaces::append(RawFaces more, std::size_t before, std::size_t cells, std::size_t points) {
    if (face_ends.empty() && more.face_ends.empty()) return;
    const auto faces = static_cast<std::int64_t>(ring_ends.size()), nodes = static_cast<std::int64_t>(rings.size());
    face_ends.resize(before, faces);
    more.face_ends.resize(cells, static_cast<std::int64_t>(more.ring_ends.size()));
    for (const std::int64_t end : more.face_ends) face_ends.push_back(faces + end);
    for (const std::int64_t end : more.ring_ends) ring_ends.push_back(nodes + end);
    for (const std::int32_t node : more.rings) rings.push_back(node + static_cast<std::int32_t>(points));
}

void RawGrid::append(RawCells more, std::optional<Section> section) {
    const auto before = static_cast<std::int64_t>(cells.connectivity.size());
    if (section || before != 0) {
        std::int64_t end = 0;
        for (std::int64_t& own : more.ends) {
            if (section) types.push_back(type_in(*section, own - end));
            end = own;
            own += before;
        }
    }
    move_behind(cells.ends, more.ends);
    move_behind(cells.connectivity, more.connectivity);
}

void keep_rows(std::vector<RawArray>& arrays, const std::vector<std::int32_t>& rows) {
    for (RawArray& array : arrays) {
        if (!array.fault.empty()) continue;
        std::visit([&](auto& values) { mesh::keep_rows(values, static_cast<std::size_t>(array.components), rows); },
                   array.values);
    }
}

void RawArray::make_labels() {
    const auto fits = [](double x) { return x >= -0x1p63 && x < 0x1p63; };
    if (has_labels() || !fault.empty() || !std::ranges::all_of(numbers(), fits)) return;
    values = std::vector<std::int64_t>(numbers().begin(), numbers().end());
}

void append_piece(RawGrid& grid, RawGrid piece, const std::string& path) {
    if (grid.point_count() != 0) {
        grid.list(path);
        piece.list(path);
    }
    const std::size_t points = grid.point_count(), cells = grid.types.size();
    if (points + piece.point_count() > max_entities || cells + piece.cell_count() > max_entities)
        refuse_file("mesh.too-large", path, "more points or cells than a mesh can have",
                    "at most " + std::to_string(max_entities) + " in all pieces");
    grid.narrow_points = grid.narrow_points || piece.narrow_points;
    grid.has_steps = grid.has_steps || piece.has_steps;
    move_behind(grid.notes, piece.notes);
    add_new(grid.loose_arrays, piece.loose_arrays);
    add_new(grid.unread_arrays, piece.unread_arrays);
    if (piece.point_count() != 0) {
        append_arrays(grid.point_arrays, piece.point_arrays, points);
        if (points == 0) {
            grid.global_ids = std::move(piece.global_ids);
        } else {
            if (piece.global_ids != grid.global_ids) grid.global_ids.clear();
            for (const std::size_t first : piece.piece_points) grid.piece_points.push_back(points + first);
        }
        move_behind(grid.points, piece.points);
    }
    if (piece.unlisted) grid.unlisted = std::move(piece.unlisted);
    if (piece.cell_count() == 0) return;
    flag_no_ghosts(grid.cell_arrays, cells, piece.cell_arrays);
    if (cells != 0) flag_no_ghosts(piece.cell_arrays, piece.cell_count(), grid.cell_arrays);
    append_arrays(grid.cell_arrays, piece.cell_arrays, cells);
    if (points != 0) {
        for (std::int32_t& node : piece.cells.connectivity) node += static_cast<std::int32_t>(points);
    }
    grid.faces.append(std::move(piece.faces), cells, piece.types.size(), points);
    grid.append(std::move(piece.cells));
    move_behind(grid.types, piece.types);
}

void join_pieces(RawGrid& grid, const std::string& path) {
    const std::size_t points = grid.point_count();
    if (grid.piece_points.size() < 2) return;
    std::size_t shared = 0, apart = 0, differing = 0;
    const auto note = [&](Note::Kind kind, std::size_t count, const char* before, const char* text) {
        if (count != 0)
            grid.notes.push_back({kind, before + std::to_string(count) + text, path, kind != Note::Kind::converted});
    };
    const auto bits_at = [&](std::size_t i) { return base::bits_of_point(&grid.points[3 * i]); };
    const std::vector<double>* const ids = global_ids_of(grid);
    std::vector<std::int32_t> first;
    if (ids == nullptr) {
        first = first_of_each<base::PointBits, base::HashOfBits>(points, bits_at);
        // Nodes of one piece at one place are as their writer wants them.
        for (std::size_t piece = 0; piece < grid.piece_points.size(); ++piece) {
            const std::size_t begin = grid.piece_points[piece],
                              end = piece + 1 < grid.piece_points.size() ? grid.piece_points[piece + 1] : points;
            for (std::size_t i = begin; i < end; ++i) shared += static_cast<std::size_t>(first[i]) < begin ? 1 : 0;
        }
        return note(Note::Kind::guessed, shared, "",
                    " nodes stand where another piece has one, and are kept apart: the file gives no GlobalNodeId, by "
                    "which pieces could be joined; check --fix joins them");
    }
    first = first_of_each<double>(points, [&](std::size_t i) { return (*ids)[i]; });
    for (std::size_t i = 0; i < points; ++i) {
        const auto own = static_cast<std::size_t>(first[i]);
        if (own == i) continue;
        if (bits_at(i) != bits_at(own)) {
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
