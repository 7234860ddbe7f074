#pragma once
#include "meshing/shape.hpp"

namespace knap {

/// Adds the volume to the current gmsh model. `orientation` (a rotation) turns the patches, and with them the mesh, of
/// a curved shape without changing the shape; a box ignores it. Lengths should be near 1: gmsh's tolerances are
/// absolute.
void add_geometry(const Sphere& sphere, const Mat3& orientation);
void add_geometry(const Ellipsoid& ellipsoid, const Mat3& orientation);
void add_geometry(const Box& box, const Mat3& orientation);

}  // namespace knap
