// What all subcommands share: the mesh, what is said on stderr, what the terminal is like.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "barycert/base/text.hpp"
#include "barycert/io/vtk/vtk_missing.hpp"
#include "command.hpp"
#include "files.hpp"

#ifdef BARYCERT_WITH_VTK
#include "barycert/vtk.hpp"
#endif

namespace barycert::cli {
namespace {

namespace fs = std::filesystem;

/// A mesh that is not there is often a PLC, a folder or a mistyped stem.
Error with_hint(Error error, const fs::path& path) {
    std::error_code ignored;
    const std::string extension = path.extension().string();
    constexpr std::array plc{".poly", ".smesh", ".off", ".stl", ".ply"};
    if (std::find(plc.begin(), plc.end(), extension) != plc.end()) {
        error.remedy = "this is a PLC, not a mesh: mesh it first with `barycert mesh " + path.string() + "`";
    } else if (!fs::exists(path, ignored) && !fs::exists(path.string() + ".node", ignored)) {
        error.remedy = "MESH is the stem of TetGen's files, or one of them: part.1 for part.1.node and part.1.ele";
    } else if (fs::is_directory(path, ignored) && !fs::exists(path.string() + ".node", ignored)) {
        error.remedy = "this is a folder: name the stem of TetGen's files in it";
    }
    return error;
}

}  // namespace

void tell(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int fail(const Error& error) {
    std::fflush(stdout);
    tell(fmt::format("error: {}\n", error.message()));
    return exit_error;
}

Result<Mesh> load_mesh(const std::string& path, const ReadOptions& options) {
    if (is_vtk_file(path)) {
#ifdef BARYCERT_WITH_VTK
        return read_vtk(path);
#else
        return vtk_missing(path);
#endif
    }
    Result<Mesh> mesh = read_tetgen(path, options);
    if (!mesh) return with_hint(mesh.error(), path);
    return mesh;
}

std::string command_name() {
    const char* wrapper = std::getenv("BARYCERT_COMMAND");
    return wrapper == nullptr || *wrapper == '\0' ? "barycert" : printable(wrapper);
}

bool colour_on_stdout() {
    const char* no_colour = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (no_colour == nullptr || *no_colour == '\0');
}

bool stderr_is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

}  // namespace barycert::cli
