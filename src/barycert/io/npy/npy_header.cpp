#include "barycert/io/npy/npy_header.hpp"

#include <charconv>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/point_columns.hpp"

namespace barycert::io {
namespace {

/// The few Python literals that stand in such a header.
class Literals {
public:
    explicit Literals(std::string_view text) : rest_(text) {}

    bool accept(char c) {
        skip_blanks();
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

    /// A string; escapes stand for what they say.
    bool string(std::string& value) {
        skip_blanks();
        if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return false;
        const char quote = rest_.front();
        rest_.remove_prefix(1);
        value.clear();
        while (!rest_.empty() && rest_.front() != quote) {
            if (rest_.front() != '\\') {
                value += rest_.front();
                rest_.remove_prefix(1);
            } else if (!escape(value)) {
                return false;
            }
        }
        return accept_here(quote);
    }

    /// A list, skipped over with all that stands in it.
    bool list(std::string& text) {
        skip_blanks();
        if (!rest_.starts_with('[')) return false;
        int depth = 0;
        char quote = '\0';
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            const char c = rest_[i];
            if (quote != '\0') {
                if (c == '\\') ++i;
                if (c == quote) quote = '\0';
            } else if (c == '\'' || c == '"') {
                quote = c;
            } else if (c == '[') {
                ++depth;
            } else if (c == ']' && --depth == 0) {
                text = rest_.substr(0, i + 1);
                rest_.remove_prefix(i + 1);
                return true;
            }
        }
        return false;
    }

    bool boolean(bool& value) {
        skip_blanks();
        value = rest_.starts_with("True");
        if (!value && !rest_.starts_with("False")) return false;
        rest_.remove_prefix(value ? 4 : 5);
        return true;
    }

    /// (5, 3) or (5,) or (); Python 2 wrote (5L, 3L).
    bool tuple(std::vector<std::uint64_t>& values) {
        values.clear();
        if (!accept('(')) return false;
        while (!accept(')')) {
            if (!values.empty() && !accept(',')) return false;
            if (accept(')')) return !values.empty();
            skip_blanks();
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
            if (error != std::errc{}) return false;
            rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
            if (rest_.starts_with('L')) rest_.remove_prefix(1);
            values.push_back(value);
        }
        return true;
    }

private:
    bool accept_here(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    /// One of those that Python writes: \\ \' \" \n \r \t, and \xHH, \uHHHH, \UHHHHHHHH.
    bool escape(std::string& value) {
        if (rest_.size() < 2) return false;
        const char c = rest_[1];
        rest_.remove_prefix(2);
        constexpr std::string_view plain = "\\'\"nrt", means = "\\'\"\n\r\t";
        if (const std::size_t at = plain.find(c); at != std::string_view::npos) {
            value += means[at];
            return true;
        }
        const std::size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 8 : 0;
        if (digits == 0 || rest_.size() < digits) return false;
        std::uint32_t code = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + digits, code, 16);
        if (error != std::errc{} || end != rest_.data() + digits) return false;
        rest_.remove_prefix(digits);
        if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
        append_utf8(value, code);
        return true;
    }

    void skip_blanks() {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\n')) {
            rest_.remove_prefix(1);
        }
    }

    std::string_view rest_;
};

Error not_npy(const std::string& file, std::string expected, std::string found, std::string remedy) {
    return file_error(file, "cannot read the header of the NPY file", std::move(expected), std::move(found),
                      std::move(remedy));
}

constexpr const char* save_again = "save the array again with numpy.save";

/// One of the three entries, whichever it is; `seen` has a bit for each.
bool parse_entry(Literals& literals, NpyHeader& header, unsigned& seen) {
    std::string key;
    if (!literals.string(key) || !literals.accept(':')) return false;
    const unsigned bit = key == "descr" ? 1U : key == "fortran_order" ? 2U : key == "shape" ? 4U : 0U;
    if (bit == 0 || (seen & bit) != 0) return false;
    seen |= bit;
    if (bit == 2U) return literals.boolean(header.fortran_order);
    if (bit == 4U) return literals.tuple(header.shape);
    if (literals.string(header.descr)) return true;
    header.structured = true;
    return literals.list(header.descr);
}

/// Values of a field at most that become columns, and structures within structures.
constexpr std::uint64_t most_values = 1024;
constexpr int deepest = 16;

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
        return file_error(file, "cannot read an array of that type", "integers, floating-point numbers or texts",
                          base::quoted(header.descr), "save a.astype('f8')");
    const std::uint64_t columns = header.shape.size() == 2 ? header.shape[1] : 1;
    if (columns > most_npy_columns)
        return file_error(file, "an array of another shape", "at most " + std::to_string(most_npy_columns) + " columns",
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

Result<NpyText> find_npy_text(std::string_view head, const std::string& file) {
    if (head.starts_with("PK\x03\x04")) {
        return not_npy(file, "one array", "a ZIP archive, as numpy.savez writes it",
                       "save the one array of points with numpy.save");
    }
    if (!head.starts_with(npy_magic)) {
        return not_npy(file, "a file that begins with \\x93NUMPY",
                       head.empty() ? "nothing" : base::quoted(head.substr(0, npy_magic.size())), save_again);
    }
    if (head.size() < 10) return not_npy(file, "a whole header", "the end of the file", save_again);
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(head[i])); };
    const std::size_t major = byte(6);
    if (major < 1 || major > 3) {
        return not_npy(file, "version 1, 2 or 3", "version " + std::to_string(major) + "." + std::to_string(byte(7)),
                       save_again);
    }
    NpyText text{.offset = 10, .size = byte(8) | byte(9) << 8, .latin1 = major != 3};
    if (major != 1) {
        if (head.size() < npy_head) return not_npy(file, "a whole header", "the end of the file", save_again);
        text.offset = npy_head;
        text.size |= byte(10) << 16 | byte(11) << 24;
    }
    if (text.size > longest_npy_text) {
        return not_npy(file, "a header of at most " + std::to_string(longest_npy_text) + " bytes",
                       std::to_string(text.size), save_again);
    }
    return text;
}

Result<NpyHeader> parse_npy_text(std::string_view text, bool latin1, const std::string& file) {
    std::string utf8;
    for (const char byte : text) append_utf8(utf8, static_cast<unsigned char>(byte));
    NpyHeader header;
    Literals literals(latin1 ? utf8 : text);
    unsigned seen = 0;
    bool good = literals.accept('{');
    while (good && !literals.accept('}')) {
        good = parse_entry(literals, header, seen);
        if (good && !literals.accept(',')) {
            good = literals.accept('}');
            break;
        }
    }
    if (good && seen == 7U && literals.at_end()) return header;
    return not_npy(file, "a dictionary of descr, fortran_order and shape", base::quoted(text), save_again);
}

std::string as_tuple(const std::vector<std::uint64_t>& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i != 0 ? ", " : "") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

Result<NpyTable> npy_table(const NpyHeader& header, const std::string& file) {
    NpyTable table{.rows = 0, .columns = {}, .structured = header.structured};
    const std::size_t axes = header.shape.size();
    if (axes == 0 || axes > (header.structured ? 1U : 2U))
        return file_error(file, "an array of another shape", header.structured ? "(n,)" : "(n, columns)",
                          as_tuple(header.shape), "save an array with a row for each point");
    table.rows = header.shape[0];
    if (header.structured) {
        std::uint64_t size = 0;
        if (!Fields(header.descr, table.columns).parse(size) || size == 0 || size > longest_npy_text << 10)
            return file_error(file, "cannot read a structured array of that type",
                              "a list of names and types of known size, and no Python objects",
                              base::quoted(header.descr), "save the fields that are needed: a[['x', 'y']]");
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
        return file_error(file, "the file ends too early",
                          rows + " rows of " + std::to_string(row) + " bytes, as its header tells",
                          std::to_string(room) + " bytes", "the file may be cut short: write it again");
    if (table.rows * row != room)
        return file_error(file, "bytes after the array", std::to_string(table.rows * row) + ", as the header tells",
                          std::to_string(room), "save one array a file");
    return Done{};
}

}  // namespace barycert::io
