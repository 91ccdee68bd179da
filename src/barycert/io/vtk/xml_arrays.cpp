#include "barycert/io/vtk/xml_arrays.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "barycert/io/vtk/blocks.hpp"

namespace barycert::io {

Result<XmlLayout> layout_of(const XmlTree& tree, std::string_view bytes, const std::string& path) {
    XmlLayout layout;
    const auto choose = [&](const char* key, auto&& known, auto&& take) -> Status {
        const std::optional<std::string_view> value = tree.root().attribute(key);
        if (!value.has_value()) return Done{};
        std::string names;
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (*value == known[i]) {
                take(i);
                return Done{};
            }
            if (!known[i].empty()) names += (names.empty() ? "" : ", ") + std::string(known[i]);
        }
        return Error{.what = "the attribute " + std::string(key) + " of the file",
                     .file = path,
                     .line = line_of(bytes, tree.root().begin),
                     .expected = names,
                     .found = in_quotes(*value)};
    };
    using Names = std::array<std::string_view, 2>;
    const bool big = std::endian::native == std::endian::big;
    layout.swap_bytes = big;
    if (Status s = choose("byte_order", Names{"LittleEndian", "BigEndian"},
                          [&](std::size_t i) { layout.swap_bytes = (i == 1) != big; });
        !s) {
        return s.error();
    }
    if (Status s = choose("header_type", Names{"UInt32", "UInt64"},
                          [&](std::size_t i) { layout.header_bytes = i == 0 ? 4 : 8; });
        !s) {
        return s.error();
    }
    if (Status s = choose("compressor",
                          std::array<std::string_view, 4>{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                          "vtkLZMADataCompressor"},
                          [&](std::size_t i) { layout.compressor = static_cast<Compressor>(i); });
        !s) {
        return s.error();
    }
    return layout;
}

std::optional<NumberType> XmlArrays::type_of(const XmlElement& array) {
    constexpr std::array<std::string_view, 11> names{"Bit",    "Int8",  "UInt8",  "Int16",   "UInt16", "Int32",
                                                     "UInt32", "Int64", "UInt64", "Float32", "Float64"};
    const std::optional<std::string_view> type = array.attribute("type");
    if (array.name != "DataArray" || !type.has_value()) return std::nullopt;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (*type == names[i]) return static_cast<NumberType>(i);
    }
    return std::nullopt;
}

Error XmlArrays::error(const XmlElement& element, std::string what, std::string expected, std::string found,
                       std::string remedy) const {
    return {.what = std::move(what),
            .file = path_,
            .line = line_of(bytes_, element.begin),
            .expected = std::move(expected),
            .found = std::move(found),
            .remedy = std::move(remedy)};
}

/// The bytes of the array as they stand in the file, from its header on.
Result<Encoded> XmlArrays::encoded(const XmlElement& array, const std::string& what) const {
    if (array.attribute("format") != "appended") return Encoded(text_of(bytes_, tree_, array), true);
    const std::optional<std::uint64_t> offset = parse_count(array.attribute("offset").value_or(""));
    if (!offset.has_value() || *offset >= tree_.appended.size()) {
        return error(
            array, "the offset of " + what + " into the appended data",
            "less than " + std::to_string(tree_.appended.size()) + ", the bytes from there to the end of the file",
            in_quotes(array.attribute("offset").value_or("")), "write the file again: it may be cut off");
    }
    return Encoded(tree_.appended.substr(static_cast<std::size_t>(*offset)), !tree_.appended_raw);
}

/// Numbers that are no text: `count` of them, or all where it is not known.
template <class To>
Status XmlArrays::read_encoded(const XmlElement& array, const std::string& what, NumberType type,
                               std::optional<std::uint64_t> count, std::vector<To>& values, NumberFault& fault) const {
    const std::optional<std::uint64_t> size = byte_count(type, count.value_or(0));
    if (!size.has_value()) return error(array, "the size of " + what, "less than 2^64 bytes", "more");
    Result<Encoded> from = encoded(array, what);
    if (!from) return from.error();
    const auto damaged = [&](const std::string& found) {
        return error(array, "the data of " + what, {}, found, "write the file again");
    };
    const auto other_size = [&](std::uint64_t found) {
        return error(array, "the size of " + what, std::to_string(*size) + " bytes", std::to_string(found),
                     "its numbers do not match the counts of points, cells and components");
    };
    if (layout_.compressor != Compressor::none) {
        BlockData blocks(*from, layout_);
        if (const std::string found = blocks.open(); !found.empty()) return damaged(found);
        if (count.has_value() && blocks.size() != *size) return other_size(blocks.size());
        const std::uint64_t numbers = count.value_or(blocks.size() / number_bytes(type));
        fault = blocks.read(type, static_cast<std::size_t>(numbers), values);
        return Done{};
    }
    const std::optional<std::uint64_t> found = read_header(*from, layout_);
    if (!found.has_value()) return damaged("the data end before their header does");
    if (count.has_value() && *found != *size) return other_size(*found);
    std::vector<char> room;
    const std::optional<std::string_view> bytes = from->take(*found, room);
    const std::uint64_t numbers = count.value_or(*found / number_bytes(type));
    if (bytes.has_value()) {
        fault = read_binary(*bytes, type, layout_.swap_bytes, static_cast<std::size_t>(numbers), values);
    } else {
        fault = {NumberFault::Kind::too_few,
                 static_cast<std::size_t>(std::min(from->left(), *found) / number_bytes(type)),
                 {}};
        if (fault.index >= numbers && numbers != 0) fault.index = static_cast<std::size_t>(numbers - 1);
    }
    return Done{};
}

template <class To>
Status XmlArrays::read(const XmlElement& array, const std::string& what, std::uint64_t count, std::vector<To>& values,
                       NumberFault* fault) const {
    const std::optional<NumberType> type = type_of(array);
    const std::string_view format = array.attribute("format").value_or("ascii");
    if (!type.has_value()) {
        return error(array, "the type of " + what, "Int8 to UInt64, Float32, Float64 or Bit",
                     in_quotes(array.attribute("type").value_or("")));
    }
    if (format != "ascii" && format != "binary" && format != "appended") {
        return error(array, "the format of " + what, "ascii, binary or appended", in_quotes(format));
    }
    NumberFault found;
    if (format == "ascii") {
        std::string_view text = text_of(bytes_, tree_, array);
        found = read_text(text, *type, static_cast<std::size_t>(count), values);
        if (found.kind != NumberFault::Kind::too_few && found.kind != NumberFault::Kind::no_number &&
            !next_word(text).empty()) {
            return error(array, what, std::to_string(count) + " numbers", "more",
                         "they do not match the counts of points, cells and components");
        }
    } else if (count != 0) {  // without a number there may be no header either
        if (Status s = read_encoded(array, what, *type, count, values, found); !s) return s;
    }
    if (fault != nullptr && found.kind == NumberFault::Kind::not_exact) {
        *fault = std::move(found);
    } else if (found) {
        return number_error(path_, line_of(bytes_, array.begin), what, count, found);
    }
    return Done{};
}

/// Each text ends with a zero byte; in ascii format bytes are written as numbers.
Status XmlArrays::read_texts(const XmlElement& array, const std::string& what, std::uint64_t count,
                             std::vector<std::string>& texts) const {
    const std::string_view format = array.attribute("format").value_or("ascii");
    std::vector<std::uint8_t> bytes;
    NumberFault fault;
    if (count == 0) return Done{};
    if (format == "ascii") {
        std::string_view text = text_of(bytes_, tree_, array);
        while (!fault) {
            const std::string_view before = text;
            if (next_word(text).empty()) break;
            text = before;
            fault = read_text(text, NumberType::uint8, std::size_t{1} << 16, bytes);
            if (fault.kind == NumberFault::Kind::too_few) fault = {};
        }
    } else if (Status s = read_encoded(array, what, NumberType::uint8, std::nullopt, bytes, fault); !s) {
        return s;
    }
    if (fault) return number_error(path_, line_of(bytes_, array.begin), what, count, fault);
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto found = static_cast<std::uint64_t>(std::count(all.begin(), all.end(), '\0'));
    if (found != count || !all.ends_with('\0')) {
        return error(array, "the texts of " + what, std::to_string(count) + ", each ended by a zero byte",
                     std::to_string(found) + " ends, and " + std::to_string(all.size()) + " bytes");
    }
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = all.find('\0', begin);
        texts.emplace_back(all.substr(begin, end - begin));
        begin = end + 1;
    }
    return Done{};
}

template Status XmlArrays::read(const XmlElement&, const std::string&, std::uint64_t, std::vector<double>&,
                                NumberFault*) const;
template Status XmlArrays::read(const XmlElement&, const std::string&, std::uint64_t, std::vector<std::int64_t>&,
                                NumberFault*) const;
template Status XmlArrays::read(const XmlElement&, const std::string&, std::uint64_t, std::vector<std::int32_t>&,
                                NumberFault*) const;
template Status XmlArrays::read(const XmlElement&, const std::string&, std::uint64_t, std::vector<std::uint8_t>&,
                                NumberFault*) const;

}  // namespace barycert::io
