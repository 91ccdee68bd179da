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
#include "barycert/jobs/user_rows.hpp"

namespace barycert::jobs {
namespace {

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& numbers) {
    return std::as_bytes(std::span(numbers));
}

/// That the format holds no such column.
Error no_place(const ColumnFormat& column, const std::string& path, const char* expected, const char* remedy) {
    return {.what = "the format has no place for a label of cells",
            .file = path,
            .expected = expected,
            .found = base::quoted(column.name) + (column.type == Column::Type::text ? ", texts" : ", integers"),
            .remedy = remedy};
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
        for (const std::size_t n : components_) {
            if (n == columns_) {  // as they stand
                if (Status done = file_->write(array++, std::as_bytes(rows.values)); !done) return done;
                break;
            }
            numbers_.resize(n * rows.cells.size());
            for (std::size_t i = 0; i < rows.cells.size(); ++i) {
                for (std::size_t c = 0; c < n; ++c) numbers_[n * i + c] = rows.values[columns_ * i + first + c];
            }
            if (Status done = file_->write(array++, bytes_of(numbers_)); !done) return done;
            first += n;
        }
        if (!rows.distances.empty()) {
            if (Status done = file_->write(array++, std::as_bytes(rows.distances)); !done) return done;
        }
        mask_.resize(rows.cells.size());
        for (std::size_t i = 0; i < mask_.size(); ++i) mask_[i] = rows.cells[i] >= 0 ? 1 : 0;
        if (Status done = file_->write(array++, bytes_of(mask_)); !done) return done;
        Status done = file_->write(array++, std::as_bytes(rows.cells));
        for (const Column& column : rows.carried) {
            if (!done) break;
            const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
            done = file_->write(array++, integers != nullptr ? bytes_of(*integers)
                                                             : bytes_of(std::get<std::vector<double>>(column.values)));
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
        std::string shape;
        for (std::size_t k = static_cast<std::size_t>(grid.dimension); k-- > 0;)
            shape += fmt::format("{}, ", grid.counts[k]);
        if (columns > 1) shape += fmt::format("{}, ", columns);
        shape.resize(shape.size() - 2);
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

/// Rows as those of points from a file.
class GridRowsSink final : public TableSink {
public:
    GridRowsSink(std::unique_ptr<TableSink> sink, const Grid& grid) : sink_(std::move(sink)), grid_(grid) {}

    Status write(const TableView& rows) override {
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
        TableView with_points = rows;
        with_points.points = points_;
        return sink_->write(with_points);
    }
    Status commit() override { return sink_->commit(); }

private:
    std::unique_ptr<TableSink> sink_;
    Grid grid_;
    std::vector<double> points_;
};

/// A picture of one column. It is kept in memory: its colours depend on all of it.
class PictureSink final : public TableSink {
public:
    PictureSink(std::string path, const Slice& slice) : path_(std::move(path)), slice_(slice) {}

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
        return write_png(path_, slice_, &counts_);
    }
    const SliceCounts& counts() const { return counts_; }

private:
    std::string path_;
    Slice slice_;
    std::vector<double> values_;
    std::vector<std::uint8_t> valid_;
    SliceCounts counts_;
};

/// The two axes of a grid in a plane.
Result<std::array<std::size_t, 2>> axes_of_picture(const Grid& grid, const std::string& path) {
    std::vector<std::size_t> axes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (grid.counts[k] > 1 || grid.dimension == 2) axes.push_back(k);
    }
    if (axes.size() != 2)
        return Error{.what = "a picture shows one layer",
                     .file = path,
                     .expected = "one point along exactly one axis, such as job.counts 800x600x1",
                     .found = fmt::format("{} x {} x {} points", grid.counts[0], grid.counts[1], grid.counts[2]),
                     .remedy = "choose the layer with job.bounds: it lies in the middle of the bounds"};
    constexpr std::int64_t max = 1000000;
    if (grid.counts[axes[0]] > max || grid.counts[axes[1]] > max)
        return Error{.what = "too many points for a picture",
                     .file = path,
                     .expected = "at most 1000000 along each axis",
                     .found = fmt::format("{} x {}", grid.counts[axes[0]], grid.counts[axes[1]]),
                     .remedy = "choose a coarser grid"};
    return std::array{axes[0], axes[1]};
}

Result<GridOutput> open_picture(const ResampleJob& a, const std::string& path, const std::vector<std::string>& columns,
                                const Grid& grid) {
    const auto axes = axes_of_picture(grid, path);
    if (!axes) return axes.error();
    if (columns.size() != 1)
        return Error{.what = "a picture shows one column",
                     .file = path,
                     .expected = "a field of one component, chosen by job.fields",
                     .found = columns.empty() ? "no field" : fmt::format("{}", fmt::join(columns, ", ")),
                     .remedy = columns.empty() ? "add one by job.field_files NAME=FILE" : "name one in job.fields"};
    const auto [w, h] = *axes;
    Slice slice;
    slice.width = static_cast<std::size_t>(grid.counts[w]);
    slice.height = static_cast<std::size_t>(grid.counts[h]);
    if (grid.spacing[w] > 0 && grid.spacing[h] > 0) slice.aspect = grid.spacing[w] / grid.spacing[h];
    if (a.range) slice.range = std::pair((*a.range)[0], (*a.range)[1]);
    slice.title = columns.front();
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (k != w && k != h) slice.title += fmt::format(", {} = {}", "xyz"[k], base::shortest(grid.origin[k]));
    }
    slice.pixel_length = grid.spacing[w];
    auto sink = std::make_unique<PictureSink>(path, slice);
    const SliceCounts* const counts = &sink->counts();
    return GridOutput{std::move(sink), counts};
}

}  // namespace

Status check_grid_output(const ResampleJob& job) {
    const bool picture = io::has_suffix(job.output, ".png");
    if (job.range && !picture)
        return Error{.what = "job.range needs a picture",
                     .file = job.output,
                     .remedy = "use job.output FILE.png, or leave job.range out"};
    if (job.output == "-" || io::has_suffix(job.output, ".csv") || io::has_suffix(job.output, ".npy") ||
        io::has_suffix(job.output, ".vti") || picture)
        return Done{};
    return unknown_output(job.output, ".vti, .npy, .csv or .png for a grid, or - for CSV on stdout");
}

Result<GridOutput> open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format,
                                  const Grid& grid) {
    const std::vector<std::string> columns = format.columns();
    const bool picture = io::has_suffix(path, ".png");
    if (!format.carried.empty() && (picture || io::has_suffix(path, ".npy")))
        return no_place(format.carried.front(), path, "fields",
                        "write .csv, or integers to .vti, or leave the label out of job.fields");
    if (picture) return open_picture(job, path, columns, grid);
    const bool array = io::has_suffix(path, ".npy");
    if (array && columns.empty())
        return Error{.what = "no field to write",
                     .file = path,
                     .remedy = "add one by job.field_files NAME=FILE; .vti and .csv can be written without fields"};
    if (array) return GridOutput{std::make_unique<NpyArraySink>(path, grid, columns.size())};
    const bool vti = io::has_suffix(path, ".vti");
    Result<std::unique_ptr<TableSink>> sink = vti ? VtiSink::open(path, format, grid) : open_rows(path, format);
    if (!sink) return sink.error();
    if (vti) return GridOutput{std::move(*sink)};
    return GridOutput{std::make_unique<GridRowsSink>(std::move(*sink), grid)};
}

}  // namespace barycert::jobs
