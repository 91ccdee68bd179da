#include "barycert/io.hpp"

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/vtk/collection.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml.hpp"

namespace barycert {
namespace {

enum class Kind : std::uint8_t { legacy, xml, series, other };

/// By the first word. A byte order mark is taken off.
Kind kind_of(std::string_view& bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    if (bytes.starts_with("# vtk")) return Kind::legacy;
    std::string_view start = bytes.substr(0, base::first_block);
    const std::string_view word = io::next_word(start);
    return word.starts_with('<') ? Kind::xml : word.starts_with('{') ? Kind::series : Kind::other;
}

Error not_of_vtk(const std::string& path, const char* what = "not a file of VTK") {
    return file_error(path, what, "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)", {},
                      "check the path; unpack a compressed file first");
}

struct VtkFile {
    base::MappedFile file;
    std::string_view legacy = {};                   ///< all of it, if that is its format
    std::optional<io::XmlTree> tree = {};           ///< of XML
    std::optional<io::Collection> collection = {};  ///< the files that it names
};

/// The first block has to show that the file is of VTK.
Result<VtkFile> open_file(const std::string& path) {
    const auto check = [&](std::string_view block, std::uint64_t) -> Status {
        const Kind kind = kind_of(block);
        if (kind == Kind::legacy) return io::check_legacy_head(block, path);
        const bool other = kind == Kind::xml ? block.find("<VTKFile") == std::string_view::npos : kind == Kind::other;
        return other ? Status(not_of_vtk(path)) : Done{};
    };
    Result<base::MappedFile> mapped = base::MappedFile::open(path, 1, base::Text::head, check);
    if (!mapped) return mapped.error();
    VtkFile file{std::move(*mapped)};
    std::string_view bytes = file.file.bytes();
    const Kind kind = kind_of(bytes);
    if (kind == Kind::other) return bytes.empty() ? not_of_vtk(path, "the file is empty") : not_of_vtk(path);
    if (kind == Kind::legacy) file.legacy = bytes;
    if (kind == Kind::series) {
        Result<io::Collection> series = io::read_series_file(bytes, path);
        if (!series) return series.error();
        file.collection = std::move(*series);
    } else if (kind == Kind::xml) {
        Result<io::XmlTree> tree = io::parse_xml(bytes, path);
        if (!tree) return tree.error();
        Result<std::optional<io::Collection>> named = io::collection_of(*tree);
        if (!named) return named.error();
        file.tree = std::move(*tree);
        file.collection = std::move(*named);
    }
    return file;
}

/// Of files that name files, each is read once.
class GridReader {
public:
    explicit GridReader(io::Part part, const StepChoice& step = {}) : part_(part), step_(step), chosen_(!step.made()) {}

    /// `depth`: of the files that name it.
    Result<io::RawGrid> read(const std::string& path, int depth = 0) {
        constexpr int deepest = 16;
        if (depth == deepest)
            return file_error(path, "files that name files too deeply",
                              "at most " + std::to_string(deepest) + " of them one in the other", "more");
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
            return file_error(path, "a file that is named twice in a collection of files", "every piece once", {},
                              "correct the file that names it");
        const Result<VtkFile> file = open_file(path);
        if (!file) return file.error();
        if (const auto& named = file->collection; named)
            return named->is_series ? read_step(named->files, path, depth) : read_all(named->files, path, depth);
        return file->tree ? io::read_xml(*file->tree, part_) : io::read_legacy(file->legacy, path, part_);
    }

    /// Whether no step is left to be chosen.
    bool chosen() const { return chosen_; }

private:
    /// Whether a grid that is no polygon data is among the files, or those that they name.
    static bool has_cells_of_grids(std::span<const io::CollectionFile> files) {
        for (const io::CollectionFile& file : files) {
            if (is_polygons(file.path)) continue;
            for (const std::string& named : vtk_mesh_files(file.path)) {
                if (io::has_suffix(named, ".vtu") || io::has_suffix(named, ".vtk")) return true;
            }
        }
        return false;
    }

    Result<io::RawGrid> read_all(std::span<const io::CollectionFile> files, const std::string& path, int depth) {
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
            Result<io::RawGrid> piece = read(file.path, depth + 1);
            if (!piece) return piece;
            if (Status s = io::append_piece(grid, std::move(*piece), path); !s) return s.error();
        }
        if (!others.empty())
            grid.notes.push_back(
                {Note::Kind::left_out,
                 std::to_string(others.size()) + " blocks that are no unstructured grids: " + io::list_of(others), path,
                 true});
        if (part_ == io::Part::all) io::join_pieces(grid, path);
        return grid;
    }

    /// The step that is chosen; of a series within a series the first.
    Result<io::RawGrid> read_step(std::span<const io::CollectionFile> files, const std::string& path, int depth) {
        const std::vector<SeriesStep> steps = io::steps_of(files);
        const StepChoice choice = std::exchange(step_, {});
        chosen_ = true;
        const Result<std::size_t> number = io::chosen_step(steps, choice, path);
        if (!number) return number.error();
        std::size_t begin = 0;
        for (std::size_t i = 0; i < *number; ++i) begin += steps[i].files.size();
        Result<io::RawGrid> grid = read_all(files.subspan(begin, steps[*number].files.size()), path, depth);
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
    bool chosen_;
    std::optional<bool> polygons_;  ///< they are the mesh: there is no other
    std::set<std::string> seen_;
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

/// Integers as such, where int64 holds them.
void make_integers(io::RawArray& array) {
    if (!array.is_whole() || !array.fault.empty() || array.has_labels() || array.components != 1) return;
    const std::vector<double>& numbers = array.numbers();
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return x >= -0x1p63 && x < 0x1p63; })) return;
    std::vector<std::int64_t> integers(numbers.size());
    std::transform(numbers.begin(), numbers.end(), integers.begin(),
                   [](double x) { return static_cast<std::int64_t>(x); });
    array.values = std::move(integers);
}

/// What is wanted of points.
struct PointWishes {
    int dimension = 3;
    io::Part part = io::Part::point_arrays;
    const std::vector<std::string>* names = nullptr;  ///< of the arrays; nullptr: all
    bool integers = false;                            ///< as labels, if an array has one component
    bool finite = true;
    std::string or_else = {};  ///< a remedy more, where a point is not
};

Result<io::PointTable> read_table(const std::string& path, const PointWishes& wishes) {
    return without_throwing(path, [&]() -> Result<io::PointTable> {
        Result<io::RawGrid> grid = GridReader(wishes.part).read(path);
        if (!grid) return grid.error();
        std::vector<io::RawArray>& arrays = grid->point_arrays;
        io::PointTable table;
        table.dimension = wishes.dimension;
        table.notes = std::move(grid->notes);
        table.unread = std::move(grid->unread_arrays);
        Result<std::vector<double>> points =
            wishes.finite ? io::to_points(std::move(grid->points), wishes.dimension, path) : std::move(grid->points);
        if (!points) {
            Error error = points.error();
            error.remedy += wishes.or_else;
            return error;
        }
        table.points = std::move(*points);
        if (const auto* const names = wishes.names; names != nullptr)
            std::erase_if(arrays,
                          [&](const io::RawArray& array) { return std::ranges::count(*names, array.name) == 0; });
        if (wishes.integers) std::for_each(arrays.begin(), arrays.end(), make_integers);
        io::take_fields(arrays, "point array", path, table.fields, &table.labels, table.notes);
        io::note_narrow_points(*grid, path, table.notes);
        return table;
    });
}

}  // namespace

Result<io::PointTable> io::read_vtk_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    // A legacy file has no list of its arrays.
    const bool listed_only = !arrays && !has_suffix(path, ".vtk");
    return read_table(path, {.part = listed_only ? Part::points : Part::point_arrays,
                             .integers = true,
                             .finite = nonfinite == NonfinitePoints::error,
                             .or_else = or_nan_for_it});
}

Result<Mesh> read_vtk(const std::string& path, const StepChoice& step) {
    return without_throwing(path, [&]() -> Result<Mesh> {
        GridReader reader(io::Part::all, step);
        Result<io::RawGrid> grid = reader.read(path);
        if (!grid) return grid.error();
        if (!reader.chosen()) return io::no_series(path);
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
    const bool arrays = !names.has_value() || !names->empty();
    Result<io::PointTable> table = read_table(path, {.dimension = dimension,
                                                     .part = arrays ? io::Part::point_arrays : io::Part::points,
                                                     .names = names ? &*names : nullptr});
    if (!table) return table.error();
    return static_cast<PointData&&>(*table);
}

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return without_throwing(path, [&]() -> Result<std::vector<SeriesStep>> {
        const Result<VtkFile> file = open_file(path);
        if (!file) return file.error();
        if (file->collection && file->collection->is_series) return io::steps_of(file->collection->files);
        const std::string found =
            file->tree ? io::in_quotes(file->tree->root().attribute("type").value_or(file->tree->root().name))
                       : "neither XML nor JSON";
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
        const Result<VtkFile> file = open_file(all[i]);
        if (!file || !file->collection) continue;
        for (const io::CollectionFile& named : file->collection->files) {
            if (known.insert(named.path).second) all.push_back(named.path);
        }
    }
    return all;
}

}  // namespace barycert
