// One rank finds no memory once, at any place: all end with an error, or none has noticed.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mpi/pieces.hpp"
#include "tests/vtk/grids.hpp"
#include "vtk/distributed_probe.hpp"
#include "vtkBarycertProbe.h"

namespace {

// VTK ends the process where it finds no memory for its own small objects, and with it the job. From 9.2 on its
// vtkFieldData has a vector of 80 bytes for each array, and there are some ten here.
constexpr std::size_t least = 1300;
std::atomic<long> left{0};  ///< allocations until one fails; 0: none does

}  // namespace

// Not inlined: GCC 12 would take malloc and delete for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (size >= least && left.load(std::memory_order_relaxed) > 0 && left.fetch_sub(1) == 1) throw std::bad_alloc();
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

// A sanitizer's own would not be freed by what follows.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace barycert::testing {
namespace {

TEST(Memory, ThatOneRankLacksEndsAll) {
    Job job(box(3, {8, 6, 6}), 200);
    const auto judge = probed<vtkBarycertProbe>(job.whole, job.mine);
    int errors = 0;
    for (long fails = 1, done = 0; done < 2; ++fails) {
        SCOPED_TRACE(fails);
        // A new one, for its index is kept.
        const auto piece = job.piece(Cut::slabs, false);
        vtkNew<vtkPolyData> output;
        output->CopyStructure(job.mine);
        in_vtk::Processes processes(vtkMultiProcessController::GetGlobalController());
        pieces::Exchange exchange(processes);
        in_vtk::ProbeReport report;
        if (rank() == ranks() / 2) left = fails;
        const Status status =
            in_vtk::probe_pieces(exchange, {.mask = "vtkValidPointMask"}, Done{}, job.mine, piece, output, report);
        int untouched = rank() == ranks() / 2 && left > 0 ? 1 : 0;
        left = 0;
        // Ranks learn by messages, too, that all know.
        std::array<double, 3> facts{status ? -1.0 : 0, status ? 0 : -1.0, -1.0 * untouched};
        exchange.least(facts);
        ASSERT_FALSE(facts[0] == -1 && facts[1] == -1);
        done += facts[2] == -1 ? 1 : 0;
        if (status) {
            expect_same(output->GetPointData(), judge->GetOutput()->GetPointData());
        } else {
            ASSERT_NE(status.error().message().find("out of memory"), std::string::npos) << status.error().message();
            ++errors;
        }
    }
    EXPECT_GT(errors, 20);
}

}  // namespace
}  // namespace barycert::testing
