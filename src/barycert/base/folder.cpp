#include "barycert/base/folder.hpp"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "barycert/base/nearest_name.hpp"

namespace barycert::base {

std::vector<std::string> names_in_folder(const std::string& folder, std::error_code& failed) {
    const auto close = [](DIR* opened) { ::closedir(opened); };
    const std::unique_ptr<DIR, decltype(close)> opened(::opendir(folder.c_str()), close);
    failed = opened ? std::error_code() : std::error_code(errno, std::generic_category());
    std::vector<std::string> names;
    while (opened) {
        errno = 0;
        const dirent* const entry = ::readdir(opened.get());
        if (entry == nullptr) {
            failed.assign(errno, std::generic_category());
            break;
        }
        const std::string name = entry->d_name;
        if (name != "." && name != "..") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string near_file(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1;
    const std::string folder = path.substr(0, name);
    std::error_code ignored;
    const std::string near = nearest_name(path.substr(name), names_in_folder(folder.empty() ? "." : folder, ignored));
    return near.empty() ? near : folder + near;
}

}  // namespace barycert::base
