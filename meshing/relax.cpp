// gmsh's optimiser swaps edges but gives up on a sliver here and there, one in 10^5 tets on a sphere; the explicit time
// step follows that one. A pattern search needs no gradient of the (non-smooth) worst quality and has few tets to
// treat.
#include "meshing/relax.hpp"

#include "meshing/mesh_quality.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {
namespace {

struct Star {
  Index vertex;
  std::span<const Index> tets;
  bool on_surface;
  Vec3 home;     // where the vertex was at first [m]
  double reach;  // farthest it may get from there, or surface vertices would wander off in a hopeless place [m]
};

// Tries the 26 directions of a cube; keeps the best. True if the vertex moved.
bool improve_once(TetMesh& mesh, const Shape& shape, const Star& star, double step) {
  Vec3& x = mesh.vertices[at(star.vertex)];
  const Vec3 start = x;
  Vec3 best_place = start;
  double best = worst_shape(mesh, star.tets);
  const double least_gain = 1e-6;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        x = start + step * Vec3(i, j, k).normalized();
        if (star.on_surface) x = snapped_to_surface(shape, x);
        if ((x - star.home).norm() > star.reach) continue;
        const double worst = worst_shape(mesh, star.tets);
        if (worst > best + least_gain) best = worst, best_place = x;
      }
  x = best_place;
  return best_place != start;
}

bool relax_vertex(TetMesh& mesh, const Shape& shape, const Star& star) {
  bool moved = false;
  const double edge = mean_edge_at(mesh, star.tets, star.vertex);
  for (double step = 0.2 * edge; step > 0.005 * edge; step *= 0.5)
    for (int i = 0; i < 4 && improve_once(mesh, shape, star, step); ++i) moved = true;
  return moved;
}

}  // namespace

void relax_worst_tets(TetMesh& mesh, const Shape& shape, double wanted) {
  const std::vector<Vec3> homes = mesh.vertices;
  const Csr tets_of = tets_of_vertices(mesh);
  const std::vector<bool> on_surface = surface_vertices(mesh);
  const bool slides = !std::holds_alternative<Box>(shape);
  constexpr int max_passes = 6;
  bool moved = true;
  for (int pass = 0; pass < max_passes && moved; ++pass) {
    moved = false;
    for (Index t = 0; t < mesh.num_tets(); ++t)
      for (const Index v : mesh.tets[at(t)]) {
        if (shape_quality(mesh, t) >= wanted) break;
        if (on_surface[at(v)] && !slides) continue;
        const double reach = 0.5 * mean_edge_at(mesh, tets_of[v], v);
        moved |= relax_vertex(mesh, shape, {v, tets_of[v], on_surface[at(v)], homes[at(v)], reach});
      }
  }
}

}  // namespace knap
