#include "barycert/io/vtk/out_array.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "barycert/io/vti/appended.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

template <class T>
char* put_number(T x, char* at) {
    if constexpr (std::is_floating_point_v<T>) {
        if (std::isnan(x)) return std::copy_n("nan", 3, at);  // its sign says nothing
        return std::to_chars(at, at + 32, x).ptr;
    } else {
        return std::to_chars(at, at + 32, static_cast<std::int64_t>(x)).ptr;
    }
}

template <class T>
void put_numbers(std::size_t first, std::size_t last, std::size_t per_line, std::string& bytes) {
    std::string text;
    text.resize((last - first) * 33);
    char* at = text.data();
    for (std::size_t i = first; i < last; ++i) {
        T x{};
        std::memcpy(&x, bytes.data() + (i - first) * sizeof(T), sizeof(T));
        at = put_number(x, at);
        *at++ = (i + 1) % per_line == 0 ? '\n' : ' ';
    }
    text.resize(static_cast<std::size_t>(at - text.data()));
    bytes = std::move(text);
}

}  // namespace

std::uint64_t OutArray::size() const {
    return count * number_size(array.type);
}

void OutArray::copy(std::size_t first, std::size_t last, char* to) const {
    const std::uint64_t number = number_size(array.type);
    if (bytes == nullptr) {
        fill(first, last, to);
    } else if (last != first) {
        std::memcpy(to, bytes + first * number, (last - first) * number);
    }
}

OutArray array_of_points(std::span<const double> points, int dimension) {
    VtiArray array{"Points", 3, VtiType::float64};
    if (dimension == 3) return array_in_memory(std::move(array), points);
    return array_made<double>(std::move(array), points.size() / 2 * 3,
                              [points](std::size_t i) { return i % 3 == 2 ? 0.0 : points[i / 3 * 2 + i % 3]; });
}

OutArray array_of_field(const Field& field) {
    return array_in_memory<double>({field.name, field.components, VtiType::float64}, field.data);
}

OutArray array_of_column(const Column& column, std::string& room) {
    if (const auto* const numbers = std::get_if<std::vector<std::int64_t>>(&column.values); numbers != nullptr)
        return array_in_memory<std::int64_t>({column.name, 1, VtiType::int64}, *numbers);
    if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values); numbers != nullptr)
        return array_in_memory<double>({column.name, 1, VtiType::float64}, *numbers);
    for (const std::string& text : std::get<std::vector<std::string>>(column.values)) {
        room += text;
        room += '\0';
    }
    return array_in_memory<char>({column.name, 1, VtiType::text}, room);
}

std::string fault_of_column(const Column& column) {
    if (const auto* const texts = std::get_if<std::vector<std::string>>(&column.values); texts != nullptr) {
        for (const std::string& text : *texts) {
            if (text.find('\0') != std::string::npos)
                return "the labels \"" + column.name + "\" hold a zero byte, which ends a text there";
        }
    }
    return {};
}

void write_parts(const OutArray& array, std::size_t part, const Transform& transform,
                 const std::function<void(std::string_view)>& write) {
    constexpr std::size_t wave = 64;
    const std::uint64_t number = number_size(array.array.type);
    const auto count = static_cast<std::size_t>(array.count);
    std::vector<std::string> parts(std::min(wave, (count + part - 1) / part));
    for (std::size_t begin = 0; begin < count; begin += wave * part) {
        const std::size_t end = std::min(count, begin + wave * part), parts_now = (end - begin + part - 1) / part;
        in_parallel(parts_now, [&](std::size_t i) {
            const std::size_t first = begin + i * part, last = std::min(end, first + part);
            parts[i].resize((last - first) * number);
            array.copy(first, last, parts[i].data());
            transform(first, last, parts[i]);
        });
        for (std::size_t i = 0; i < parts_now; ++i) write(parts[i]);
    }
}

void write_as_text(const OutArray& array, std::size_t per_line, const std::function<void(std::string_view)>& write) {
    constexpr std::size_t part = std::size_t{1} << 13;
    write_parts(
        array, part,
        [&](std::size_t first, std::size_t last, std::string& bytes) {
            switch (array.array.type) {
                case VtiType::int8:
                    return put_numbers<std::int8_t>(first, last, per_line, bytes);
                case VtiType::int32:
                    return put_numbers<std::int32_t>(first, last, per_line, bytes);
                case VtiType::int64:
                    return put_numbers<std::int64_t>(first, last, per_line, bytes);
                case VtiType::float32:
                    return put_numbers<float>(first, last, per_line, bytes);
                case VtiType::float64:
                    return put_numbers<double>(first, last, per_line, bytes);
                default:
                    return put_numbers<std::uint8_t>(first, last, per_line, bytes);
            }
        },
        write);
    if (array.count % per_line != 0) write("\n");
}

}  // namespace barycert::io
