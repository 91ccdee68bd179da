/// VTK's files on their way out: arrays whose numbers stand in memory, or are made some at a time; files of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "io/vtk/numbers.hpp"

namespace barycert::io {

/// An array of VTK without its numbers: `components` of them a row, side by side. VTK's `vtkValidPointMask` is an int8.
struct ArrayFormat {
    std::string name;
    int components = 1;
    NumberType type = NumberType::float64;
};

struct OutArray {
    ArrayFormat format;
    std::uint64_t count = 0;      ///< numbers; of text: bytes, those that end the texts included
    const char* bytes = nullptr;  ///< where they stand; nullptr: `fill` makes them
    /// Puts the numbers `first` to `last` - 1 there, from any thread.
    std::function<void(std::size_t first, std::size_t last, char* to)> fill = {};

    std::uint64_t size() const { return count * number_bytes(format.type); }
};

/// The type of numbers T; char stands for text.
template <class T>
constexpr NumberType number_type() {
    if constexpr (std::is_same_v<T, char>) return NumberType::text;
    if constexpr (std::is_floating_point_v<T>) return sizeof(T) == 4 ? NumberType::float32 : NumberType::float64;
    constexpr int wide = std::bit_width(sizeof(T)) - 1;
    return static_cast<NumberType>(static_cast<int>(NumberType::int8) + 2 * wide + (std::is_signed_v<T> ? 0 : 1));
}

/// Numbers as they stand in memory, which must outlive it.
template <class T>
OutArray array_in_memory(std::string name, std::span<const T> numbers, int components = 1) {
    return {
        {std::move(name), components, number_type<T>()}, numbers.size(), reinterpret_cast<const char*>(numbers.data())};
}

/// count numbers at(0), at(1), ... of type T.
template <class T, class At>
OutArray array_made(std::string name, std::size_t count, At at, int components = 1) {
    return {{std::move(name), components, number_type<T>()},
            count,
            nullptr,
            [at](std::size_t first, std::size_t last, char* to) {
                auto* const numbers = reinterpret_cast<T*>(to);
                for (std::size_t i = first; i < last; ++i) numbers[i - first] = static_cast<T>(at(i));
            }};
}

/// Points of 3 coordinates; those of a plane get z = 0.
OutArray array_of_points(std::span<const double> points, int dimension);

inline std::vector<OutArray> arrays_of(const std::vector<Field>& fields) {
    std::vector<OutArray> arrays;
    arrays.reserve(fields.size());
    for (const Field& f : fields) arrays.push_back(array_in_memory<double>(f.name, f.data, f.components));
    return arrays;
}

/// A change to a part of an array, on any thread: its numbers `first` to `last` - 1 are `bytes`.
using Transform = std::function<void(std::size_t first, std::size_t last, std::string& bytes)>;

/// Writes the array in parts of `part` numbers in their order; they are made, and transformed where `transform` is not
/// empty, on all threads, some at a time, and written on any one.
void write_parts(const OutArray& array, std::size_t part, const Transform& transform,
                 const std::function<void(std::string_view)>& write);

/// The numbers as text: the shortest that reads back, in lines of `per_line`. Texts as the numbers of their bytes.
void write_as_text(const OutArray& array, std::size_t per_line, const std::function<void(std::string_view)>& write);

/// `name` such that between double quotes in an XML 1.0 file it reads back as `name` (VTK 9.1 writes names as they are
/// given); nothing if no escape can do that: where it is not UTF-8, or has a character that XML excludes.
std::optional<std::string> xml_attribute(std::string_view name);

enum class Names : bool { legacy, xml };

/// Says, in one clause, what is wrong with the names of fields; empty if nothing is. VTK keeps but one array of a name.
std::string fault_of_names(const std::vector<OutArray>& arrays, Names names);

Error cannot_write(const std::string& what, const std::string& fault, const std::string& path);

/// Error: a name that is empty, there twice, or that XML cannot hold; fewer than one component.
Status check_arrays(const std::string& path, const std::vector<OutArray>& arrays);

Error wrong_in_memory(ErrorCode code, const std::string& path, std::string what, std::string expected,
                      std::string found);

struct OutSection {
    std::string element;
    std::vector<OutArray> arrays;
};

/// A data set of one piece.
struct OutFile {
    std::string data_set;         ///< "UnstructuredGrid"
    std::string attributes = {};  ///< of its element, each with a blank before it
    std::string piece;            ///< attributes of the piece, likewise
    std::vector<OutSection> sections;
};

/// Names must pass check_arrays. Compressed blocks are made on all threads, in memory for some; on a pipe twice.
Status write_xml(const OutFile& file, const std::string& path, VtkData data);

// Text around raw arrays, for those that write these themselves.

/// All before the arrays, which stand one after the other in the order of their elements.
std::string raw_head(const OutFile& file);

/// Bytes before each array: its size, an integer of 64 bits.
inline constexpr std::uint64_t appended_header = 8;

/// Behind the last array.
inline constexpr std::string_view appended_tail = "\n  </AppendedData>\n</VTKFile>\n";

/// A sink of rows into a .vtu file. The format has one array after the other: rows are kept in files without names
/// beside the target up to commit(), so that memory does not grow with them.
Result<std::unique_ptr<TableSink>> open_vtu_sink(const std::string& path, const TableFormat& format);

}  // namespace barycert::io
