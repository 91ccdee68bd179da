#include "barycert/io/gmsh/walk.hpp"

#include <bit>
#include <cstring>

#include "barycert/base/text.hpp"
#include "barycert/io/tetgen/scanner.hpp"

namespace barycert::io {
namespace {

bool is_feed(char c) {
    return c == '\n' || c == '\r';
}

}  // namespace

Walk::Walk(const MshFile& file, const MshSection& section, MshLayout layout)
    : file_(file), name_(section.name), layout_(layout), end_(section.body.data() + section.body.size()) {
    move_to(section.body.data());
}

void Walk::move_to(const char* at) {
    place_.at = at;
    if (layout_ == MshLayout::lines) place_.line = file_.lines().number(at);
}

void Walk::skip() {
    const bool free = layout_ == MshLayout::free;
    while (place_.at != end_ && (is_blank(*place_.at) || (free && is_feed(*place_.at)))) ++place_.at;
}

bool Walk::refuse(std::string what, std::string expected, std::string found, std::string remedy) {
    what_ = std::move(what);
    expected_ = std::move(expected);
    found_ = std::move(found);
    remedy_ = std::move(remedy);
    return false;
}

bool Walk::take(const char* after, const char* name) {
    if (after == nullptr || static_cast<unsigned char>(*after) > ' ' || after > end_) {
        return refuse("bad number", name,
                      word_at(place_.at, file_.data().bytes().data() + file_.data().bytes().size()));
    }
    place_.at = after;
    return true;
}

bool Walk::number(std::int64_t& value, std::size_t bytes, const char* name) {
    if (text()) {
        skip();
        return take(scan_integer(place_.at, value), name);
    }
    if (static_cast<std::size_t>(end_ - place_.at) < bytes)
        return refuse("the section ends too early", name, "the end of the section");
    if (bytes == 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, place_.at, 4);
        value = static_cast<std::int32_t>(file_.swapped() ? __builtin_bswap32(word) : word);
    } else {
        std::uint64_t word = 0;
        std::memcpy(&word, place_.at, 8);
        value = static_cast<std::int64_t>(file_.swapped() ? __builtin_bswap64(word) : word);
    }
    place_.at += bytes;
    return true;
}

bool Walk::integer(std::int64_t& value, const char* name) {
    return number(value, 4, name);
}

bool Walk::size(std::int64_t& value, const char* name) {
    const char* const at = place_.at;
    if (!number(value, 8, name)) return false;
    if (value >= 0) return true;
    place_.at = at;
    return refuse("bad number", name, std::to_string(value));
}

bool Walk::real(double& value, const char* name) {
    if (text()) {
        skip();
        return take(scan_real(place_.at, end_, value), name);
    }
    std::int64_t bits = 0;
    if (!number(bits, 8, name)) return false;
    value = std::bit_cast<double>(bits);
    return true;
}

bool Walk::end_header() {
    if (layout_ != MshLayout::lines) return true;
    skip();
    if (*place_.at == '\r') ++place_.at;
    if (*place_.at != '\n') return false;  // told when it is read again
    ++place_.at;
    ++place_.line;
    return true;
}

bool Walk::count_line(std::int64_t& value, const char* name) {
    if (text()) return size(value, name) && end_header();
    const char* const after = scan_integer(place_.at, value);
    if (!take(after, name)) return false;
    const std::string_view rest = take_line(place_.at, end_);
    if (value < 0 || rest.find_first_not_of(" \t") != std::string_view::npos)
        return refuse("bad number", name, base::quoted({after, rest.size()}));
    return true;
}

std::uint64_t Walk::skip_numbers(std::uint64_t count) {
    const char* at = place_.at;
    for (std::uint64_t i = 0; i < count; ++i) {
        while (at != end_ && static_cast<unsigned char>(*at) <= ' ') ++at;
        if (at == end_) return i;
        while (at != end_ && static_cast<unsigned char>(*at) > ' ') ++at;
    }
    place_.at = at;
    return count;
}

bool Walk::skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name) {
    const auto count = static_cast<std::uint64_t>(rows);
    const auto room = static_cast<std::uint64_t>(end_ - place_.at);
    bool good = count <= room;  // in any layout a row has a byte or more, so that products do not overflow below
    std::string found = "fewer";
    if (good && layout_ == MshLayout::binary) {
        good = count * bytes <= room;
        if (good) place_.at += count * bytes;
    } else if (good && layout_ == MshLayout::lines) {
        // A number takes a character and one that ends it: memory for the rows is a multiple of what is there.
        good = count * numbers * 2 <= room + 1;
    }
    if (good && layout_ == MshLayout::lines) {
        const char* const at = file_.lines().start(place_.line + count, place_);
        good = at != nullptr && at <= end_;
        if (good) place_ = {at, place_.line + count};
    } else if (good && layout_ == MshLayout::free) {
        const std::uint64_t skipped = skip_numbers(count * numbers);
        good = skipped == count * numbers;
        if (!good) found = std::to_string(skipped / numbers);
    }
    return good || refuse("the section ends too early", std::to_string(rows) + " " + name, found,
                          "the file may be cut short: write it again, or mend the number");
}

bool Walk::at_end() {
    while (place_.at != end_ && (is_blank(*place_.at) || is_feed(*place_.at))) ++place_.at;
    if (place_.at == end_) return true;
    return refuse("more than its header tells", "the end of the section",
                  text() ? word_at(place_.at, end_) : std::to_string(end_ - place_.at) + " more bytes",
                  "mend the numbers at the beginning of the section");
}

Error Walk::error() const {
    std::string what = what_.empty() ? "not one row a line" : what_;
    return file_.error_at(place_.at, what + " in $" + std::string(name_), expected_, found_, remedy_);
}

}  // namespace barycert::io
