#include "barycert/io/vtk/blocks.hpp"

#include <atomic>
#include <bit>
#include <memory>
#include <numeric>

#include "barycert/io/vtk/parallel.hpp"
#include "barycert/io/vtk/xml_arrays.hpp"

namespace barycert::io {

std::optional<std::uint64_t> read_header(Encoded& from, const XmlLayout& layout) {
    std::vector<char> room;
    const std::optional<std::string_view> bytes = from.take(layout.header_bytes, room);
    if (!bytes) return std::nullopt;
    const bool big = layout.swap_bytes != (std::endian::native == std::endian::big);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < layout.header_bytes; ++i) {
        const char byte = (*bytes)[big ? i : layout.header_bytes - 1 - i];
        value = value << 8U | static_cast<unsigned char>(byte);
    }
    return value;
}

std::string BlockData::open() {
    const std::optional<std::uint64_t> blocks = read_header(from_, layout_);
    const std::optional<std::uint64_t> block = read_header(from_, layout_);
    const std::optional<std::uint64_t> last = read_header(from_, layout_);
    const char* const cut_off = "the data end before their header does";
    if (!blocks || !block || !last || *blocks > from_.left() / layout_.header_bytes) return cut_off;
    block_ = *block;
    last_ = *last != 0 ? *last : block_;
    if (*blocks == 0) return {};
    if (last_ > block_ || __builtin_mul_overflow(*blocks - 1, block_, &size_) ||
        __builtin_add_overflow(size_, last_, &size_)) {
        return "a header of compressed blocks that contradicts itself";
    }
    std::uint64_t packed = 0;
    for (std::uint64_t i = 0; i < *blocks; ++i) {
        const std::optional<std::uint64_t> bytes = read_header(from_, layout_);
        if (!bytes) return cut_off;
        packed_.push_back(*bytes);
        if (__builtin_add_overflow(packed, *bytes, &packed)) return "compressed blocks of more than 2^64 bytes";
        if ((i + 1 < *blocks ? block_ : last_) > max_unpacked(layout_.compressor, *bytes))
            return "a block that holds more than its compressed bytes can";
    }
    return packed > from_.left() ? "the data end before the last block does" : "";
}

/// Blocks `first` to `last` - 1 one behind the other at `to`.
bool BlockData::unpack_wave(std::size_t first, std::size_t last, const std::vector<std::string_view>& bytes,
                            char* to) const {
    std::atomic<bool> good{true};
    in_parallel(last - first, [&](std::size_t i) {
        if (!unpack(layout_.compressor, bytes[i], to + i * static_cast<std::size_t>(block_), plain_size(first + i)))
            good = false;
    });
    return good;
}

template <class To>
NumberFault BlockData::read(NumberType type, std::size_t count, std::vector<To>& values) {
    // Numbers across the bounds of waves: another size of block than any writer is known to choose.
    const std::size_t number = number_bytes(type);
    constexpr std::uint64_t wave_bytes = std::uint64_t{1} << 24;
    std::size_t per_wave =
        static_cast<std::size_t>(std::max<std::uint64_t>(wave_bytes / std::max<std::uint64_t>(block_, 1), 1));
    if (per_wave > number) per_wave -= per_wave % number;
    if (type == NumberType::bit || (per_wave * block_ % number != 0 && per_wave < packed_.size()))
        return read_whole(type, count, values);
    NumberFault fault;
    // No block holds more than its bytes can. Those of lzma could hold a hundred times what data ever have: memory
    // grows with what there is.
    constexpr std::uint64_t likely = 64;
    const std::uint64_t packed_all = std::accumulate(packed_.begin(), packed_.end(), std::uint64_t{0});
    const bool honest = layout_.compressor != Compressor::lzma;
    make_room(values, honest ? count : static_cast<std::size_t>(std::min<std::uint64_t>(count, likely * packed_all)));
    std::vector<char> packed_room;
    std::unique_ptr<char[]> plain_room;  // not initialised: pages that no data reach take no memory
    std::size_t done = 0;
    for (std::size_t first = 0; first < packed_.size(); first += per_wave) {
        const std::size_t last = std::min(packed_.size(), first + per_wave);
        std::uint64_t packed = 0, plain = 0;
        for (std::size_t i = first; i < last; ++i) {
            packed += packed_[i];
            plain += plain_size(i);
        }
        const std::optional<std::string_view> bytes = from_.take(packed, packed_room);
        if (!bytes) return {NumberFault::Kind::too_few, done, {}};
        std::vector<std::string_view> blocks;
        std::size_t at = 0;
        for (std::size_t i = first; i < last; ++i) {
            blocks.push_back(bytes->substr(at, static_cast<std::size_t>(packed_[i])));
            at += static_cast<std::size_t>(packed_[i]);
        }
        const std::size_t numbers = static_cast<std::size_t>(plain) / number, before = values.size();
        const bool direct = are_as_they_stand<To>(type, layout_.swap_bytes) && last - first > 1;
        if (!direct && plain_room == nullptr)
            plain_room =
                std::make_unique_for_overwrite<char[]>(static_cast<std::size_t>(std::min(size_, per_wave * block_)));
        if (direct) {
            make_room(values, numbers);
            values.resize(before + numbers);
        }
        char* const to = direct ? reinterpret_cast<char*>(values.data() + before) : plain_room.get();
        if (!unpack_wave(first, last, blocks, to)) return {NumberFault::Kind::too_few, done, {}};
        if (!direct) {
            NumberFault found =
                read_binary({to, static_cast<std::size_t>(plain)}, type, layout_.swap_bytes, numbers, values);
            if (found && !fault) {
                fault = std::move(found);
                fault.index += done;
            }
        }
        done += numbers;
    }
    return done < count ? NumberFault{NumberFault::Kind::too_few, done, {}} : fault;
}

template <class To>
NumberFault BlockData::read_whole(NumberType type, std::size_t count, std::vector<To>& values) {
    std::vector<char> plain, room;
    for (std::size_t i = 0; i < packed_.size(); ++i) {
        const std::optional<std::string_view> bytes = from_.take(packed_[i], room);
        const auto block = std::make_unique_for_overwrite<char[]>(plain_size(i));
        if (!bytes || !unpack(layout_.compressor, *bytes, block.get(), plain_size(i))) break;
        plain.insert(plain.end(), block.get(), block.get() + plain_size(i));
    }
    return read_binary({plain.data(), plain.size()}, type, layout_.swap_bytes, count, values);
}

template NumberFault BlockData::read(NumberType, std::size_t, std::vector<double>&);
template NumberFault BlockData::read(NumberType, std::size_t, std::vector<std::int64_t>&);
template NumberFault BlockData::read(NumberType, std::size_t, std::vector<std::int32_t>&);
template NumberFault BlockData::read(NumberType, std::size_t, std::vector<std::uint8_t>&);

}  // namespace barycert::io
