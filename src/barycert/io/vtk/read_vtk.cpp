#include "barycert/vtk.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "barycert/base/mapped_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/vtk/collection.hpp"
#include "barycert/io/vtk/grid_to_mesh.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/read_grid.hpp"
#include "barycert/io/vtk/series_file.hpp"
#include "barycert/io/vtk/xml_grids.hpp"
#include "barycert/io/vtk/xml_reader.hpp"

namespace barycert {
namespace {

Error out_of_memory(const std::string& path) {
    return {.what = "too little memory to read the file",
            .file = path,
            .line = 0,
            .expected = {},
            .found = {},
            .remedy = "free some memory, or check whether the file is damaged"};
}

bool is_xml(std::string_view bytes) {
    std::string_view text = bytes.substr(0, 4096);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    return io::next_word(text).starts_with('<');
}

/// The files that a file names; none where it holds data itself.
Result<std::vector<io::CollectionFile>> files_named_in(std::string_view bytes, const std::string& path) {
    if (io::is_series_file(bytes)) return io::series_files(bytes, path);
    if (!is_xml(bytes)) return std::vector<io::CollectionFile>();
    const Result<io::XmlTree> tree = io::parse_xml(bytes, path);
    if (!tree) return tree.error();
    if (!io::is_collection(*tree)) return std::vector<io::CollectionFile>();
    return io::collection_files(*tree, bytes, path);
}

/// Of files that name files, each is read once.
class GridReader {
public:
    explicit GridReader(io::Part part) : part_(part) {}

    Result<io::RawGrid> read(const std::string& path) {
        constexpr int deepest = 16;
        if (depth_ == deepest) {
            return Error{.what = "files that name files too deeply",
                         .file = path,
                         .expected = "at most " + std::to_string(deepest) + " of them one in the other",
                         .found = "more"};
        }
        ++depth_;
        Result<io::RawGrid> grid = read_one(path);
        --depth_;
        return grid;
    }

private:
    Result<io::RawGrid> read_one(const std::string& path) {
        const Result<base::MappedFile> file = base::MappedFile::open(path);
        if (!file) return file.error();
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second) {
            return Error{.what = "a file that is named twice in a collection of files",
                         .file = path,
                         .expected = "every piece once",
                         .found = {},
                         .remedy = "correct the file that names it"};
        }
        std::string_view bytes = file->bytes();
        if (bytes.starts_with("\xEF\xBB\xBF# vtk")) bytes.remove_prefix(3);  // byte order mark
        if (bytes.starts_with("# vtk")) return io::read_legacy(bytes, path, part_);
        if (io::is_series_file(bytes)) {
            const Result<std::vector<io::CollectionFile>> files = io::series_files(bytes, path);
            if (!files) return files.error();
            return read_first_step(*files, path);
        }
        if (!is_xml(bytes)) {
            return Error{.what = bytes.empty() ? "the file is empty" : "not a file of VTK",
                         .file = path,
                         .line = 0,
                         .expected = "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)",
                         .found = {},
                         .remedy = "check the path; unpack a compressed file first"};
        }
        const Result<io::XmlTree> tree = io::parse_xml(bytes, path);
        if (!tree) return tree.error();
        if (!io::is_collection(*tree)) return io::read_xml(bytes, *tree, path, part_);
        const Result<std::vector<io::CollectionFile>> files = io::collection_files(*tree, bytes, path);
        if (!files) return files.error();
        return io::is_series(*tree) ? read_first_step(*files, path) : read_all(*files, path);
    }

    Result<io::RawGrid> read_all(const std::vector<io::CollectionFile>& files, const std::string& path) {
        io::RawGrid grid;
        std::vector<std::string> others;
        for (const io::CollectionFile& file : files) {
            if (part_ == io::Part::all && is_other_kind(file.path)) {
                others.push_back(file.block.empty() ? file.path : file.block + " (" + file.path + ")");
                continue;
            }
            Result<io::RawGrid> piece = read(file.path);
            if (!piece) return piece;
            if (Status s = io::append_piece(grid, std::move(*piece), path); !s) return s.error();
        }
        if (!others.empty()) {
            grid.notes.push_back(
                {Note::Kind::left_out,
                 std::to_string(others.size()) + " blocks that are no unstructured grids: " + io::list_of(others), path,
                 true});
        }
        if (part_ == io::Part::all) io::join_pieces(grid, path);
        return grid;
    }

    Result<io::RawGrid> read_first_step(const std::vector<io::CollectionFile>& files, const std::string& path) {
        const std::vector<SeriesStep> steps = io::steps_of(files);
        if (steps.empty()) {
            return Error{
                .what = "a series without steps", .file = path, .expected = "a file for each step", .found = "none"};
        }
        std::vector<io::CollectionFile> first;
        for (const std::string& file : steps.front().files) first.push_back({file, {}, 0});
        Result<io::RawGrid> grid = read_all(first, path);
        if (grid && steps.size() > 1) {
            grid->notes.push_back({Note::Kind::left_out,
                                   "all steps but the first of a series of " + std::to_string(steps.size()), path,
                                   true});
        }
        return grid;
    }

    /// Blocks of surfaces and grids beside the mesh.
    static bool is_other_kind(const std::string& path) {
        const std::string suffix = std::filesystem::path(path).extension().string();
        return suffix == ".vtp" || suffix == ".vti" || suffix == ".vtr" || suffix == ".vts" || suffix == ".pvtp" ||
               suffix == ".pvti" || suffix == ".pvtr" || suffix == ".pvts" || suffix == ".vtt" || suffix == ".vth";
    }

    io::Part part_;
    std::set<std::string> seen_;
    int depth_ = 0;
};

template <class T>
Result<T> without_throwing(const std::string& path, const std::function<Result<T>()>& read) {
    const ExactEnvironment environment;
    try {
        return read();
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

}  // namespace

namespace io {

Result<RawGrid> read_grid(const std::string& path, Part part) {
    return GridReader(part).read(path);
}

}  // namespace io

Result<Mesh> read_vtk(const std::string& path) {
    return without_throwing<Mesh>(path, [&]() -> Result<Mesh> {
        Result<io::RawGrid> grid = io::read_grid(path, io::Part::all);
        if (!grid) return grid.error();
        return io::to_mesh(std::move(*grid), path);
    });
}

Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension) {
    Result<PointData> data = read_vtk_point_data(path, dimension, {});
    if (!data) return data.error();
    return std::move(data->points);
}

Result<PointData> read_vtk_point_data(const std::string& path, int dimension,
                                      const std::optional<std::vector<std::string>>& names) {
    if (dimension != 2 && dimension != 3) {
        return Error{.what = "the dimension of points",
                     .file = path,
                     .line = 0,
                     .expected = "2 or 3",
                     .found = std::to_string(dimension)};
    }
    return without_throwing<PointData>(path, [&]() -> Result<PointData> {
        const bool arrays = !names.has_value() || !names->empty();
        Result<io::RawGrid> grid = io::read_grid(path, arrays ? io::Part::point_arrays : io::Part::points);
        if (!grid) return grid.error();
        PointData data;
        data.dimension = dimension;
        data.notes = std::move(grid->notes);
        Result<std::vector<double>> points = io::to_points(std::move(grid->points), dimension, path);
        if (!points) return points.error();
        data.points = std::move(*points);
        if (names.has_value()) {
            std::erase_if(grid->point_arrays, [&](const io::RawArray& array) {
                return std::find(names->begin(), names->end(), array.field.name) == names->end();
            });
        }
        io::take_fields(grid->point_arrays, "point array", path, data.fields, &data.labels, data.notes);
        if (grid->narrow_points)
            data.notes.push_back({Note::Kind::converted, "float32 to double: the coordinates", path});
        return data;
    });
}

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return without_throwing<std::vector<SeriesStep>>(path, [&]() -> Result<std::vector<SeriesStep>> {
        const Result<base::MappedFile> file = base::MappedFile::open(path);
        if (!file) return file.error();
        if (io::is_series_file(file->bytes())) {
            const Result<std::vector<io::CollectionFile>> files = io::series_files(file->bytes(), path);
            if (!files) return files.error();
            return io::steps_of(*files);
        }
        const Result<io::XmlTree> tree = io::parse_xml(file->bytes(), path);
        if (!tree) return tree.error();
        if (!io::is_series(*tree)) {
            return Error{.what = "the kind of the file",
                         .file = path,
                         .line = 1,
                         .expected = "a VTKFile of type Collection (.pvd), or ParaView's JSON (.vtu.series)",
                         .found = io::in_quotes(tree->root().attribute("type").value_or(tree->root().name))};
        }
        const Result<std::vector<io::CollectionFile>> files = io::collection_files(*tree, file->bytes(), path);
        if (!files) return files.error();
        return io::steps_of(*files);
    });
}

std::vector<std::string> vtk_mesh_files(const std::string& path) {
    std::vector<std::string> all{path};
    const std::string suffix = std::filesystem::path(path).extension().string();
    if (suffix == ".vtu" || suffix == ".vtk" || suffix == ".vtp") return all;
    // Names within names; what cannot be read is told by the reader.
    std::set<std::string> known{path};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Result<base::MappedFile> file = base::MappedFile::open(all[i]);
        if (!file) continue;
        const Result<std::vector<io::CollectionFile>> files = files_named_in(file->bytes(), all[i]);
        if (!files) continue;
        for (const io::CollectionFile& named : *files) {
            if (known.insert(named.path).second) all.push_back(named.path);
        }
    }
    return all;
}

}  // namespace barycert
