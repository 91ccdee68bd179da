#include "files.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "barycert/base/output_file.hpp"

namespace barycert::cli {
namespace {

CLI::Validator not_empty() {
    return {[](std::string& text) { return text.empty() ? "expected the name of a file, found \"\"" : ""; }, ""};
}

}  // namespace

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::string& path, const std::string& help) {
    return sub.add_option(name, path, help)->check(not_empty())->type_name("FILE");
}

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::vector<std::string>& paths,
                         const std::string& help) {
    return sub.add_option(name, paths, help)->check(not_empty())->type_name("FILE")->allow_extra_args(false);
}

Status write_output(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
            return Error{.what = "cannot write to stdout", .found = std::strerror(errno)};
        return Done{};
    }
    base::OutputFile file(path);
    file.write(bytes);
    return file.commit();
}

Status all_written(const std::vector<Status>& written) {
    const auto wrong = std::find_if(written.begin(), written.end(), [](const Status& status) { return !status; });
    return wrong == written.end() ? Status(Done{}) : *wrong;
}

}  // namespace barycert::cli
