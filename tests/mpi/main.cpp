// Tests that all ranks of a job run together. The first rank prints; others print what fails.

#include <gtest/gtest.h>

#include <cstdio>

#include <vtkMPIController.h>
#include <vtkNew.h>

namespace {

class Failures : public ::testing::EmptyTestEventListener {
public:
    explicit Failures(int rank) : rank_(rank) {}
    void OnTestPartResult(const ::testing::TestPartResult& part) override {
        if (part.failed())
            std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, part.file_name(), part.line_number(), part.message());
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
    if (controller->GetLocalProcessId() != 0) {
        delete listeners.Release(listeners.default_result_printer());
        listeners.Append(new Failures(controller->GetLocalProcessId()));
    }
    const int result = RUN_ALL_TESTS();
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize();
    return result;
}
