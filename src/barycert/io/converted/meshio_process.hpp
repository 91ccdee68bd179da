/// meshio in a process of its own.
#pragma once

#include <string>

#include "barycert/result.hpp"

namespace barycert::io {

/// A file that meshio has read.
struct MeshioFile {
    std::string vtu;       ///< the path of the mesh as a .vtu file without a name, there as long as this is
    std::string answer;    ///< what was read, JSON
    std::string messages;  ///< what meshio printed, cut off where it is long

    MeshioFile() = default;
    MeshioFile(MeshioFile&& other) noexcept;
    ~MeshioFile();

    int descriptor = -1;
};

/// Has `path` read as what meshio calls `format`, by the Python of BARYCERT_MESHIO, else python3 or /usr/bin/python3.
///
/// The process is started without fork(), in a session of its own, with limits of time, memory and output; it is ended
/// as a whole, also by the end of this process, and leaves no file. Error: there is no meshio, it may not be used, it
/// did not come to its end.
Result<MeshioFile> run_meshio(const std::string& path, const std::string& format);

}  // namespace barycert::io
