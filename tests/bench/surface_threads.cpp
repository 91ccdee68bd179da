// In C++17: VTK 9.1's vtkSMPTools.h does not compile as C++20.
#include <vtkSMPTools.h>

#include <string>

namespace barycert::bench {

std::string use_vtk_threads(int threads);

std::string use_vtk_threads(int threads) {
    vtkSMPTools::Initialize(threads);
    return std::string(vtkSMPTools::GetBackend()) + ", " + std::to_string(vtkSMPTools::GetEstimatedNumberOfThreads());
}

}  // namespace barycert::bench
