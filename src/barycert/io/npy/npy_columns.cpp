#include "barycert/io/npy/npy_columns.hpp"

#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/npy/npy_literals.hpp"
#include "barycert/io/point_columns.hpp"

namespace barycert::io {
namespace {

/// Values of a field at most that become columns, and structures within structures.
constexpr std::uint64_t most_values = 1024;
constexpr int deepest = 16;

Error failure(const std::string& file, std::string what, std::string expected, std::string found, std::string remedy) {
    return {.what = std::move(what),
            .file = file,
            .line = 0,
            .expected = std::move(expected),
            .found = std::move(found),
            .remedy = std::move(remedy)};
}

/// The list of fields of a structured type.
class Fields {
public:
    Fields(std::string_view text, std::vector<NpyColumn>& columns) : literals_(text), columns_(columns) {}

    /// False if it is none, or the size of an item is not known.
    bool parse(std::uint64_t& size) { return list(size, 0) && literals_.at_end(); }

private:
    bool list(std::uint64_t& size, int depth) {
        if (depth > deepest || !literals_.accept('[')) return false;
        size = 0;
        for (bool first = true; !literals_.accept(']'); first = false) {
            if (!first && !literals_.accept(',')) return false;
            if (!first && literals_.accept(']')) return true;
            if (!field(size, depth)) return false;
        }
        return true;
    }

    /// (name, type) or (name, type, shape); the name may be (title, name). `size`: of the fields before; and then this.
    bool field(std::uint64_t& size, int depth) {
        std::string name, simple;
        if (!literals_.accept('(') || !field_name(name) || !literals_.accept(',')) return false;
        NpyType type;
        std::uint64_t item = 0;
        if (literals_.string(simple)) {
            const auto known = npy_type(simple);
            if (!known) return false;
            type = *known;
            item = type.size;
        } else if (!list(item, depth + 1)) {
            return false;
        }
        std::vector<std::uint64_t> shape;
        std::uint64_t count = 1;
        if (literals_.accept(',')) {
            if (!literals_.accept(')') && !(literals_.tuple(shape) && literals_.accept(')'))) return false;
        } else if (!literals_.accept(')')) {
            return false;
        }
        for (const std::uint64_t n : shape) {
            if (__builtin_mul_overflow(count, n, &count)) return false;
        }
        std::uint64_t whole = 0, after = 0;
        if (__builtin_mul_overflow(count, item, &whole) || __builtin_add_overflow(size, whole, &after)) return false;
        if (depth == 0 && !name.empty()) add(name, type, size, !shape.empty(), count);
        size = after;
        return columns_.size() <= most_npy_columns;
    }

    bool field_name(std::string& name) {
        if (literals_.string(name)) return true;
        std::string title;
        return literals_.accept('(') && literals_.string(title) && literals_.accept(',') && literals_.string(name) &&
               literals_.accept(')');
    }

    /// `array`: the field is one of `count` values.
    void add(const std::string& name, NpyType type, std::uint64_t at, bool array, std::uint64_t count) {
        if (array && count != 0 && count <= most_values) {
            for (std::uint64_t i = 0; i < count; ++i)
                columns_.push_back({name + "." + std::to_string(i), type, at + i * type.size, 0});
            return;
        }
        if (array) type.kind = 'V';
        columns_.push_back({name, std::move(type), at, 0});
    }

    Literals literals_;
    std::vector<NpyColumn>& columns_;
};

/// The columns and the bytes of a row of an array without fields.
Status simple_table(const NpyHeader& header, const std::string& file, NpyTable& table) {
    const auto type = npy_type(header.descr);
    if (!type || type->size == 0)
        return failure(file, "cannot read an array of that type", "integers, floating-point numbers or texts",
                       base::quoted(header.descr), "save a.astype('f8')");
    const std::uint64_t columns = header.shape.size() == 2 ? header.shape[1] : 1;
    if (columns > most_npy_columns)
        return failure(file, "an array of another shape", "at most " + std::to_string(most_npy_columns) + " columns",
                       as_tuple(header.shape), "save an array with a row for each point");
    table.row_size = columns * type->size;
    table.by_columns = header.fortran_order && columns > 1;
    for (std::uint64_t c = 0; c < columns; ++c) {
        const std::uint64_t first = (table.by_columns ? table.rows : 1) * c * type->size;
        table.columns.push_back({column_number(c), *type, first, table.by_columns ? type->size : table.row_size});
    }
    return Done{};
}

}  // namespace

std::string as_tuple(const std::vector<std::uint64_t>& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i != 0 ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

Result<NpyTable> npy_table(const NpyHeader& header, const std::string& file) {
    NpyTable table{.rows = 0, .columns = {}, .structured = header.structured};
    const std::size_t axes = header.shape.size();
    if (axes == 0 || axes > (header.structured ? 1U : 2U))
        return failure(file, "an array of another shape", header.structured ? "(n,)" : "(n, columns)",
                       as_tuple(header.shape), "save an array with a row for each point");
    table.rows = header.shape[0];
    if (header.structured) {
        std::uint64_t size = 0;
        if (!Fields(header.descr, table.columns).parse(size) || size == 0 || size > longest_npy_text << 10)
            return failure(file, "cannot read a structured array of that type",
                           "a list of names and types of known size, and no Python objects", base::quoted(header.descr),
                           "save the fields that are needed: a[['x', 'y']]");
        table.row_size = size;
        for (NpyColumn& column : table.columns) column.step = size;
    } else if (Status simple = simple_table(header, file, table); !simple) {
        return simple.error();
    }
    return table;
}

Status check_npy_room(const NpyTable& table, std::uint64_t room, const std::string& file) {
    const std::uint64_t row = table.row_size;
    const std::string rows = std::to_string(table.rows);
    if (row != 0 && table.rows > room / row)
        return failure(file, "the file ends too early",
                       rows + " rows of " + std::to_string(row) + " bytes, as its header tells",
                       std::to_string(room) + " bytes", "the file may be cut short: write it again");
    if (table.rows * row != room)
        return failure(file, "bytes after the array", std::to_string(table.rows * row) + ", as the header tells",
                       std::to_string(room), "save one array a file");
    return Done{};
}

}  // namespace barycert::io
