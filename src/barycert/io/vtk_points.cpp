#include "barycert/io/vtk_points.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/vtk/raw_grid.hpp"

namespace barycert::io {
namespace {

/// Integers as such, where int64 holds them.
void make_integers(RawArray& array) {
    if (!array.is_whole() || !array.fault.empty() || array.has_labels() || array.components != 1) return;
    const std::vector<double>& numbers = array.numbers();
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return x >= -0x1p63 && x < 0x1p63; })) return;
    std::vector<std::int64_t> integers;
    integers.reserve(numbers.size());
    for (const double x : numbers) integers.push_back(static_cast<std::int64_t>(x));
    array.values = std::move(integers);
}

Result<PointTable> read_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    // A legacy file has no list of its arrays.
    const bool listed_only = !arrays && !has_suffix(path, ".vtk");
    Result<RawGrid> grid = read_grid(path, listed_only ? Part::points : Part::point_arrays);
    if (!grid) return grid.error();
    PointTable table;
    table.notes = std::move(grid->notes);
    Result<std::vector<double>> points =
        nonfinite == NonfinitePoints::nan ? std::move(grid->points) : to_points(std::move(grid->points), 3, path);
    if (!points) {
        Error error = points.error();
        error.remedy += or_nan_for_it;
        return error;
    }
    table.points = std::move(*points);
    for (RawArray& array : grid->point_arrays) make_integers(array);
    take_fields(grid->point_arrays, "point array", path, table.fields, &table.labels, table.notes);
    table.unread = std::move(grid->unread_arrays);
    note_narrow_points(*grid, path, table.notes);
    return table;
}

}  // namespace

Result<PointTable> read_vtk_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    try {
        return read_table(path, arrays, nonfinite);
    } catch (const std::bad_alloc&) {
        return base::too_little_memory(path);
    }
}

Result<std::unique_ptr<PointSource>> open_vtk_points(const std::string& path, int dimension,
                                                     const PointOptions& options) {
    Result<PointTable> table =
        read_vtk_table(path, !options.keep.empty() || !options.columns.empty(), options.nonfinite_points);
    if (!table) return table.error();
    return points_of_table(std::move(*table), path, dimension, options);
}

}  // namespace barycert::io
