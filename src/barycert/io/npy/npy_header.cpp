#include "barycert/io/npy/npy_header.hpp"

#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/npy/npy_literals.hpp"

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

std::string utf8_of_latin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80) {
            utf8 += c;
        } else {
            utf8 += {static_cast<char>(0xC0U | code >> 6), static_cast<char>(0x80U | (code & 0x3FU))};
        }
    }
    return utf8;
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
