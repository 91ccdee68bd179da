/// Polygons of .off .stl .ply .obj; the words of such files, of .poly and .smesh. Errors are thrown as Exceptions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert::io {

/// Characters that separate words: in TetGen's files commas do, too. Elsewhere a comma is part of a word, and no number
/// has one.
enum class Separators : std::uint8_t {
    blanks,
    blanks_and_commas,
    blanks_alone,  ///< and `#` starts no comment: of the numbers that are none one is 1.#QNAN
};

/// The lines of a file as words, with errors that know where they are.
class PlcText {
public:
    /// Both texts must outlive it. `#` starts a comment, if it may. `size`: of the whole file.
    PlcText(const std::string& path, std::string_view text, std::size_t size, Separators separators)
        : path_(path),
          rest_(text),
          end_(text.data() + text.size()),
          size_(size),
          separators_(separators == Separators::blanks_and_commas ? " \t\r," : " \t\r"),
          comments_(separators != Separators::blanks_alone) {}

    const std::string& path() const { return path_; }
    std::string_view rest() const { return rest_; }

    bool next_line();
    /// As next_line(), but the end of the file is an error: `expected` says what is missing.
    void need_line(std::string_view expected);
    /// The same of number `i` of `count` such lines: "node 3 of 8".
    void need_line(std::string_view what, std::size_t i, std::size_t count);

    std::size_t words_left() const { return words_.size() - at_; }
    /// Empty where the line has no more.
    std::string_view word(std::size_t i) const { return i < words_.size() ? words_[i] : std::string_view(); }
    std::string_view line() const { return line_; }
    std::size_t line_number() const { return line_number_; }

    /// The next word of the line as a string, a decimal integer, or a finite number; `expected` names it in errors. A
    /// number is a whole word: what stands behind its digits is an error.
    std::string_view take(std::string_view expected);
    std::string_view take_numeric(std::string_view expected);  ///< a word of one or more numbers
    std::int32_t take_integer(std::string_view expected);
    double take_number(std::string_view expected, bool finite = true);  ///< or any
    /// Refuses what is left of the line: `expected` says all that it may have.
    void need_end(std::string_view expected) const;

    /// A count of things that take at least two bytes each: one that the file cannot hold is an error.
    std::size_t take_count(std::string_view expected);

    /// Notes it where the file ends with a number: of a file that is cut short it may be the beginning of another one.
    void note_last_number(Notes& notes) const;

    [[noreturn]] void fail(ErrorCode code, std::string_view what, std::string_view expected = {},
                           std::string_view found = {}, std::string_view remedy = {}) const;

private:
    const std::string& path_;
    std::string_view rest_;
    const char* end_;
    std::size_t size_;
    std::string_view separators_;
    bool comments_;
    std::string_view line_;
    std::size_t line_number_ = 0;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    bool ends_with_number_ = false;
};

/// Returns the remedy for a word that is no number: "" where nothing is known.
std::string remedy_for_number(std::string_view word);

/// The whole file as text. `check` throws what is wrong with its beginning, whole lines of it.
std::string read_surface_text(const std::string& path, Separators separators,
                              const std::function<void(PlcText&)>& check);

/// A surface whose polygons are not cut into cells yet: its cell fields have a row for each polygon.
struct Polygons : Surface {
    std::vector<Mesh::Index> rings;     ///< the corners of all polygons, one after the other
    std::vector<std::uint32_t> counts;  ///< corners of each; empty: all are triangles

    std::size_t count() const { return counts.empty() ? rings.size() / 3 : counts.size(); }
};

/// The whole file, which is any of these by the end of its path; `counts` is empty if all are triangles.
Polygons read_polygons(const std::string& path);

// One format each.
Polygons read_stl(PlcText& in);
Polygons read_off(PlcText& in);
Polygons read_obj(PlcText& in);
Polygons read_ply(PlcText& in);

/// "0 to 7", the nodes that there are.
std::string nodes_of(std::size_t count);
/// Refuses corners that are no points; numbers from 1 become numbers from 0.
void check_corners(PlcText& in, Polygons& all);

/// By the beginning of a file of `size` bytes: whether it has binary data, in which a zero byte is no fault.
bool is_binary_stl(std::string_view beginning, std::size_t size, const std::string& path);
bool is_binary_surface(std::string_view path, std::string_view beginning, std::size_t size);

}  // namespace barycert::io
