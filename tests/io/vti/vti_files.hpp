/// Grids written in blocks, in one order or another.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "io/vti/vti.hpp"

namespace barycert::testing {

using Bytes = std::vector<std::byte>;

inline Bytes any_bytes(base::Random& random, std::size_t count) {
    Bytes bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.below(256));
    return bytes;
}

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

/// Blocks of any length, arrays taking turns by chance (or one after the other).
inline Status write_in_blocks(const std::string& path, const io::VtiGrid& grid,
                              const std::vector<io::ArrayFormat>& arrays, const std::vector<Bytes>& data,
                              std::uint64_t seed, bool take_turns) {
    Result<std::unique_ptr<io::VtiWriter>> writer = io::VtiWriter::open(path, grid, arrays);
    if (!writer) return writer.error();
    base::Random random(seed);
    std::vector<std::size_t> done(data.size());
    while (true) {
        std::vector<std::size_t> left;
        for (std::size_t i = 0; i < data.size(); ++i) {
            if (done[i] < data[i].size()) left.push_back(i);
        }
        if (left.empty()) break;
        const std::size_t array = take_turns ? left[random.below(left.size())] : left[0];
        const std::size_t step = std::min<std::size_t>(data[array].size() - done[array], random.below(1000));
        if (Status s = (*writer)->write(array, std::span(data[array]).subspan(done[array], step)); !s) return s;
        done[array] += step;
    }
    return (*writer)->commit();
}

}  // namespace barycert::testing
