/// The words and numbers of VTK's legacy files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {

/// A place in a legacy file. Words are separated by white space; in a binary file the numbers of an array stand in
/// big-endian order behind the end of the line that announces it. A copy remembers the place.
class LegacyText {
public:
    LegacyText(std::string_view bytes, const std::string& path) : bytes_(bytes), rest_(bytes), path_(&path) {}

    /// The first three lines: version, title, ASCII or BINARY.
    Status read_head();
    const std::string& path() const { return *path_; }
    int major_version() const { return major_version_; }
    bool binary() const { return binary_; }

    /// The next word; empty at the end of the file.
    std::string word();
    /// The next word in capitals, as which keywords are compared.
    std::string keyword();
    /// The next word as a name: %20 and the like are one byte.
    std::string name();
    /// What is left of the line, which is then behind.
    std::string_view rest_of_line();
    Status expect(const char* wanted);
    Status skip_line();
    /// Lines up to an empty one.
    Status skip_metadata();

    /// The next word as a count, at most that of entities in a mesh.
    Result<std::size_t> count(const std::string& what);
    Result<NumberType> number_type(const std::string& what);
    static std::optional<NumberType> number_type_named(std::string_view name);
    static bool is_text(std::string_view type);

    /// Exactly `count` numbers; as XmlArrays::read.
    template <class To>
    Status numbers(const std::string& what, NumberType type, std::uint64_t count, std::vector<To>& values,
                   NumberFault* fault = nullptr);
    /// Bytes 0 to 255, which in an ASCII file are written as shares of 255.
    Status colors(const std::string& what, std::uint64_t count, std::vector<double>& values);
    Status skip_colors(std::uint64_t count);
    /// Strings of an array: a line each, or in a binary file their length and bytes.
    /// `texts`: where they go, if they are wanted.
    Status strings(const std::string& what, std::string_view type, std::uint64_t count,
                   std::vector<std::string>* texts);

    /// An error at this place.
    Error error(std::string what, std::string expected, std::string found, std::string remedy = {}) const;

private:
    /// The line where `rest` begins, which is what is left of the file at that place.
    std::size_t line_of(std::string_view rest) const;

    std::string_view bytes_;
    std::string_view rest_;
    const std::string* path_;
    int major_version_ = 0;
    bool binary_ = false;
};

}  // namespace barycert::io
