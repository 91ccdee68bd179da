/// Bytes of a file as they stand, written in base64, or compressed block by block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace barycert::io {

/// Room for bytes, which hold anything until they are written.
class ByteRoom {
public:
    /// `size` bytes; what stood there is lost.
    char* of(std::size_t size);

private:
    std::unique_ptr<char[]> bytes_;
    std::size_t size_ = 0;
};

/// Base64 is RFC 4648's, white space passed over. After padding it goes on with the next quadruple: VTK encodes the
/// head of compressed data apart from the data. It ends at any other character.
class Encoded {
public:
    /// Reads bytes of the file to that place, where they are not in memory: that is where they would stand.
    using ReadPart = std::function<void(std::string_view part, char* to)>;

    /// `read_part`: empty if the bytes are in memory, as those in base64 are. It must stay.
    Encoded(std::string_view bytes, bool base64, const ReadPart& read_part)
        : left_(bytes), base64_(base64), read_part_(read_part) {}

    /// The next `count` bytes: of the file itself, or read or decoded into `room`, which must live as long as the view.
    /// Nothing if there are fewer.
    std::optional<std::string_view> take(std::uint64_t count, ByteRoom& room);

    /// The next `count` bytes where they stand in the file or, if is_unread(), would stand in memory: read_part() reads
    /// them. Precondition: there are so many; no base64.
    std::string_view take_as_they_stand(std::size_t count);
    bool is_unread() const { return !base64_ && read_part_; }
    void read_part(std::string_view part, char* to) const { read_part_(part, to); }

    /// That many bytes are left at most.
    std::uint64_t left() const { return base64_ ? left_.size() / 4 * 3 + 3 + held_ : left_.size(); }

private:
    bool next_quadruple();
    std::size_t take_quadruples(char* to, std::size_t count);

    std::string_view left_;
    bool base64_;
    const ReadPart& read_part_;
    char bytes_[3] = {};
    std::size_t first_ = 0;  // of the bytes not yet given
    std::size_t held_ = 0;   // how many they are
};

enum class Compressor : std::uint8_t { none, zlib, lz4, lzma };  ///< in the order of VtkData

/// As files name them.
inline constexpr std::array<std::string_view, 4> compressor_names{"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor",
                                                                  "vtkLZMADataCompressor"};

/// Fills `size` bytes from those of a block. False if it gives fewer, or is damaged.
bool unpack(Compressor compressor, std::string_view packed, char* to, std::size_t size);

/// The block compressed; empty where memory is short.
std::string pack(Compressor compressor, std::string_view plain);

/// No block of that size unpacks to more: a header that says so lies.
std::uint64_t max_unpacked(Compressor compressor, std::uint64_t packed);

}  // namespace barycert::io
