// barycert-audit reads the files of TetGen and Triangle alone: readers of other formats are much of the time of
// building.

#include "audit_inputs.hpp"
#include "barycert/tetgen_files.hpp"
#include "files/suffix.hpp"

namespace barycert::cli {

std::vector<std::string> audited_files(const std::string& path) {
    return tetgen_files(path);
}

Result<Mesh> read_audited(const std::string& path, const ReadOptions& options) {
    const std::string suffix = base::suffix_of(path);
    const bool other = base::file_exists(path) && !base::has_one_of(path, {".node", ".ele"}) &&
                       !base::file_exists(tetgen_files(path).front());
    if (other)
        return file_error(
            "file.suffix", path, "barycert-audit reads meshes of TetGen and Triangle alone", ".node and .ele",
            suffix.empty() ? "no suffix" : '"' + suffix + '"',
            "`barycert audit` reads all formats; among the sources, build it: ./run barycert check " + path);
    return read_tetgen(path, options);
}

}  // namespace barycert::cli
