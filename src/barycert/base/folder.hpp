/// What is in a folder. In place of std::filesystem::directory_iterator, which ends the process where memory is short.
#pragma once

#include <string>
#include <system_error>
#include <vector>

namespace barycert::base {

/// Names of all in a folder but "." and "..", sorted. `failed` tells why they are not all there.
std::vector<std::string> names_in_folder(const std::string& folder, std::error_code& failed);

/// The file that may be meant by a path where there is none: a near name in the same folder; empty if there is none.
std::string near_file(const std::string& path);

}  // namespace barycert::base
