// The header of an NPY file: a dictionary as Python writes it.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "core/base/text.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/npy/npy.hpp"
#include "io/paths.hpp"

namespace barycert::io {

bool append_utf8(std::string& text, std::uint32_t code) {
    if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
    // The first code that takes two, three and four bytes; what marks the first of so many.
    constexpr std::array<std::uint32_t, 3> longer{0x80, 0x800, 0x10000};
    constexpr std::array<std::uint32_t, 4> marks{0, 0xC0, 0xE0, 0xF0};
    auto more = static_cast<std::size_t>(std::upper_bound(longer.begin(), longer.end(), code) - longer.begin());
    text += static_cast<char>(marks[more] | code >> 6 * more);
    while (more-- != 0) text += static_cast<char>(0x80U | (code >> 6 * more & 0x3FU));
    return true;
}

std::optional<NpyType> npy_type(std::string_view descr) {
    constexpr std::size_t longest = std::size_t{1} << 30;
    NpyType type{.text = std::string(descr)};
    if (descr.size() < 3 || std::string_view("<>|").find(descr.front()) == std::string_view::npos) return std::nullopt;
    const bool big = descr.front() == '>';
    const char kind = descr[1];
    descr.remove_prefix(2);
    const auto [end, error] = std::from_chars(descr.data(), descr.data() + descr.size(), type.size);
    if (error != std::errc{} || kind == 'O' || type.size > longest) return std::nullopt;
    const std::string_view unit = descr.substr(static_cast<std::size_t>(end - descr.data()));  // <M8[ns]
    const bool time = kind == 'M' || kind == 'm';
    if (!unit.empty() && !(time && unit.starts_with('[') && unit.ends_with(']'))) return std::nullopt;
    type.swapped = big == (std::endian::native == std::endian::little);
    const std::size_t least = kind == 'f' ? 2 : 1, most = kind == 'b' ? 1 : 8;
    const bool fits = std::has_single_bit(type.size) && type.size >= least && type.size <= most;
    if (((kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b') && fits) || kind == 'S' || kind == 'U')
        type.kind = kind;
    constexpr std::string_view known = "fiubSUVcMm";
    if (known.find(kind) == std::string_view::npos) return std::nullopt;
    if (kind == 'U') type.size *= 4;
    return type;
}

namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";

/// A Python literal of those that stand in such a header.
struct Literal {
    char kind = '\0';  ///< ( [ { for what holds others, ' for a text, T or F, 0 for a number
    std::string text{};
    std::uint64_t number = 0;
    std::vector<Literal> items{};
};

void skip_blanks(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\n"), rest.size()));
}

bool accept(std::string_view& rest, char c) {
    skip_blanks(rest);
    if (!rest.starts_with(c)) return false;
    rest.remove_prefix(1);
    return true;
}

/// One of those that Python writes: \\ \' \" \n \r \t, and \xHH, \uHHHH, \UHHHHHHHH.
bool take_escape(std::string_view& rest, std::string& value) {
    if (rest.size() < 2) return false;
    const char c = rest[1];
    rest.remove_prefix(2);
    constexpr std::string_view plain = "\\'\"nrt", means = "\\'\"\n\r\t";
    if (const std::size_t at = plain.find(c); at != std::string_view::npos) {
        value += means[at];
        return true;
    }
    const std::size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 8 : 0;
    if (digits == 0 || rest.size() < digits) return false;
    const std::optional<std::uint32_t> code = whole_number<std::uint32_t, 16>(rest.substr(0, digits));
    rest.remove_prefix(digits);
    return code && append_utf8(value, *code);
}

/// Takes a literal off the text. Python 2 wrote numbers as 5L.
bool take_literal(std::string_view& rest, Literal& out, int depth = 0) {
    constexpr int most_depth = 64;
    skip_blanks(rest);
    if (rest.empty() || depth > most_depth) return false;
    const char c = rest.front();
    out.kind = c == '"' ? '\'' : c;
    if (out.kind == '\'') {
        rest.remove_prefix(1);
        while (!rest.empty() && rest.front() != c) {
            if (rest.front() == '\\') {
                if (!take_escape(rest, out.text)) return false;
                continue;
            }
            out.text += rest.front();
            rest.remove_prefix(1);
        }
        return accept(rest, c);
    }
    if (c == '(' || c == '[') {
        const char close = c == '(' ? ')' : ']';
        rest.remove_prefix(1);
        while (!accept(rest, close)) {
            if (!out.items.empty() && !accept(rest, ',')) return false;
            if (!out.items.empty() && accept(rest, close)) return true;
            if (!take_literal(rest, out.items.emplace_back(), depth + 1)) return false;
        }
        return true;
    }
    for (const std::string_view word : {"True", "False"}) {
        if (!rest.starts_with(word)) continue;
        rest.remove_prefix(word.size());
        return true;
    }
    out.kind = '0';
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), out.number);
    if (error != std::errc{}) return false;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (rest.starts_with('L')) rest.remove_prefix(1);
    return true;
}

/// Whether the list at the beginning has its end, whatever is in it.
bool list_ends(std::string_view text) {
    int depth = 0;
    char quote = '\0';
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != '\0' && c == '\\') {
            ++i;
        } else if (quote == '\0' && (c == '\'' || c == '"')) {
            quote = c;
        } else if (quote == c) {
            quote = '\0';
        } else if (quote == '\0' && (c == '[' || c == ']')) {
            depth += c == '[' ? 1 : -1;
            if (depth == 0) return true;
        }
    }
    return false;
}

/// (5, 3) or (5,) or ().
bool is_tuple(const Literal& literal) {
    return literal.kind == '(' && std::ranges::count(literal.items, '0', &Literal::kind) == std::ssize(literal.items);
}

[[noreturn]] void not_npy(ErrorCode code, const std::string& file, std::string expected, std::string found,
                          std::string remedy = "save the array again with numpy.save") {
    refuse_file(code, file, "cannot read the header of the NPY file", std::move(expected), std::move(found),
                std::move(remedy));
}

/// Values of a field at most that become columns, and structures within structures.
constexpr std::uint64_t most_values = 1024;
constexpr int deepest = 16;

/// `array`: the field is one of `count` values.
void add_field(const std::string& name, NpyType type, std::uint64_t at, bool array, std::uint64_t count,
               std::vector<NpyColumn>& columns) {
    if (array && count != 0 && count <= most_values) {
        for (std::uint64_t i = 0; i < count; ++i)
            columns.push_back({name + "." + std::to_string(i), type, at + i * type.size, 0});
        return;
    }
    if (array) type.kind = 'V';
    columns.push_back({name, std::move(type), at, 0});
}

/// Fields of a structured type, (name, type) or (name, type, shape), name or (title, name); and the bytes of an item.
bool take_fields(const Literal& list, std::vector<NpyColumn>& columns, std::uint64_t& size, int depth) {
    if (list.kind != '[' || depth > deepest) return false;
    size = 0;
    for (const Literal& field : list.items) {
        const std::vector<Literal>& parts = field.items;
        if (field.kind != '(' || parts.size() < 2 || parts.size() > 3) return false;
        const bool titled = parts[0].kind == '(' && parts[0].items.size() == 2 && parts[0].items[0].kind == '\'';
        const Literal& name = titled ? parts[0].items[1] : parts[0];
        if (name.kind != '\'' || (parts.size() == 3 && !is_tuple(parts[2]))) return false;
        NpyType type;
        std::uint64_t item = 0, count = 1, whole = 0, after = 0;
        if (parts[1].kind == '\'') {
            const auto known = npy_type(parts[1].text);
            if (!known) return false;
            type = *known;
            item = type.size;
        } else if (!take_fields(parts[1], columns, item, depth + 1)) {
            return false;
        }
        const bool array = parts.size() == 3 && !parts[2].items.empty();
        for (std::size_t i = 0; array && i < parts[2].items.size(); ++i) {
            if (__builtin_mul_overflow(count, parts[2].items[i].number, &count)) return false;
        }
        if (__builtin_mul_overflow(count, item, &whole) || __builtin_add_overflow(size, whole, &after)) return false;
        if (depth == 0 && !name.text.empty()) add_field(name.text, std::move(type), size, array, count, columns);
        size = after;
        if (columns.size() > most_npy_columns) return false;
    }
    return true;
}

/// From the text of the header, in Latin-1 or UTF-8: a Python dictionary of descr, fortran_order and shape.
NpyHeader parse_npy_text(std::string_view text, bool latin1, const std::string& file) {
    std::string utf8;
    for (const char byte : text) append_utf8(utf8, static_cast<unsigned char>(byte));
    NpyHeader header;
    std::string_view rest = latin1 ? utf8 : text;
    unsigned seen = 0;  // a bit for each of the three entries
    bool good = accept(rest, '{');
    while (good && !accept(rest, '}')) {
        Literal key, value;
        good = take_literal(rest, key) && key.kind == '\'' && accept(rest, ':');
        skip_blanks(rest);
        const std::string_view from = rest;
        const bool whole = good && take_literal(rest, value);
        if (key.text == "descr" && value.kind == '[' && (whole || list_ends(from))) {
            header.structured = true;
            if (!whole || !take_fields(value, header.fields, header.item_size, 0) || header.item_size == 0 ||
                header.item_size > longest_npy_text << 10)
                refuse_file("column.type", file, "cannot read a structured array of that type",
                            "a list of names and types of known size, and no Python objects",
                            base::quoted(from.substr(0, from.size() - rest.size())),
                            "save the fields that are needed: a[['x', 'y']]");
        }
        unsigned bit = 0;
        if (key.text == "descr" && (value.kind == '[' || value.kind == '\'')) bit = 1;
        if (key.text == "fortran_order" && (value.kind == 'T' || value.kind == 'F')) bit = 2;
        if (key.text == "shape" && is_tuple(value)) bit = 4;
        good = whole && bit != 0 && (seen & bit) == 0;
        seen |= bit;
        if (bit == 1) header.descr = value.text;
        if (bit == 2) header.fortran_order = value.kind == 'T';
        for (std::size_t i = 0; bit == 4 && i < value.items.size(); ++i) header.shape.push_back(value.items[i].number);
        if (good && !accept(rest, ',')) {
            good = accept(rest, '}');
            break;
        }
    }
    skip_blanks(rest);
    if (good && seen == 7 && rest.empty()) return header;
    not_npy("file.syntax", file, "a dictionary of descr, fortran_order and shape", base::quoted(text));
}

}  // namespace

NpyHeader read_npy_header(const base::InputFile& file, const std::string& path) {
    // 6 bytes of magic, 2 of version, then the length of the text in 2 or 4.
    std::string head(12, '\0');
    head.resize(file.read_at(0, head, path).value());
    if (head.starts_with("PK\x03\x04"))
        not_npy("file.format", path, "one array", "a ZIP archive, as numpy.savez writes it",
                "save the one array of points with numpy.save");
    if (!head.starts_with(npy_magic))
        not_npy("file.format", path, "a file that begins with \\x93NUMPY",
                head.empty() ? "nothing" : base::quoted(head.substr(0, npy_magic.size())));
    const auto need = [&](std::size_t size) {
        if (head.size() < size) not_npy("file.truncated", path, "a whole header", "the end of the file");
    };
    need(10);
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(head[i])); };
    const std::size_t major = byte(6);
    if (major < 1 || major > 3)
        not_npy("file.version", path, "version 1, 2 or 3",
                "version " + std::to_string(major) + "." + std::to_string(byte(7)));
    const std::size_t offset = major == 1 ? 10 : 12;
    need(offset);
    std::size_t length = 0;
    for (std::size_t i = offset; i-- > 8;) length = length << 8 | byte(i);
    if (length > longest_npy_text)
        not_npy("file.too-large", path, "a header of at most " + std::to_string(longest_npy_text) + " bytes",
                std::to_string(length));
    const std::size_t size = offset + length;
    if (size > file.size())
        refuse_file("file.truncated", path, "the file ends too early", "a header of " + std::to_string(size) + " bytes",
                    std::to_string(file.size()), "the file may be cut short: write it again");
    std::string text(length, '\0');
    text.resize(file.read_at(offset, text, path).value());
    NpyHeader header = parse_npy_text(text, major != 3, path);
    header.size = size;
    return header;
}

std::string as_tuple(const std::vector<std::uint64_t>& shape) {
    const auto number = [](std::uint64_t n) { return std::to_string(n); };
    return "(" + base::joined(shape, ", ", number) + (shape.size() == 1 ? ",)" : ")");
}

std::string npy_header_of(const std::string& descr, const std::vector<std::uint64_t>& shape, std::size_t size) {
    std::string text = "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + as_tuple(shape) + ", }";
    const auto aligned = [&](std::size_t before) { return (before + text.size() + 1 + 63) / 64 * 64; };
    // Version 1 has 2 bytes for the length of the text and is in Latin-1, version 2 has 4, version 3 is in UTF-8.
    const bool ascii = std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) > 127; });
    const char version = !ascii ? 3 : std::max(size, aligned(12)) > UINT16_MAX ? 2 : 1;
    const std::size_t before = version == 1 ? 10 : 12;
    if (size == 0) size = aligned(before);
    text.resize(size - before - 1, ' ');
    text += '\n';
    std::string head(npy_magic);
    head += {version, '\0'};
    for (std::size_t i = 8; i < before; ++i) head += static_cast<char>(text.size() >> 8 * (i - 8) & 0xFFU);
    return head + text;
}

}  // namespace barycert::io
