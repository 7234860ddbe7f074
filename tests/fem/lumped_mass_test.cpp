#include "fem/lumped_mass.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "fem/tet_reference.hpp"
#include "tests/fem/grid_mesh.hpp"

namespace knap {
namespace {

TEST(LumpedMass, AddsUpToTheBody) {
  const TetMesh mesh = grid_mesh(5, 2e-3, 0.15);
  const Topology topology = make_topology(mesh);
  const auto corners = corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), 2000.0);
  const auto nodes = lumped_masses(topology, corners);
  const double total = std::accumulate(nodes.begin(), nodes.end(), 0.0);
  EXPECT_NEAR(total, 2000.0 * 8e-9, 1e-12 * total);
  for (std::size_t t = 0; t < corners.size(); ++t)
    EXPECT_NEAR(corners[t], 500.0 * tet_volume(mesh, to_index(t)), 1e-13 * corners[t]);
}

TEST(LumpedMass, PiecesOfAVertexAddUpBitForBit) {
  const TetMesh mesh = grid_mesh(4, 2e-3, 0.15);
  const Topology topology = make_topology(mesh);
  const auto masses = corner_masses(topology, tet_volumes(mesh.tets, mesh.vertices), 1234.5);
  const auto whole = lumped_masses(topology, masses);
  for (Index v = 0; v < topology.num_vertices(); ++v) {
    const auto corners = topology.corners_of_vertex[v];
    for (std::size_t cut = 0; cut <= corners.size(); ++cut)
      EXPECT_EQ(corner_sum(corners.first(cut), masses) + corner_sum(corners.subspan(cut), masses), whole[at(v)]);
  }
}

}  // namespace
}  // namespace knap
