#include "barycert/io/gmsh/msh_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "barycert/base/workers.hpp"

namespace barycert::io {
namespace {

/// Fits in a core's own cache, which has it for the second look.
constexpr std::size_t piece = std::size_t{1} << 18;

bool in_word(char c) {
    return static_cast<unsigned char>(c) > ' ';
}

/// How many words begin in [at, end); the byte before is read. 64 bytes at a time: sums of bytes, which compilers make
/// vectors of, overflow after 255 rounds.
std::size_t count_words(const char* at, const char* end) {
    std::size_t total = 0;
    while (end - at >= 64) {
        std::array<std::uint8_t, 64> sums{};
        for (int round = 0; round < 255 && end - at >= 64; ++round, at += 64) {
            for (std::size_t i = 0; i < 64; ++i) {
                const auto begins = static_cast<std::uint8_t>(static_cast<std::uint8_t>(at[i]) > ' ') &
                                    static_cast<std::uint8_t>(static_cast<std::uint8_t>((at - 1)[i]) <= ' ');
                sums[i] = static_cast<std::uint8_t>(sums[i] + begins);
            }
        }
        for (const std::uint8_t sum : sums) total += sum;
    }
    for (; at < end; ++at) total += in_word(at[0]) && !in_word(at[-1]) ? 1 : 0;
    return total;
}

}  // namespace

WordIndex::WordIndex(std::string_view text, int threads) : text_(text) {
    const std::size_t pieces = (text.size() + piece - 1) / piece;
    before_.resize(pieces + 1);
    std::vector<std::vector<const char*>> marks(pieces);
    base::share_work(threads, pieces, [&](std::size_t i) {
        const std::string_view part = text.substr(i * piece, piece);
        const char *at = part.data(), *const end = at + part.size();
        before_[i + 1] = count_words(at + (i == 0 ? 1 : 0), end);
        while ((at = static_cast<const char*>(std::memchr(at, '$', static_cast<std::size_t>(end - at)))) != nullptr) {
            if (at == text.data() || at[-1] == '\n') marks[i].push_back(at);
            ++at;
        }
        return true;
    });
    for (std::size_t i = 0; i < pieces; ++i) before_[i + 1] += before_[i];
    for (const auto& some : marks) marked_.insert(marked_.end(), some.begin(), some.end());
}

std::size_t WordIndex::before(const char* at) const {
    const std::size_t i = static_cast<std::size_t>(at - text_.data()) / piece;
    return before_[i] + count_words(text_.data() + std::max<std::size_t>(i * piece, 1), at);
}

const char* WordIndex::find(std::size_t number) const {
    // The last piece with no more before it.
    const auto after = std::upper_bound(before_.begin(), before_.end(), number);
    const auto i = static_cast<std::size_t>(after - before_.begin()) - 1;
    const char* at = text_.data() + std::max<std::size_t>(i * piece, 1);
    std::size_t left = number - before_[i];
    constexpr std::ptrdiff_t step = 1024;
    const char* const end = text_.data() + text_.size();
    for (std::size_t count = 0; end - at > step && (count = count_words(at, at + step)) <= left; at += step)
        left -= count;
    while (!in_word(at[0]) || in_word(at[-1]) || left-- != 0) ++at;
    return at;
}

std::vector<WordIndex::Part> WordIndex::cut(const char* from, std::size_t rows, std::size_t words) const {
    std::vector<Part> parts;
    if (rows == 0) return parts;
    const std::size_t base = before(from);
    for (Part part{0, 0, from}; part.first != rows; part.first = part.last) {
        const auto i = static_cast<std::size_t>(part.at - text_.data()) / piece;
        part.last = std::clamp((before_[i + 1] - base + words - 1) / words, part.first + 1, rows);
        parts.push_back(part);
        if (part.last != rows) part.at = find(base + part.last * words);
    }
    return parts;
}

const char* skip_words(const char* at, const char* end, std::size_t& count) {
    std::size_t found = 0;
    for (const char* next = at; found != count; ++found, at = next) {
        while (next != end && !in_word(*next)) ++next;
        if (next == end) break;
        while (next != end && in_word(*next)) ++next;
    }
    count = found;
    return at;
}

}  // namespace barycert::io
