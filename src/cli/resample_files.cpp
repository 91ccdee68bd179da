#include "resample_files.hpp"

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
#include "barycert/io.hpp"
#include "barycert/io/vti/vti.hpp"
#include "sampling_files.hpp"

namespace barycert::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& numbers) {
    return std::as_bytes(std::span(numbers));
}

/// VTK's image data: an array for each field, and what VTK's own probes give besides.
class VtiOutput final : public GridOutput {
public:
    static Result<std::unique_ptr<GridOutput>> open(const std::string& path, const SamplingEngine& engine,
                                                    const Grid& grid, bool distances) {
        std::unique_ptr<VtiOutput> out(new VtiOutput);
        std::vector<VtiArray> arrays;
        for (const FieldChoice& f : engine.fields()) {
            arrays.push_back({f.field->name, f.field->components, VtiType::float64});
            out->components_.push_back(static_cast<std::size_t>(f.field->components));
            out->columns_ += out->components_.back();
        }
        if (distances) arrays.push_back({"distance", 1, VtiType::float64});
        arrays.push_back({"vtkValidPointMask", 1, VtiType::int8});
        arrays.push_back({"cell", 1, VtiType::int32});
        auto file = VtiWriter::open(path, {grid.counts, grid.origin, grid.spacing}, arrays);
        if (!file) return file.error();
        out->file_ = std::move(*file);
        return std::unique_ptr<GridOutput>(std::move(out));
    }

    Status write(const GridBlock& block) override {
        std::size_t array = 0, first = 0;
        for (const std::size_t n : components_) {
            numbers_.resize(n * block.cells.size());
            for (std::size_t i = 0; i < block.cells.size(); ++i) {
                for (std::size_t c = 0; c < n; ++c) numbers_[n * i + c] = block.values[columns_ * i + first + c];
            }
            if (Status done = file_->write(array++, bytes_of(numbers_)); !done) return done;
            first += n;
        }
        if (!block.distances.empty()) {
            if (Status done = file_->write(array++, std::as_bytes(block.distances)); !done) return done;
        }
        mask_.resize(block.cells.size());
        for (std::size_t i = 0; i < mask_.size(); ++i) mask_[i] = block.cells[i] >= 0 ? 1 : 0;
        if (Status done = file_->write(array++, bytes_of(mask_)); !done) return done;
        return file_->write(array, std::as_bytes(block.cells));
    }

    Status commit() override { return file_->commit(); }

private:
    VtiOutput() = default;
    std::unique_ptr<VtiWriter> file_;
    std::vector<std::size_t> components_;
    std::size_t columns_ = 0;
    std::vector<double> numbers_;
    std::vector<std::int8_t> mask_;
};

/// One array of float64, z slowest: its bytes are the values as they come.
class NpyOutput final : public GridOutput {
public:
    NpyOutput(const std::string& path, const Grid& grid, std::size_t columns) : file_(path) {
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
    Status write(const GridBlock& block) override {
        const auto bytes = std::as_bytes(block.values);
        file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        return file_.status();
    }
    Status commit() override { return file_.commit(); }

private:
    OutputFile file_;
};

/// Rows as those of points from a file.
class RowsOutput final : public GridOutput {
public:
    RowsOutput(std::unique_ptr<points::Sink> sink, const Grid& grid) : sink_(std::move(sink)), grid_(grid) {}

    Status write(const GridBlock& block) override {
        const auto d = static_cast<std::size_t>(grid_.dimension);
        points_.resize(d * block.cells.size());
        std::array<std::uint64_t, 3> size{}, at{};
        for (std::size_t k = 0; k < 3; ++k) size[k] = static_cast<std::uint64_t>(grid_.counts[k]);
        at = {block.first_point % size[0], block.first_point / size[0] % size[1],
              block.first_point / grid_.layer_size()};
        for (std::size_t i = 0; i < block.cells.size(); ++i) {
            for (std::size_t k = 0; k < d; ++k)
                points_[d * i + k] = grid_.coordinate(k, static_cast<std::int64_t>(at[k]));
            for (std::size_t k = 0; k < 3 && ++at[k] == size[k]; ++k) at[k] = 0;
        }
        return sink_->write({grid_.dimension, points_, block.cells, block.features, block.values, block.distances});
    }
    Status commit() override { return sink_->commit(); }

private:
    std::unique_ptr<points::Sink> sink_;
    Grid grid_;
    std::vector<double> points_;
};

/// A picture of one column. It is kept in memory: its colours depend on all of it.
class PngOutput final : public GridOutput {
public:
    PngOutput(std::string path, const Slice& slice) : path_(std::move(path)), slice_(slice) {}

    Status write(const GridBlock& block) override {
        values_.insert(values_.end(), block.values.begin(), block.values.end());
        // A point outside is transparent only where it has got no value.
        for (std::size_t i = 0; i < block.cells.size(); ++i)
            valid_.push_back(block.cells[i] >= 0 || std::isfinite(block.values[i]) ? 1 : 0);
        return Done{};
    }
    Status commit() override {
        slice_.values = values_;
        slice_.valid = valid_;
        return write_png(path_, slice_, &counts_);
    }
    std::optional<SliceCounts> picture() const override { return counts_; }

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
                     .expected = "one point along exactly one axis, such as --grid 800x600x1",
                     .found = fmt::format("{} x {} x {} points", grid.counts[0], grid.counts[1], grid.counts[2]),
                     .remedy = "set where the layer is by --bounds: it lies in their middle"};
    constexpr std::int64_t most = 1000000;
    if (grid.counts[axes[0]] > most || grid.counts[axes[1]] > most)
        return Error{.what = "too many points for a picture",
                     .file = path,
                     .expected = "at most 1000000 along each axis",
                     .found = fmt::format("{} x {}", grid.counts[axes[0]], grid.counts[axes[1]]),
                     .remedy = "choose a coarser grid"};
    return std::array{axes[0], axes[1]};
}

Result<std::unique_ptr<GridOutput>> open_picture(const ResampleArguments& a, const std::vector<std::string>& columns,
                                                 const Grid& grid) {
    const auto axes = axes_of_picture(grid, a.output);
    if (!axes) return axes.error();
    if (columns.size() != 1)
        return Error{.what = "a picture shows one column",
                     .file = a.output,
                     .expected = "a field of one component, chosen by --fields",
                     .found = columns.empty() ? "no field" : fmt::format("{}", fmt::join(columns, ", ")),
                     .remedy = columns.empty() ? "add one by --field NAME=FILE" : "name one in --fields"};
    const auto [w, h] = *axes;
    Slice slice;
    slice.width = static_cast<std::size_t>(grid.counts[w]);
    slice.height = static_cast<std::size_t>(grid.counts[h]);
    if (grid.spacing[w] > 0 && grid.spacing[h] > 0) slice.aspect = grid.spacing[w] / grid.spacing[h];
    if (a.range) slice.range = std::pair((*a.range)[0], (*a.range)[1]);
    return std::unique_ptr<GridOutput>(std::make_unique<PngOutput>(a.output, slice));
}

}  // namespace

Status check_grid_output(const ResampleArguments& a) {
    const bool picture = has_suffix(a.output, ".png");
    if (a.range && !picture)
        return Error{.what = "--range without a picture", .file = a.output, .remedy = "it is for --output FILE.png"};
    if (a.output == "-" || has_suffix(a.output, ".csv") || has_suffix(a.output, ".npy") ||
        has_suffix(a.output, ".vti") || picture)
        return Done{};
    const std::size_t dot = a.output.find_last_of("./");
    const bool suffix = dot != std::string::npos && a.output[dot] == '.';
    return Error{.what = "--output in a format that is not known by its suffix",
                 .file = a.output,
                 .expected = ".vti, .npy, .csv or .png for a grid, or - for CSV on stdout",
                 .found = suffix ? '"' + a.output.substr(dot) + '"' : "no suffix",
                 .remedy = "choose another name"};
}

Result<std::unique_ptr<GridOutput>> open_grid_output(const ResampleArguments& a, const SamplingEngine& engine,
                                                     const Grid& grid) {
    const bool distances = a.options.outside.kind == Outside::nearest || a.options.outside.kind == Outside::extrapolate;
    const std::vector<std::string>& columns = engine.sampler().columns();
    if (has_suffix(a.output, ".vti")) return VtiOutput::open(a.output, engine, grid, distances);
    if (has_suffix(a.output, ".png")) return open_picture(a, columns, grid);
    if (has_suffix(a.output, ".npy")) {
        if (columns.empty())
            return Error{.what = "no field to write",
                         .file = a.output,
                         .remedy = "add one by --field NAME=FILE; .vti and .csv have cells without fields, too"};
        return std::unique_ptr<GridOutput>(std::make_unique<NpyOutput>(a.output, grid, columns.size()));
    }
    auto sink = open_rows(a.output, grid.dimension, engine.fields(), columns, a.options.outside);
    if (!sink) return sink.error();
    return std::unique_ptr<GridOutput>(std::make_unique<RowsOutput>(std::move(*sink), grid));
}

}  // namespace barycert::cli
