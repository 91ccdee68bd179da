#include "barycert/io/vtk/out_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <set>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

template <class T>
void put_numbers(std::size_t first, std::size_t last, std::size_t per_line, std::string& bytes) {
    std::string text;
    text.resize((last - first) * 33);
    char* at = text.data();
    for (std::size_t i = first; i < last; ++i) {
        T x{};
        std::memcpy(&x, bytes.data() + (i - first) * sizeof(T), sizeof(T));
        // The sign of a NaN says nothing.
        at = std::isnan(x) ? std::copy_n("nan", 3, at) : std::to_chars(at, at + 32, x).ptr;
        *at++ = (i + 1) % per_line == 0 ? '\n' : ' ';
    }
    text.resize(static_cast<std::size_t>(at - text.data()));
    bytes = std::move(text);
}

/// The production Char of XML 1.0.
bool is_xml(char32_t code) {
    if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
    return code < 0xD800 || (code >= 0xE000 && code < 0xFFFE) || (code >= 0x10000 && code < 0x110000);
}

/// A name that two of the arrays have; nullptr if there is none.
const std::string* name_twice(const std::vector<OutArray>& arrays) {
    std::set<std::string_view> names;
    for (const OutArray& array : arrays)
        if (!names.insert(array.format.name).second) return &array.format.name;
    return nullptr;
}

}  // namespace

OutArray array_of_points(std::span<const double> points, int dimension) {
    if (dimension == 3) return array_in_memory("Points", points, 3);
    const auto at = [points](std::size_t i) { return i % 3 == 2 ? 0.0 : points[i / 3 * 2 + i % 3]; };
    return array_made<double>("Points", points.size() / 2 * 3, at, 3);
}

void write_parts(const OutArray& array, std::size_t part, const Transform& transform,
                 const std::function<void(std::string_view)>& write) {
    constexpr std::size_t wave = 64;
    const std::uint64_t number = number_bytes(array.format.type);
    const auto count = static_cast<std::size_t>(array.count);
    std::vector<std::string> parts(std::min(wave, (count + part - 1) / part));
    for (std::size_t begin = 0; begin < count; begin += wave * part) {
        const std::size_t end = std::min(count, begin + wave * part), parts_now = (end - begin + part - 1) / part;
        in_parallel(parts_now, [&](std::size_t i) {
            const std::size_t first = begin + i * part, last = std::min(end, first + part);
            if (array.bytes != nullptr) {
                parts[i].assign(array.bytes + first * number, (last - first) * number);
            } else {
                parts[i].resize((last - first) * number);
                array.fill(first, last, parts[i].data());
            }
            if (transform) transform(first, last, parts[i]);
        });
        for (std::size_t i = 0; i < parts_now; ++i) write(parts[i]);
    }
}

void write_as_text(const OutArray& array, std::size_t per_line, const std::function<void(std::string_view)>& write) {
    constexpr std::size_t part = std::size_t{1} << 13;
    write_parts(
        array, part,
        [&](std::size_t first, std::size_t last, std::string& bytes) {
            with_number_type(array.format.type, [&]<class T>() { put_numbers<T>(first, last, per_line, bytes); });
        },
        write);
    if (array.count % per_line != 0) write("\n");
}

std::optional<std::string> xml_attribute(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const base::Character c = base::first_character(name);
        if (c.size == 0 || !is_xml(c.code)) return std::nullopt;
        // What would end the value, and white space, which a reader would turn into spaces.
        if (std::string_view("<>&\"'\t\n\r").find(name[0]) != std::string_view::npos) {
            text += "&#" + std::to_string(static_cast<std::uint32_t>(c.code)) + ";";
        } else {
            text += name.substr(0, c.size);
        }
        name.remove_prefix(c.size);
    }
    return text;
}

std::string fault_of_names(const std::vector<OutArray>& arrays, Names names) {
    const auto is_plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    };
    for (const OutArray& array : arrays) {
        const std::string &name = array.format.name, named = "the name of field \"" + name + '"';
        if (name.empty()) return "a field has no name";
        if (names == Names::xml) {
            if (!xml_attribute(name)) return named + " has bytes that XML cannot hold";
            continue;
        }
        // VTK's readers take words of up to 255 bytes, and others than these may be written as three.
        const auto plain = static_cast<std::size_t>(std::ranges::count_if(name, is_plain));
        if (3 * name.size() - 2 * plain > 200) return named + " is too long for the format";
        if (name == "METADATA" || name == "NULL_ARRAY") return named + " means something else in the format";
    }
    const std::string* const twice = name_twice(arrays);
    return twice == nullptr ? "" : "two fields are named \"" + *twice + '"';
}

Error cannot_write(const std::string& what, const std::string& fault, const std::string& path) {
    return file_error(path, "cannot write " + what + ": " + fault, {}, {}, "correct it in memory");
}

Status check_arrays(const std::string& path, const std::vector<OutArray>& arrays) {
    for (const OutArray& array : arrays) {
        const auto& [name, components, type] = array.format;
        if (name.empty()) return wrong_in_memory(path, "the name of an array", "one", "none");
        if (!xml_attribute(name))
            return wrong_in_memory(path, "the name of an array", "text in UTF-8 without control characters",
                                   '"' + name + '"');
        if (components < 1)
            return wrong_in_memory(path, "the components of array \"" + name + '"', "1 or more",
                                   std::to_string(components));
    }
    if (const std::string* const twice = name_twice(arrays); twice != nullptr)
        return wrong_in_memory(path, "the names of arrays", "different ones", '"' + *twice + "\" twice");
    return Done{};
}

Error wrong_in_memory(const std::string& path, std::string what, std::string expected, std::string found) {
    return file_error(path, std::move(what), std::move(expected), std::move(found),
                      "correct what is to be written, or its arrays, in memory");
}

}  // namespace barycert::io
