/// Is a file a whole shared library, as far as its headers tell?
#pragma once

#include <string>

#include "barycert/result.hpp"

namespace barycert::kernels {

/// dlopen maps what the headers of an ELF file announce, and touches it: where the file ends before that, the system
/// ends the process (SIGBUS). So every part that a header names must lie within the file. Errors: the file cannot be
/// read, is no regular file, is no shared library in ELF for this machine, or is truncated. What its code does, and
/// whether headers that agree with the file's size are true, is not looked at.
Status check_shared_library(const std::string& path);

}  // namespace barycert::kernels
