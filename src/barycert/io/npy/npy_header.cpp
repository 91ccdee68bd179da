#include "barycert/io/npy/npy_header.hpp"

#include <charconv>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/tetgen/row_errors.hpp"

namespace barycert::io {
namespace {

Error not_npy(const std::string& file, std::string expected, std::string found, std::string remedy) {
    return {.what = "cannot read the header of the NPY file",
            .file = file,
            .line = 0,
            .expected = std::move(expected),
            .found = std::move(found),
            .remedy = std::move(remedy)};
}

constexpr const char* save_again = "save the array again with numpy.save";

/// The few Python literals that stand in a header.
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

    /// A string without escapes in it: what the keys and the simple types are.
    bool string(std::string& value) {
        skip_blanks();
        if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return false;
        const std::size_t stop = rest_.find(rest_.front(), 1);
        if (stop == std::string_view::npos) return false;
        value = rest_.substr(1, stop - 1);
        rest_.remove_prefix(stop + 1);
        return true;
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
    void skip_blanks() {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\n')) {
            rest_.remove_prefix(1);
        }
    }

    std::string_view rest_;
};

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
    NpyText text{.offset = 10, .size = byte(8) | byte(9) << 8};
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

Result<NpyHeader> parse_npy_text(std::string_view text, const std::string& file) {
    NpyHeader header;
    Literals literals(text);
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

}  // namespace barycert::io
