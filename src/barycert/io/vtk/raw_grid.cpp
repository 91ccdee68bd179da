#include "barycert/io/vtk/raw_grid.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <iterator>
#include <utility>
#include <variant>

#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {

Error number_error(const std::string& path, std::size_t line, const std::string& what, std::uint64_t count,
                   const NumberFault& fault) {
    Error error{.what = what, .file = path, .line = line};
    const std::string number = "number " + std::to_string(fault.index) + " (from 0)";
    switch (fault.kind) {
        case NumberFault::Kind::too_few:
            error.expected = std::to_string(count) + " numbers";
            error.found = std::to_string(fault.index);
            error.remedy = "write the file again: it may be cut off";
            break;
        case NumberFault::Kind::no_number:
            error.what = number + " of " + what;
            error.expected = "a number of the type of the array";
            error.found = in_quotes(fault.text);
            break;
        default:
            error.what = number + " of " + what;
            error.expected = "a number that fits what it stands for";
            error.found = fault.text;
    }
    return error;
}

std::string inexact(const NumberFault& fault) {
    return "it holds " + fault.text + ", which is not exactly a double";
}

std::size_t first_wrong_node(const std::vector<std::int32_t>& nodes, std::size_t from, std::size_t count) {
    std::atomic<bool> wrong{false};
    in_parts(nodes.size() - from, std::size_t{1} << 18, [&](std::size_t first, std::size_t last) {
        // The sign of any of these numbers: below 0, or at `count` or above.
        std::uint32_t signs = 0;
        for (std::size_t i = from + first; i < from + last; ++i) {
            const auto node = static_cast<std::uint32_t>(nodes[i]);
            signs |= node | (static_cast<std::uint32_t>(count) - 1 - node);
        }
        if (signs >> 31U != 0) wrong = true;
    });
    if (!wrong) return nodes.size();
    std::size_t i = from;
    while (i < nodes.size() && static_cast<std::uint32_t>(nodes[i]) < count) ++i;
    return i;
}

namespace {

constexpr const char* missing = "it is missing in a piece of the file";

template <class T>
void move_behind(std::vector<T>& to, std::vector<T>& from) {
    if (to.empty()) {
        to = std::move(from);
    } else {
        make_room(to, from.size());
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    }
}

/// Numbers that a field holds exactly, as the labels that another piece has.
void make_labels(RawArray& array) {
    std::vector<std::int64_t> numbers;
    numbers.reserve(array.field.data.size());
    for (const double x : array.field.data) numbers.push_back(static_cast<std::int64_t>(x));
    array.labels = std::move(numbers);
    array.has_labels = true;
    array.field.data = {};
}

/// Whether both became of one kind.
bool agree(RawArray& a, RawArray& b) {
    if (a.field.components != b.field.components) return false;
    if (a.has_labels != b.has_labels) {
        RawArray& plain = a.has_labels ? b : a;
        RawArray& labelled = a.has_labels ? a : b;
        // Those of uint64 that are no int64 were refused as labels, and may be among the plain ones.
        if (!plain.is_integer || !std::holds_alternative<std::vector<std::int64_t>>(labelled.labels)) return false;
        for (const double x : plain.field.data) {
            if (!(x >= -0x1p63 && x < 0x1p63)) return false;
        }
        make_labels(plain);
    }
    return !a.has_labels || a.labels.index() == b.labels.index();
}

void append_array(RawArray& to, RawArray& from) {
    to.is_narrow = to.is_narrow || from.is_narrow;
    if (to.fault.empty()) to.fault = from.fault;
    if (to.fault.empty() && !agree(to, from)) to.fault = "its type differs between pieces of the file";
    if (!to.fault.empty()) {
        to.field.data = {};
        to.labels = {};
    } else if (to.has_labels) {
        std::visit([&](auto& values) { move_behind(values, std::get<std::decay_t<decltype(values)>>(from.labels)); },
                   to.labels);
    } else {
        to.is_integer = to.is_integer && from.is_integer;
        to.is_whole = to.is_whole && from.is_whole;
        move_behind(to.field.data, from.field.data);
    }
}

/// `before`: rows that there are.
void append_arrays(std::vector<RawArray>& to, std::vector<RawArray>& from, std::size_t before) {
    const auto named = [](std::vector<RawArray>& arrays, const std::string& name) -> RawArray* {
        for (RawArray& array : arrays) {
            if (array.field.name == name) return &array;
        }
        return nullptr;
    };
    for (RawArray& array : to) {
        if (array.fault.empty() && named(from, array.field.name) == nullptr) array.fault = missing;
    }
    for (RawArray& array : from) {
        if (RawArray* const known = named(to, array.field.name); known != nullptr) {
            append_array(*known, array);
        } else {
            if (before != 0 && array.fault.empty()) array.fault = missing;
            to.push_back(std::move(array));
        }
    }
}

}  // namespace

void make_field_of_doubles(RawArray& array) {
    const auto* const numbers = std::get_if<std::vector<std::int64_t>>(&array.labels);
    if (!array.has_labels || numbers == nullptr) return;
    const auto is_double = [](std::int64_t n) {
        const auto x = static_cast<double>(n);
        return x < 0x1p63 && static_cast<std::int64_t>(x) == n;
    };
    if (!std::all_of(numbers->begin(), numbers->end(), is_double)) return;
    array.field.data.assign(numbers->begin(), numbers->end());
    array.labels = {};
    array.has_labels = false;
}

Status append_piece(RawGrid& grid, RawGrid piece, const std::string& path) {
    const std::size_t points = grid.point_count(), cells = grid.types.size(), nodes = grid.connectivity.size();
    if (points + piece.point_count() > max_entities || cells + piece.types.size() > max_entities) {
        return Error{.what = "more points or cells than a mesh can have",
                     .file = path,
                     .line = 0,
                     .expected = "at most " + std::to_string(max_entities) + " in all pieces",
                     .found = {}};
    }
    grid.narrow_points = grid.narrow_points || piece.narrow_points;
    grid.has_steps = grid.has_steps || piece.has_steps;
    grid.checked_nodes = (cells == 0 || grid.checked_nodes) && piece.checked_nodes;
    move_behind(grid.notes, piece.notes);
    for (std::string& name : piece.loose_arrays) {
        if (std::find(grid.loose_arrays.begin(), grid.loose_arrays.end(), name) == grid.loose_arrays.end())
            grid.loose_arrays.push_back(std::move(name));
    }
    for (std::string& name : piece.unread_arrays) {
        if (std::find(grid.unread_arrays.begin(), grid.unread_arrays.end(), name) == grid.unread_arrays.end())
            grid.unread_arrays.push_back(std::move(name));
    }
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
    if (!piece.types.empty()) {
        append_arrays(grid.cell_arrays, piece.cell_arrays, cells);
        if (points != 0) {
            for (std::int32_t& node : piece.connectivity) node += static_cast<std::int32_t>(points);
        }
        if (nodes != 0) {
            for (std::int64_t& end : piece.ends) end += static_cast<std::int64_t>(nodes);
        }
        move_behind(grid.connectivity, piece.connectivity);
        move_behind(grid.ends, piece.ends);
        move_behind(grid.types, piece.types);
    }
    return Done{};
}

}  // namespace barycert::io
