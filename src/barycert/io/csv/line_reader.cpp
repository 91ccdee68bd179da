#include "barycert/io/csv/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {

Result<LineReader> LineReader::open(const std::string& path) {
    LineReader reader(path == "-" ? "standard input" : path);
    const bool own = path != "-";
    // A named pipe waits for its writer, as every reader of streams does: `gen > p.csv & barycert ... p.csv`.
    reader.descriptor_ = own ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
    if (reader.descriptor_ < 0) return base::read_failure(reader.name_, errno);
    Status plain = base::unpack(reader.descriptor_, reader.name_, base::Text::words);
    if (own) reader.owned_.reset(new int(reader.descriptor_));
    if (own && !plain) return plain.error();
    struct stat status {};
    if (::fstat(reader.descriptor_, &status) != 0) return base::read_failure(reader.name_, errno);
    if (S_ISDIR(status.st_mode)) return base::read_failure(reader.name_, EISDIR);
    base::record_input(reader.descriptor_, reader.name_);
    if (S_ISREG(status.st_mode)) reader.then_ = {static_cast<std::uint64_t>(status.st_size), status.st_mtim};
    // A small file takes a small buffer: all of it, and a byte more than that, so that the end is met at once.
    const bool small = S_ISREG(status.st_mode) && static_cast<std::uint64_t>(status.st_size) < longest_line;
    const std::size_t room = small ? static_cast<std::size_t>(status.st_size) + 1 : longest_line;
    reader.buffer_.resize(room + 1);  // the last byte stays zero: a scanner may look at it
    if (!reader.skip_mark()) return reader.error_;
    return reader;
}

void LineReader::Close::operator()(const int* descriptor) const {
    ::close(*descriptor);
    delete descriptor;
}

bool LineReader::skip_mark() {
    while (end_ < 3 && !ended_) {
        if (!refill()) return false;
    }
    const std::string_view head(buffer_.data(), end_);
    if (head.starts_with("\xEF\xBB\xBF")) begin_ = searched_ = 3;
    if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF"))
        error_ = line_error(name_, 1, "the text is not in UTF-8", "UTF-8 or ASCII", "a byte-order mark of UTF-16",
                            "save the file as UTF-8");
    if (head.starts_with("\x93NU")) {
        error_ = file_error(name_, "this is an NPY file", "text: a point a line", {},
                            "name a file that ends in .npy: a stream or a file of another name is read as CSV");
        return false;
    }
    // A smaller part of the file, as a pipe gives, is decided line by line.
    if (const Status text = base::check_beginning(head.substr(0, base::first_block), base::Text::words, name_); !text)
        error_ = text.error();
    if (const OtherFormat* packed = packed_format(head); owned_ && packed != nullptr)
        error_ = other_format_error(*packed, name_);
    return !failed();
}

bool LineReader::refill() {
    if (begin_ != 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        searched_ -= begin_;
        begin_ = 0;
    }
    if (end_ == longest_line) {
        error_ =
            line_error(name_, number_ + 1, "a line is too long", "at most " + std::to_string(longest_line) + " bytes",
                       "more", "check that this is a text file, with a line end after each point");
        return false;
    }
    if (end_ + 1 == buffer_.size()) buffer_.resize(longest_line + 1);  // the file has grown meanwhile
    ssize_t got = 0;
    do {
        got = ::read(descriptor_, buffer_.data() + end_, buffer_.size() - 1 - end_);
    } while (got < 0 && errno == EINTR);
    if (got < 0) {
        error_ = base::read_failure(name_, errno);
        return false;
    }
    end_ += static_cast<std::size_t>(got);
    buffer_[end_] = '\0';
    ended_ = got == 0;
    return true;
}

bool LineReader::more_is_there() const {
    pollfd asked{.fd = descriptor_, .events = POLLIN, .revents = 0};
    return ::poll(&asked, 1, 0) == 1;
}

bool LineReader::end() {
    if (const Status same = unchanged(); !same) error_ = same.error();
    return false;
}

bool LineReader::next(std::string_view& line) {
    if (failed()) return false;
    const char* feed = nullptr;
    while (true) {
        feed = static_cast<const char*>(std::memchr(buffer_.data() + searched_, '\n', end_ - searched_));
        if (feed != nullptr || ended_) break;
        searched_ = end_;
        if (!refill()) return false;
    }
    if (feed == nullptr && begin_ == end_) return end();
    const std::size_t stop = feed == nullptr ? end_ : static_cast<std::size_t>(feed - buffer_.data());
    line = std::string_view(buffer_.data() + begin_, stop - begin_);
    line_ended_ = feed != nullptr || line.ends_with('\r');
    if (line.ends_with('\r')) line.remove_suffix(1);
    begin_ = searched_ = feed == nullptr ? stop : stop + 1;
    ++number_;
    return true;
}

bool LineReader::next_lines(std::string_view& lines) {
    if (failed()) return false;
    // As much as there is room for: a pipe gives little at a time. But a line is not kept waiting for others that may
    // be long in coming.
    const auto held = [&] { return std::string_view(buffer_.data() + begin_, end_ - begin_); };
    while (!ended_ && (begin_ != 0 || end_ != longest_line)) {
        if (held().rfind('\n') != std::string_view::npos && !more_is_there()) break;
        if (!refill()) return false;
    }
    const std::string_view text = held();
    if (text.empty()) return end();
    std::size_t size = text.size();
    if (!ended_) {
        const std::size_t feed = text.rfind('\n');
        if (feed == std::string_view::npos) return refill();  // a line too long: refill() says so
        size = feed + 1;
    }
    lines = text.substr(0, size);
    begin_ = searched_ = begin_ + size;
    return true;
}

}  // namespace barycert::io
