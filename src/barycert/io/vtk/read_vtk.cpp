#include "barycert/io.hpp"

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/mapped_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/collection.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml.hpp"

namespace barycert {
namespace {

bool is_xml(std::string_view bytes) {
    std::string_view text = bytes.substr(0, 4096);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    return io::next_word(text).starts_with('<');
}

Error not_of_vtk(const std::string& path, const char* what) {
    return file_error(path, what, "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)", {},
                      "check the path; unpack a compressed file first");
}

/// The whole file, of which the first block has to show that it is of VTK.
Result<base::MappedFile> open_file(const std::string& path) {
    return base::MappedFile::open(path, 1, base::Text::head, [&](std::string_view block, std::uint64_t) -> Status {
        if (block.starts_with("\xEF\xBB\xBF")) block.remove_prefix(3);
        if (block.starts_with("# vtk")) return io::check_legacy_head(block, path);
        if (io::is_series_file(block) || (is_xml(block) && block.find("<VTKFile") != std::string_view::npos))
            return Done{};
        return not_of_vtk(path, "not a file of VTK");
    });
}

/// What a file that is not of the legacy format holds.
struct Contents {
    std::optional<io::XmlTree> tree;
    std::optional<io::Collection> collection;  ///< the files that it names
};

Result<Contents> contents_of(std::string_view bytes, const std::string& path) {
    Contents contents;
    if (io::is_series_file(bytes)) {
        Result<io::Collection> series = io::read_series_file(bytes, path);
        if (!series) return series.error();
        contents.collection = std::move(*series);
    } else if (is_xml(bytes)) {
        Result<io::XmlTree> tree = io::parse_xml(bytes, path);
        if (!tree) return tree.error();
        Result<std::optional<io::Collection>> named = io::collection_of(*tree);
        if (!named) return named.error();
        contents = {std::move(*tree), std::move(*named)};
    }
    return contents;
}

/// Of files that name files, each is read once.
class GridReader {
public:
    GridReader(io::Part part, const StepChoice& step) : part_(part), step_(step), chosen_(!step.made()) {}

    Result<io::RawGrid> read(const std::string& path) {
        constexpr int deepest = 16;
        if (depth_ == deepest) {
            return file_error(path, "files that name files too deeply",
                              "at most " + std::to_string(deepest) + " of them one in the other", "more");
        }
        ++depth_;
        Result<io::RawGrid> grid = read_one(path);
        --depth_;
        if (grid && depth_ == 0 && !chosen_) return io::no_series(path);
        return grid;
    }

private:
    Result<io::RawGrid> read_one(const std::string& path) {
        const Result<base::MappedFile> file = open_file(path);
        if (!file) return file.error();
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second) {
            return file_error(path, "a file that is named twice in a collection of files", "every piece once", {},
                              "correct the file that names it");
        }
        std::string_view bytes = file->bytes();
        if (bytes.starts_with("\xEF\xBB\xBF# vtk")) bytes.remove_prefix(3);  // byte order mark
        if (bytes.starts_with("# vtk")) return io::read_legacy(bytes, path, part_);
        const Result<Contents> contents = contents_of(bytes, path);
        if (!contents) return contents.error();
        if (const auto& named = contents->collection; named)
            return named->is_series ? read_step(named->files, path) : read_all(named->files, path);
        if (contents->tree) return io::read_xml(*contents->tree, part_);
        return not_of_vtk(path, bytes.empty() ? "the file is empty" : "not a file of VTK");
    }

    /// Whether a grid that is no polygon data is among the files, or those that they name.
    static bool has_cells_of_grids(const std::vector<io::CollectionFile>& files) {
        for (const io::CollectionFile& file : files) {
            if (is_polygons(file.path)) continue;
            for (const std::string& named : vtk_mesh_files(file.path)) {
                if (io::has_suffix(named, ".vtu") || io::has_suffix(named, ".vtk")) return true;
            }
        }
        return false;
    }

    Result<io::RawGrid> read_all(const std::vector<io::CollectionFile>& files, const std::string& path) {
        io::RawGrid grid;
        std::vector<std::string> others;
        if (!polygons_) polygons_ = !has_cells_of_grids(files);
        for (const io::CollectionFile& file : files) {
            if (part_ == io::Part::all && is_other_kind(file.path) && !(*polygons_ && is_polygons(file.path))) {
                others.push_back(file.block.empty() ? file.path : file.block + " (" + file.path + ")");
                continue;
            }
            std::error_code unknown;
            if (std::filesystem::status(file.path, unknown).type() == std::filesystem::file_type::not_found)
                return Error{"a file that is named here is missing", path, file.line, file.path, "no such file",
                             "put it there, or correct the name"};
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

    /// The step that is chosen; of a series within a series the first.
    Result<io::RawGrid> read_step(const std::vector<io::CollectionFile>& files, const std::string& path) {
        const std::vector<SeriesStep> steps = io::steps_of(files);
        const StepChoice choice = std::exchange(step_, {});
        chosen_ = true;
        const Result<std::size_t> number = io::chosen_step(steps, choice, path);
        if (!number) return number.error();
        std::size_t begin = 0;
        for (std::size_t i = 0; i < *number; ++i) begin += steps[i].files.size();
        const auto first = files.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto count = static_cast<std::ptrdiff_t>(steps[*number].files.size());
        Result<io::RawGrid> grid = read_all({first, first + count}, path);
        // Who names a number knows what is read.
        if (!grid || steps.size() == 1 || choice.number) return grid;
        const std::string which = *number == 0 ? "the first" : "number " + std::to_string(*number);
        grid->notes.push_back({Note::Kind::left_out,
                               "all steps but " + which + " of a series of " + std::to_string(steps.size()) +
                                   ": read is the time " + base::shortest(steps[*number].time),
                               path, !choice.made()});
        return grid;
    }

    static bool is_polygons(const std::string& path) {
        return io::has_suffix(path, ".vtp") || io::has_suffix(path, ".pvtp");
    }

    /// Blocks of surfaces and grids beside the mesh.
    static bool is_other_kind(const std::string& path) {
        constexpr std::string_view others = " .vtp .vti .vtr .vts .pvtp .pvti .pvtr .pvts .vtt .vth ";
        return others.find(' ' + std::filesystem::path(path).extension().string() + ' ') != std::string_view::npos;
    }

    io::Part part_;
    StepChoice step_;
    bool chosen_;                   ///< no step is left to be chosen
    std::optional<bool> polygons_;  ///< they are the mesh: there is no other
    std::set<std::string> seen_;
    int depth_ = 0;
};

template <class Read>
auto without_throwing(const std::string& path, const Read& read) -> decltype(read()) {
    const ExactEnvironment environment;
    try {
        return read();
    } catch (const std::bad_alloc&) {
        return base::too_little_memory(path);
    }
}

}  // namespace

namespace io {

Result<RawGrid> read_grid(const std::string& path, Part part) {
    return GridReader(part, {}).read(path);
}

}  // namespace io

Result<Mesh> read_vtk(const std::string& path, const StepChoice& step) {
    return without_throwing(path, [&]() -> Result<Mesh> {
        Result<io::RawGrid> grid = GridReader(io::Part::all, step).read(path);
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
    if (dimension != 2 && dimension != 3)
        return file_error(path, "the dimension of points", "2 or 3", std::to_string(dimension));
    return without_throwing(path, [&]() -> Result<PointData> {
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
                return std::find(names->begin(), names->end(), array.name) == names->end();
            });
        }
        io::take_fields(grid->point_arrays, "point array", path, data.fields, &data.labels, data.notes);
        io::note_narrow_points(*grid, path, data.notes);
        return data;
    });
}

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return without_throwing(path, [&]() -> Result<std::vector<SeriesStep>> {
        const Result<base::MappedFile> file = open_file(path);
        if (!file) return file.error();
        const Result<Contents> contents = contents_of(file->bytes(), path);
        if (!contents) return contents.error();
        if (contents->collection && contents->collection->is_series) return io::steps_of(contents->collection->files);
        const std::string found =
            !contents->tree
                ? "neither XML nor JSON"
                : io::in_quotes(contents->tree->root().attribute("type").value_or(contents->tree->root().name));
        return Error{"the kind of the file", path, 1,
                     "a VTKFile of type Collection (.pvd), or ParaView's JSON (.vtu.series)", found};
    });
}

std::vector<std::string> vtk_mesh_files(const std::string& path) {
    std::vector<std::string> all{path};
    const std::string suffix = std::filesystem::path(path).extension().string();
    if (suffix == ".vtu" || suffix == ".vtk" || suffix == ".vtp") return all;
    // Names within names; what cannot be read is told by the reader.
    std::set<std::string> known{path};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Result<base::MappedFile> file = open_file(all[i]);
        if (!file) continue;
        const Result<Contents> contents = contents_of(file->bytes(), all[i]);
        if (!contents || !contents->collection) continue;
        for (const io::CollectionFile& named : contents->collection->files) {
            if (known.insert(named.path).second) all.push_back(named.path);
        }
    }
    return all;
}

}  // namespace barycert
