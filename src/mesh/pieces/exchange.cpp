#include "mesh/pieces/exchange.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"

namespace barycert::pieces {

Status Exchange::agree(const Status& mine) {
    if (size() == 1) return mine;
    double lowest = mine ? size() : rank();
    least({&lowest, 1});
    const int first = static_cast<int>(lowest);
    if (first == size()) return Done{};
    // No memory may be left: code and text have a place of their own.
    struct {
        std::array<char, 64> code{};
        std::array<char, 1024> text{};
    } told;
    if (rank() == first) {
        mine.error().code.name().copy(told.code.data(), told.code.size() - 1);
        const std::string message = mine.error().message();
        message.copy(told.text.data(), told.text.size() - 1);
    }
    ranks_.broadcast(std::as_writable_bytes(std::span(&told, 1)), first);
    gathered_ += sizeof told;
    return Error{.code = ErrorCode::named(told.code.data()).value_or(ErrorCode("rank.lost")),
                 .what = "rank " + std::to_string(first) + ": " + told.text.data()};
}

void Exchange::least(std::span<double> values) {
    if (size() == 1) return;
    ranks_.least(values);
    gathered_ += values.size_bytes();
}

Status Exchange::broadcast(std::vector<unsigned char>& bytes, int from) {
    if (size() == 1) return Done{};
    std::uint64_t count = bytes.size();
    ranks_.broadcast(std::as_writable_bytes(std::span(&count, 1)), from);
    Status room = everywhere([&] {
        if (rank() != from) bytes.resize(count);
    });
    if (!room) return room;
    if (count > 0) ranks_.broadcast(std::as_writable_bytes(std::span(bytes)), from);
    gathered_ += sizeof count + count;
    return Done{};
}

// In the order of rank XOR partner, every pair has the same place with both, and a rank no two pairs in one place. So
// the first pair that is not done can always go on. The pairs of one place meet at the same time.
void Exchange::set_partners(std::vector<int> ranks) {
    partners_ = std::move(ranks);
    std::sort(partners_.begin(), partners_.end(), [this](int a, int b) { return (a ^ rank()) < (b ^ rank()); });
}

Status Exchange::swap_bytes(std::span<const std::byte> out, std::span<const std::size_t> out_begin,
                            std::span<std::byte> in, std::span<const std::size_t> in_begin, std::size_t width) {
    bool went_well = true;
    const auto in_chunks = [&](auto bytes, std::span<const std::size_t> begin, std::size_t k, const auto& pass) {
        bytes = bytes.subspan(width * begin[k], width * (begin[k + 1] - begin[k]));
        bool passed = true;
        for (std::size_t at = 0; at < bytes.size() && passed; at += chunk_)
            passed = pass(bytes.subspan(at, std::min(chunk_, bytes.size() - at)));
        went_well = went_well && passed;
        return bytes.size();
    };
    for (std::size_t k = 0; k < partners_.size(); ++k) {
        const int other = partners_[k];
        const auto give = [&] {
            sent_ += in_chunks(out, out_begin, k, [&](auto some) { return ranks_.send(some, other); });
        };
        if (rank() < other) give();
        in_chunks(in, in_begin, k, [&](auto some) { return ranks_.receive(some, other); });
        if (rank() > other) give();
    }
    if (!went_well) return Error{.code = "rank.lost", .what = "a message to or from another rank was lost"};
    return Done{};
}

}  // namespace barycert::pieces
