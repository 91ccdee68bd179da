/// Paths of files as readers and writers look at them.
#pragma once

#include <string>
#include <string_view>

#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/suffix.hpp"

namespace barycert::io {

using base::FormatKind;
using base::has_one_of;
using base::has_suffix;
using base::lower;
using base::stem_of;
using base::suffix_of;
using base::whole_number;
using base::without_gz;

inline bool exists(const std::string& path) {
    return base::file_exists(path);
}

/// Whether it is the standard input, a pipe or a device.
bool is_read_once(const std::string& path);

/// The path, or with .gz at its end where there is only such a file.
inline std::string plain_or_packed(const std::string& path) {
    return !exists(path) && exists(path + ".gz") ? path + ".gz" : path;
}

inline bool is_vtk_file(std::string_view path) {
    return base::is_vtk(base::kind_of(path));
}

}  // namespace barycert::io
