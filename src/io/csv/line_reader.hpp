/// Lines of a text file, pipe or the standard input, in bounded memory.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"
#include "files/descriptor.hpp"
#include "files/input_file.hpp"

namespace barycert::io {

/// Reads in chunks. A byte-order mark of UTF-8 is passed over, one of UTF-16 refused. Errors are thrown as Exceptions.
class LineReader {
public:
    /// The longest line, and so what the reader holds in memory.
    static constexpr std::size_t longest_line = std::size_t{1} << 20;

    explicit LineReader(const std::string& path);

    /// The next line without its end, valid until the next call; a byte after it may be read. False: there is none.
    bool next(std::string_view& line);

    /// Several lines at once, whole ones with their ends but for the last of the file, which may lack its own: at least
    /// one, and as many more as have come, at most longest_line bytes. Valid until the next call, and one byte after
    /// them may be read. False as above. Whoever has counted the lines tells it by count().
    bool next_lines(std::string_view& lines);
    void count(std::size_t lines) { number_ += lines; }

    /// Error: it is a regular file and was changed since it was opened, so that a line that is wrong may be half of
    /// one. Looked at where the file ends.
    Status unchanged() const { return then_ ? base::unchanged(file_.number, *then_, name_) : Status(Done{}); }

    /// The last line given ended with LF or CR, and not with the file.
    bool line_ended() const { return line_ended_; }

    /// The number of the last line given or counted, from 1.
    std::size_t number() const { return number_; }

    const std::string& name() const { return name_; }

private:
    bool take_lines();
    void refill();
    void skip_mark(bool standard_input);

    std::string name_;
    base::Descriptor file_;
    std::optional<base::FileState> then_;  // of a regular file
    bool ended_ = false;                   // nothing more comes from the system
    std::vector<char> buffer_;
    std::size_t begin_ = 0, end_ = 0;  // what has been read and not taken
    std::string_view lines_;           // taken, whole lines, and not given
    bool line_ended_ = true;
    std::size_t number_ = 0;
};

}  // namespace barycert::io
