#include "barycert/io/fields/field_file.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <string_view>

#include "barycert/base/input_file.hpp"
#include "barycert/base/mapped_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/npy/npy_header.hpp"

namespace barycert::io {
namespace {

/// The words of a line.
class Words {
public:
    explicit Words(std::string_view line) : rest_(line.substr(0, line.find('#'))) {}

    /// The next word, empty at the end. Two commas stand for a word that is missing.
    std::string_view next() {
        skip_blanks();
        if (rest_.empty()) return {};
        const std::size_t end = std::min(rest_.find_first_of(" \t\r,;"), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        skip_blanks();
        if (!rest_.empty() && (rest_.front() == ',' || rest_.front() == ';')) {
            rest_.remove_prefix(1);
            separated_ = true;
        } else {
            separated_ = false;
        }
        return word;
    }
    /// A separator stood after the last word, so that there is to be another one.
    bool separated() const { return separated_; }
    bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

private:
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size())); }
    std::string_view rest_;
    bool separated_ = false;
};

Result<Field> read_text(Field field, const std::string& path, std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    const char* const file_end = bytes.data() + bytes.size();
    std::size_t line_number = 0, components = 0;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        Words words(bytes.substr(0, end));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        ++line_number;
        if (words.at_end()) continue;
        const std::size_t before = field.data.size();
        do {
            const std::string_view word = words.next();
            const auto x = base::parse_double(word);
            if (!x)
                return Error{.what = "a row of field \"" + field.name + '"',
                             .file = path,
                             .line = line_number,
                             .expected = "numbers",
                             .found = base::quoted(word),
                             .remedy = "write one row of numbers per node or cell; start header lines with #"};
            if (word.data() + word.size() == file_end) return base::unended_number(path, line_number);
            field.data.push_back(*x);
        } while (!words.at_end() || words.separated());
        const std::size_t found = field.data.size() - before;
        if (components == 0) components = found;
        if (found != components)
            return Error{.what = "a row of field \"" + field.name + '"',
                         .file = path,
                         .line = line_number,
                         .expected = std::to_string(components) + " numbers, as in the first row",
                         .found = std::to_string(found),
                         .remedy = "rows have one number for each component of the field"};
    }
    field.components = static_cast<int>(std::max<std::size_t>(components, 1));
    return field;
}

/// How one number stands in an NPY file: 'f', 'i', 'u' or 'b' and its bytes.
struct NpyNumber {
    char kind = 'f';
    std::size_t size = 8;
    bool swapped = false;
};

std::optional<NpyNumber> number_of(const std::string& descr) {
    static constexpr std::string_view known[]{"f8", "f4", "i8", "i4", "i2", "i1", "u8", "u4", "u2", "u1", "b1"};
    if (descr.size() != 3 || std::find(std::begin(known), std::end(known), descr.substr(1)) == std::end(known))
        return std::nullopt;
    const bool big = descr[0] == '>';
    if (!big && descr[0] != '<' && descr[0] != '|' && descr[0] != '=') return std::nullopt;
    return NpyNumber{descr[1], static_cast<std::size_t>(descr[2] - '0'),
                     big == (std::endian::native == std::endian::little)};
}

/// The number at `at`; nothing if it is an integer that is no double.
std::optional<double> value_at(const char* at, const NpyNumber& type) {
    char bytes[8] = {};
    for (std::size_t i = 0; i < type.size; ++i) bytes[i] = at[type.swapped ? type.size - 1 - i : i];
    const auto as = [&]<class T>(T x) {
        std::memcpy(&x, bytes, sizeof x);
        return x;
    };
    if (type.kind == 'f') return type.size == 8 ? as(0.0) : static_cast<double>(as(0.0F));
    if (type.kind == 'b') return bytes[0] != 0 ? 1 : 0;
    const auto exactly = [](auto x) -> std::optional<double> {
        const auto y = static_cast<double>(x);
        // 2^64 and 2^63, to which the largest round, cannot be cast back.
        if (y >= (std::is_signed_v<decltype(x)> ? 0x1p63 : 0x1p64) || static_cast<decltype(x)>(y) != x)
            return std::nullopt;
        return y;
    };
    if (type.kind == 'i') {
        switch (type.size) {
            case 8:
                return exactly(as(std::int64_t{0}));
            case 4:
                return static_cast<double>(as(std::int32_t{0}));
            case 2:
                return static_cast<double>(as(std::int16_t{0}));
            default:
                return static_cast<double>(as(std::int8_t{0}));
        }
    }
    switch (type.size) {
        case 8:
            return exactly(as(std::uint64_t{0}));
        case 4:
            return static_cast<double>(as(std::uint32_t{0}));
        case 2:
            return static_cast<double>(as(std::uint16_t{0}));
        default:
            return static_cast<double>(as(std::uint8_t{0}));
    }
}

Result<Field> read_npy(Field field, const std::string& path, std::string_view bytes) {
    const auto text = find_npy_text(bytes.substr(0, npy_head), path);
    if (!text) return text.error();
    if (text->size > bytes.size() - std::min(bytes.size(), text->offset))
        return Error{.what = "the file ends inside its header", .file = path, .remedy = "write it again"};
    const auto header = parse_npy_text(bytes.substr(text->offset, text->size), path);
    if (!header) return header.error();
    const auto type = number_of(header->descr);
    if (!type || header->structured)
        return Error{.what = "the type of field \"" + field.name + '"',
                     .file = path,
                     .expected = "floats of 4 or 8 bytes, or integers",
                     .found = header->structured ? "a structured array" : base::quoted(header->descr),
                     .remedy = "save a.astype('f8')"};
    const auto& shape = header->shape;
    constexpr std::uint64_t max_components = 1U << 20;
    if (shape.empty() || shape.size() > 2 || (shape.size() == 2 && (shape[1] < 1 || shape[1] > max_components)))
        return Error{.what = "the shape of field \"" + field.name + '"',
                     .file = path,
                     .expected = "(rows,) or (rows, components)",
                     .found = std::to_string(shape.size()) + " axes" + (shape.size() == 2 ? " of another size" : ""),
                     .remedy = "save a.reshape(len(a), -1)"};
    const std::uint64_t rows = shape[0], components = shape.size() == 2 ? shape[1] : 1;
    const std::string_view body = bytes.substr(text->offset + text->size);
    if (rows > body.size() / (components * type->size) || rows * components * type->size != body.size())
        return Error{
            .what = "the size of the file does not fit its header",
            .file = path,
            .expected = std::to_string(rows) + " rows of " + std::to_string(components * type->size) + " bytes",
            .found = std::to_string(body.size()) + " bytes",
            .remedy = "write it again"};
    field.components = static_cast<int>(components);
    field.data.resize(rows * components);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t c = 0; c < components; ++c) {
            const std::size_t at = header->fortran_order ? c * rows + i : i * components + c;
            const auto x = value_at(body.data() + at * type->size, *type);
            if (!x)
                return Error{.what = "row " + std::to_string(i) + " of field \"" + field.name + '"',
                             .file = path,
                             .expected = "an integer that a double holds exactly",
                             .found = "a larger one",
                             .remedy = "save a.astype('f8') to round it"};
            field.data[i * components + c] = *x;
        }
    }
    return field;
}

}  // namespace

Result<Field> read_field_file(const std::string& name, const std::string& path) {
    const auto file = base::MappedFile::open(path);
    if (!file) return file.error();
    std::string lower = path;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    Field field{.name = name, .components = 1, .data = {}};
    return lower.ends_with(".npy") ? read_npy(std::move(field), path, file->bytes())
                                   : read_text(std::move(field), path, file->bytes());
}

}  // namespace barycert::io
