// Tests that all ranks of a job run together. The first rank prints; others print what fails.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <vtkMPIController.h>
#include <vtkNew.h>

namespace {

// After a failure ranks may no longer be in step: the job ends with the test, when all had time to print.
class Failures : public ::testing::EmptyTestEventListener {
public:
    explicit Failures(int rank) : rank_(rank) {}
    void OnTestPartResult(const ::testing::TestPartResult& part) override {
        if (part.failed() && rank_ > 0)
            std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, part.file_name(), part.line_number(), part.message());
    }
    void OnTestEnd(const ::testing::TestInfo& test) override {
        if (!test.result()->Failed()) return;
        std::fprintf(stderr, "rank %d: %s.%s failed\n", rank_, test.test_suite_name(), test.name());
        std::fflush(nullptr);
        std::this_thread::sleep_for(std::chrono::seconds(2));
        std::_Exit(1);
    }

private:
    int rank_;
};

}  // namespace

int main(int argc, char** argv) {
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv);
    vtkMultiProcessController::SetGlobalController(controller);
    ::testing::InitGoogleTest(&argc, argv);
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    if (controller->GetLocalProcessId() != 0) delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures(controller->GetLocalProcessId()));
    const int result = RUN_ALL_TESTS();
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize();
    return result;
}
