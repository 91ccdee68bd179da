/// Columns that are carried through, value by value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// The number of characters of well-formed UTF-8, see base::first_character; -1 for other bytes.
std::ptrdiff_t count_characters(std::string_view text);

/// The format of the column, with the lengths of its longest text.
ColumnFormat format_of(const Column& column);

/// Makes `columns` empty ones of these formats; what memory they have is kept.
void begin_columns(const std::vector<ColumnFormat>& formats, std::vector<Column>& columns);

/// Moves `count` values, from number `first` on, to the end of `to`, of the same type. `from` is not to be read there.
void move_values(Column& from, std::size_t first, std::size_t count, Column& to);

/// Copies of the values, each as often as it has rows: value i has the rows begin[i] to begin[i + 1] - 1.
Column repeated(const Column& column, std::span<const std::size_t> begin);

/// For each cell its value in `labels`, a column of cells. Outside (-1): an empty text, NaN, or `no_label`.
Column labels_at(const Column& labels, std::span<const Mesh::Index> cells);

/// The integer of points outside: the smallest.
inline constexpr std::int64_t no_label = INT64_MIN;

}  // namespace barycert::mesh
