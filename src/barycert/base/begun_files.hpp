/// Names of unfinished files, on record.
#pragma once

#include <atomic>
#include <string>

#include "barycert/base/output_file.hpp"

namespace barycert::base {

/// From before the file exists until it is renamed or removed. In a list that only grows: a signal handler may walk it
/// at any moment, in any thread, without a lock. Some tens of bytes for each file that needed a name.
struct BegunName {
    const std::string path;
    std::atomic<bool> live{true};
    BegunName* next = nullptr;
};

/// Safe to call from any thread.
BegunName* begin_name(std::string path);

}  // namespace barycert::base
