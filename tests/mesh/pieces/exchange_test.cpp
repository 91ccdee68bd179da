// Messages between ranks: sizes from nothing to more than one chunk, lost ones, and errors.

#include "mesh/pieces/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/mesh/pieces/threads.hpp"

namespace barycert::testing {
namespace {

using pieces::Exchange;
using pieces::Parcels;

std::vector<double> letter(int from, int to) {
    const auto size = static_cast<std::size_t>((37 * from + 101 * to) % 5) * 40;
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i) values.push_back(1000.0 * from + to + 0.001 * static_cast<double>(i));
    return values;
}

std::vector<int> every(int skip, const Exchange& exchange) {
    std::vector<int> partners;
    for (int other = 0; other < exchange.size(); ++other)
        if (other != exchange.rank() && (other - exchange.rank()) % skip == 0) partners.push_back(other);
    return partners;
}

TEST(Exchanges, BringEveryValueToItsPartner) {
    for (const int size : {1, 2, 3, 8}) {
        for (const int skip : {1, 2, 3}) {
            // Chunks of some bytes that do not even hold whole numbers of values.
            for (const std::size_t chunk : {std::size_t{100}, std::size_t{1} << 30}) {
                Threads(size).run([&](pieces::Communicator& ranks) {
                    Exchange exchange(ranks, chunk);
                    exchange.set_partners(every(skip, exchange));
                    Parcels<double> out, in;
                    std::uint64_t bytes = 0;
                    for (const int other : exchange.partners()) {
                        const std::vector<double> one = letter(ranks.rank(), other);
                        out.values.insert(out.values.end(), one.begin(), one.end());
                        out.close();
                        bytes += 8 + 8 * one.size();
                    }
                    EXPECT_TRUE(exchange.swap(out, in).has_value());
                    EXPECT_EQ(exchange.sent(), bytes);
                    EXPECT_EQ(in.count(), exchange.partners().size());
                    for (std::size_t k = 0; k < in.count(); ++k)
                        EXPECT_TRUE(std::ranges::equal(in.of(k), letter(exchange.partners()[k], ranks.rank())));
                    // Once more, where sizes are known.
                    std::fill(in.values.begin(), in.values.end(), 0.0);
                    EXPECT_TRUE(exchange.swap(out, in, true).has_value());
                    EXPECT_EQ(exchange.sent(), 2 * bytes - 8 * in.count());
                    for (std::size_t k = 0; k < in.count(); ++k)
                        EXPECT_TRUE(std::ranges::equal(in.of(k), letter(exchange.partners()[k], ranks.rank())));
                });
            }
        }
    }
}

TEST(Exchanges, TellTheErrorOfTheLowestRankToAll) {
    for (const int size : {1, 2, 5}) {
        Threads(size).run([&](pieces::Communicator& ranks) {
            Exchange exchange(ranks);
            EXPECT_TRUE(exchange.everywhere([]() -> Status { return Done{}; }).has_value());
            const Status some = exchange.everywhere([&]() -> Status {
                if (ranks.rank() * 2 >= size - 1) throw std::runtime_error("of " + std::to_string(ranks.rank()));
                return Done{};
            });
            const std::string low = std::to_string(size / 2);
            EXPECT_EQ(some.error().message(), size == 1 ? "of 0" : "rank " + low + ": of " + low);
            const Status memory = exchange.everywhere([]() -> Status { throw std::bad_alloc(); });
            EXPECT_EQ(memory.error().message(), size == 1 ? "out of memory" : "rank 0: out of memory");
            const Status lengthy = exchange.everywhere(
                []() -> Status { return Error{.code = "mesh.inconsistent", .what = std::string(5000, 'x')}; });
            EXPECT_FALSE(lengthy.has_value());
        });
    }
}

TEST(Exchanges, TellAllOfALostMessage) {
    Threads job(3);
    job.lose_one_of(1);
    job.run([&](pieces::Communicator& ranks) {
        Exchange exchange(ranks);
        exchange.set_partners(every(1, exchange));
        Parcels<double> out, in;
        for (int k = 0; k < 2; ++k) out.close();
        for (std::size_t k = 0; k < 2; ++k) out.values.push_back(1), out.begin[k + 1] = k + 1;
        const Status swapped = exchange.swap(out, in);
        ASSERT_FALSE(swapped.has_value());
        EXPECT_EQ(swapped.error().message(), "rank 1: a message to or from another rank was lost");
    });
}

TEST(Exchanges, GatherAndBroadcast) {
    for (const int size : {1, 4}) {
        Threads(size).run([&](pieces::Communicator& ranks) {
            Exchange exchange(ranks);
            std::vector<int> all(static_cast<std::size_t>(size));
            exchange.gather(10 * ranks.rank(), all);
            for (int r = 0; r < size; ++r) EXPECT_EQ(all[static_cast<std::size_t>(r)], 10 * r);
            std::vector<unsigned char> bytes(static_cast<std::size_t>(3 * ranks.rank()),
                                             static_cast<unsigned char>(ranks.rank()));
            for (const int from : {size - 1, 0}) {
                std::vector<unsigned char> mine = bytes;
                EXPECT_TRUE(exchange.broadcast(mine, from).has_value());
                EXPECT_EQ(mine, std::vector<unsigned char>(static_cast<std::size_t>(3 * from),
                                                           static_cast<unsigned char>(from)));
            }
            std::array<double, 2> values{static_cast<double>(ranks.rank()), -static_cast<double>(ranks.rank())};
            exchange.least(values);
            EXPECT_EQ(values[0], 0);
            EXPECT_EQ(values[1], 1.0 - size);
            EXPECT_EQ(exchange.gathered() > 0, size > 1);
        });
    }
}

}  // namespace
}  // namespace barycert::testing
