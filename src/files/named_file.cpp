#include "files/named_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/result.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"

namespace barycert::base {

namespace fs = std::filesystem;

namespace {

/// Not streams and devices: /dev/stdin and /dev/stdout may well be one terminal.
bool can_be_overwritten(const std::string& path) {
    std::error_code unknown;
    const fs::file_status status = fs::status(path, unknown);
    return !fs::exists(status) || fs::is_regular_file(status);
}

Status check_writable(const std::string& path) {
    if (path == "-") {
        if (fcntl(STDOUT_FILENO, F_GETFD) >= 0) return Done{};
        return Error{.code = "file.unwritable", .what = "cannot write to stdout", .found = std::strerror(errno)};
    }
    // A pipe would see its writer come and go: only ask of it whether it may be written.
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
        if (access(path.c_str(), W_OK) == 0) return Done{};
        return Error{
            .code = "file.unwritable", .what = "cannot write the file", .file = path, .found = std::strerror(errno)};
    }
    return OutputFile(path).close();
}

}  // namespace

bool same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    if (a == b) return true;
    if (a == "-" || b == "-") return false;
    std::error_code unknown;
    if (fs::equivalent(a, b, unknown)) return true;
    // Without absolute() a relative path of which nothing exists would stay relative.
    const auto real = [&](const std::string& path) {
        return fs::weakly_canonical(fs::absolute(resolved_path(path), unknown), unknown);
    };
    const fs::path one = real(a);
    return !unknown && one == real(b) && !unknown;
}

Status check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const NamedFile& out = outputs[i];
        // A standard stream may be redirected from or to a file.
        const std::string path = out.path == "-" ? "/dev/stdout" : out.path;
        for (const NamedFile& in : inputs) {
            if (!can_be_overwritten(path) || !same_file(path, in.path == "-" ? "/dev/stdin" : in.path)) continue;
            return about(out.what, file_error("file.overwrite", out.path, out.what + " would overwrite " + in.what, {},
                                              {}, "choose another name for the output"));
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (!same_file(out.path, outputs[k].path)) continue;
            return about(out.what, file_error("file.overwrite", out.path,
                                              outputs[k].what + " and " + out.what + " name the same output", {}, {},
                                              "choose two different names"));
        }
    }
    return Done{};
}

std::vector<NamedFile> named_files(const std::string& what, std::vector<std::string> paths, bool of_mesh) {
    std::vector<NamedFile> files;
    files.reserve(paths.size());
    for (std::string& path : paths) files.push_back({what, std::move(path), of_mesh});
    return files;
}

Status check_outputs(const std::vector<NamedFile>& inputs, std::vector<NamedFile> outputs) {
    std::erase_if(outputs, [](const NamedFile& f) { return f.path.empty(); });
    if (Status distinct = check_distinct(inputs, outputs); !distinct) return distinct;
    for (const NamedFile& out : outputs) {
        for (const std::string_view place : {step_place, time_place}) {
            if (out.path.find(place) == std::string::npos) continue;
            return about(
                out.what,
                file_error("series.place", out.path,
                           out.what + " has a place for a step, and there are no steps to fill it",
                           "a name without " + std::string(place), {},
                           "files of steps are job.output of sample and resample, of a series as mesh or field: a "
                           ".pvd or .vtu.series file, or job.field_files NAME@'step-*.npy'; elsewhere choose one "
                           "step by job.step or job.time"));
        }
        if (Status ok = check_writable(out.path); !ok) return ok;
    }
    return Done{};
}

Status check_inputs(const std::vector<NamedFile>& inputs) {
    for (const NamedFile& in : inputs) {
        if (in.path == "-") {
            if (fcntl(STDIN_FILENO, F_GETFD) < 0)
                return Error{
                    .code = "file.unreadable", .what = "cannot read the standard input", .found = std::strerror(errno)};
        } else if (access(in.path.c_str(), R_OK) != 0) {
            if (errno == ENOENT) return read_failure(in.path, errno);
            return file_error("file.unreadable", in.path, "cannot read the file", {}, std::strerror(errno),
                              "check the name and the permissions");
        }
    }
    return Done{};
}

}  // namespace barycert::base
