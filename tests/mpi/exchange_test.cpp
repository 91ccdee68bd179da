// Messages between ranks: sizes from nothing to more than one chunk, errors, and boxes that find the ranks of a point.

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <vtkMultiProcessController.h>

#include "barycert/base/random.hpp"
#include "mpi/pieces.hpp"
#include "vtk/boxes.hpp"
#include "vtk/exchange.hpp"

namespace barycert::testing {
namespace {

using in_vtk::Box;
using in_vtk::Exchange;
using in_vtk::Parcels;

Exchange job(std::size_t chunk) {
    return Exchange(vtkMultiProcessController::GetGlobalController(), chunk);
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
            Exchange exchange = job(chunk);
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
    Exchange exchange = job(100);
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
    const Status lengthy = exchange.everywhere([]() -> Status { return Error{.what = std::string(5000, 'x')}; });
    EXPECT_FALSE(lengthy.has_value());
}

Box random_box(base::Random& random) {
    Box box;
    for (int corner = 0; corner < 2; ++corner) {
        double x[3];
        // On a lattice, so that many sides coincide, and points lie on them.
        for (double& c : x) c = static_cast<double>(random.below(9));
        box.add(x);
    }
    return box;
}

TEST(Boxes, AreFoundByTheirPointsWithTheirSides) {
    base::Random random(rank() == 0 ? 1 : 2);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{77}}) {
        std::vector<Box> boxes;
        std::vector<int> owners;
        for (std::size_t i = 0; i < count; ++i) {
            boxes.push_back(i % 9 == 5 ? Box() : random_box(random));
            owners.push_back(static_cast<int>(i));
        }
        const in_vtk::BoxTree tree(boxes, owners);
        for (int i = 0; i < 500; ++i) {
            const double x[3] = {static_cast<double>(random.below(10)), static_cast<double>(random.below(10)),
                                 static_cast<double>(random.below(10))};
            std::vector<int> found, expected;
            tree.holders(x, [&](int owner) { found.push_back(owner); });
            std::sort(found.begin(), found.end());
            for (std::size_t k = 0; k < count; ++k)
                if (boxes[k].holds(x)) expected.push_back(owners[k]);
            ASSERT_EQ(found, expected);
        }
    }
}

TEST(Boxes, FewCoverMany) {
    base::Random random(3);
    for (const std::size_t most : {std::size_t{1}, std::size_t{3}, std::size_t{64}}) {
        Box all;
        std::vector<Box> boxes;
        for (int i = 0; i < 1000; ++i) {
            boxes.push_back(random_box(random));
            all.add(boxes.back());
        }
        in_vtk::Gathered gathered(all);
        for (const Box& box : boxes) gathered.add(box);
        const std::vector<Box> few = in_vtk::cover(gathered.boxes(), most);
        EXPECT_LE(few.size(), most);
        for (const Box& box : boxes) {
            EXPECT_TRUE(std::any_of(few.begin(), few.end(), [&](const Box& one) {
                return one.holds(box.low.data()) && one.holds(box.high.data());
            }));
        }
    }
}

}  // namespace
}  // namespace barycert::testing
