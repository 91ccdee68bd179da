#include "files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/io.hpp"
#include "barycert/plc.hpp"

namespace barycert::cli {
namespace {

CLI::Validator not_empty() {
    return {[](std::string& text) { return text.empty() ? "expected the name of a file, found \"\"" : ""; }, ""};
}

Status check_writable(const std::string& path) {
    if (path == "-") {
        if (fcntl(STDOUT_FILENO, F_GETFD) < 0)
            return Error{.what = "cannot write to stdout", .found = std::strerror(errno)};
        return Done{};
    }
    // A pipe would see its writer come and go: only ask of it whether it may be written.
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
        if (access(path.c_str(), W_OK) != 0)
            return Error{.what = "cannot write the file", .file = path, .found = std::strerror(errno)};
        return Done{};
    }
    return OutputFile(path).close();
}

std::vector<NamedFile> named(const std::string& what, std::vector<std::string> paths) {
    std::vector<NamedFile> files;
    files.reserve(paths.size());
    for (std::string& path : paths) files.push_back({what, std::move(path)});
    return files;
}

}  // namespace

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::string& path, const std::string& help) {
    return sub.add_option(name, path, help)->check(not_empty())->type_name("FILE");
}

CLI::Option* file_option(CLI::App& sub, const std::string& name, std::vector<std::string>& paths,
                         const std::string& help) {
    return sub.add_option(name, paths, help)->check(not_empty())->type_name("FILE")->allow_extra_args(false);
}

bool has_suffix(const std::string& path, std::string_view suffix) {
    if (path.size() < suffix.size()) return false;
    return std::equal(
        suffix.begin(), suffix.end(), path.end() - static_cast<std::ptrdiff_t>(suffix.size()),
        [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); });
}

bool is_vtk_file(const std::string& path) {
    return has_suffix(path, ".vtu") || has_suffix(path, ".vtk") || has_suffix(path, ".vtp");
}

std::vector<NamedFile> files_of_mesh(const std::string& what, const std::string& path) {
    return named(what, is_vtk_file(path) ? std::vector{path} : tetgen_files(path));
}

std::vector<NamedFile> files_of_plc(const std::string& what, const std::string& path) {
    return named(what, plc_files(path));
}

Status check_outputs(const std::vector<NamedFile>& inputs, std::vector<NamedFile> outputs) {
    std::erase_if(outputs, [](const NamedFile& f) { return f.path.empty(); });
    if (Status distinct = check_distinct(inputs, outputs); !distinct) return distinct;
    for (const NamedFile& out : outputs) {
        if (Status ok = check_writable(out.path); !ok) return ok;
    }
    return Done{};
}

Status check_inputs(const std::vector<NamedFile>& inputs) {
    for (const NamedFile& in : inputs) {
        if (in.path == "-") {
            if (fcntl(STDIN_FILENO, F_GETFD) < 0)
                return Error{.what = "cannot read the standard input", .found = std::strerror(errno)};
        } else if (access(in.path.c_str(), R_OK) != 0) {
            return Error{.what = "cannot read the file",
                         .file = in.path,
                         .found = std::strerror(errno),
                         .remedy = "check the name and the permissions"};
        }
    }
    return Done{};
}

Status write_output(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
            return Error{.what = "cannot write to stdout", .found = std::strerror(errno)};
        return Done{};
    }
    OutputFile file(path);
    file.write(bytes);
    return file.commit();
}

}  // namespace barycert::cli
