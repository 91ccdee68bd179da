#include "barycert/io/gmsh/rows.hpp"

#include <bit>

#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

/// So many words are passed one by one: the index would take longer.
constexpr std::size_t few = 1024;

}  // namespace

Walk::Walk(const MshFile& file, const MshSection& section, bool text, const char* bad)
    : file_(&file),
      name_(section.name),
      text_(text),
      bad_(bad),
      at_(section.body.data()),
      end_(at_ + section.body.size()) {}

void Walk::skip() {
    while (at_ != end_ && (is_blank(*at_) || *at_ == '\n' || *at_ == '\r')) ++at_;
}

bool Walk::fail(const std::string& what, std::string expected, std::string found, std::string remedy) {
    error_ = file_->error_at(at_, what + " $" + std::string(name_), std::move(expected), std::move(found),
                             std::move(remedy));
    return false;
}

bool Walk::take(const char* after, const char* name) {
    if (after == nullptr || static_cast<unsigned char>(*after) > ' ' || after > end_)
        return refuse_word(name, word_at(at_, file_->bytes().data() + file_->bytes().size()));
    at_ = after;
    return true;
}

bool Walk::number(std::int64_t& value, std::size_t bytes, const char* name) {
    if (text_) {
        skip();
        return take(scan_integer(at_, value), name);
    }
    if (static_cast<std::size_t>(end_ - at_) < bytes)
        return refuse("the section ends too early", name, "the end of the section");
    value = bytes == 4 ? static_cast<std::int32_t>(word_in<std::uint32_t>(at_, file_->swapped()))
                       : static_cast<std::int64_t>(word_in<std::uint64_t>(at_, file_->swapped()));
    at_ += bytes;
    return true;
}

bool Walk::size(std::int64_t& value, const char* name) {
    const char* const at = at_;
    if (!number(value, 8, name)) return false;
    if (value >= 0) return true;
    at_ = at;
    return refuse("bad number", name, std::to_string(value));
}

bool Walk::real(double& value, const char* name) {
    if (text_) {
        skip();
        return take(scan_real(at_, end_, value), name);
    }
    std::int64_t bits = 0;
    if (!number(bits, 8, name)) return false;
    value = std::bit_cast<double>(bits);
    return true;
}

bool Walk::value(double& value, const char* name) {
    skip();
    return take(scan_any_real(at_, end_, value), name);
}

bool Walk::count_line(std::int64_t& value, const char* name) {
    if (text_) return size(value, name);
    const char* const after = scan_integer(at_, value);
    if (!take(after, name)) return false;
    const std::string_view rest = line();
    if (value < 0 || rest.find_first_not_of(" \t") != std::string_view::npos)
        return refuse("bad number", name, base::quoted({after, rest.size()}));
    return true;
}

bool Walk::skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name) {
    const auto count = static_cast<std::uint64_t>(rows);
    const auto room = static_cast<std::uint64_t>(end_ - at_);
    bool good = count <= room;  // in any layout a row has a byte or more, so that products do not overflow below
    std::string found = "fewer";
    if (good && !text_) {
        good = count * bytes <= room;
        if (good) at_ += count * bytes;
    } else if (good) {
        // The last of many words is found by its number.
        const std::size_t wanted = count * numbers, words = wanted <= few ? wanted : std::min(wanted, words_left());
        const std::size_t passed = words <= few ? 0 : words - 1;
        std::size_t rest = words - passed;
        const char* const from = passed == 0 ? at_ : file_->words().find(file_->words().before(at_) + passed);
        const char* const after = skip_words(from, end_, rest);
        good = passed + rest == wanted;
        if (good) at_ = after;
        if (!good) found = std::to_string((passed + rest) / numbers);
    }
    return good || refuse("the section ends too early", std::to_string(rows) + " " + name, found,
                          "the file may be cut short: write it again, or mend the number");
}

bool Walk::at_end() {
    skip();
    if (at_ == end_) return true;
    return refuse("more than its header tells", "the end of the section",
                  text_ ? word_at(at_, end_) : std::to_string(end_ - at_) + " more bytes",
                  "mend the numbers at the beginning of the section");
}

std::vector<RunPart> cut_runs(const MshFile& file, std::span<const Run> runs) {
    constexpr std::size_t part_bytes = std::size_t{1} << 18;
    std::vector<RunPart> parts;
    for (const Run& run : runs) {
        if (!file.binary() && run.count * run.numbers <= few) {
            parts.push_back({&run, 0, run.count, run.at});
            continue;
        }
        if (!file.binary()) {
            for (const WordIndex::Part& part : file.words().cut(run.at, run.count, run.numbers))
                parts.push_back({&run, part.first, part.last, part.at});
            continue;
        }
        const std::size_t step = std::max<std::size_t>(1, part_bytes / run.bytes);
        for (std::size_t i = 0; i < run.count; i += step)
            parts.push_back({&run, i, std::min(i + step, run.count), run.at + i * run.bytes});
    }
    return parts;
}

Error row_error(const MshFile& file, const char* section, const char* at, const RowFault& fault, std::size_t row) {
    const char* const end = file.bytes().data() + file.bytes().size();
    const bool text = !file.binary();
    while (text && at != end && (is_blank(*at) || *at == '\r' || *at == '\n') && !fault.number) ++at;
    std::string what = std::string(fault.what) + " in $" + section;
    if (!text) what += ", row " + std::to_string(row) + " from 0";
    const std::string found = fault.number ? std::to_string(*fault.number) : text ? word_at(at, end) : "another one";
    return file.error_at(at, what, fault.expected, found, fault.remedy);
}

}  // namespace barycert::io
