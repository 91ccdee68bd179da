#include "app/cli/tetgen_alone.hpp"

#include <string>

#include "barycert/result.hpp"
#include "barycert/tetgen_files.hpp"
#include "files/format.hpp"
#include "files/suffix.hpp"

namespace barycert::cli {

void refuse_other_formats(const std::string& path, const std::string& program) {
    const bool tetgen = base::is_tetgen(base::kind_of(path)) || base::file_exists(tetgen_files(path).front());
    if (tetgen || !base::file_exists(path)) return;
    const std::string suffix = base::suffix_of(path);
    throw Exception(
        file_error("file.suffix", path, program + " reads meshes of TetGen and Triangle alone", ".node and .ele",
                   suffix.empty() ? "no suffix" : '"' + suffix + '"',
                   "`barycert` reads all formats; among the sources, `./run barycert check " + path + "` builds it"));
}

}  // namespace barycert::cli
