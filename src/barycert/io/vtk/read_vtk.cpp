#include "barycert/vtk.hpp"

#include <new>
#include <utility>

#include "barycert/base/mapped_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/vtk/grid_to_mesh.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert {
namespace {

Result<io::RawGrid> read_grid(const std::string& path, io::Part part) {
    const Result<base::MappedFile> file = base::MappedFile::open(path);
    if (!file) return file.error();
    const std::string_view bytes = file->bytes();
    if (bytes.starts_with("# vtk")) return io::read_legacy(bytes, path, part);
    std::string_view text = bytes.substr(0, 4096);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    if (io::next_word(text).starts_with('<')) return io::read_xml(bytes, path, part);
    return Error{.what = bytes.empty() ? "the file is empty" : "not a file of VTK",
                 .file = path,
                 .line = 0,
                 .expected = "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)",
                 .found = {},
                 .remedy = "check the path; unpack a compressed file first"};
}

Error out_of_memory(const std::string& path) {
    return {.what = "too little memory to read the file",
            .file = path,
            .line = 0,
            .expected = {},
            .found = {},
            .remedy = "free some memory, or check whether the file is damaged"};
}

}  // namespace

Result<Mesh> read_vtk(const std::string& path, VtkLeftOut* left_out) {
    const ExactEnvironment environment;
    try {
        Result<io::RawGrid> grid = read_grid(path, io::Part::all);
        if (!grid) return grid.error();
        return io::to_mesh(std::move(*grid), path, left_out);
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension) {
    const ExactEnvironment environment;
    if (dimension != 2 && dimension != 3) {
        return Error{.what = "the dimension of points",
                     .file = path,
                     .line = 0,
                     .expected = "2 or 3",
                     .found = std::to_string(dimension)};
    }
    try {
        Result<io::RawGrid> grid = read_grid(path, io::Part::points);
        if (!grid) return grid.error();
        return io::to_points(std::move(grid->points), dimension, path);
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

}  // namespace barycert
