#include "io/gmsh/msh_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "core/base/workers.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/number_word.hpp"
#include "io/other_formats.hpp"
#include "io/tetgen/scanner.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

std::string_view trimmed(std::string_view text) {
    text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

/// Fits in a core's own cache, which has it for the second look.
constexpr std::size_t text_piece = std::size_t{1} << 18;

bool in_word(char c) {
    return static_cast<unsigned char>(c) > ' ';
}

/// How many words begin in [at, end); the byte before is read. Sums of bytes, in vectors, overflow after 255 rounds.
std::size_t count_words(const char* at, const char* end) {
    std::size_t total = 0;
    while (end - at >= 64) {
        std::array<std::uint8_t, 64> sums{};
        for (int round = 0; round < 255 && end - at >= 64; ++round, at += 64) {
            for (std::size_t i = 0; i < 64; ++i) {
                const auto begins = static_cast<std::uint8_t>(static_cast<std::uint8_t>(at[i]) > ' ') &
                                    static_cast<std::uint8_t>(static_cast<std::uint8_t>((at - 1)[i]) <= ' ');
                sums[i] = static_cast<std::uint8_t>(sums[i] + begins);
            }
        }
        for (const std::uint8_t sum : sums) total += sum;
    }
    for (; at < end; ++at) total += in_word(at[0]) && !in_word(at[-1]) ? 1 : 0;
    return total;
}

}  // namespace

std::string_view take_line(const char*& at, const char* end) {
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    std::string_view line = rest.substr(0, rest.find('\n'));
    at += std::min(line.size() + 1, rest.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string word_at(const char* at, const char* end) {
    while (at != end && is_white(*at)) ++at;
    const char* const stop = std::find_if(at, std::min(end, at + std::min<std::ptrdiff_t>(end - at, 64)), is_white);
    return at == stop ? "the end of the file" : base::quoted({at, static_cast<std::size_t>(stop - at)});
}

void MshFile::read_format() {
    const std::string convert_remedy = "convert it with " + gmsh_command(path_);
    const char* const save_remedy = "write the file again, in version 4.1";
    const char* at = begin();
    const char* const first = at;
    const std::string_view head = trimmed(take_line(at, end()));
    if (head == "$NOD")
        refuse("file.version", first, "a .msh file of version 1", "version 2.2 or 4.1", "\"$NOD\"", convert_remedy);
    if (head.starts_with("$MeshFormat") && head.find('\r') != std::string_view::npos)
        refuse("file.encoding", first, "the lines have other ends", "LF or CR LF", "CR alone",
               "convert the ends of the lines");
    const bool blank = head.empty() && first != end();
    if (head != "$MeshFormat")
        refuse("file.format", first, "not a file of Gmsh", "a first line \"$MeshFormat\"",
               blank ? "an empty line" : word_at(first, end()),
               blank ? "remove the empty lines at the beginning" : "check the path");
    const char* const line = at;
    const std::vector<std::string_view> words = cut_fields(take_line(at, end()), " \t\r", "");
    after_format_ = at;
    if (words.size() != 3)
        refuse("file.syntax", line, "bad $MeshFormat", "version, file type and data size, such as 4.1 0 8",
               word_at(line, end()), save_remedy);
    // As a number: some write 2.200000.
    constexpr std::array<std::pair<double, int>, 5> versions{{{2, 22}, {2.1, 22}, {2.2, 22}, {4, 40}, {4.1, 41}}};
    const double number = real_of_word(words[0], true).value_or(0);
    const auto* const version = std::ranges::find_if(versions, [&](const auto& v) { return v.first == number; });
    if (version == versions.end())
        refuse("file.version", line, "unknown version of the format", "2.2 or 4.1", base::quoted(words[0]),
               words[0].starts_with("2.") || words[0].starts_with("3") ? convert_remedy : save_remedy);
    version_ = version->second;
    if (words[1] != "0" && words[1] != "1")
        refuse("file.syntax", line, "bad file type in $MeshFormat", "0 (text) or 1 (binary)", base::quoted(words[1]),
               save_remedy);
    if (words[1] == "0") return;
    if (words[2] != "8")
        refuse("file.version", line, "bad data size in $MeshFormat", "8 in a binary file", base::quoted(words[2]),
               convert_remedy);
    if (version_ == 40)  // of which Gmsh itself writes text alone
        refuse("file.version", line, "a binary file of version 4.0", "version 4.1 or 2.2", base::quoted(words[0]),
               save_remedy);
    binary_ = true;
    std::int32_t one = 0;
    if (end() - at >= 4) std::memcpy(&one, at, 4);
    swapped_ = one == 0x01000000;
    if (one != 1 && !swapped_)
        refuse("file.format", line, "bad byte order mark in $MeshFormat", "the number 1 in 4 bytes after this line",
               "other bytes", "check whether the file was changed on the way, such as by a transfer as text");
}

void MshFile::add_section(const char* at, const char* stop) {
    const char* body = at;
    const std::string_view name = trimmed(take_line(body, end())).substr(1);
    if (stop == nullptr) {
        const std::string shown = base::printable(name.substr(0, 40));
        refuse("file.truncated", at, "section $" + shown + " has no end", "a line \"$End" + shown + "\"",
               "none in the rest of the file", "the file may be cut short: write it again");
    }
    sections_.push_back({name, {body, static_cast<std::size_t>(stop - body)}});
}

void MshFile::list_text_sections() {
    const auto name_of = [&](const char* at) { return trimmed(take_line(at, end())).substr(1); };
    const std::vector<const char*>& marks = words_.marked();
    const char* from = begin();
    const auto no_text_before = [&](const char* stop) {
        while (from != stop && is_white(*from)) ++from;
        if (from != stop)
            refuse("file.syntax", from, "text between sections", "a line \"$...\" that begins a section",
                   word_at(from, end()), "remove it, or put it into a section $Comments");
    };
    for (auto mark = marks.begin(); mark != marks.end(); ++mark) {
        const char* const begins = *mark;
        no_text_before(begins);
        mark = std::ranges::find(mark + 1, marks.end(), "End" + std::string(name_of(begins)), name_of);
        add_section(begins, mark == marks.end() ? nullptr : *mark);
        from = *mark;
        take_line(from, end());
    }
    no_text_before(end());
}

void MshFile::list_binary_sections() {
    for (const char* at = begin();;) {
        while (at != end() && is_white(*at)) ++at;
        if (at == end()) return;
        if (*at != '$')
            refuse("file.syntax", at, "bytes between sections", "\"$\", which begins a section", word_at(at, end()),
                   "the file may be damaged: write it again");
        const char* body = at;
        const std::string mark = "$End" + std::string(trimmed(take_line(body, end())).substr(1));
        const std::size_t last = bytes_.find(mark, static_cast<std::size_t>(body - bytes_.data()));
        add_section(at, last == std::string_view::npos ? nullptr : bytes_.data() + last);
        at = bytes_.data() + last + mark.size();
    }
}

void MshFile::check_sections() const {
    for (const MshSection& section : sections_) {
        const std::string_view name = section.name;
        if (std::ranges::count(once_sections, name) != 0 && find(name) != &section)
            refuse("file.duplicate", name.data(), "a second section $" + std::string(name), "one of each kind", "two",
                   "keep one mesh a file");
    }
}

MshFile::MshFile(const std::string& path, int threads) : path_(path), threads_(threads) {
    const auto format_in = [&](std::string_view block, std::uint64_t) {
        bytes_ = block;
        Status format = status_of([&] { read_format(); });
        return format && !binary_ ? base::check_beginning(block, base::Text::all, path) : format;
    };
    data_ = base::MappedFile::open(path, threads, base::Text::head, format_in).value();
    bytes_ = data_.bytes();
    read_format();
    if (binary_) {
        list_binary_sections();
    } else {
        const char* const text = begin();
        words_ = WordIndex({text, static_cast<std::size_t>(end() - text)}, threads);
        list_text_sections();
    }
    check_sections();
}

const MshSection* MshFile::find(std::string_view name) const {
    const auto found = std::ranges::find(sections_, name, &MshSection::name);
    return found == sections_.end() ? nullptr : &*found;
}

WordIndex::WordIndex(std::string_view text, int threads) : text_(text) {
    const std::size_t pieces = (text.size() + text_piece - 1) / text_piece;
    before_.resize(pieces + 1);
    std::vector<std::vector<const char*>> marks(pieces);
    base::share_work(threads, pieces, [&](std::size_t i) {
        const std::string_view part = text.substr(i * text_piece, text_piece);
        const char* const at = part.data();
        before_[i + 1] = count_words(at + (i == 0 ? 1 : 0), at + part.size());
        for (std::size_t k = part.find('$'); k != std::string_view::npos; k = part.find('$', k + 1)) {
            if (at + k == text.data() || (at + k)[-1] == '\n') marks[i].push_back(at + k);
        }
        return true;
    });
    for (std::size_t i = 0; i < pieces; ++i) before_[i + 1] += before_[i];
    for (const auto& some : marks) marked_.insert(marked_.end(), some.begin(), some.end());
}

std::size_t WordIndex::before(const char* at) const {
    const std::size_t i = static_cast<std::size_t>(at - text_.data()) / text_piece;
    return before_[i] + count_words(text_.data() + std::max<std::size_t>(i * text_piece, 1), at);
}

const char* WordIndex::find(std::size_t number) const {
    // The last piece with no more before it.
    const auto after = std::upper_bound(before_.begin(), before_.end(), number);
    const auto i = static_cast<std::size_t>(after - before_.begin()) - 1;
    const char* at = text_.data() + std::max<std::size_t>(i * text_piece, 1);
    std::size_t left = number - before_[i];
    constexpr std::ptrdiff_t step = 1024;
    const char* const end = text_.data() + text_.size();
    for (std::size_t count = 0; end - at > step && (count = count_words(at, at + step)) <= left; at += step)
        left -= count;
    while (!in_word(at[0]) || in_word(at[-1]) || left-- != 0) ++at;
    return at;
}

void WordIndex::cut(const Run& run, std::vector<RunPart>& parts) const {
    if (run.count == 0) return;
    const std::size_t base = before(run.at);
    for (RunPart part{&run, 0, 0, run.at}; part.first != run.count; part.first = part.last) {
        const auto i = static_cast<std::size_t>(part.at - text_.data()) / text_piece;
        part.last = std::clamp((before_[i + 1] - base + run.numbers - 1) / run.numbers, part.first + 1, run.count);
        parts.push_back(part);
        if (part.last != run.count) part.at = find(base + part.last * run.numbers);
    }
}

std::vector<RunPart> MshFile::cut(std::span<const Run> runs) const {
    std::vector<RunPart> parts;
    for (const Run& run : runs) {
        if (!binary_ && run.count * run.numbers > few_words) {
            words_.cut(run, parts);
            continue;
        }
        const std::size_t step = binary_ ? std::max<std::size_t>(1, text_piece / run.bytes) : run.count;
        for (std::size_t i = 0; i < run.count; i += step)
            parts.push_back({&run, i, std::min(i + step, run.count), run.at + i * run.bytes});
    }
    return parts;
}

const char* skip_words(const char* at, const char* end, std::size_t& count) {
    std::size_t found = 0;
    for (const char* next = at; found != count; ++found, at = next) {
        while (next != end && !in_word(*next)) ++next;
        if (next == end) break;
        while (next != end && in_word(*next)) ++next;
    }
    count = found;
    return at;
}

void Walk::refuse_word(std::string expected, std::string found) const {
    file_->refuse("file.number", at_, std::string(bad_) + " $" + std::string(section_->name), std::move(expected),
                  std::move(found));
}

/// A number in binary form may reach into the end of the section, "$End..." and its name, which has 9 bytes or more.
template <class Number, class Take>
Number Walk::step(const char* name, const Take& take) {
    Number number{};
    const auto from = [&](auto row) {
        if (!take(row, number)) {
            at_ = row.at();
            refuse_word(name, word_at(at_, file_->end()));
        }
        if (row.at() > end()) refuse("file.truncated", "the section ends too early", name, "the end of the section");
        at_ = row.at();
    };
    text_ ? from(NumberScanner<true>(*file_, at_)) : from(NumberScanner<false>(*file_, at_));
    return number;
}

std::int64_t Walk::integer(const char* name) {
    return step<std::int64_t>(name, [&](auto& row, auto& to) { return row.integer(to, name); });
}

std::int64_t Walk::size(const char* name) {
    const char* const at = at_;
    const auto value = step<std::int64_t>(name, [&](auto& row, auto& to) { return row.tag(to, name); });
    if (value >= 0) return value;
    at_ = at;
    refuse("file.number", "bad number", name, std::to_string(value));
}

double Walk::real(const char* name, bool any) {
    return step<double>(
        name, [&](auto& row, auto& to) { return row.text && !any ? row.real(to, name) : row.any_real(to, name); });
}

std::int64_t Walk::count_line(const char* name) {
    if (text_) return size(name);
    std::int64_t value = 0;
    const char* const after = scan_integer(at_, value);
    if (after == nullptr || static_cast<unsigned char>(*after) > ' ') refuse_word(name, word_at(at_, file_->end()));
    at_ = after;
    const std::string_view rest = line();
    if (value < 0 || rest.find_first_not_of(" \t") != std::string_view::npos)
        refuse("file.number", "bad number", name, base::quoted({after, rest.size()}));
    return value;
}

void Walk::skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name) {
    const auto count = static_cast<std::uint64_t>(rows);
    const auto room = static_cast<std::uint64_t>(end() - at_);
    // In any layout a row has a byte or more: with no more rows than bytes products do not overflow.
    if (!text_ && count <= room && count * bytes <= room) return move_to(at_ + count * bytes);
    std::string found = "fewer";
    if (text_ && count <= room) {
        // The last of many words is found by its number.
        const WordIndex& index = file_->words();
        const std::size_t wanted = count * numbers;
        const std::size_t words =
            wanted <= few_words ? wanted : std::min(wanted, index.before(end()) - index.before(at_));
        const std::size_t passed = words <= few_words ? 0 : words - 1;
        std::size_t rest = words - passed;
        const char* const from = passed == 0 ? at_ : index.find(index.before(at_) + passed);
        const char* const after = skip_words(from, end(), rest);
        if (passed + rest == wanted) return move_to(after);
        found = std::to_string((passed + rest) / numbers);
    }
    refuse("file.truncated", "the section ends too early", std::to_string(rows) + " " + name, found,
           "the file may be cut short: write it again, or mend the number");
}

void Walk::need_end() {
    while (at_ != end() && (is_blank(*at_) || *at_ == '\n' || *at_ == '\r')) ++at_;
    if (at_ != end())
        refuse("file.count", "more than its header tells", "the end of the section",
               text_ ? word_at(at_, end()) : std::to_string(end() - at_) + " more bytes",
               "mend the numbers at the beginning of the section");
}

void refuse_row(const MshFile& file, std::string_view section, const char* at, const RowFault& fault, std::size_t row) {
    const bool text = !file.binary();
    std::string what = std::string(fault.what) + " in $" + std::string(section);
    if (!text) what += ", row " + std::to_string(row) + " from 0";
    const std::string found = fault.number ? std::to_string(*fault.number)
                              : text       ? word_at(at, file.end())
                                           : "another one";
    std::string remedy = fault.remedy;
    if (remedy.empty() && text && !fault.number) {
        std::string_view rest(at, static_cast<std::size_t>(file.end() - at));
        remedy = about_real(next_word(rest), {}, {}).remedy;
    }
    file.refuse(fault.code, at, what, fault.expected, found, remedy);
}

}  // namespace barycert::io
