#include "barycert/io/gmsh/msh_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// Bytes before the text.
std::size_t byte_order_mark(std::string_view bytes) {
    return bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

/// Where `mark` stands next, or nullptr.
const char* find_mark(std::string_view bytes, std::string_view mark) {
    const char* const end = bytes.data() + bytes.size();
    for (const char* at = bytes.data(); at < end; ++at) {
        at = static_cast<const char*>(std::memchr(at, '$', static_cast<std::size_t>(end - at)));
        if (at == nullptr) return nullptr;
        if (std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(mark)) return at;
    }
    return nullptr;
}

}  // namespace

std::string_view take_line(const char*& at, const char* end) {
    const char* const start = at;
    const void* const feed = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
    const char* stop = feed == nullptr ? end : static_cast<const char*>(feed);
    at = feed == nullptr ? end : stop + 1;
    if (stop != start && stop[-1] == '\r') --stop;
    return {start, static_cast<std::size_t>(stop - start)};
}

std::string word_at(const char* at, const char* end) {
    while (at != end && is_space(*at)) ++at;
    const char* const stop = std::find_if(at, std::min(end, at + std::min<std::ptrdiff_t>(end - at, 64)), is_space);
    return at == stop ? "the end of the file" : base::quoted({at, static_cast<std::size_t>(stop - at)});
}

Error MshFile::error_at(const char* at, std::string what, std::string expected, std::string found,
                        std::string remedy) const {
    const bool text = !binary_ || at < after_format_;
    return line_error(path_, text ? line_of(bytes_, at) : 0, std::move(what), std::move(expected), std::move(found),
                      std::move(remedy));
}

Status MshFile::read_format() {
    const std::string convert_remedy = "convert it with " + gmsh_command(path_);
    const char* const save_remedy = "write the file again, in version 4.1";
    const char* at = bytes_.data() + byte_order_mark(bytes_);
    const char* const end = bytes_.data() + bytes_.size();
    const char* const first = at;
    const std::string_view head = trimmed(take_line(at, end));
    if (head == "$NOD")
        return error_at(first, "a .msh file of version 1", "version 2.2 or 4.1", "\"$NOD\"", convert_remedy);
    if (head.starts_with("$MeshFormat") && head.find('\r') != std::string_view::npos)
        return error_at(first, "the lines have other ends", "LF or CR LF", "CR alone", "convert the ends of the lines");
    if (head.empty() && first != end)
        return error_at(first, "not a file of Gmsh", "a first line \"$MeshFormat\"", "an empty line",
                        "remove the empty lines at the beginning");
    if (head != "$MeshFormat")
        return error_at(first, "not a file of Gmsh", "a first line \"$MeshFormat\"", word_at(first, end),
                        "check the path");
    const char* const line = at;
    std::vector<std::string_view> words;
    cut_fields(take_line(at, end), " \t\r", "", words);
    after_format_ = at;
    if (words.size() != 3)
        return error_at(line, "bad $MeshFormat", "version, file type and data size, such as 4.1 0 8",
                        word_at(line, end), save_remedy);
    constexpr std::array<std::pair<std::string_view, int>, 7> versions{
        {{"2", 22}, {"2.0", 22}, {"2.1", 22}, {"2.2", 22}, {"4", 40}, {"4.0", 40}, {"4.1", 41}}};
    const auto* const version =
        std::find_if(versions.begin(), versions.end(), [&](const auto& v) { return v.first == words[0]; });
    if (version == versions.end())
        return error_at(line, "unknown version of the format", "2.2 or 4.1", base::quoted(words[0]),
                        words[0].starts_with("2.") || words[0].starts_with("3") ? convert_remedy : save_remedy);
    version_ = version->second;
    if (words[1] != "0" && words[1] != "1")
        return error_at(line, "bad file type in $MeshFormat", "0 (text) or 1 (binary)", base::quoted(words[1]),
                        save_remedy);
    if (words[1] == "0") return Done{};
    if (words[2] != "8")
        return error_at(line, "bad data size in $MeshFormat", "8 in a binary file", base::quoted(words[2]),
                        convert_remedy);
    if (version_ == 40) {  // of which Gmsh itself writes text alone
        return error_at(line, "a binary file of version 4.0", "version 4.1 or 2.2", base::quoted(words[0]),
                        save_remedy);
    }
    binary_ = true;
    std::int32_t one = 0;
    if (end - at >= 4) std::memcpy(&one, at, 4);
    swapped_ = one == 0x01000000;
    if (one != 1 && !swapped_)
        return error_at(line, "bad byte order mark in $MeshFormat", "the number 1 in 4 bytes after this line",
                        "other bytes", "check whether the file was changed on the way, such as by a transfer as text");
    return Done{};
}

Status MshFile::add_section(const char* at, const char* end) {
    const char* const file_end = bytes_.data() + bytes_.size();
    const char* body = at;
    const std::string_view name = trimmed(take_line(body, file_end)).substr(1);
    if (end == nullptr)
        return error_at(at, "section $" + base::printable(name.substr(0, 40)) + " has no end",
                        "a line \"$End" + base::printable(name.substr(0, 40)) + "\"", "none in the rest of the file",
                        "the file may be cut short: write it again");
    sections_.push_back({name, {body, static_cast<std::size_t>(end - body)}});
    return Done{};
}

Status MshFile::list_text_sections() {
    const char* const file_end = bytes_.data() + bytes_.size();
    const auto name_of = [&](const char* at) { return trimmed(take_line(at, file_end)).substr(1); };
    const std::vector<const char*>& marks = words_.marked();
    const char* from = bytes_.data() + byte_order_mark(bytes_);
    const auto stray = [&](const char* end) -> Status {
        while (from != end && is_space(*from)) ++from;
        if (from == end) return Done{};
        return error_at(from, "text between sections", "a line \"$...\" that begins a section", word_at(from, file_end),
                        "remove it, or put it into a section $Comments");
    };
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const std::string_view name = name_of(marks[i]);
        if (Status clean = stray(marks[i]); !clean) return clean;
        std::size_t last = i + 1;
        const auto ends = [&](const char* at) {
            const std::string_view other = name_of(at);
            return other.starts_with("End") && other.substr(3) == name;
        };
        while (last < marks.size() && !ends(marks[last])) ++last;
        if (Status s = add_section(marks[i], last < marks.size() ? marks[last] : nullptr); !s) return s;
        from = marks[last];
        take_line(from, file_end);
        i = last;
    }
    return stray(file_end);
}

Status MshFile::list_binary_sections() {
    const char* at = bytes_.data() + byte_order_mark(bytes_);
    const char* const end = bytes_.data() + bytes_.size();
    while (true) {
        while (at != end && is_space(*at)) ++at;
        if (at == end) return Done{};
        if (*at != '$')
            return error_at(at, "bytes between sections", "\"$\", which begins a section", word_at(at, end),
                            "the file may be damaged: write it again");
        const char* body = at;
        const std::string mark = "$End" + std::string(trimmed(take_line(body, end)).substr(1));
        const char* const last = find_mark({body, static_cast<std::size_t>(end - body)}, mark);
        if (Status s = add_section(at, last); !s) return s;
        at = last + mark.size();
    }
}

Status MshFile::check_sections() const {
    constexpr std::array<std::string_view, 7> once{"MeshFormat", "PhysicalNames",   "Entities", "PartitionedEntities",
                                                   "Nodes",      "ParametricNodes", "Elements"};
    for (const std::string_view name : once) {
        const MshSection* first = nullptr;
        for (const MshSection& section : sections_) {
            if (section.name != name) continue;
            if (first != nullptr)
                return error_at(section.name.data(), "a second section $" + std::string(name), "one of each kind",
                                "two", "keep one mesh a file");
            first = &section;
        }
    }
    return Done{};
}

Result<MshFile> MshFile::open(const std::string& path, int threads) {
    MshFile file;
    file.path_ = path;
    const auto format_in = [&](std::string_view block, std::uint64_t) {
        file.bytes_ = block;
        return file.read_format();
    };
    Result<base::MappedFile> mapped = base::MappedFile::open(path, threads, base::Text::head, format_in);
    if (!mapped) return mapped.error();
    file.threads_ = threads;
    file.data_ = std::move(*mapped);
    file.bytes_ = file.data_.bytes();
    Status status = file.read_format();
    if (status && file.binary_) {
        status = file.list_binary_sections();
    } else if (status) {
        file.words_ = WordIndex(file.bytes_.substr(byte_order_mark(file.bytes_)), threads);
        status = file.list_text_sections();
    }
    if (status) status = file.check_sections();
    if (!status) return status.error();
    return file;
}

const MshSection* MshFile::find(std::string_view name) const {
    const auto found =
        std::find_if(sections_.begin(), sections_.end(), [&](const MshSection& s) { return s.name == name; });
    return found == sections_.end() ? nullptr : &*found;
}

}  // namespace barycert::io
