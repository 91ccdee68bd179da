#include "barycert/io/gmsh/rows.hpp"

namespace barycert::io {

void Walk::refuse_word(std::string expected, std::string found) const {
    file_->refuse(at_, std::string(bad_) + " $" + std::string(section_->name), std::move(expected), std::move(found));
}

/// A number in binary form may reach into the end of the section, "$End..." and its name, which has 9 bytes or more.
template <class Take>
void Walk::step(const char* name, const Take& take) {
    const auto from = [&](auto row) {
        if (!take(row)) {
            at_ = row.at();
            refuse_word(name, word_at(at_, file_->end()));
        }
        if (row.at() > end()) refuse("the section ends too early", name, "the end of the section");
        at_ = row.at();
    };
    text_ ? from(Row<true>(*file_, at_)) : from(Row<false>(*file_, at_));
}

std::int64_t Walk::integer(const char* name) {
    std::int64_t value = 0;
    step(name, [&](auto& row) { return row.integer(value, name); });
    return value;
}

std::int64_t Walk::size(const char* name) {
    const char* const at = at_;
    std::int64_t value = 0;
    step(name, [&](auto& row) { return row.tag(value, name); });
    if (value >= 0) return value;
    at_ = at;
    refuse("bad number", name, std::to_string(value));
}

double Walk::real(const char* name, bool any) {
    double value = 0;
    step(name, [&](auto& row) { return row.text && !any ? row.real(value, name) : row.any_real(value, name); });
    return value;
}

std::int64_t Walk::count_line(const char* name) {
    if (text_) return size(name);
    std::int64_t value = 0;
    const char* const after = scan_integer(at_, value);
    if (after == nullptr || static_cast<unsigned char>(*after) > ' ') refuse_word(name, word_at(at_, file_->end()));
    at_ = after;
    const std::string_view rest = line();
    if (value < 0 || rest.find_first_not_of(" \t") != std::string_view::npos)
        refuse("bad number", name, base::quoted({after, rest.size()}));
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
    refuse("the section ends too early", std::to_string(rows) + " " + name, found,
           "the file may be cut short: write it again, or mend the number");
}

void Walk::need_end() {
    while (at_ != end() && (is_blank(*at_) || *at_ == '\n' || *at_ == '\r')) ++at_;
    if (at_ != end())
        refuse("more than its header tells", "the end of the section",
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
    file.refuse(at, what, fault.expected, found, fault.remedy);
}

}  // namespace barycert::io
