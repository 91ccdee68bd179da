/// Files that appear whole or not at all.
#pragma once

#include <string>
#include <string_view>

#include "barycert/core/result.hpp"

namespace barycert {

/// Writes beside the target and renames on commit(), so that a killed run leaves the target as it was. Without a
/// commit() the temporary file is removed by the destructor. Errors (no space, no permission) are told by commit().
class OutputFile {
public:
    explicit OutputFile(std::string target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);
    Status commit();

private:
    void fail(const char* what, int error_number);

    std::string target_;
    std::string temporary_;
    std::string buffer_;
    int descriptor_ = -1;
    Error error_;
};

}  // namespace barycert
