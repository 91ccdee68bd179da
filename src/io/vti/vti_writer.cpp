#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "files/spool.hpp"
#include "io/vti/vti.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert::io {
namespace {

OutFile layout_of(const VtiGrid& grid) {
    const auto range = [](std::int64_t count) { return "0 " + std::to_string(count - 1); };
    const auto step = [](double spacing) { return base::shortest(spacing == 0 ? 1 : spacing); };
    const std::string extent = "Extent=\"" + base::joined(grid.counts, " ", range) + '"';
    return {.data_set = "ImageData",
            .attributes = " Whole" + extent + " Origin=\"" + base::joined(grid.origin, " ", base::shortest) +
                          "\" Spacing=\"" + base::joined(grid.spacing, " ", step) + '"',
            .piece = " " + extent,
            .sections = {{"PointData", {}}, {"CellData", {}}}};
}

/// Bytes of such an array, or INT64_MAX if they are more.
std::uint64_t size_of(const VtiGrid& grid, const ArrayFormat& array) {
    std::uint64_t size = number_bytes(array.type) * static_cast<std::uint64_t>(array.components);
    for (const std::int64_t count : grid.counts) {
        if (__builtin_mul_overflow(size, static_cast<std::uint64_t>(count), &size) || size > INT64_MAX)
            return INT64_MAX;
    }
    return size;
}

}  // namespace

Result<std::unique_ptr<VtiWriter>> VtiWriter::open(const std::string& path, const VtiGrid& grid,
                                                   const std::vector<ArrayFormat>& arrays, VtkData data) {
    const ExactEnvironment environment;
    std::unique_ptr<VtiWriter> writer(new VtiWriter(path, layout_of(grid), data));
    for (const ArrayFormat& array : arrays) writer->arrays().push_back({array});
    if (Status s = check_arrays(path, writer->arrays()); !s) return s.error();
    std::uint64_t end = 0;
    for (OutArray& array : writer->arrays()) {
        const std::uint64_t size = size_of(grid, array.format);
        array.count = size / number_bytes(array.format.type);
        writer->places_.push_back({end, 0, base::Spool(path)});
        end += size + appended_header;
        if (end > INT64_MAX / 2)  // room is left for the head and the tail
            return wrong_in_memory("argument.size", path, "the size of the arrays", "less than 2^62 bytes", "more");
    }
    if (data == VtkData::raw) {
        const std::string head = raw_head(writer->layout_);
        for (ArrayPlace& place : writer->places_) place.begin += head.size();
        writer->tail_ = head.size() + end;
        writer->put(0, head);
    }
    if (Status s = writer->file_.status(); !s) return s.error();
    return writer;
}

/// In its place, or in order, as few bytes, which are gathered, and on a pipe. False: there it is not its turn.
bool VtiWriter::put(std::uint64_t at, std::string_view bytes) {
    constexpr std::size_t many = std::size_t{1} << 16;
    if (at == end_ && (bytes.size() < many || !file_.can_replace())) {
        file_.write(bytes);
        end_ += bytes.size();
        return true;
    }
    if (file_.can_replace()) file_.replace(at, bytes);
    return file_.can_replace();
}

Status VtiWriter::write(std::size_t array, std::span<const std::byte> bytes) {
    const ExactEnvironment environment;
    ArrayPlace& place = places_[array];
    const std::string name = "array \"" + arrays()[array].format.name + '"';
    const std::uint64_t size = arrays()[array].size();
    if (bytes.size() > size - place.done)
        return file_error("argument.size", path_, "the bytes of " + name, std::to_string(size) + " in all", "more");
    if (data_ != VtkData::raw) {
        place.done += bytes.size();
        return place.bytes.append(bytes);
    }
    const bool headed = place.done != 0 || put(place.begin, bytes_of(std::span(&size, 1)));
    if (!headed || !put(place.begin + appended_header + place.done, bytes_of(bytes)))
        return file_error("file.pipe", path_, name + " is not next",
                          "one array after the other, as the file cannot be written elsewhere",
                          "arrays that take turns", "write to a file instead of a pipe or device");
    place.done += bytes.size();
    return file_.status();
}

Status VtiWriter::commit() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        OutArray& array = arrays()[i];
        if (places_[i].done != array.size())
            return file_error("argument.size", path_, "the bytes of array \"" + array.format.name + '"',
                              std::to_string(array.size()), std::to_string(places_[i].done));
        if (data_ == VtkData::raw) continue;
        if (Status done = places_[i].bytes.finish(); !done) return done;
        array.bytes = places_[i].bytes.values<char>().data();
    }
    if (data_ != VtkData::raw) return write_xml(layout_, path_, data_);
    put(tail_, appended_tail);
    return file_.commit();
}

}  // namespace barycert::io
