#include "barycert/base/named_file.hpp"

#include <cstddef>
#include <filesystem>
#include <system_error>

namespace barycert {

namespace fs = std::filesystem;

namespace {

/// Not streams and devices: /dev/stdin and /dev/stdout may well be one terminal.
bool can_be_overwritten(const std::string& path) {
    if (path == "-") return false;
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    return !fs::exists(status) || fs::is_regular_file(status);
}

}  // namespace

bool same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    if (a == b) return true;
    if (a == "-" || b == "-") return false;
    std::error_code unknown;
    if (fs::equivalent(a, b, unknown)) return true;
    // Without absolute() a relative path of which nothing exists would stay relative.
    const fs::path one = fs::weakly_canonical(fs::absolute(a, unknown), unknown);
    return !unknown && one == fs::weakly_canonical(fs::absolute(b, unknown), unknown) && !unknown;
}

Status check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& out = outputs[i];
        for (const NamedFile& in : inputs) {
            if (!can_be_overwritten(out.path) || !same_file(out.path, in.path)) continue;
            return Error{.what = out.what + " would overwrite " + in.what,
                         .file = out.path,
                         .remedy = "choose another name for the output"};
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (!same_file(out.path, outputs[k].path)) continue;
            return Error{.what = outputs[k].what + " and " + out.what + " name the same output",
                         .file = out.path,
                         .remedy = "give each its own"};
        }
    }
    return Done{};
}

}  // namespace barycert
