#pragma once
#include "fem/lumped_mass.hpp"
#include "meshing/tetrahedralise.hpp"
#include "quasistatic/load_path.hpp"

namespace knap {

/// A body to be pressed along z between two half spaces that move alike.
struct PressedBody {
  TetMesh mesh;
  Material material = make_material(2.45e9, 0.25, 1270.0);
  double friction = 0.0;
  Topology topology = make_topology(mesh);

  LoadedBody view() const { return {topology, mesh.vertices, material}; }
  std::array<Platen, 2> platens() const {
    const BoundingBox box = bounding_box(mesh);
    return {Platen{.point = box.low, .normal = Vec3::UnitZ(), .friction = friction},
            Platen{.point = box.high, .normal = -Vec3::UnitZ(), .friction = friction}};
  }
};

/// The particle of these tests: 1.5 mm, 2,000 tets.
inline TetMesh coarse_sphere() { return tetrahedralise(Sphere{1.5e-3}, {.element_size = 0.2e-3}); }

}  // namespace knap
