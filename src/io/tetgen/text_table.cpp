#include "io/tetgen/text_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "core/base/workers.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/other_formats.hpp"
#include "io/parallel.hpp"
#include "io/paths.hpp"
#include "io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

/// Whole lines of a table, from byte `start` to `stop` - 1 of the file, and the rows that should stand in them.
struct LinesOfTable {
    const TextTable* table;
    std::size_t start;
    std::size_t stop;
    std::size_t first_row;
    std::size_t last_row;
};

/// Large enough that the start of a block costs nothing, small enough to stay in the second cache.
constexpr std::size_t block_size = std::size_t{1} << 19;

/// Bytes `from` to `to` - 1 of the file, in memory that is used again, as those of a MappedFile: a scanner may look
/// ahead.
std::string_view some_bytes(const TextTable& table, std::size_t from, std::size_t to, ByteRoom& room) {
    if (table.is_whole) return table.bytes.substr(from, to - from);
    constexpr std::size_t ahead = 128;
    const std::size_t size = to - from;
    char* const bytes = room.of(size + ahead);
    const std::size_t got = table.input.read_at(from, {bytes, size}, table.file).value();
    std::fill(bytes + got, bytes + size + ahead, '\0');
    return {bytes, size};
}

/// Behind the first line end at byte `from` or later.
std::size_t behind_line(const TextTable& table, std::size_t from, ByteRoom& room) {
    constexpr std::size_t step = std::size_t{1} << 12;
    const std::size_t size = table.input.size();
    while (from < size) {
        const std::string_view some = some_bytes(table, from, std::min(size, from + step), room);
        if (const std::size_t feed = some.find('\n'); feed != std::string_view::npos) return from + feed + 1;
        from += some.size();
    }
    return size;
}

/// The number of the first row in these lines, by its id, which may be wrong; `none` if there is no row, nothing if the
/// id is no number, or cannot be one of a row.
std::optional<std::size_t> first_row_in(const TextTable& table, std::size_t start, std::size_t stop, ByteRoom& room,
                                        std::size_t none) {
    constexpr std::size_t enough = std::size_t{1} << 12, longest = 64;
    for (std::size_t size = std::min(enough, stop - start);; size = stop - start) {
        const std::string_view some = some_bytes(table, start, start + size, room);
        const bool all = size == stop - start;
        Scanner first{some.data(), some.data() + size};
        if (!first.next_row(first.end - (all ? 0 : longest))) {
            if (all) return none;
            continue;
        }
        std::int64_t id = 0;
        if (!first.integer(id) || id < table.base || id - table.base > max_count) return std::nullopt;
        return static_cast<std::size_t>(id - table.base);
    }
}

/// Cuts the body at line ends; looks at the first id of each block. False if the ids cannot belong to a good file.
bool append_blocks(const TextTable& table, std::vector<LinesOfTable>& blocks) {
    const std::size_t begin = blocks.size();
    ByteRoom room;
    const std::size_t size = table.input.size();
    for (std::size_t at = table.body; at < size;) {
        const std::size_t next = behind_line(table, std::min(size, at + block_size), room);
        // Where there are but comments, they can only follow the last row, or a check fails.
        const bool first = blocks.size() == begin;
        const std::optional<std::size_t> row = first_row_in(table, at, next, room, first ? 0 : table.rows);
        if (!row || *row > table.rows) return false;
        if (first ? *row != 0 : *row < blocks.back().first_row) return false;
        if (!first) blocks.back().last_row = *row;
        blocks.push_back({&table, at, next, *row, table.rows});
        at = next;
    }
    return blocks.size() != begin || table.rows == 0;
}

/// The commonest row of all: an id and the corners of a linear cell. False: nothing is known, nothing has moved.
template <std::size_t Corners>
bool parse_plain_cell(const TextTable& table, Scanner& scanner, std::size_t row) {
    std::array<std::uint32_t, Corners + 1> values{};
    const char* const after = scan_plain_row(scanner.at, values);
    const auto base = static_cast<std::uint32_t>(table.base);
    if (after == nullptr || values[0] != row + base) return false;
    Mesh::Index* const to = table.columns[1].indices->data() + row * Corners;
    bool good = true;
    for (std::size_t i = 0; i < Corners; ++i) {
        const std::uint32_t index = values[i + 1] - base;
        good = good && index < static_cast<std::uint64_t>(table.columns[1].limit);
        to[i] = static_cast<Mesh::Index>(index);
    }
    if (good) scanner.at = after;
    return good;
}

/// The corners of a row that is nothing but an id and these; else 0.
std::size_t plain_corners(const TextTable& table) {
    const std::size_t count = table.column_count();
    if (count < 4 || table.columns[1].kind != ColumnKind::index || table.columns[1].indices == nullptr) return 0;
    return table.columns[1].count == count - 1 && table.columns[1].step == count - 1 ? count - 1 : 0;
}

/// Moves from the first field of the row over its end, and puts values where they belong. False: it is a bad row.
bool parse_row(const TextTable& table, Scanner& scanner, std::size_t row) {
    for (const Columns& c : table.columns) {
        for (std::size_t k = 0; k < c.count; ++k) {
            if (c.kind != ColumnKind::id && !scanner.separator()) return false;
            if (c.kind == ColumnKind::real) {
                double value = 0;
                if (!scanner.real(value) && !(table.any_real && scanner.nonfinite(value))) return false;
                if (c.fields != nullptr) (*c.fields)[k].data[row] = value;
                if (c.reals != nullptr) (*c.reals)[row * c.step + k] = value;
                continue;
            }
            std::int64_t value = 0;
            if (!scanner.integer(value)) return false;
            if (c.kind == ColumnKind::integer) {
                if (c.integers != nullptr) (*c.integers)[row * c.step + k] = value;
                continue;
            }
            const bool none = c.kind == ColumnKind::neighbour && value == -1;
            value -= none ? 0 : table.base;
            if (c.kind == ColumnKind::id) {
                if (value != static_cast<std::int64_t>(row)) return false;
                continue;
            }
            if (!none && static_cast<std::uint64_t>(value) >= static_cast<std::uint64_t>(c.limit)) return false;
            if (c.indices == nullptr) continue;
            Mesh::Index& to =
                k < c.step ? (*c.indices)[row * c.step + k] : (*c.more_indices)[row * (c.count - c.step) + k - c.step];
            to = static_cast<Mesh::Index>(value);
        }
    }
    return scanner.end_row();
}

/// Parses the rows [row, last) that stand before `stop`. On failure `row` and the scanner tell where.
bool parse_rows(const TextTable& table, Scanner& scanner, const char* stop, std::size_t& row, std::size_t last) {
    Scanner local = scanner;  // its address is not known elsewhere, so it may stay in registers
    const std::size_t corners = plain_corners(table);
    std::size_t r = row;
    bool good = true;
    while (good && local.next_row(stop)) {
        good = r != last && ((corners == 4 && parse_plain_cell<4>(table, local, r)) ||
                             (corners == 3 && parse_plain_cell<3>(table, local, r)) || parse_row(table, local, r));
        if (good) ++r;
    }
    scanner = local;
    row = r;
    return good && r == last;
}

/// The whole table at once: the slow twin that knows the first error.
void parse_in_order(TextTable& table) {
    table.read_whole();
    Scanner scanner{table.begin() + table.body, table.end()};
    std::size_t row = 0;
    if (parse_rows(table, scanner, table.end(), row, table.rows)) return;
    if (row == table.rows) refuse_surplus(table, scanner.at);
    // A row parser stops inside the row; only the search for the next row reaches the end with no row begun.
    // A body of nothing begins on the header's line, which has no end.
    const bool ended = table.body == table.bytes.size() || fields_of_line(table, scanner.at).empty();
    if (scanner.at == table.end() && ended) refuse_end(table, row);
    refuse_row(table, scanner.at, row);
}

void read_header(TextTable& table, std::span<const char* const> header_names) {
    if (const base::Format* packed = base::format_that_begins(table.bytes); packed != nullptr)
        throw Exception(other_format_error(*packed, table.file));
    Scanner scanner{table.begin(), table.end()};
    if (table.bytes.starts_with("\xEF\xBB\xBF")) scanner.at += 3;
    const std::string expected = std::string("a header that begins with the number of ") + header_names[0];
    if (!scanner.next_row(table.end()))
        refuse_header("file.empty", table, "the file is empty", expected, "nothing", "write the file again");
    const char* const header = scanner.at;
    table.header_at = static_cast<std::size_t>(header - table.begin());
    scanner.skip_line();
    table.body = static_cast<std::size_t>(scanner.at - table.begin());

    for (const std::string_view field : fields_of_line(table, header)) {
        const std::size_t i = table.header.size();
        std::int64_t value = 0;
        const bool integer = scan_integer(field.data(), value) == field.data() + field.size();
        if (i == header_names.size() && field != "BIN")
            refuse_header("file.syntax", table, "too many numbers in the header",
                          "at most " + std::to_string(header_names.size()), base::quoted(field),
                          "remove it or put # before it");
        if (!integer || value < 0 || value > max_count)
            refuse_count(table, field, i < header_names.size() ? header_names[i] : "columns");
        table.header.push_back(static_cast<std::size_t>(value));
    }
}

}  // namespace

void TextTable::read_whole() {
    if (std::exchange(is_whole, true)) return;
    data = base::MappedFile::read(input, file, input.size(), threads).value();
    bytes = data.bytes();
}

std::size_t TextTable::column_count() const {
    std::size_t count = 0;
    for (const Columns& group : columns) count += group.count;
    return count;
}

std::vector<std::string_view> TextTable::first_row() const {
    Scanner scanner{begin() + body, end()};
    if (!scanner.next_row(end())) return {};
    return fields_of_line(*this, scanner.at);
}

TextTable open_table(const std::string& name, std::span<const char* const> header_names, int threads) {
    TextTable table;
    table.file = plain_or_packed(name);
    bool has_first_row = false;  // in the first block of a larger file
    const auto header_in = [&](std::string_view block, std::uint64_t) -> Status {
        TextTable beginning;
        beginning.file = table.file;
        beginning.bytes = block.substr(0, block.rfind('\n') + 1);  // no comment is cut, and no number
        Status read = status_of([&] { read_header(beginning, header_names); });
        has_first_row = beginning.body != 0 && !beginning.first_row().empty();
        return beginning.body == 0 ? Status(Done{}) : read;  // after many comments
    };
    table.input = base::InputFile::open(table.file, base::save_first, base::Text::all).value();
    table.threads = threads;
    table.input.check(base::Text::all, table.file, header_in).value();
    if (has_first_row) {
        table.data = base::MappedFile::read(table.input, table.file, base::first_block).value();
        table.bytes = table.data.bytes().substr(0, base::first_block);
        table.bytes = table.bytes.substr(0, table.bytes.rfind('\n') + 1);
    } else {
        table.read_whole();
    }
    read_header(table, header_names);
    table.rows = table.header[0];
    return table;
}

void make_room(TextTable& table) {
    // Each field takes a character and something that ends it. Without that room rows are missing, or one is too short,
    // or the last has no line end: the first of these is told.
    const std::size_t bytes = table.input.size() - table.body;
    if (table.rows * 2 * table.column_count() > bytes) {
        for (Columns& c : table.columns) c = {c.kind, c.count, c.name, c.limit, c.refers_to};  // there is no place yet
        parse_in_order(table);
    }
    for (Columns& c : table.columns) {
        if (c.step == 0) c.step = c.count;
        const auto room = [&](auto* values, std::size_t width) {
            if (values != nullptr) base::resize_large(*values, table.rows * width);
        };
        room(c.indices, c.step);
        room(c.more_indices, c.count - c.step);
        room(c.integers, c.step);
        room(c.reals, c.step);
        if (c.fields == nullptr) continue;
        if (table.rows == 0) c.count = 0;  // a count that no row bears out may be anything
        for (std::size_t k = 0; k < c.count; ++k) {
            c.fields->push_back({"attribute" + std::to_string(k), 1, {}});
            room(&c.fields->back().data, 1);
        }
    }
}

void parse_tables(std::span<TextTable* const> tables, int threads) {
    std::vector<LinesOfTable> blocks;
    bool good = true;
    for (const TextTable* table : tables) good = good && append_blocks(*table, blocks);
    good = good && base::share_work(threads, blocks.size(), [&](std::size_t i) {
               const LinesOfTable& block = blocks[i];
               ByteRoom room;  // the thread's next block gets the same memory
               const std::string_view text = some_bytes(*block.table, block.start, block.stop, room);
               Scanner scanner{text.data(), text.data() + text.size()};
               std::size_t row = block.first_row;
               return parse_rows(*block.table, scanner, scanner.end, row, block.last_row);
           });
    for (TextTable* table : tables) {
        if (good)
            table->input.unchanged(table->file).value();
        else
            parse_in_order(*table);
    }
}

}  // namespace barycert::io
