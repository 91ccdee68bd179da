// In C++17: VTK 9.1's vtkSMPTools.h does not compile as C++20.
#include <vtkSMPTools.h>

namespace barycert::bench {

void use_one_vtk_thread() {
    vtkSMPTools::Initialize(1);
}

}  // namespace barycert::bench
