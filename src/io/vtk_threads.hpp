#pragma once

namespace knap {

/// Makes VTK work on the calling thread alone: a thread pool does not survive a fork.
void use_one_vtk_thread();

}  // namespace knap
