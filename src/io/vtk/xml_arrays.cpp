#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "io/parallel.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/packed.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

constexpr int base64_space = -1, base64_padding = -2, base64_other = -3;

constexpr std::array<std::int8_t, 256> base64_values = [] {
    std::array<std::int8_t, 256> table{};
    table.fill(base64_other);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    for (const char c : {' ', '\t', '\n', '\r'}) table[static_cast<unsigned char>(c)] = base64_space;
    table['='] = base64_padding;
    return table;
}();

int base64_value(char c) {
    return base64_values[static_cast<unsigned char>(c)];
}

/// Whether all `quadruples` are digits, which give three bytes each.
bool decode_digits(const char* from, std::size_t quadruples, char* to) {
    int all = 0;
    for (std::size_t i = 0; i < quadruples; ++i, from += 4, to += 3) {
        const int a = base64_value(from[0]), b = base64_value(from[1]), c = base64_value(from[2]),
                  d = base64_value(from[3]);
        all |= a | b | c | d;
        const auto word = static_cast<std::uint32_t>(a << 18 | b << 12 | c << 6 | d);
        to[0] = static_cast<char>(word >> 16U);
        to[1] = static_cast<char>(word >> 8U);
        to[2] = static_cast<char>(word);
    }
    return all >= 0;
}

/// Bytes of a file as they stand or in base64: RFC 4648's, white space passed over. After padding it goes on with the
/// next quadruple: VTK encodes the head of compressed data apart from the data. It ends at any other character.
class Encoded {
public:
    /// Requires: bytes in base64 are in memory, and so are others if the tree does not read parts.
    Encoded(std::string_view bytes, bool base64, const XmlTree& tree) : left_(bytes), base64_(base64), tree_(tree) {}

    /// The next `count` bytes, or nothing: of the file, or in `room`, which must live as long as they.
    std::optional<std::string_view> take(std::uint64_t count, ByteRoom& room) {
        if (count > left()) return std::nullopt;
        const auto size = static_cast<std::size_t>(count);
        if (!base64_) {
            const std::string_view taken = take_as_they_stand(size);
            if (!is_unread()) return taken;
            tree_.read_part(taken, room.of(size));
            return std::string_view(room.of(size), size);
        }
        char* const to = room.of(size);
        bool quick = true;
        for (std::size_t done = 0; done < size;) {
            if (quick && held_ == 0) {
                const std::size_t got = take_quadruples(to + done, size - done);
                quick = got >= 3 * (std::size_t{1} << 14);  // lines of text: one after the other from here on
                done += got;
                if (done == size) break;
            }
            if (held_ == 0 && !next_quadruple()) return std::nullopt;
            const std::size_t step = std::min(size - done, held_);
            std::copy_n(bytes_ + first_, step, to + done);
            first_ += step;
            held_ -= step;
            done += step;
        }
        return std::string_view(to, size);
    }

    /// The next bytes where they stand or, if is_unread(), would. Requires: so many, no base64.
    std::string_view take_as_they_stand(std::size_t count) {
        const std::string_view taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }
    bool is_unread() const { return !base64_ && tree_.read_part; }

    /// The most bytes that are left.
    std::uint64_t left() const { return base64_ ? left_.size() / 4 * 3 + 3 + held_ : left_.size(); }

private:
    bool next_quadruple() {
        std::array<char, 4> digits{'A', 'A', 'A', 'A'};
        std::size_t count = 0, pads = 0, at = 0;
        for (; count + pads < 4 && at < left_.size(); ++at) {
            const int value = base64_value(left_[at]);
            if (value == base64_space) continue;
            if (value == base64_padding) {
                ++pads;
            } else if (value == base64_other || pads != 0) {
                break;
            } else {
                digits[count++] = left_[at];
            }
        }
        if (count + pads < 4 || count < 2) {
            left_ = {};
            return false;
        }
        left_.remove_prefix(at);
        decode_digits(digits.data(), 1, bytes_);
        first_ = 0;
        held_ = 3 - pads;
        return true;
    }

    /// Whole quadruples without white space, on all threads; the bytes of those before the first that is none.
    std::size_t take_quadruples(char* to, std::size_t count) {
        constexpr std::size_t part = std::size_t{1} << 16;
        const std::size_t wanted = std::min(count / 3, left_.size() / 4);
        const std::size_t good = first_bad(wanted, part, [&](std::size_t first, std::size_t last) {
            return decode_digits(left_.data() + 4 * first, last - first, to + 3 * first) ? last : first;
        });
        left_.remove_prefix(4 * good);
        return 3 * good;
    }

    std::string_view left_;
    bool base64_;
    const XmlTree& tree_;
    char bytes_[3] = {};
    std::size_t first_ = 0;  // of the bytes not yet given
    std::size_t held_ = 0;   // how many they are
};

/// The data of an array, of which a header tells the sizes. Compressed block by block: number of blocks, bytes of a
/// block, bytes of the last one if it is shorter (else 0), then the compressed bytes of each block; then the blocks.
/// Others: their bytes.
class ArrayData {
public:
    ArrayData(Encoded from, const XmlTree& tree) : from_(from), tree_(tree) {}

    /// Reads the header; what is wrong with it, or empty.
    std::string open() {
        constexpr const char* too_short = "the data end before their header does";
        const bool plain = tree_.compressor == VtkData::raw;
        const std::optional<std::vector<std::uint64_t>> head = next_words(plain ? 1 : 3);
        if (!head || (!plain && head->front() > from_.left() / tree_.header_bytes)) return too_short;
        size_ = head->front();
        if (plain && from_.is_unread() && size_ <= from_.left()) {  // else it is all in memory, or too short
            block_ = std::uint64_t{1} << 18;
            packed_.assign(static_cast<std::size_t>((size_ + block_ - 1) / block_), block_);
            if (size_ % block_ != 0) packed_.back() = size_ % block_;
        }
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
            if ((&bytes != &packed_.back() ? block_ : last) > max_unpacked(tree_.compressor, bytes))
                return "a block that holds more than its compressed bytes can";
        }
        return packed_size_ > from_.left() ? "the data end before the last block does" : "";
    }

    std::uint64_t size() const { return size_; }

    /// As read_binary, of size() bytes. Blocks are unpacked some at a time: memory grows with what the file really has.
    template <class To>
    NumberFault read(NumberType type, std::size_t count, std::vector<To>& values) {
        if (tree_.compressor == VtkData::raw && packed_.empty()) {
            const std::uint64_t there = std::min(from_.left(), size_) / number_bytes(type);  // at most
            ByteRoom room;
            const std::optional<std::string_view> bytes = from_.take(size_, room);
            if (bytes) return read_binary(*bytes, type, tree_.swap_bytes, count, values);
            return {NumberFault::Kind::too_few, std::min(static_cast<std::size_t>(there), count - 1)};
        }
        const std::size_t number = number_bytes(type);
        constexpr std::uint64_t wave_bytes = std::uint64_t{1} << 22;
        auto per_wave =
            static_cast<std::size_t>(std::max<std::uint64_t>(wave_bytes / std::max<std::uint64_t>(block_, 1), 1));
        if (per_wave > number) per_wave -= per_wave % number;
        // Numbers across the bounds of waves: another size of block than any writer is known to choose.
        const bool at_once = type == NumberType::bit || per_wave * block_ % number != 0;
        if (at_once) per_wave = packed_.size();
        // No block holds more than its bytes can; of lzma a hundred times what data ever have: there memory grows.
        constexpr std::uint64_t likely = 64;
        const bool honest = tree_.compressor != VtkData::lzma;
        make_room(values,
                  honest ? count : static_cast<std::size_t>(std::min<std::uint64_t>(count, likely * packed_size_)));
        const bool as_they_stand = type != NumberType::bit && (!tree_.swap_bytes || number == 1) &&
                                   with_number_type(type, []<class From>() { return std::is_same_v<From, To>; });
        ByteRoom packed_room;
        ByteRoom plain_room;
        NumberFault fault;
        std::size_t done = 0;
        for (std::size_t first = 0; first < packed_.size(); first += per_wave) {
            const std::size_t last = std::min(packed_.size(), first + per_wave);
            const std::size_t plain = block_at(last) - block_at(first), before = values.size();
            const std::size_t numbers = at_once ? count : plain / number;
            const bool direct = last - first > 1 && as_they_stand;
            if (direct) grow(values, numbers);
            char* const to = direct ? reinterpret_cast<char*>(values.data() + before) : plain_room.of(plain);
            if (!unpack_wave(first, last, packed_room, to)) return {NumberFault::Kind::too_few, done};
            if (!direct) {
                NumberFault found = read_binary({to, plain}, type, tree_.swap_bytes, numbers, values);
                found.index += done;
                if (!fault) fault = std::move(found);
            }
            done += numbers;
        }
        return done < count ? NumberFault{NumberFault::Kind::too_few, done} : fault;
    }

private:
    /// Integers of a header; nothing if the data end before.
    std::optional<std::vector<std::uint64_t>> next_words(std::size_t count) {
        const std::size_t width = tree_.header_bytes;
        ByteRoom room;
        const std::optional<std::string_view> bytes = from_.take(count * width, room);
        std::vector<std::int64_t> words;
        if (!bytes) return std::nullopt;
        read_binary(*bytes, width == 8 ? NumberType::int64 : NumberType::uint32, tree_.swap_bytes, count, words);
        return std::vector<std::uint64_t>(words.begin(), words.end());
    }

    std::size_t block_at(std::size_t block) const {
        return static_cast<std::size_t>(block == packed_.size() ? size_ : block * block_);
    }

    /// Blocks `first` to `last` - 1 one behind the other at `to`.
    bool unpack_wave(std::size_t first, std::size_t last, ByteRoom& room, char* to) {
        std::vector<std::size_t> ends{0};
        for (std::size_t i = first; i < last; ++i) ends.push_back(ends.back() + static_cast<std::size_t>(packed_[i]));
        if (tree_.compressor == VtkData::raw) {
            const std::string_view part = from_.take_as_they_stand(ends.back());
            in_parallel(last - first, [&](std::size_t i) {
                tree_.read_part(part.substr(ends[i], ends[i + 1] - ends[i]), to + ends[i]);
            });
            return true;
        }
        const std::optional<std::string_view> bytes = from_.take(ends.back(), room);
        std::atomic<bool> good{bytes.has_value()};
        if (!good) return false;
        in_parallel(last - first, [&](std::size_t i) {
            const std::size_t begin = block_at(first + i), end = block_at(first + i + 1);
            if (!unpack(tree_.compressor, bytes->substr(ends[i], ends[i + 1] - ends[i]), to + begin - block_at(first),
                        end - begin))
                good = false;
        });
        return good;
    }

    Encoded from_;
    const XmlTree& tree_;
    std::vector<std::uint64_t> packed_;  // bytes of each block
    std::uint64_t block_ = 0, size_ = 0, packed_size_ = 0;
};

/// `count` numbers, or all where it is not known.
NumberFault read_any(const XmlTree& tree, const XmlElement& array, const std::string& what, NumberType type,
                     std::optional<std::uint64_t> count, NumbersTo values) {
    constexpr std::uint64_t all = std::numeric_limits<std::size_t>::max();
    constexpr const char* other_count = "its numbers do not match the counts of points, cells and components";
    const std::string_view format = array.attribute_or("format", "ascii");
    if (format != "ascii" && format != "binary" && format != "appended")
        tree.refuse_at("file.syntax", array, "the format of " + what, "ascii, binary or appended", in_quotes(format));
    std::string_view text = format == "appended" ? tree.appended : tree.text_of(array);
    if (format == "ascii") {
        NumberFault fault = read_text(text, type, static_cast<std::size_t>(count.value_or(all)), values);
        if (fault.kind == NumberFault::Kind::too_few) return count ? fault : NumberFault{};
        if (fault.kind != NumberFault::Kind::no_number && !next_word(text).empty())
            tree.refuse_at("file.count", array, what, std::to_string(*count) + " numbers", "more", other_count);
        return fault;
    }
    if (count == 0U) return {};  // without a number there may be no header either
    const std::optional<std::uint64_t> size = byte_count(type, count.value_or(0));
    if (!size) tree.refuse_at("file.too-large", array, "the size of " + what, "less than 2^64 bytes", "more");
    if (format == "appended") {
        const std::string_view offset = array.attribute_or("offset", "");
        const std::uint64_t begin = parse_count(offset).value_or(all);
        if (begin >= text.size())
            tree.refuse_at("file.truncated", array, "the offset of " + what + " into the appended data",
                           "less than " + std::to_string(text.size()) + ", the bytes from there to the end of the file",
                           in_quotes(offset), cut_off);
        text.remove_prefix(static_cast<std::size_t>(begin));
    }
    ArrayData data(Encoded(text, format == "binary" || !tree.appended_raw, tree), tree);
    if (const std::string found = data.open(); !found.empty())
        tree.refuse_at("file.syntax", array, "the data of " + what, {}, found, "write the file again");
    if (count && data.size() != *size)
        tree.refuse_at("file.count", array, "the size of " + what, std::to_string(*size) + " bytes",
                       std::to_string(data.size()), other_count);
    const auto numbers = static_cast<std::size_t>(count.value_or(data.size() / number_bytes(type)));
    return std::visit([&](auto to) { return data.read(type, numbers, to.get()); }, values);
}

}  // namespace

void XmlTree::take_layout() {
    // Values of each attribute; the first is that of files without the attribute.
    constexpr std::array<std::string_view, 2> orders{"LittleEndian", "BigEndian"}, headers{"UInt32", "UInt64"};
    const auto choose = [&](const char* key, std::span<const std::string_view> values) {
        const std::string_view value = root().attribute_or(key, values.front());
        const auto found = std::ranges::find(values, value);
        if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
        refuse_at("file.unsupported", root(), std::string("the attribute ") + key + " of the file",
                  base::joined(values, ", ", std::identity()), in_quotes(value));
    };
    swap_bytes = (choose("byte_order", orders) == 0) != (std::endian::native == std::endian::little);
    header_bytes = choose("header_type", headers) == 0 ? 4 : 8;
    compressor = static_cast<VtkData>(choose("compressor", compressor_names));
}

std::optional<NumberType> XmlElement::number_type() const {
    const std::string_view type_name = attribute_or("type", "");
    const std::optional<NumberType> type = type_of_name(type_name);
    return name == "DataArray" && type && xml_name(*type) == type_name && type != NumberType::text ? type
                                                                                                   : std::nullopt;
}

void XmlTree::take_numbers(const XmlElement& array, const std::string& what, std::uint64_t count, NumbersTo values,
                           NumberFault* inexact) const {
    const std::optional<NumberType> type = array.number_type();
    if (!type)
        refuse_at("file.unsupported", array, "the type of " + what, "Int8 to UInt64, Float32, Float64 or Bit",
                  in_quotes(array.attribute_or("type", "")));
    check(read_any(*this, array, what, *type, count, values), bytes.data() + array.begin, what, count, inexact);
}

/// Each text ends with a zero byte; in ascii format bytes are written as numbers.
std::vector<std::string> XmlTree::take_texts(const XmlElement& array, const std::string& what,
                                             std::uint64_t count) const {
    std::vector<std::uint8_t> numbers;
    if (count == 0) return {};
    check(read_any(*this, array, what, NumberType::uint8, std::nullopt, numbers), bytes.data() + array.begin, what,
          count, nullptr);
    std::string_view all(reinterpret_cast<const char*>(numbers.data()), numbers.size());
    const auto found = static_cast<std::uint64_t>(std::ranges::count(all, '\0'));
    if (found != count || !all.ends_with('\0'))
        refuse_at("file.count", array, "the texts of " + what, std::to_string(count) + ", each ended by a zero byte",
                  std::to_string(found) + " ends, and " + std::to_string(all.size()) + " bytes");
    std::vector<std::string> texts;
    for (; !all.empty(); all.remove_prefix(texts.back().size() + 1)) texts.emplace_back(all.data());
    return texts;
}

}  // namespace barycert::io
