#include "files/suffix.hpp"

#include <filesystem>
#include <string>
#include <system_error>

namespace barycert::base {

bool file_exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

}  // namespace barycert::base
