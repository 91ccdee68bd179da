#include "barycert/io/gmsh/line_index.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "barycert/base/workers.hpp"

namespace barycert::io {
namespace {

/// Fits in a core's own cache, which has it for the second look.
constexpr std::size_t piece = std::size_t{1} << 18;

const char* next_byte(const char* at, const char* end, char byte) {
    return static_cast<const char*>(std::memchr(at, byte, static_cast<std::size_t>(end - at)));
}

/// Line feeds, 64 bytes at a time: sums of bytes, which compilers make vectors of, overflow after 255 rounds.
std::size_t count_feeds(const char* at, const char* end) {
    std::size_t total = 0;
    while (end - at >= 64) {
        std::array<std::uint8_t, 64> sums{};
        for (int round = 0; round < 255 && end - at >= 64; ++round, at += 64) {
            for (std::size_t i = 0; i < 64; ++i) sums[i] = static_cast<std::uint8_t>(sums[i] + (at[i] == '\n'));
        }
        for (const std::uint8_t sum : sums) total += sum;
    }
    return total + static_cast<std::size_t>(std::count(at, end, '\n'));
}

}  // namespace

LineIndex::LineIndex(std::string_view text, int threads) : text_(text) {
    const std::size_t pieces = (text.size() + piece - 1) / piece;
    before_.resize(pieces + 1);
    std::vector<std::vector<const char*>> marks(pieces);
    base::share_work(threads, pieces, [&](std::size_t i) {
        const std::string_view part = text.substr(i * piece, piece);
        const char* const end = part.data() + part.size();
        before_[i + 1] = count_feeds(part.data(), end);
        for (const char* at = next_byte(part.data(), end, '$'); at != nullptr; at = next_byte(at + 1, end, '$')) {
            if (at == text.data() || at[-1] == '\n') marks[i].push_back(at);
        }
        return true;
    });
    for (std::size_t i = 0; i < pieces; ++i) before_[i + 1] += before_[i];
    for (const auto& some : marks) marked_.insert(marked_.end(), some.begin(), some.end());
}

std::size_t LineIndex::number(const char* at) const {
    const std::size_t i = static_cast<std::size_t>(at - text_.data()) / piece;
    return before_[i] + count_feeds(text_.data() + i * piece, at);
}

const char* LineIndex::start(std::size_t number, const Place& from) const {
    if (number == from.line) return from.at;
    if (before_.empty() || number > before_.back()) return nullptr;
    // The piece with the line feed before the line; it is the last one with fewer before it.
    const auto after = std::lower_bound(before_.begin(), before_.end(), number);
    const auto i = static_cast<std::size_t>(after - before_.begin()) - 1;
    Place place{text_.data() + i * piece, before_[i]};
    if (from.at > place.at) place = from;
    const char* const end = text_.data() + text_.size();
    for (; place.line < number; ++place.line) place.at = next_byte(place.at, end, '\n') + 1;
    return place.at;
}

std::vector<LineIndex::Part> LineIndex::cut(const Place& from, std::size_t count) const {
    std::vector<Part> parts;
    if (count == 0) return parts;
    // Lines begin in the piece that has the line feed before them.
    for (Part part{0, 0, from.at}; part.first != count; part.first = part.last) {
        const auto i = static_cast<std::size_t>(part.at - text_.data()) / piece;
        part.last = before_[i + 1] < from.line + count ? before_[i + 1] + 1 - from.line : count;
        if (part.last <= part.first) part.last = part.first + 1;
        parts.push_back(part);
        if (part.last != count) part.at = start(from.line + part.last, {part.at, from.line + part.first});
    }
    return parts;
}

}  // namespace barycert::io
