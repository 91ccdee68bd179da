/// A section from its beginning: headers number by number, rows passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Each step is false if what it wants is not there; error() then says so. Nothing may follow a failed step.
class Walk {
public:
    /// `layout`: how the section's text is laid out; what is short may always be `free`.
    Walk(const MshFile& file, const MshSection& section, MshLayout layout);
    Walk(const MshFile& file, const MshSection& section) : Walk(file, section, file.layout()) {}

    bool integer(std::int64_t& value, const char* name);  ///< int
    bool size(std::int64_t& value, const char* name);     ///< size_t; not negative
    bool real(double& value, const char* name);
    bool end_header();
    /// A number on a line of its own, which is text in binary files too; not negative.
    bool count_line(std::int64_t& value, const char* name);

    Place place() const { return place_; }
    /// Moves over rows: so many lines, numbers or bytes.
    bool skip_rows(std::int64_t rows, std::size_t numbers, std::size_t bytes, const char* name);
    /// White space and nothing else is left.
    bool at_end();

    Error error() const;
    bool refuse(std::string what, std::string expected, std::string found, std::string remedy = {});
    /// Goes on at the start of a line.
    void move_to(const char* at);

private:
    bool text() const { return layout_ != MshLayout::binary; }
    void skip();
    bool take(const char* after, const char* name);
    bool number(std::int64_t& value, std::size_t bytes, const char* name);
    std::uint64_t skip_numbers(std::uint64_t count);  ///< how many there were

    const MshFile& file_;
    std::string_view name_;
    MshLayout layout_;
    Place place_;
    const char* end_;  // of the section
    std::string what_, expected_, found_, remedy_;
};

}  // namespace barycert::io
