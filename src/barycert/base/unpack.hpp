/// Files packed by gzip, unpacked before anyone reads them.
#pragma once

#include <string>

#include "barycert/result.hpp"

namespace barycert::base {

/// Where `descriptor` is a regular file packed by gzip, of one member or several, it becomes one of the unpacked bytes,
/// which are in memory and have no name. Error: it is damaged or cut off; unpacked it would take more than half of the
/// machine's memory, or more than 200 times its size and 256 MiB, as no table of numbers does.
Status unpack(int& descriptor, const std::string& path);

}  // namespace barycert::base
