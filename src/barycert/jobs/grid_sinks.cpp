#include "barycert/jobs/resampled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vti/vti.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/stream.hpp"

namespace barycert::jobs {
namespace {

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& numbers) {
    return std::as_bytes(std::span(numbers));
}

/// That the format holds no such column.
Error no_place(const ColumnFormat& column, const std::string& path, const char* expected, const char* remedy) {
    return refusal(path, "the format has no place for a label of cells", expected,
                   base::quoted(column.name) + (column.type == Column::Type::text ? ", texts" : ", integers"), remedy);
}

/// VTK's image data: an array for each field, and what VTK's own probes give besides.
class VtiSink final : public TableSink {
public:
    static Result<std::unique_ptr<TableSink>> open(const std::string& path, const TableFormat& format,
                                                   const Grid& grid) {
        std::unique_ptr<VtiSink> out(new VtiSink);
        std::vector<io::ArrayFormat> arrays;
        for (const TableField& f : format.fields) {
            arrays.push_back({f.name, f.components, io::NumberType::float64});
            out->components_.push_back(static_cast<std::size_t>(f.components));
            out->columns_ += out->components_.back();
        }
        if (format.distances) arrays.push_back({"distance", 1, io::NumberType::float64});
        arrays.push_back({"vtkValidPointMask", 1, io::NumberType::int8});
        arrays.push_back({"cell", 1, io::NumberType::int32});
        for (const ColumnFormat& column : format.carried) {
            if (column.type == Column::Type::text)
                return no_place(column, path, "numbers", "write .csv, or leave the label out of job.fields");
            const bool integer = column.type == Column::Type::integer;
            arrays.push_back({column.name, 1, integer ? io::NumberType::int64 : io::NumberType::float64});
        }
        auto file = io::VtiWriter::open(path, {grid.counts, grid.origin, grid.spacing}, arrays, format.vtk_data);
        if (!file) return file.error();
        out->file_ = std::move(*file);
        return std::unique_ptr<TableSink>(std::move(out));
    }

    Status write(const TableView& rows) override {
        std::size_t array = 0, first = 0;
        Status done = Done{};
        const auto put = [&](std::span<const std::byte> bytes) {
            if (done) done = file_->write(array++, bytes);
        };
        for (const std::size_t n : components_) {
            if (n == columns_) {  // as they stand
                put(std::as_bytes(rows.values));
                break;
            }
            numbers_.resize(n * rows.cells.size());
            for (std::size_t i = 0; i < rows.cells.size(); ++i)
                std::copy_n(&rows.values[columns_ * i + first], n, &numbers_[n * i]);
            put(bytes_of(numbers_));
            first += n;
        }
        if (!rows.distances.empty()) put(std::as_bytes(rows.distances));
        mask_.resize(rows.cells.size());
        for (std::size_t i = 0; i < mask_.size(); ++i) mask_[i] = rows.cells[i] >= 0 ? 1 : 0;
        put(bytes_of(mask_));
        put(std::as_bytes(rows.cells));
        for (const Column& column : rows.carried) {
            const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
            put(integers != nullptr ? bytes_of(*integers) : bytes_of(std::get<std::vector<double>>(column.values)));
        }
        return done;
    }

    Status commit() override { return file_->commit(); }

private:
    VtiSink() = default;
    std::unique_ptr<io::VtiWriter> file_;
    std::vector<std::size_t> components_;
    std::size_t columns_ = 0;
    std::vector<double> numbers_;
    std::vector<std::int8_t> mask_;
};

/// One array of float64, z slowest: its bytes are the values as they come.
class NpyArraySink final : public TableSink {
public:
    NpyArraySink(const std::string& path, const Grid& grid, std::size_t columns) : file_(path) {
        std::vector<std::int64_t> sizes(grid.counts.rend() - grid.dimension, grid.counts.rend());
        if (columns > 1) sizes.push_back(static_cast<std::int64_t>(columns));
        const std::string shape = fmt::format("{}", fmt::join(sizes, ", "));
        std::string text = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape);
        // Magic, version 1.0, the length of the text in two bytes; the array begins at a multiple of 64.
        constexpr std::size_t head = 10;
        text.resize((head + text.size() + 1 + 63) / 64 * 64 - head, ' ');
        text.back() = '\n';
        std::string header = "\x93NUMPY";
        header += {'\1', '\0', static_cast<char>(text.size() % 256), static_cast<char>(text.size() / 256)};
        file_.write(header + text);
    }
    Status write(const TableView& rows) override {
        const auto bytes = std::as_bytes(rows.values);
        file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        return file_.status();
    }
    Status commit() override { return file_.commit(); }

private:
    base::OutputFile file_;
};

/// Puts the points of the grid into rows, as rows of points from a file have them.
class PointsOfGrid {
public:
    explicit PointsOfGrid(const Grid& grid) : grid_(grid) {}

    void operator()(TableView& rows) {
        const auto d = static_cast<std::size_t>(grid_.dimension);
        points_.resize(d * rows.cells.size());
        std::array<std::uint64_t, 3> size{}, at{};
        for (std::size_t k = 0; k < 3; ++k) size[k] = static_cast<std::uint64_t>(grid_.counts[k]);
        at = {rows.first_row % size[0], rows.first_row / size[0] % size[1], rows.first_row / grid_.layer_size()};
        for (std::size_t i = 0; i < rows.cells.size(); ++i) {
            for (std::size_t k = 0; k < d; ++k)
                points_[d * i + k] = grid_.coordinate(k, static_cast<std::int64_t>(at[k]));
            for (std::size_t k = 0; k < 3 && ++at[k] == size[k]; ++k) at[k] = 0;
        }
        rows.points = points_;
    }

private:
    Grid grid_;
    std::vector<double> points_;
};

/// A picture of one column. It is kept in memory: its colours depend on all of it.
class PictureSink final : public TableSink {
public:
    PictureSink(std::string path, Slice slice, std::optional<SliceCounts>& counts)
        : path_(std::move(path)), slice_(std::move(slice)), counts_(counts) {}

    Status write(const TableView& rows) override {
        values_.insert(values_.end(), rows.values.begin(), rows.values.end());
        // A point outside is transparent only where it has got no value.
        for (std::size_t i = 0; i < rows.cells.size(); ++i)
            valid_.push_back(rows.cells[i] >= 0 || std::isfinite(rows.values[i]) ? 1 : 0);
        return Done{};
    }
    Status commit() override {
        slice_.values = values_;
        slice_.valid = valid_;
        return write_png(path_, slice_, &counts_.emplace());
    }

private:
    std::string path_;
    Slice slice_;
    std::optional<SliceCounts>& counts_;
    std::vector<double> values_;
    std::vector<std::uint8_t> valid_;
};

Result<std::unique_ptr<TableSink>> open_picture(const ResampleJob& a, const std::string& path,
                                                const std::vector<std::string>& columns, const Grid& grid,
                                                std::optional<SliceCounts>& counts) {
    // The two axes of a grid in a plane.
    std::vector<std::size_t> axes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (grid.counts[k] > 1 || grid.dimension == 2) axes.push_back(k);
    }
    if (axes.size() != 2)
        return refusal(path, "a picture shows one layer",
                       "one point along exactly one axis, such as job.counts 800x600x1",
                       fmt::format("{} points", fmt::join(grid.counts, " x ")),
                       "choose the layer with job.bounds: it lies in the middle of the bounds");
    constexpr std::int64_t max = 1000000;
    const std::size_t w = axes[0], h = axes[1];
    if (grid.counts[w] > max || grid.counts[h] > max)
        return refusal(path, "too many points for a picture", "at most 1000000 along each axis",
                       fmt::format("{} x {}", grid.counts[w], grid.counts[h]), "choose a coarser grid");
    if (columns.size() != 1)
        return refusal(path, "a picture shows one column", "a field of one component, chosen by job.fields",
                       columns.empty() ? "no field" : fmt::format("{}", fmt::join(columns, ", ")),
                       columns.empty() ? "add one by job.field_files NAME=FILE" : "name one in job.fields");
    Slice slice;
    slice.width = static_cast<std::size_t>(grid.counts[w]);
    slice.height = static_cast<std::size_t>(grid.counts[h]);
    if (grid.spacing[w] > 0 && grid.spacing[h] > 0) slice.aspect = grid.spacing[w] / grid.spacing[h];
    slice.range = a.range;
    slice.title = columns.front();
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (k != w && k != h) slice.title += fmt::format(", {} = {}", "xyz"[k], base::shortest(grid.origin[k]));
    }
    slice.pixel_length = grid.spacing[w];
    return std::unique_ptr<TableSink>(std::make_unique<PictureSink>(path, std::move(slice), counts));
}

}  // namespace

Status check_grid_output(const ResampleJob& job) {
    if (job.range && !io::has_suffix(job.output, ".png"))
        return refusal(job.output, "job.range needs a picture", "", "",
                       "use job.output FILE.png, or leave job.range out");
    if (job.output == "-" || has_suffix_of(job.output, ".csv .npy .vti .png")) return Done{};
    return unknown_output(job.output, ".vti, .npy, .csv or .png for a grid, or - for CSV on stdout");
}

Result<std::unique_ptr<TableSink>> open_grid_sink(const ResampleJob& job, const std::string& path,
                                                  const TableFormat& format, const Grid& grid,
                                                  std::optional<SliceCounts>& picture) {
    const std::vector<std::string> columns = format.columns();
    const bool png = io::has_suffix(path, ".png"), array = io::has_suffix(path, ".npy");
    if (!format.carried.empty() && (png || array))
        return no_place(format.carried.front(), path, "fields",
                        "write .csv, or integers to .vti, or leave the label out of job.fields");
    if (png) return open_picture(job, path, columns, grid, picture);
    if (array && columns.empty())
        return refusal(path, "no field to write", "", "",
                       "add one by job.field_files NAME=FILE; .vti and .csv can be written without fields");
    if (array) return std::unique_ptr<TableSink>(std::make_unique<NpyArraySink>(path, grid, columns.size()));
    if (io::has_suffix(path, ".vti")) return VtiSink::open(path, format, grid);
    Result<std::unique_ptr<TableSink>> rows = open_rows(path, format);
    if (!rows) return rows;
    return changed(std::move(*rows), PointsOfGrid(grid));
}

}  // namespace barycert::jobs
