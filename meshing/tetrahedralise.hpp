#pragma once
#include "core/tet_mesh.hpp"
#include "meshing/shape.hpp"

namespace knap {

struct TetrahedraliseOptions {
  double element_size = 0.0;          ///< mean edge far from the contact points [m]
  double contact_element_size = 0.0;  ///< mean edge within contact_extent of a contact point [m]; 0 = not refined
  double contact_extent = 0.0;        ///< [m]; beyond it the size grows linearly over one more; 0 = not refined
  std::vector<Vec3> contact_points{Vec3::Zero()};  ///< at least one [m]
  std::int64_t seed = 0;                           ///< 0 = the shape's standard orientation; others give other meshes
  double perturbation = 0.0;  ///< random displacement of interior vertices over the local mean edge, 0 to 0.3
};

/// Number of tets to expect, within about 15 %: 10.9 times the integral of size^-3 over the volume, half of each
/// refined ball taken to lie in the particle. Without a contact: 10.9 volume / element_size^3.
double expected_num_tets(const Shape& shape, const TetrahedraliseOptions& options);

/// The mesh of a shape, Morton-ordered; the same bits for the same arguments. Surface vertices lie on the shape to
/// round-off, so curved shapes lose volume to their chords: a sphere 1.37 (element_size / diameter)^2 of it.
/// Throws InputError for sizes that make no sense, RuntimeFailure when gmsh fails. One call at a time in a process.
TetMesh tetrahedralise(const Shape& shape, const TetrahedraliseOptions& options);

}  // namespace knap
