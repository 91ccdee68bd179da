/// The words and numbers of VTK's legacy files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {

std::string capitals(std::string_view word);

/// A place in a legacy file. Words are separated by white space; in a binary file the numbers of an array stand in
/// big-endian order behind the end of the line that announces it.
///
/// The first error is kept. From then on the file is as if it ended there: there are no words, and nothing is read.
class LegacyText {
public:
    LegacyText(std::string_view bytes, const std::string& path) : bytes_(bytes), rest_(bytes), path_(path) {}

    const Status& status() const { return status_; }
    const std::string& path() const { return path_; }

    /// The first three lines: version, title, ASCII or BINARY.
    void read_head();
    int major_version() const { return major_version_; }
    bool binary() const { return binary_; }

    /// What is left of the file, to which one can go back.
    std::string_view rest() const { return rest_; }
    void go_back(std::string_view rest) { rest_ = rest; }

    /// The next word; empty at the end of the file.
    std::string word() { return std::string(next_word(rest_)); }
    /// The next word in capitals, as which keywords are compared.
    std::string keyword();
    /// The same, which stays the next word.
    std::string next_keyword() const;
    /// The next word as a name: %20 and the like are one byte.
    std::string name();
    /// What is left of the line, which is then behind.
    std::string_view rest_of_line();
    void expect(const char* wanted);
    /// Lines up to an empty one.
    void skip_metadata();

    /// The next word as a count, at most that of entities in a mesh.
    std::size_t count(const std::string& what);
    NumberType number_type(const std::string& what);

    /// Exactly `count` numbers; as XmlArrays::read.
    void numbers(const std::string& what, NumberType type, std::uint64_t count, NumbersTo values,
                 NumberFault* fault = nullptr);
    /// Bytes 0 to 255, which in an ASCII file are written as shares of 255.
    void colors(const std::string& what, std::uint64_t count, std::vector<double>& values);
    /// Strings of an array: a line each, or in a binary file, but for variants (`in_lines`), their length and bytes.
    /// `texts`: where they go, if they are wanted.
    void strings(const std::string& what, bool in_lines, std::uint64_t count, std::vector<std::string>* texts);

    /// An error at this place.
    void fail(std::string what, std::string expected, std::string found, std::string remedy = {});

private:
    void fail(Error error);
    /// Of that place in the file.
    std::size_t line_at(const char* place) const;

    std::string_view bytes_;
    std::string_view rest_;
    std::string path_;
    Status status_ = Done{};
    int major_version_ = 0;
    bool binary_ = false;
};

}  // namespace barycert::io
