#include "barycert/io/vtk/xml_arrays.hpp"

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
Result<std::unique_ptr<ByteStream>> XmlArrays::encoded(const XmlElement& array, const std::string& what) const {
    if (array.attribute("format") != "appended") {
        return std::unique_ptr<ByteStream>(std::make_unique<Base64Stream>(text_of(bytes_, tree_, array)));
    }
    const std::optional<std::uint64_t> offset = parse_count(array.attribute("offset").value_or(""));
    if (!offset.has_value() || *offset >= tree_.appended.size()) {
        return error(
            array, "the offset of " + what + " into the appended data",
            "less than " + std::to_string(tree_.appended.size()) + ", the bytes from there to the end of the file",
            in_quotes(array.attribute("offset").value_or("")), "write the file again: it may be cut off");
    }
    const std::string_view data = tree_.appended.substr(static_cast<std::size_t>(*offset));
    if (tree_.appended_raw) return std::unique_ptr<ByteStream>(std::make_unique<PlainStream>(data));
    return std::unique_ptr<ByteStream>(std::make_unique<Base64Stream>(data));
}

/// The numbers' own bytes, which are to be `size`.
Result<std::unique_ptr<ByteStream>> XmlArrays::content(const XmlElement& array, const std::string& what,
                                                       std::uint64_t size) const {
    Result<std::unique_ptr<ByteStream>> stream = encoded(array, what);
    if (!stream) return stream;
    std::string fault;
    std::uint64_t found = 0;
    if (layout_.compressor != Compressor::none) {
        auto blocks = std::make_unique<BlockStream>(std::move(*stream), layout_);
        fault = blocks->open();
        found = blocks->size();
        stream = std::unique_ptr<ByteStream>(std::move(blocks));
    } else if (const std::optional<std::uint64_t> header = read_header(**stream, layout_); header.has_value()) {
        found = *header;
    } else {
        fault = "the data end before their header does";
    }
    if (!fault.empty()) return error(array, "the data of " + what, {}, fault, "write the file again");
    if (found != size) {
        return error(array, "the size of " + what, std::to_string(size) + " bytes", std::to_string(found),
                     "its numbers do not match the counts of points, cells and components");
    }
    return stream;
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
        if (!found && !next_word(text).empty()) {
            return error(array, what, std::to_string(count) + " numbers", "more",
                         "they do not match the counts of points, cells and components");
        }
    } else {
        const std::optional<std::uint64_t> size = byte_count(*type, count);
        if (!size.has_value()) return error(array, "the size of " + what, "less than 2^64 bytes", "more");
        // Without a number there may be no header either.
        if (count == 0) return Done{};
        Result<std::unique_ptr<ByteStream>> stream = content(array, what, *size);
        if (!stream) return stream.error();
        found = read_binary(**stream, *type, layout_.swap_bytes, static_cast<std::size_t>(count), values);
    }
    if (fault != nullptr && found.kind == NumberFault::Kind::not_exact) {
        *fault = std::move(found);
    } else if (found) {
        return number_error(path_, line_of(bytes_, array.begin), what, count, found);
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
