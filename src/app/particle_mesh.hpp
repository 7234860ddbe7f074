#pragma once
#include <optional>

#include "config/run_config.hpp"
#include "core/tet_mesh.hpp"
#include "meshing/mesh_quality.hpp"
#include "meshing/shape.hpp"
#include "meshing/tetrahedralise.hpp"

namespace knap {

/// A particle's mesh where it starts: just above the plane z = 0 if not said otherwise.
struct ParticleMesh {
  TetMesh mesh;
  MeshQuality quality;
  double diameter = 0.0;              ///< of the sphere of equal volume [m]
  double contact_element_size = 0.0;  ///< mean edge near the contacts [m]
  double element_size = 0.0;          ///< mean edge far from the contacts [m]
};

/// The shape of a case; nothing for a mesh file.
std::optional<Shape> particle_shape(const ParticleConfig& particle);
/// How that shape is to be meshed.
TetrahedraliseOptions mesh_options(const MeshConfig& mesh, const Shape& shape);

/// Free way to the wall at the start [m].
double initial_gap(double contact_element_size);

/// Meshes the shape, or reads and checks the mesh file, and puts it where it starts. Throws InputError.
ParticleMesh make_particle_mesh(const ParticleConfig& config);
/// A mesh put just above the plane z = 0.
ParticleMesh particle_on_plane(TetMesh mesh);

}  // namespace knap
