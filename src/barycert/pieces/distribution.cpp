#include "barycert/pieces/distribution.hpp"

#include <cstring>
#include <limits>

namespace barycert::pieces {

Status Distribution::ask() {
    if (Status done = map_.gather(piece_, points_); !done) return done;
    if (Status done = map_.refine(piece_); !done) return done;
    Parcels<double> coordinates;
    Status room = exchange_.everywhere([&] { map_.points_to_ask(points_, asked_, coordinates); });
    if (!room) return room;
    sent_ = coordinates.values.size() / 3;
    return exchange_.swap(coordinates, received_);
}

Status Distribution::swap_values(std::span<const Mesh::Index> owners, const std::vector<std::int64_t>& numbers,
                                 const Tuples& tuples) {
    const auto number = [&](Mesh::Index cell) {
        return numbers.empty() ? map_.cells_before() + cell : numbers[static_cast<std::size_t>(cell)];
    };
    Parcels<char> answers;
    std::vector<char>& bytes = answers.values;
    Status room = exchange_.everywhere([&]() -> Status {
        // For each point that a partner asks for a bit, set if it has an owner here; for each of these the number of
        // the owner, and the tuple.
        for (std::size_t k = 0; k < exchange_.partners().size(); ++k) {
            const std::size_t count = received_.size(k) / 3, first = points_.count + received_.begin[k] / 3;
            const std::size_t bits = bytes.size();
            bytes.resize(bits + (count + 7) / 8);
            for (std::size_t i = 0; i < count; ++i) {
                if (owners[first + i] < 0) continue;
                bytes[bits + i / 8] = static_cast<char>(bytes[bits + i / 8] | 1 << i % 8);
                const std::int64_t its = number(owners[first + i]);
                const std::size_t at = bytes.size();
                bytes.resize(at + sizeof its);
                std::memcpy(bytes.data() + at, &its, sizeof its);
                tuples.put(first + i, bytes);
            }
            answers.close();
        }
        if (exchange_.partners().empty()) return Done{};
        best_.assign(points_.count, {std::numeric_limits<std::int64_t>::max(), exchange_.size()});
        for (std::size_t i = 0; i < best_.size(); ++i)
            if (owners[i] >= 0) best_[i] = {number(owners[i]), exchange_.rank()};
        return Done{};
    });
    if (!room) return room;
    return exchange_.swap(answers, answered_);
}

void Distribution::merge(Tuples& tuples, char* valid) {
    for (std::size_t k = 0; k < exchange_.partners().size(); ++k) {
        const std::span<const std::size_t> asked = asked_.of(k);
        const char* const bits = answered_.of(k).data();
        const char* bytes = bits + (asked.size() + 7) / 8;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
            Owner its{0, exchange_.partners()[k]};
            std::memcpy(&its.first, bytes, sizeof its.first);
            const bool better = its < best_[asked[i]];
            if (better) {
                best_[asked[i]] = its;
                valid[asked[i]] = 1;
            }
            bytes = tuples.take(asked[i], bytes + sizeof its.first, better);
        }
    }
}

}  // namespace barycert::pieces
