#include "meshing/perturb.hpp"

#include "core/random.hpp"
#include "meshing/vertex_star.hpp"

namespace knap {

void perturb_interior(TetMesh& mesh, double fraction, std::int64_t seed) {
  constexpr double worst_allowed = 0.1;
  constexpr std::uint64_t stream = 0x70657274757262ULL;  // apart from the numbers that turned the geometry
  std::uint64_t random = static_cast<std::uint64_t>(seed) ^ stream;
  const Csr tets_of = tets_of_vertices(mesh);
  const std::vector<bool> on_surface = surface_vertices(mesh);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (on_surface[at(v)]) continue;
    const Vec3 before = mesh.vertices[at(v)];
    const double worst_before = worst_shape(mesh, tets_of[v]);
    mesh.vertices[at(v)] += fraction * mean_edge_at(mesh, tets_of[v], v) * random_in_unit_ball(random);
    const double worst = worst_shape(mesh, tets_of[v]);
    if (worst < worst_allowed && worst < worst_before) mesh.vertices[at(v)] = before;
  }
}

}  // namespace knap
