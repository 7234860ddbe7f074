#pragma once
#include <functional>

namespace knap {

/// Runs `work` in a gmsh model of its own, silently and on one thread, and leaves gmsh and OpenMP as they were.
/// gmsh's errors become RuntimeFailure with gmsh's message. gmsh is global: one call at a time in a process.
void with_gmsh(const std::function<void()>& work);

/// Meshes the current model up to a dimension. Throws RuntimeFailure with gmsh's message.
void generate_mesh(int dimension);

}  // namespace knap
