#include "io/vtk/out_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "files/output_file.hpp"
#include "io/parallel.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/packed.hpp"

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

const std::string* name_twice(const std::vector<OutArray>& arrays) {
    std::set<std::string_view> names;
    for (const OutArray& array : arrays)
        if (!names.insert(array.format.name).second) return &array.format.name;
    return nullptr;
}

/// Bytes of a block before it is compressed: a multiple of every number's size.
constexpr std::size_t block_size = std::size_t{1} << 17;

const char* element_of(NumberType type) {
    return type == NumberType::text ? "Array" : "DataArray";
}

/// All elements but those of appended data, in parts: each but the last ends behind the name of an array.
std::vector<std::string> elements_of(const OutFile& f, std::string_view compressor) {
    const bool big = std::endian::native == std::endian::big;
    std::vector<std::string> parts{"<VTKFile type=\"" + f.data_set + "\" version=\"1.0\" byte_order=\"" +
                                   (big ? "BigEndian" : "LittleEndian") + "\" header_type=\"UInt64\"" +
                                   (compressor.empty() ? "" : " compressor=\"" + std::string(compressor) + '"') +
                                   ">\n  <" + f.data_set + f.attributes + ">\n    <Piece" + f.piece + ">\n"};
    for (const OutSection& section : f.sections) {
        parts.back() += "      <" + section.element + ">\n";
        for (const OutArray& a : section.arrays) {
            const auto& [name, components, type] = a.format;
            parts.back() += std::string("        <") + element_of(type) + " type=\"" + std::string(xml_name(type)) +
                            "\" Name=\"" + *xml_attribute(name) + '"' +
                            (components != 1 ? " NumberOfComponents=\"" + std::to_string(components) + '"' : "");
            parts.emplace_back();
        }
        parts.back() += "      </" + section.element + ">\n";
    }
    parts.back() += "    </Piece>\n  </" + f.data_set + ">\n";
    return parts;
}

template <class Write>
void for_each_array(const OutFile& f, const Write& write) {
    for (const OutSection& section : f.sections) {
        for (const OutArray& a : section.arrays) write(a);
    }
}

/// All before the arrays, which begin at these offsets from behind the underscore. `width`: of each, with its quote.
std::string head_of(const OutFile& f, std::string_view compressor, const std::vector<std::uint64_t>& offsets,
                    std::size_t width) {
    const std::vector<std::string> parts = elements_of(f, compressor);
    std::string head;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        std::string place = std::to_string(offsets[i]) + '"';
        place.resize(std::max(place.size(), width), ' ');
        head += parts[i] + " format=\"appended\" offset=\"" + place + "/>\n";
    }
    return head + parts.back() + "  <AppendedData encoding=\"raw\">\n    _";
}

void write_raw(const OutFile& f, base::OutputFile& file) {
    const auto write = [&](std::string_view bytes) { file.write(bytes); };
    write(raw_head(f));
    for_each_array(f, [&](const OutArray& a) {
        const std::uint64_t size = a.size();
        write({reinterpret_cast<const char*>(&size), appended_header});
        a.bytes != nullptr ? write({a.bytes, static_cast<std::size_t>(size)})
                           : write_parts(a, block_size / number_bytes(a.format.type), {}, write);
    });
    write(appended_tail);
}

/// Each array has a header (number of blocks, their size, that of the last if it is shorter, their compressed sizes)
/// before its blocks. Headers and offsets are known last, and replace what stands for them; where nothing can be
/// replaced, all is compressed twice. There is room for offsets, and for the quote behind. (Blanks before the quote, as
/// VTK has them, keep meshio 5 from reading the file.)
bool write_compressed(const OutFile& f, VtkData compressor, base::OutputFile& file) {
    constexpr std::size_t offset_width = 21;
    std::vector<std::vector<std::uint64_t>> headers;
    for_each_array(f, [&](const OutArray& a) {
        const std::uint64_t blocks = (a.size() + block_size - 1) / block_size;
        headers.push_back({blocks, blocks == 0 ? 0 : block_size, a.size() % block_size});
        headers.back().resize(3 + blocks);
    });
    std::vector<std::uint64_t> offsets(headers.size());
    const auto head = [&] {
        return head_of(f, compressor_names[static_cast<std::size_t>(compressor)], offsets, offset_width);
    };
    bool good = true;
    const auto write_all = [&](const std::function<void(std::string_view)>& write) {
        std::size_t array = 0, end = 0;
        write(head());
        for_each_array(f, [&](const OutArray& a) {
            std::vector<std::uint64_t>& header = headers[array];
            offsets[array++] = end;
            write(bytes_of(header));
            end += bytes_of(header).size();
            std::size_t next = 3;
            write_parts(
                a, block_size / number_bytes(a.format.type),
                [&](std::size_t, std::size_t, std::string& bytes) { bytes = pack(compressor, bytes); },
                [&](std::string_view packed) {
                    good = good && !packed.empty();
                    header[next++] = packed.size();
                    end += packed.size();
                    write(packed);
                });
        });
        write(appended_tail);
    };
    if (!file.can_replace()) write_all([](std::string_view) {});
    write_all([&](std::string_view bytes) { file.write(bytes); });
    if (!file.can_replace()) return good;
    const std::string final_head = head();
    file.replace(0, final_head);
    for (std::size_t i = 0; i < headers.size(); ++i) file.replace(final_head.size() + offsets[i], bytes_of(headers[i]));
    return good;
}

void write_text(const OutFile& f, base::OutputFile& file) {
    constexpr std::size_t numbers_a_line = 12;
    const std::vector<std::string> parts = elements_of(f, {});
    auto part = parts.begin();
    for_each_array(f, [&](const OutArray& a) {
        file.write(*part++ + " format=\"ascii\">\n");
        const auto components = static_cast<std::size_t>(a.format.components);
        write_as_text(a, components > 1 ? components : numbers_a_line,
                      [&](std::string_view text) { file.write(text); });
        file.write(std::string("        </") + element_of(a.format.type) + ">\n");
    });
    file.write(*part + "</VTKFile>\n");
}

}  // namespace

OutArray array_of_points(std::span<const double> points, int dimension) {
    if (dimension == 3) return array_in_memory("Points", points, 3);
    const auto at = [points](std::size_t i) { return i % 3 == 2 ? 0.0 : points[i / 3 * 2 + i % 3]; };
    return array_made<double>("Points", points.size() / 2 * 3, at, 3);
}

void write_parts(const OutArray& array, std::size_t part, const Transform& transform,
                 const std::function<void(std::string_view)>& write) {
    constexpr std::size_t wave = 16;
    const std::uint64_t number = number_bytes(array.format.type);
    const auto count = static_cast<std::size_t>(array.count);
    const auto make = [&](std::size_t first, std::string& bytes) {
        const std::size_t last = std::min(count, first + part);
        if (array.bytes != nullptr) {
            bytes.assign(array.bytes + first * number, (last - first) * number);
        } else {
            bytes.resize((last - first) * number);
            array.fill(first, last, bytes.data());
        }
        if (transform) transform(first, last, bytes);
    };
    // One thread writes a wave while the others make the next.
    std::vector<std::string> made(std::min(wave, (count + part - 1) / part)), next(made.size());
    for (std::size_t begin = 0, ready = 0; begin < count || ready != 0; begin += wave * part) {
        const std::size_t parts = begin < count ? std::min(wave, (count - begin + part - 1) / part) : 0;
        in_parallel(1 + parts, [&](std::size_t i) {
            if (i != 0) return make(begin + (i - 1) * part, next[i - 1]);
            for (std::size_t p = 0; p < ready; ++p) write(made[p]);
        });
        ready = parts;
        std::swap(made, next);
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
        // Escapes characters that would end the value, and white space, which a reader would turn into spaces.
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
    for (const OutArray& array : arrays) {
        const std::string &name = array.format.name, named = "the name of field \"" + name + '"';
        if (name.empty()) return "a field has no name";
        if (names == Names::xml && !xml_attribute(name)) return named + " has bytes that XML cannot hold";
        if (names == Names::xml) continue;
        // VTK's readers take words of up to 255 bytes, and others than these may be written as three.
        const auto plain = static_cast<std::size_t>(std::ranges::count_if(name, is_letter_or_digit));
        if (3 * name.size() - 2 * plain > 200) return named + " is too long for the format";
        if (name == "METADATA" || name == "NULL_ARRAY") return named + " means something else in the format";
    }
    const std::string* const twice = name_twice(arrays);
    return twice == nullptr ? "" : "two fields are named \"" + *twice + '"';
}

Error cannot_write(const std::string& what, const std::string& fault, const std::string& path) {
    return file_error("mesh.inconsistent", path, "cannot write " + what + ": " + fault, {}, {}, "correct it in memory");
}

Status check_arrays(const std::string& path, const std::vector<OutArray>& arrays) {
    for (const OutArray& array : arrays) {
        const auto& [name, components, type] = array.format;
        if (name.empty()) return wrong_in_memory("field.type", path, "the name of an array", "one", "none");
        if (!xml_attribute(name))
            return wrong_in_memory("field.type", path, "the name of an array",
                                   "text in UTF-8 without control characters", '"' + name + '"');
        if (components < 1)
            return wrong_in_memory("field.component", path, "the components of array \"" + name + '"', "1 or more",
                                   std::to_string(components));
    }
    if (const std::string* const twice = name_twice(arrays); twice != nullptr)
        return wrong_in_memory("column.duplicate", path, "the names of arrays", "different ones",
                               '"' + *twice + "\" twice");
    return Done{};
}

Error wrong_in_memory(ErrorCode code, const std::string& path, std::string what, std::string expected,
                      std::string found) {
    return file_error(code, path, std::move(what), std::move(expected), std::move(found),
                      "correct what is to be written, or its arrays, in memory");
}

std::string raw_head(const OutFile& f) {
    std::vector<std::uint64_t> offsets{0};
    for_each_array(f, [&](const OutArray& a) { offsets.push_back(offsets.back() + appended_header + a.size()); });
    return head_of(f, {}, offsets, 0);
}

Status write_xml(const OutFile& f, const std::string& path, VtkData data) {
    base::OutputFile file(path);
    if (Status good = file.status(); !good) return good;
    if (data == VtkData::raw) {
        write_raw(f, file);
    } else if (data == VtkData::ascii) {
        write_text(f, file);
    } else if (!write_compressed(f, data, file)) {
        return file_error("memory.short", path, "too little memory to compress the data", {}, {}, "free some memory");
    }
    return file.commit();
}

}  // namespace barycert::io
