/// Columns that are carried through as they are: regions, names of materials, ids and times of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace barycert {

struct Column {
    enum class Type : std::uint8_t { integer, number, text };  ///< in the order of the alternatives of `values`
    using Values = std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

    std::string name;
    Values values;  ///< one an entity

    Type type() const { return static_cast<Type>(values.index()); }
    std::size_t size() const {
        return std::visit([](const auto& all) { return all.size(); }, values);
    }
};

/// A column without its values.
struct ColumnFormat {
    std::string name;
    Column::Type type = Column::Type::integer;
    /// Of text: the longest that may come, in bytes; and in characters, if all are UTF-8, else 0. NPY files need them.
    std::size_t max_bytes = 0, max_characters = 0;

    friend bool operator==(const ColumnFormat&, const ColumnFormat&) = default;
};

/// An empty column of that format.
inline Column empty_column(const ColumnFormat& format) {
    Column column{format.name, {}};
    if (format.type == Column::Type::number) column.values = std::vector<double>();
    if (format.type == Column::Type::text) column.values = std::vector<std::string>();
    return column;
}

}  // namespace barycert
