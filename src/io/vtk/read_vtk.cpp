// Meshes and points from VTK's files of every kind, those that name files among them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/paths.hpp"
#include "io/point_table.hpp"
#include "io/series_steps.hpp"
#include "io/streams.hpp"
#include "io/tetgen/node_table.hpp"
#include "io/vtk/collection.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"

namespace barycert::io {
namespace {

/// Kind of blocks that make the mesh: unstructured grids; where there are none, structured ones; else polygons.
enum class GridKind : std::uint8_t { unstructured, structured, polygons };

bool is_structured(FormatKind kind) {
    return kind == FormatKind::vti || kind == FormatKind::vtr || kind == FormatKind::vts;
}

GridKind kind_of_block(const std::string& path) {
    const FormatKind kind = base::kind_of(path);
    if (kind == FormatKind::vtp || kind == FormatKind::pvtp) return GridKind::polygons;
    return is_structured(kind) ? GridKind::structured : GridKind::unstructured;
}

/// Chooses the kind by the files, or those that they name.
GridKind blocks_of_mesh(std::span<const CollectionFile> files) {
    GridKind kind = GridKind::polygons;
    for (const CollectionFile& file : files) {
        for (const std::string& own : vtk_mesh_files(file.path)) {
            const FormatKind of_file = base::kind_of(own);
            if (of_file == FormatKind::vtu || of_file == FormatKind::vtk || is_structured(of_file))
                kind = std::min(kind, kind_of_block(own));
        }
    }
    return kind;
}

/// Kinds that are not read: pieces of structured grids, trees, hypertrees.
bool is_unread(const std::string& path) {
    return has_one_of(path, {".pvti", ".pvtr", ".pvts", ".vtt", ".vth"});
}

/// Reads files, and files that these name, each once. Errors are thrown as Exceptions.
class GridReader {
public:
    explicit GridReader(Wanted part, const StepChoice& step = {}) : part_(part), step_(step) {}

    /// `depth`: of the files that name it.
    RawGrid read(const std::string& path, int depth = 0) {
        constexpr int deepest = 16;
        if (depth == deepest)
            refuse_file("file.unsupported", path, "files that name files too deeply",
                        "at most " + std::to_string(deepest) + " of them one in the other", "more");
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
            refuse_file("file.duplicate", path, "a file that is named twice in a collection of files",
                        "every piece once", {}, "correct the file that names it");
        VtkFile file = open_vtk(path);
        if (const auto& named = file.collection; named)
            return named->is_series ? read_step(named->files, path, depth) : read_all(named->files, path, depth);
        RawGrid grid = file.tree ? read_xml(*std::move(file.tree), part_) : read_legacy(file.text, path, part_);
        file.input->unchanged(path).value();
        return grid;
    }

    bool step_left() const { return step_.made(); }

private:
    RawGrid read_all(std::span<const CollectionFile> files, const std::string& path, int depth) {
        RawGrid grid;
        std::vector<std::string> others;
        if (!blocks_) blocks_ = blocks_of_mesh(files);
        for (const CollectionFile& file : files) {
            if (part_ == Wanted::all && (is_unread(file.path) || kind_of_block(file.path) > *blocks_)) {
                others.push_back(file.block.empty() ? file.path : file.block + " (" + file.path + ")");
                continue;
            }
            std::error_code unknown;
            if (std::filesystem::status(file.path, unknown).type() == std::filesystem::file_type::not_found)
                refuse_line("file.missing", path, file.line, "a file that is named here is missing", file.path,
                            "no such file", "put it there, or correct the name");
            append_piece(grid, read(file.path, depth + 1), path);
        }
        const std::string left_out = std::to_string(others.size()) + " blocks beside those with the mesh: ";
        if (!others.empty()) grid.notes.push_back({Note::Kind::left_out, left_out + list_of(others), path, true});
        if (part_ == Wanted::all) join_pieces(grid, path);
        return grid;
    }

    /// The step that is chosen; of a series within a series the first.
    RawGrid read_step(std::span<const CollectionFile> files, const std::string& path, int depth) {
        const std::vector<SeriesStep> steps = steps_of(files);
        const StepChoice choice = std::exchange(step_, {});
        const std::size_t number = chosen_step(steps, choice, path).value();
        std::size_t begin = 0;
        for (std::size_t i = 0; i < number; ++i) begin += steps[i].files.size();
        RawGrid grid = read_all(files.subspan(begin, steps[number].files.size()), path, depth);
        // Who names a number knows what is read.
        if (steps.size() == 1 || choice.number) return grid;
        const std::string which = number == 0 ? "the first" : "number " + std::to_string(number),
                          others = "all steps but " + which + " of a series of " + std::to_string(steps.size()),
                          time = base::shortest(steps[number].time);
        grid.notes.push_back({Note::Kind::left_out, others + ": read is the time " + time, path, !choice.made()});
        return grid;
    }

    Wanted part_;
    StepChoice step_;  ///< not yet made use of
    std::optional<GridKind> blocks_;
    std::set<std::string> seen_;
};

/// `arrays`: too, of these names or all. `labels`: such are integers of one component; points not finite have a remedy.
Result<PointTable> read_table(const std::string& path, int dimension, bool arrays,
                              const std::vector<std::string>* names, bool labels, bool finite) {
    return read_guarded(path, [&]() -> Result<PointTable> {
        RawGrid grid = GridReader(arrays ? Wanted::point_arrays : Wanted::points).read(path);
        PointTable table;
        table.dimension = dimension;
        table.notes = std::move(grid.notes);
        table.unread = std::move(grid.unread_arrays);
        try {
            table.points = finite ? to_points(std::move(grid.points), dimension, path) : std::move(grid.points);
        } catch (const Exception& problem) {
            Error error = problem.error();
            if (labels) error = about(nonfinite_points, std::move(error)), error.remedy += or_nan_for_it;
            return error;
        }
        if (names != nullptr)
            std::erase_if(grid.point_arrays, [&](auto& array) { return std::ranges::count(*names, array.name) == 0; });
        for (RawArray& array : grid.point_arrays) {
            if (labels && array.type < NumberType::float32 && array.components == 1) array.make_labels();
        }
        take_fields(grid.point_arrays, "point array", path, table.fields, &table.labels, table.notes);
        note_narrow_points(grid, path, table.notes);
        return table;
    });
}

}  // namespace

Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path) {
    const std::size_t number = choice.last ? steps.size() - 1 : choice.number.value_or(0);
    const auto error = [&](const std::string& expected, const std::string& found) {
        return file_error("series.step", path, "no such step of the series", expected, found,
                          "choose one of its steps");
    };
    if (steps.empty()) return file_error("series.step", path, "a series without steps", "a file for each step", "none");
    if (number >= steps.size())
        return error("a number from 0 to " + std::to_string(steps.size() - 1), std::to_string(number));
    if (!choice.time) return number;
    constexpr std::size_t most_listed = 100;
    std::string times;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].time == *choice.time) return i;
        if (i < most_listed) times += (i == 0 ? "" : ", ") + base::shortest(steps[i].time);
    }
    if (steps.size() > most_listed) times += ", ... (" + std::to_string(steps.size()) + " steps)";
    return error("one of the times " + times, base::shortest(*choice.time));
}

Error no_series(const std::string& path) {
    return file_error("series.none", path, "a step is chosen, and this is no series of steps",
                      "one of " + base::suffix_list_read(base::Use::steps), {}, "leave --step and --time out");
}

}  // namespace barycert::io

namespace barycert {

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return io::read_guarded(path, [&]() -> Result<std::vector<SeriesStep>> {
        const io::VtkFile file = io::open_vtk(path);
        if (file.collection && file.collection->is_series) return io::steps_of(file.collection->files);
        io::refuse_line("file.format", path, 1, "the kind of the file",
                        "a VTKFile of type Collection (.pvd), or ParaView's JSON (.vtu.series)",
                        file.tree ? io::in_quotes(file.tree->root().attribute_or("type", file.tree->root().name))
                                  : "neither XML nor JSON");
    });
}

std::vector<std::string> vtk_mesh_files(const std::string& path) {
    std::vector<std::string> all{path};
    const base::FormatKind kind = base::kind_of(path);
    if (base::is_vtk(kind) && kind <= base::FormatKind::vts) return all;  // the kinds that name no other files
    std::set<std::string> known{path};
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::optional<io::Collection> named;
        // Names within names; what cannot be read is told by the reader.
        static_cast<void>(io::status_of([&] { named = io::open_vtk(all[i]).collection; }));
        for (const io::CollectionFile& one : named.value_or(io::Collection()).files) {
            if (known.insert(one.path).second) all.push_back(one.path);
        }
    }
    return all;
}

Result<io::PointTable> io::read_vtk_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    // A legacy file has no list of its arrays.
    return read_table(path, 3, arrays || base::kind_of(path) == FormatKind::vtk, nullptr, true,
                      nonfinite == NonfinitePoints::error);
}

Result<Mesh> io::read_vtk_in_space(const std::string& path, const ReadOptions& options, InSpace* space) {
    return read_guarded(path, [&]() -> Result<Mesh> {
        GridReader reader(Wanted::all, options.step);
        RawGrid grid = reader.read(path);
        if (reader.step_left()) return no_series(path);
        return to_mesh(std::move(grid), path, space, options.list_grids);
    });
}

Result<Mesh> read_vtk(const std::string& path, const StepChoice& step) {
    return io::read_vtk_in_space(path, {.step = step}, nullptr);
}

Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension) {
    Result<PointData> data = read_vtk_point_data(path, dimension, std::vector<std::string>());
    if (!data) return data.error();
    return std::move(data->points);
}

Result<PointData> read_vtk_point_data(const std::string& path, int dimension,
                                      const std::optional<std::vector<std::string>>& names) {
    if (dimension != 2 && dimension != 3)
        return file_error("point.dimension", path, "the dimension of points", "2 or 3", std::to_string(dimension));
    Result<io::PointTable> table =
        io::read_table(path, dimension, !names || !names->empty(), names ? &*names : nullptr, false, true);
    if (!table) return table.error();
    return static_cast<PointData&&>(*table);
}

}  // namespace barycert
