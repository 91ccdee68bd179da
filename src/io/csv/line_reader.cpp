#include "io/csv/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/result.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/other_formats.hpp"

namespace barycert::io {

LineReader::LineReader(const std::string& path) : name_(path == "-" ? "standard input" : path) {
    const auto need = [&](bool good) {
        if (!good) throw Exception(base::read_failure(name_, errno));
    };
    // A named pipe waits for its writer, as every reader of streams does: `gen > p.csv & barycert ... p.csv`.
    file_.number = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    need(file_.number >= 0);
    base::unpack(file_.number, name_, base::Text::words).value();
    struct stat status {};
    need(::fstat(file_.number, &status) == 0);
    errno = EISDIR;
    need(!S_ISDIR(status.st_mode));
    base::record_input(file_.number, name_);
    if (S_ISREG(status.st_mode)) then_ = {static_cast<std::uint64_t>(status.st_size), status.st_mtim};
    // A small file takes a small buffer: all of it, and a byte more than that, so that the end is met at once.
    const bool small = S_ISREG(status.st_mode) && static_cast<std::uint64_t>(status.st_size) < longest_line;
    const std::size_t room = small ? static_cast<std::size_t>(status.st_size) + 1 : longest_line;
    buffer_.resize(room + 1);  // the last byte stays zero: a scanner may look at it
    skip_mark(path == "-");
}

void LineReader::skip_mark(bool standard_input) {
    while (end_ < 3 && !ended_) refill();
    const std::string_view head(buffer_.data(), end_);
    if (head.starts_with("\x93NU"))
        refuse_file("file.format", name_, "this is an NPY file", "text: a point a line", {},
                    "name a file that ends in .npy: a stream or a file of another name is read as CSV");
    const base::Format* const packed = base::format_that_begins(head);
    if (head.starts_with("\x1f\x8b") || (packed != nullptr && standard_input))
        refuse_file("file.packed", name_,
                    packed != nullptr ? std::string("this is ") + std::string(packed->what) : "this is packed by gzip",
                    "text: a point a line", {}, "unpack it first: gunzip, xz -dc, ...");
    if (packed != nullptr) throw Exception(other_format_error(*packed, name_));
    // A smaller part of the file, as a pipe gives, is decided line by line.
    base::check_beginning(head.substr(0, base::first_block), base::Text::words, name_).value();
    if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF"))
        refuse_line("file.encoding", name_, 1, "the text is not in UTF-8", "UTF-8 or ASCII",
                    "a byte-order mark of UTF-16", "save the file as UTF-8");
    if (head.starts_with("\xEF\xBB\xBF")) begin_ = 3;
}

void LineReader::refill() {
    if (begin_ != 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ == longest_line)
        refuse_line("file.too-large", name_, number_ + 1, "a line is too long",
                    "at most " + std::to_string(longest_line) + " bytes", "more",
                    "check that this is a text file, with a line end after each point");
    if (end_ + 1 == buffer_.size()) buffer_.resize(longest_line + 1);  // the file has grown meanwhile
    const ssize_t got = TEMP_FAILURE_RETRY(::read(file_.number, buffer_.data() + end_, buffer_.size() - 1 - end_));
    if (got < 0) throw Exception(base::read_failure(name_, errno));
    end_ += static_cast<std::size_t>(got);
    buffer_[end_] = '\0';
    ended_ = got == 0;
}

bool LineReader::next(std::string_view& line) {
    if (lines_.empty() && !take_lines()) return false;
    line = lines_.substr(0, lines_.find('\n'));
    const bool feed = line.size() != lines_.size();
    lines_.remove_prefix(line.size() + (feed ? 1 : 0));
    line_ended_ = feed || line.ends_with('\r');
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return true;
}

bool LineReader::next_lines(std::string_view& lines) {
    if (lines_.empty() && !take_lines()) return false;
    lines = std::exchange(lines_, {});
    return true;
}

bool LineReader::take_lines() {
    // As much as there is room for, as a pipe gives little; but no line waits for others that may be long in coming.
    const auto held = [&] { return std::string_view(buffer_.data() + begin_, end_ - begin_); };
    const auto would_wait = [&] {
        pollfd asked{.fd = file_.number, .events = POLLIN, .revents = 0};
        return ::poll(&asked, 1, 0) != 1;
    };
    while (!ended_ && (begin_ != 0 || end_ != longest_line)) {
        if (held().rfind('\n') != std::string_view::npos && would_wait()) break;
        refill();
    }
    std::size_t size = held().size();
    if (size == 0) unchanged().value();
    if (!ended_) {
        const std::size_t feed = held().rfind('\n');
        if (feed == std::string_view::npos) refill();  // a line too long, which that says
        size = feed + 1;
    }
    lines_ = held().substr(0, size);
    begin_ += size;
    return size != 0;
}

}  // namespace barycert::io
