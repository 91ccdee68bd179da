#include "mesh/columns.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/base/text.hpp"

namespace barycert::mesh {

std::ptrdiff_t count_characters(std::string_view text) {
    std::ptrdiff_t count = 0;
    for (; !text.empty(); ++count) {
        const std::size_t size = base::first_character(text).size;
        if (size == 0) return -1;
        text.remove_prefix(size);
    }
    return count;
}

ColumnFormat format_of(const Column& column) {
    ColumnFormat format{column.name, column.type()};
    const auto* const texts = std::get_if<std::vector<std::string>>(&column.values);
    if (texts == nullptr) return format;
    std::ptrdiff_t characters = 1;  // of an array of empty texts
    for (const std::string& text : *texts) {
        format.max_bytes = std::max(format.max_bytes, text.size());
        if (characters >= 0) {
            const std::ptrdiff_t n = count_characters(text);
            characters = n < 0 ? n : std::max(characters, n);
        }
    }
    format.max_characters = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, characters));
    return format;
}

void begin_columns(const std::vector<ColumnFormat>& formats, std::vector<Column>& columns) {
    columns.resize(formats.size());
    for (std::size_t k = 0; k < formats.size(); ++k) {
        if (columns[k].type() != formats[k].type) columns[k] = empty_column(formats[k]);
        columns[k].name = formats[k].name;
        std::visit([](auto& values) { values.clear(); }, columns[k].values);
    }
}

void move_values(Column& from, std::size_t first, std::size_t count, Column& to) {
    std::visit(
        [&](auto& values) {
            auto& more = std::get<std::remove_reference_t<decltype(values)>>(to.values);
            const auto begin = std::make_move_iterator(values.begin() + static_cast<std::ptrdiff_t>(first));
            more.insert(more.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        },
        from.values);
}

namespace {

/// A column of the same name and type; fill(values, new_values).
template <class Fill>
Column filled(const Column& column, const Fill& fill) {
    return std::visit(
        [&]<class Values>(const Values& values) {
            Values made;
            fill(values, made);
            return Column{column.name, std::move(made)};
        },
        column.values);
}

}  // namespace

Column repeated(const Column& column, std::span<const std::size_t> begin) {
    return filled(column, [&](const auto& values, auto& all) {
        if (!begin.empty()) all.reserve(begin.back());
        for (std::size_t i = 0; i + 1 < begin.size(); ++i) all.insert(all.end(), begin[i + 1] - begin[i], values[i]);
    });
}

Column labels_at(const Column& labels, std::span<const Mesh::Index> cells) {
    return filled(labels, [&]<class Value>(const std::vector<Value>& values, std::vector<Value>& all) {
        Value outside{};
        if constexpr (std::is_same_v<Value, std::int64_t>) outside = no_label;
        if constexpr (std::is_same_v<Value, double>) outside = std::numeric_limits<double>::quiet_NaN();
        all.reserve(cells.size());
        for (const Mesh::Index cell : cells) all.push_back(cell < 0 ? outside : values[static_cast<std::size_t>(cell)]);
    });
}

}  // namespace barycert::mesh
