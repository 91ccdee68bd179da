/// A PLC file's lines as words, with errors that know where they are.
///
/// For use within read_plc: errors are thrown as Exception and turned into a Result there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io.hpp"

namespace barycert::io {

/// STEM.node, where the nodes of STEM.poly and STEM.smesh may be.
std::string node_path_of(const std::string& path);

/// The whole file; throws Exception if it cannot be read.
std::string read_whole_file(const std::string& path);

class PlcText {
public:
    /// Both texts must outlive the object. Words are parted by blanks and commas; `#` starts a comment. `size`: of the
    /// file, where the text is its beginning.
    PlcText(const std::string& path, std::string_view text) : PlcText(path, text, text.size()) {}
    PlcText(const std::string& path, std::string_view text, std::size_t size)
        : path_(path), rest_(text), end_(text.data() + text.size()), size_(size) {}

    bool at_end() const { return rest_.empty(); }

    /// Goes to the next line that has words. False at the end of the file.
    bool next_line();
    /// As next_line(), but the end of the file is an error: `expected` says what is missing.
    void need_line(std::string_view expected);

    std::size_t word_count() const { return words_.size(); }
    std::size_t words_left() const { return words_.size() - at_; }
    std::string_view word(std::size_t i) const { return words_[i]; }
    std::string_view line() const { return line_; }

    /// The next word of the line as a string, a decimal integer, or a finite number; `expected` names it in errors.
    std::string_view take(std::string_view expected);
    std::int32_t take_integer(std::string_view expected);
    double take_number(std::string_view expected);

    /// A count of things that take at least two bytes each: one that the file cannot hold is an error.
    std::size_t take_count(std::string_view expected);

    [[noreturn]] void fail(std::string_view what, std::string_view expected = {}, std::string_view found = {},
                           std::string_view remedy = {}) const;

private:
    /// A word that something follows: what the end of the file has cut may be the beginning of another number.
    std::string_view take_whole(std::string_view expected);

    const std::string& path_;
    std::string_view rest_;
    const char* end_;
    std::size_t size_;
    std::string_view line_;
    std::size_t line_number_ = 0;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
};

/// The headers by themselves; each reader below reads its own.
struct NodeHeader {
    std::size_t nodes = 0;
    int attributes = 0;
    bool markers = false;
};
struct OffHeader {
    std::size_t nodes = 0;
    std::size_t polygons = 0;
};
/// The number of nodes or polygons and where x, y, z stand, from the head of a .ply file.
struct PlyHeader {
    std::size_t nodes = 0;
    std::size_t polygons = 0;
    std::array<std::optional<std::size_t>, 3> axis;
    std::size_t properties = 0;
};
NodeHeader read_node_header(PlcText& in);
OffHeader read_off_header(PlcText& in);
PlyHeader read_ply_header(PlcText& in, const std::string& path);

Plc read_poly(const std::string& path, std::string_view text, bool one_polygon_a_facet);
Plc read_off(const std::string& path, std::string_view text);
Plc read_stl(const std::string& path, std::string_view text);
/// Throws Exception if the file is an .stl neither as text nor, by its size, in binary form.
void check_stl_size(const std::string& path);
Plc read_ply(const std::string& path, std::string_view text);

}  // namespace barycert::io
