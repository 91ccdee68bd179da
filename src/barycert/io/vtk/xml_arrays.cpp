#include "barycert/io/vtk/xml.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <span>
#include <utility>

namespace barycert::io {
namespace {

/// The data of an array, of which a header tells the sizes. Compressed block by block: number of blocks, bytes of a
/// block, bytes of the last one if it is shorter (else 0), then the compressed bytes of each block; then the blocks.
/// Others: their bytes.
class ArrayData {
public:
    ArrayData(Encoded from, const XmlLayout& layout) : from_(from), layout_(layout) {}

    /// Reads the header; what is wrong with it, or empty.
    std::string open() {
        constexpr const char* too_short = "the data end before their header does";
        const bool plain = layout_.compressor == Compressor::none;
        const std::optional<std::vector<std::uint64_t>> head = next_words(plain ? 1 : 3);
        if (!head || (!plain && head->front() > from_.left() / layout_.header_bytes)) return too_short;
        size_ = head->front();
        if (plain || size_ == 0) return {};
        const std::uint64_t blocks = size_, last = (*head)[2] != 0 ? (*head)[2] : (*head)[1];
        block_ = (*head)[1];
        if (last > block_ || __builtin_mul_overflow(blocks - 1, block_, &size_) ||
            __builtin_add_overflow(size_, last, &size_))
            return "a header of compressed blocks that contradicts itself";
        std::optional<std::vector<std::uint64_t>> packed = next_words(static_cast<std::size_t>(blocks));
        if (!packed) return too_short;
        packed_ = std::move(*packed);
        for (const std::uint64_t& bytes : packed_) {
            if (__builtin_add_overflow(packed_size_, bytes, &packed_size_))
                return "compressed blocks of more than 2^64 bytes";
            if ((&bytes != &packed_.back() ? block_ : last) > max_unpacked(layout_.compressor, bytes))
                return "a block that holds more than its compressed bytes can";
        }
        return packed_size_ > from_.left() ? "the data end before the last block does" : "";
    }

    /// Bytes of all blocks, as the header has them.
    std::uint64_t size() const { return size_; }

    /// As read_binary of numbers.hpp, of exactly size() bytes. Blocks are unpacked on all threads, some at a time, so
    /// that memory grows with what the file really has.
    template <class To>
    NumberFault read(NumberType type, std::size_t count, std::vector<To>& values) {
        if (layout_.compressor == Compressor::none) {
            const std::uint64_t there = std::min(from_.left(), size_) / number_bytes(type);  // at most
            std::vector<char> room;
            const std::optional<std::string_view> bytes = from_.take(size_, room);
            if (bytes) return read_binary(*bytes, type, layout_.swap_bytes, count, values);
            return {NumberFault::Kind::too_few, std::min(static_cast<std::size_t>(there), count - 1)};
        }
        const std::size_t number = number_bytes(type);
        constexpr std::uint64_t wave_bytes = std::uint64_t{1} << 24;
        auto per_wave =
            static_cast<std::size_t>(std::max<std::uint64_t>(wave_bytes / std::max<std::uint64_t>(block_, 1), 1));
        if (per_wave > number) per_wave -= per_wave % number;
        // Numbers across the bounds of waves: another size of block than any writer is known to choose.
        const bool at_once = type == NumberType::bit || per_wave * block_ % number != 0;
        if (at_once) per_wave = packed_.size();
        // No block holds more than its bytes can. Those of lzma could hold a hundred times what data ever have: memory
        // grows with what there is.
        constexpr std::uint64_t likely = 64;
        const bool honest = layout_.compressor != Compressor::lzma;
        make_room(values,
                  honest ? count : static_cast<std::size_t>(std::min<std::uint64_t>(count, likely * packed_size_)));
        std::vector<char> packed_room;
        std::unique_ptr<char[]> plain_room;  // not initialised: pages that no data reach take no memory
        NumberFault fault;
        std::size_t done = 0;
        for (std::size_t first = 0; first < packed_.size(); first += per_wave) {
            const std::size_t last = std::min(packed_.size(), first + per_wave);
            const std::size_t plain = block_at(last) - block_at(first), before = values.size();
            const std::size_t numbers = at_once ? count : plain / number;
            const bool direct = last - first > 1 && are_as_they_stand(type, layout_.swap_bytes, values);
            if (direct) {
                make_room(values, numbers);
                values.resize(before + numbers);
            } else if (plain_room == nullptr) {
                plain_room = std::make_unique_for_overwrite<char[]>(plain);  // the first wave is the largest
            }
            char* const to = direct ? reinterpret_cast<char*>(values.data() + before) : plain_room.get();
            if (!unpack_wave(first, last, packed_room, to)) return {NumberFault::Kind::too_few, done};
            if (!direct) {
                NumberFault found = read_binary({to, plain}, type, layout_.swap_bytes, numbers, values);
                if (found && !fault) {
                    fault = std::move(found);
                    fault.index += done;
                }
            }
            done += numbers;
        }
        return done < count ? NumberFault{NumberFault::Kind::too_few, done} : fault;
    }

private:
    /// Integers of a header; nothing if the data end before.
    std::optional<std::vector<std::uint64_t>> next_words(std::size_t count) {
        const std::size_t width = layout_.header_bytes;
        std::vector<char> room;
        const std::optional<std::string_view> bytes = from_.take(count * width, room);
        std::vector<std::int64_t> words;
        if (!bytes) return std::nullopt;
        read_binary(*bytes, width == 8 ? NumberType::int64 : NumberType::uint32, layout_.swap_bytes, count, words);
        return std::vector<std::uint64_t>(words.begin(), words.end());
    }

    /// Where the bytes of a block begin among those of all.
    std::size_t block_at(std::size_t block) const {
        return static_cast<std::size_t>(block == packed_.size() ? size_ : block * block_);
    }

    /// Blocks `first` to `last` - 1 one behind the other at `to`.
    bool unpack_wave(std::size_t first, std::size_t last, std::vector<char>& room, char* to) {
        std::vector<std::size_t> ends{0};
        for (std::size_t i = first; i < last; ++i) ends.push_back(ends.back() + static_cast<std::size_t>(packed_[i]));
        const std::optional<std::string_view> bytes = from_.take(ends.back(), room);
        std::atomic<bool> good{bytes.has_value()};
        if (!good) return false;
        in_parallel(last - first, [&](std::size_t i) {
            const std::size_t begin = block_at(first + i), end = block_at(first + i + 1);
            if (!unpack(layout_.compressor, bytes->substr(ends[i], ends[i + 1] - ends[i]), to + begin - block_at(first),
                        end - begin))
                good = false;
        });
        return good;
    }

    Encoded from_;
    const XmlLayout& layout_;
    std::vector<std::uint64_t> packed_;  // bytes of each block
    std::uint64_t block_ = 0, size_ = 0, packed_size_ = 0;
};

}  // namespace

Result<XmlArrays> XmlArrays::of(const XmlTree& tree) {
    // What each attribute may be; the first is that of files without it.
    constexpr std::array<std::string_view, 2> orders{"LittleEndian", "BigEndian"}, headers{"UInt32", "UInt64"};
    const std::array<std::pair<const char*, std::span<const std::string_view>>, 3> known{
        {{"byte_order", orders}, {"header_type", headers}, {"compressor", compressor_names}}};
    std::array<std::size_t, 3> chosen{};
    for (std::size_t i = 0; i < known.size(); ++i) {
        const auto& [key, values] = known[i];
        const std::string_view value = tree.root().attribute(key).value_or(values.front());
        chosen[i] = static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
        if (chosen[i] < values.size()) continue;
        std::string names;
        for (const std::string_view name : values) names.append(names.empty() ? "" : ", ").append(name);
        return tree.error(tree.root(), std::string("the attribute ") + key + " of the file", names, in_quotes(value));
    }
    XmlArrays arrays(tree);
    arrays.layout_ = {.swap_bytes = (chosen[0] == 0) != (std::endian::native == std::endian::little),
                      .header_bytes = chosen[1] == 0 ? 4U : 8U,
                      .compressor = static_cast<Compressor>(chosen[2])};
    return arrays;
}

std::optional<NumberType> XmlArrays::type_of(const XmlElement& array) {
    const std::string_view name = array.attribute("type").value_or("");
    const std::optional<NumberType> type = type_of_name(name);
    return array.name == "DataArray" && type && xml_name(*type) == name && type != NumberType::text ? type
                                                                                                    : std::nullopt;
}

/// A number stands in a line of its own.
Error XmlArrays::error(const XmlElement& array, const std::string& what, std::uint64_t count,
                       const NumberFault& fault) const {
    const char* const file = tree_.bytes.data();
    const std::size_t at = fault.place != nullptr ? static_cast<std::size_t>(fault.place - file) : array.begin;
    return number_error(tree_.path, line_of(tree_.bytes, at), what, count, fault);
}

/// `count` numbers, or all where it is not known.
Status XmlArrays::read_any(const XmlElement& array, const std::string& what, NumberType type,
                           std::optional<std::uint64_t> count, NumbersTo values, NumberFault& fault) const {
    constexpr std::uint64_t all = std::numeric_limits<std::size_t>::max();
    const std::string_view format = array.attribute("format").value_or("ascii");
    if (format != "ascii" && format != "binary" && format != "appended")
        return tree_.error(array, "the format of " + what, "ascii, binary or appended", in_quotes(format));
    std::string_view text = format == "appended" ? tree_.appended : tree_.text_of(array);
    if (format == "ascii") {
        fault = read_text(text, type, static_cast<std::size_t>(count.value_or(all)), values);
        if (!count && fault.kind == NumberFault::Kind::too_few) fault = {};
        const bool ended = fault.kind == NumberFault::Kind::too_few || fault.kind == NumberFault::Kind::no_number;
        if (!ended && !next_word(text).empty())
            return tree_.error(array, what, std::to_string(*count) + " numbers", "more",
                               "they do not match the counts of points, cells and components");
        return Done{};
    }
    if (count == 0U) return Done{};  // without a number there may be no header either
    const std::optional<std::uint64_t> size = byte_count(type, count.value_or(0));
    if (!size) return tree_.error(array, "the size of " + what, "less than 2^64 bytes", "more");
    if (format == "appended") {
        const std::string_view offset = array.attribute("offset").value_or("");
        const std::uint64_t begin = parse_count(offset).value_or(all);
        if (begin >= text.size())
            return tree_.error(
                array, "the offset of " + what + " into the appended data",
                "less than " + std::to_string(text.size()) + ", the bytes from there to the end of the file",
                in_quotes(offset), cut_off);
        text.remove_prefix(static_cast<std::size_t>(begin));
    }
    ArrayData data(Encoded(text, format == "binary" || !tree_.appended_raw), layout_);
    if (const std::string found = data.open(); !found.empty())
        return tree_.error(array, "the data of " + what, {}, found, "write the file again");
    if (count && data.size() != *size)
        return tree_.error(array, "the size of " + what, std::to_string(*size) + " bytes", std::to_string(data.size()),
                           "its numbers do not match the counts of points, cells and components");
    const auto numbers = static_cast<std::size_t>(count.value_or(data.size() / number_bytes(type)));
    fault = std::visit([&](auto to) { return data.read(type, numbers, to.get()); }, values);
    return Done{};
}

Status XmlArrays::read(const XmlElement& array, const std::string& what, std::uint64_t count, NumbersTo values,
                       NumberFault* fault) const {
    const std::optional<NumberType> type = type_of(array);
    if (!type)
        return tree_.error(array, "the type of " + what, "Int8 to UInt64, Float32, Float64 or Bit",
                           in_quotes(array.attribute("type").value_or("")));
    NumberFault found;
    if (Status s = read_any(array, what, *type, count, values, found); !s) return s;
    if (fault != nullptr && found.kind == NumberFault::Kind::not_exact) {
        *fault = std::move(found);
    } else if (found) {
        return error(array, what, count, found);
    }
    return Done{};
}

/// Each text ends with a zero byte; in ascii format bytes are written as numbers.
Status XmlArrays::read_texts(const XmlElement& array, const std::string& what, std::uint64_t count,
                             std::vector<std::string>& texts) const {
    std::vector<std::uint8_t> bytes;
    NumberFault fault;
    if (count == 0) return Done{};
    if (Status s = read_any(array, what, NumberType::uint8, std::nullopt, bytes, fault); !s) return s;
    if (fault) return error(array, what, count, fault);
    std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto found = static_cast<std::uint64_t>(std::ranges::count(all, '\0'));
    if (found != count || !all.ends_with('\0'))
        return tree_.error(array, "the texts of " + what, std::to_string(count) + ", each ended by a zero byte",
                           std::to_string(found) + " ends, and " + std::to_string(all.size()) + " bytes");
    for (; !all.empty(); all.remove_prefix(texts.back().size() + 1)) texts.emplace_back(all.data());
    return Done{};
}

}  // namespace barycert::io
