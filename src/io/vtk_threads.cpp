// A file of its own, compiled as C++17: this header of VTK 9.1 is no valid C++20.
#include "io/vtk_threads.hpp"

#include <vtkSMPTools.h>

namespace knap {

void use_one_vtk_thread() { vtkSMPTools::SetBackend("Sequential"); }

}  // namespace knap
