#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/vtk/collection.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert {
namespace {

bool is_polygons(const std::string& path) {
    return io::has_suffix(path, ".vtp") || io::has_suffix(path, ".pvtp");
}

/// Blocks of surfaces and grids beside the mesh.
bool is_other_kind(const std::string& path) {
    constexpr std::string_view others = " .vtp .vti .vtr .vts .pvtp .pvti .pvtr .pvts .vtt .vth ";
    return others.find(' ' + std::filesystem::path(path).extension().string() + ' ') != std::string_view::npos;
}

/// Whether a grid that is no polygon data is among the files, or those that they name.
bool has_cells_of_grids(std::span<const io::CollectionFile> files) {
    const auto is_grid = [](const std::string& path) {
        return io::has_suffix(path, ".vtu") || io::has_suffix(path, ".vtk");
    };
    return std::ranges::any_of(files, [&](const io::CollectionFile& file) {
        return !is_polygons(file.path) && std::ranges::any_of(vtk_mesh_files(file.path), is_grid);
    });
}

/// Of files that name files, each is read once. Errors are thrown as Exceptions.
class GridReader {
public:
    explicit GridReader(io::Part part, const StepChoice& step = {}) : part_(part), step_(step) {}

    /// `depth`: of the files that name it.
    io::RawGrid read(const std::string& path, int depth = 0) {
        constexpr int deepest = 16;
        if (depth == deepest)
            io::refuse_file(path, "files that name files too deeply",
                            "at most " + std::to_string(deepest) + " of them one in the other", "more");
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
            io::refuse_file(path, "a file that is named twice in a collection of files", "every piece once", {},
                            "correct the file that names it");
        const io::VtkFile file = io::open_vtk(path);
        if (const auto& named = file.collection; named)
            return named->is_series ? read_step(named->files, path, depth) : read_all(named->files, path, depth);
        io::RawGrid grid = file.tree ? io::read_xml(*file.tree, part_) : io::read_legacy(file.text, path, part_);
        file.input->unchanged(path).value();
        return grid;
    }

    /// Whether a step is chosen of what is no series.
    bool step_left() const { return step_.made(); }

private:
    io::RawGrid read_all(std::span<const io::CollectionFile> files, const std::string& path, int depth) {
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
                io::refuse_line(path, file.line, "a file that is named here is missing", file.path, "no such file",
                                "put it there, or correct the name");
            io::append_piece(grid, read(file.path, depth + 1), path);
        }
        const std::string left_out = std::to_string(others.size()) + " blocks that are no unstructured grids: ";
        if (!others.empty()) grid.notes.push_back({Note::Kind::left_out, left_out + io::list_of(others), path, true});
        if (part_ == io::Part::all) io::join_pieces(grid, path);
        return grid;
    }

    /// The step that is chosen; of a series within a series the first.
    io::RawGrid read_step(std::span<const io::CollectionFile> files, const std::string& path, int depth) {
        const std::vector<SeriesStep> steps = io::steps_of(files);
        const StepChoice choice = std::exchange(step_, {});
        const std::size_t number = io::chosen_step(steps, choice, path).value();
        std::size_t begin = 0;
        for (std::size_t i = 0; i < number; ++i) begin += steps[i].files.size();
        io::RawGrid grid = read_all(files.subspan(begin, steps[number].files.size()), path, depth);
        // Who names a number knows what is read.
        if (steps.size() == 1 || choice.number) return grid;
        const std::string which = number == 0 ? "the first" : "number " + std::to_string(number),
                          others = "all steps but " + which + " of a series of " + std::to_string(steps.size()),
                          time = base::shortest(steps[number].time);
        grid.notes.push_back({Note::Kind::left_out, others + ": read is the time " + time, path, !choice.made()});
        return grid;
    }

    io::Part part_;
    StepChoice step_;               ///< not yet made use of
    std::optional<bool> polygons_;  ///< they are the mesh: there is no other
    std::set<std::string> seen_;
};

/// `arrays`: those too, of these names or all. `labels`: integers of one component that int64 holds are labels, and
/// there is a remedy for points that are not finite.
Result<io::PointTable> read_table(const std::string& path, int dimension, bool arrays,
                                  const std::vector<std::string>* names, bool labels, bool finite) {
    return io::read_guarded(path, [&]() -> Result<io::PointTable> {
        io::RawGrid grid = GridReader(arrays ? io::Part::point_arrays : io::Part::points).read(path);
        io::PointTable table;
        table.dimension = dimension;
        table.notes = std::move(grid.notes);
        table.unread = std::move(grid.unread_arrays);
        try {
            table.points = finite ? io::to_points(std::move(grid.points), dimension, path) : std::move(grid.points);
        } catch (const Exception& problem) {
            Error error = problem.error();
            if (labels) error.remedy += io::or_nan_for_it;
            return error;
        }
        if (names != nullptr)
            std::erase_if(grid.point_arrays, [&](auto& array) { return std::ranges::count(*names, array.name) == 0; });
        for (io::RawArray& array : grid.point_arrays) {
            if (labels && array.type < io::NumberType::float32 && array.components == 1) array.make_labels();
        }
        io::take_fields(grid.point_arrays, "point array", path, table.fields, &table.labels, table.notes);
        io::note_narrow_points(grid, path, table.notes);
        return table;
    });
}

}  // namespace

Result<io::PointTable> io::read_vtk_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    // A legacy file has no list of its arrays.
    return read_table(path, 3, arrays || has_suffix(path, ".vtk"), nullptr, true, nonfinite == NonfinitePoints::error);
}

Result<Mesh> io::read_vtk_in_space(const std::string& path, const StepChoice& step, InSpace* space) {
    return read_guarded(path, [&]() -> Result<Mesh> {
        GridReader reader(Part::all, step);
        RawGrid grid = reader.read(path);
        if (reader.step_left()) return no_series(path);
        return to_mesh(std::move(grid), path, space);
    });
}

Result<Mesh> read_vtk(const std::string& path, const StepChoice& step) {
    return io::read_vtk_in_space(path, step, nullptr);
}

Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension) {
    Result<PointData> data = read_vtk_point_data(path, dimension, std::vector<std::string>());
    if (!data) return data.error();
    return std::move(data->points);
}

Result<PointData> read_vtk_point_data(const std::string& path, int dimension,
                                      const std::optional<std::vector<std::string>>& names) {
    if (dimension != 2 && dimension != 3)
        return file_error(path, "the dimension of points", "2 or 3", std::to_string(dimension));
    Result<io::PointTable> table =
        read_table(path, dimension, !names || !names->empty(), names ? &*names : nullptr, false, true);
    if (!table) return table.error();
    return static_cast<PointData&&>(*table);
}

}  // namespace barycert
