#include "meshing/relax.hpp"

#include <gtest/gtest.h>

#include "meshing/mesh_quality.hpp"
#include "meshing/tetrahedralise.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {
namespace {

// Pushes every third interior vertex most of the way towards a facet opposite of it.
void spoil(TetMesh& mesh) {
  const std::vector<bool> on_surface = surface_vertices(mesh);
  const Csr tets_of = tets_of_vertices(mesh);
  for (Index v = 0; v < mesh.num_vertices(); v += 3) {
    if (on_surface[at(v)]) continue;
    Vec3 sum = Vec3::Zero();
    for (const Index other : mesh.tets[at(tets_of[v][0])]) sum += mesh.vertices[at(other)];
    const Vec3 facet_centre = (sum - mesh.vertices[at(v)]) / 3.0;
    const Vec3 before = mesh.vertices[at(v)];
    mesh.vertices[at(v)] = 0.95 * facet_centre + 0.05 * before;
    if (worst_shape(mesh, tets_of[v]) <= 0.0) mesh.vertices[at(v)] = before;
  }
}

TEST(RelaxWorstTets, MendsASpoiltMesh) {
  const Sphere sphere{1.0};
  TetMesh mesh = tetrahedralise(sphere, {.element_size = 0.15});
  spoil(mesh);
  ASSERT_LT(measure_quality(mesh).min_shape, 0.15);
  relax_worst_tets(mesh, sphere, 0.3);
  EXPECT_GT(measure_quality(mesh).min_shape, 0.25);
  const std::vector<bool> on_surface = surface_vertices(mesh);
  for (std::size_t v = 0; v < on_surface.size(); ++v)
    EXPECT_TRUE(!on_surface[v] || std::abs(mesh.vertices[v].norm() - 0.5) < 1e-15);
}

TEST(RelaxWorstTets, LeavesAGoodMeshAlone) {
  const Box box{{1.0, 1.0, 1.0}};
  TetMesh mesh = tetrahedralise(box, {.element_size = 0.2});
  const TetMesh before = mesh;
  relax_worst_tets(mesh, box, 0.3);
  EXPECT_EQ(mesh.vertices, before.vertices);
}

}  // namespace
}  // namespace knap
