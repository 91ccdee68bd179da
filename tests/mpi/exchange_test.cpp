// Messages between ranks over VTK's controller: sizes from nothing to more than one chunk, and errors.
// tests/mesh/pieces has more of them, between threads.

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <vtkMultiProcessController.h>

#include "mesh/pieces/exchange.hpp"
#include "tests/mpi/pieces.hpp"
#include "vtk/distributed_probe.hpp"

namespace barycert::testing {
namespace {

using pieces::Exchange;
using pieces::Parcels;

pieces::Communicator& processes() {
    static in_vtk::Processes all(vtkMultiProcessController::GetGlobalController());
    return all;
}

std::vector<double> letter(int from, int to, std::size_t size) {
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i) values.push_back(1000.0 * from + to + 0.001 * static_cast<double>(i));
    return values;
}

std::size_t size_of(int from, int to) {
    return static_cast<std::size_t>((37 * from + 101 * to) % 5) * 40;
}

TEST(Exchanges, BringEveryValueToItsPartner) {
    for (const int skip : {1, 2, 3}) {
        // Chunks of some bytes that do not even hold whole numbers of values.
        for (const std::size_t chunk : {std::size_t{100}, std::size_t{1} << 30}) {
            Exchange exchange(processes(), chunk);
            std::vector<int> partners;
            for (int other = 0; other < ranks(); ++other)
                if (other != rank() && (other - rank()) % skip == 0) partners.push_back(other);
            exchange.set_partners(partners);
            Parcels<double> out, in;
            std::uint64_t bytes = 0;
            for (const int other : exchange.partners()) {
                const std::vector<double> one = letter(rank(), other, size_of(rank(), other));
                out.values.insert(out.values.end(), one.begin(), one.end());
                out.close();
                bytes += 8 + 8 * one.size();
            }
            ASSERT_TRUE(exchange.swap(out, in).has_value());
            EXPECT_EQ(exchange.sent(), bytes);
            ASSERT_EQ(in.count(), partners.size());
            for (std::size_t k = 0; k < in.count(); ++k) {
                const int other = exchange.partners()[k];
                const std::vector<double> expected = letter(other, rank(), size_of(other, rank()));
                EXPECT_TRUE(std::ranges::equal(in.of(k), expected));
            }
        }
    }
}

TEST(Exchanges, TellTheErrorOfTheLowestRankToAll) {
    Exchange exchange(processes(), 100);
    EXPECT_TRUE(exchange.everywhere([]() -> Status { return Done{}; }).has_value());
    const Status some = exchange.everywhere([]() -> Status {
        if (rank() * 2 >= ranks() - 1) throw std::runtime_error("of " + std::to_string(rank()));
        return Done{};
    });
    ASSERT_FALSE(some.has_value());
    const std::string low = std::to_string(ranks() / 2);
    EXPECT_EQ(some.error().message(), ranks() == 1 ? "of 0" : "rank " + low + ": of " + low);
    const Status memory = exchange.everywhere([]() -> Status { throw std::bad_alloc(); });
    EXPECT_EQ(memory.error().message(), ranks() == 1 ? "out of memory" : "rank 0: out of memory");
    const Status lengthy = exchange.everywhere(
        []() -> Status { return Error{.code = "mesh.inconsistent", .what = std::string(5000, 'x')}; });
    EXPECT_FALSE(lengthy.has_value());
}

}  // namespace
}  // namespace barycert::testing
