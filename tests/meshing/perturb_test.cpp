#include "meshing/perturb.hpp"

#include <gtest/gtest.h>

#include "meshing/mesh_quality.hpp"
#include "meshing/tetrahedralise.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {
namespace {

TetMesh small_box() { return tetrahedralise(Box{{1.0, 1.0, 1.0}}, {.element_size = 0.2}); }

TEST(PerturbInterior, MovesTheInteriorOnlyAndNotTooFar) {
  const TetMesh before = small_box();
  const Csr tets_of = tets_of_vertices(before);
  TetMesh after = before;
  perturb_interior(after, 0.1, 3);
  const std::vector<bool> on_surface = surface_vertices(before);
  Index moved = 0, interior = 0;
  for (Index v = 0; v < before.num_vertices(); ++v) {
    const double distance = (after.vertices[at(v)] - before.vertices[at(v)]).norm();
    if (on_surface[at(v)]) {
      EXPECT_EQ(distance, 0.0);
      continue;
    }
    ++interior;
    moved += distance > 0.0;
    // Neighbours that moved first change the mean edge a little.
    EXPECT_LE(distance, 0.1 * 1.1 * mean_edge_at(before, tets_of[v], v));
  }
  EXPECT_GT(interior, 50);
  EXPECT_EQ(moved, interior);
}

TEST(PerturbInterior, NeverLeavesABadTet) {
  TetMesh mesh = small_box();
  for (std::int64_t seed = 1; seed <= 5; ++seed) perturb_interior(mesh, 0.3, seed);
  EXPECT_GE(measure_quality(mesh).min_shape, 0.1);
}

TEST(PerturbInterior, SeedsRepeatAndDiffer) {
  TetMesh a = small_box(), b = a, c = a;
  perturb_interior(a, 0.1, 1);
  perturb_interior(b, 0.1, 1);
  perturb_interior(c, 0.1, 2);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_NE(a.vertices, c.vertices);
}

}  // namespace
}  // namespace knap
