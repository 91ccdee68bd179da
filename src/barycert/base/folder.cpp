#include "barycert/base/folder.hpp"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <memory>

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

}  // namespace barycert::base
