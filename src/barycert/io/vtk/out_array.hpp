/// Arrays on their way to files: numbers that stand in memory, or are made some at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/io/vti/vti.hpp"
#include "barycert/mesh.hpp"

namespace barycert::io {

struct OutArray {
    VtiArray array;
    std::uint64_t count = 0;      ///< numbers; of text: bytes, those that end the texts included
    const char* bytes = nullptr;  ///< where they stand; nullptr: `fill` makes them
    /// Puts the numbers `first` to `last` - 1 there, from any thread.
    std::function<void(std::size_t first, std::size_t last, char* to)> fill = {};

    std::uint64_t size() const;
    void copy(std::size_t first, std::size_t last, char* to) const;
};

/// Numbers as they stand in memory, which must outlive it.
template <class T>
OutArray array_in_memory(VtiArray array, std::span<const T> numbers) {
    return {std::move(array), numbers.size(), reinterpret_cast<const char*>(numbers.data())};
}

/// count numbers at(0), at(1), ... of type T.
template <class T, class At>
OutArray array_made(VtiArray array, std::size_t count, At at) {
    return {std::move(array), count, nullptr, [at](std::size_t first, std::size_t last, char* to) {
                auto* const numbers = reinterpret_cast<T*>(to);
                for (std::size_t i = first; i < last; ++i) numbers[i - first] = static_cast<T>(at(i));
            }};
}

/// Points of 3 coordinates; those of a plane get z = 0.
OutArray array_of_points(std::span<const double> points, int dimension);

/// Values of a field.
OutArray array_of_field(const Field& field);

/// A column of one value an entity. Texts go to `room`, which must outlive it.
OutArray array_of_column(const Column& column, std::string& room);

/// Why the column has no place in a file; empty if it has.
std::string fault_of_column(const Column& column);

/// What is done to a part of an array on any thread: its numbers `first` to `last` - 1 are `bytes`.
using Transform = std::function<void(std::size_t first, std::size_t last, std::string& bytes)>;

/// Writes the array in parts of `part` numbers in their order; they are transformed on all threads, some at a time.
/// `taken` hears the size of each part that was written.
void write_parts(const OutArray& array, std::size_t part, const Transform& transform,
                 const std::function<void(std::string_view)>& write);

/// The numbers as text: the shortest that reads back, in lines of `per_line`. Texts as the numbers of their bytes.
void write_as_text(const OutArray& array, std::size_t per_line, const std::function<void(std::string_view)>& write);

}  // namespace barycert::io
