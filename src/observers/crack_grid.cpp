#include "observers/crack_grid.hpp"

#include <cmath>
#include <numbers>

#include "observers/fragment_census.hpp"

namespace knap {
namespace {

// The two sides of a facet now.
struct Opening {
  std::array<Vec3, 3> middle;
  double normal = 0.0;  ///< mean over the corners, negative where the sides overlap [m]
  double shear = 0.0;   ///< [m]
};

Opening opening(const Simulation& s, Index facet) {
  Opening result;
  Vec3 jump = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = xyz(s.nodes.x[at(s.topology.facet_node(facet, k, 0))]);
    const Vec3 b = xyz(s.nodes.x[at(s.topology.facet_node(facet, k, 1))]);
    result.middle[static_cast<std::size_t>(k)] = 0.5 * (a + b);
    jump += (b - a) / 3.0;
  }
  const auto& [a, b, c] = result.middle;
  const Vec3 normal = (b - a).cross(c - a).normalized();
  result.normal = jump.dot(normal);
  result.shear = (jump - result.normal * normal).norm();
  return result;
}

// From 0, pure opening, to 1, pure shear.
double mode_mixity(const Opening& open) {
  return 2.0 / std::numbers::pi * std::atan2(open.shear, std::max(0.0, open.normal));
}

}  // namespace

VtkGrid crack_grid(const Simulation& s) {
  VtkGrid grid;
  VtkField displacement{"displacement [m]", 3, {}};
  VtkField normal{"opening_normal [m]", 1, {}}, shear{"opening_shear [m]", 1, {}};
  VtkField damage{"damage [-]", 1, {}}, mixity{"mode_mixity [-]", 1, {}};
  VtkIntField state{"state", 1, {}};
  const auto damages = facet_damage(s);
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet) {
    if (s.topology.facet_state[at(facet)] == FacetState::Bonded) continue;
    const Opening open = opening(s, facet);
    const Index first = to_index(grid.points.size());
    for (int k = 0; k < 3; ++k) {
      const Vec3& x = open.middle[static_cast<std::size_t>(k)];
      const Vec3 moved = x - s.reference.vertices[at(s.topology.facet_vertex(facet, k))];
      grid.points.push_back(x);
      displacement.values.insert(displacement.values.end(), {moved.x(), moved.y(), moved.z()});
    }
    grid.triangles.push_back({first, first + 1, first + 2});
    normal.values.push_back(open.normal);
    shear.values.push_back(open.shear);
    damage.values.push_back(damages[at(facet)]);
    mixity.values.push_back(mode_mixity(open));
    state.values.push_back(static_cast<std::int32_t>(s.topology.facet_state[at(facet)]));
  }
  grid.point_fields = {std::move(displacement)};
  grid.cell_fields = {std::move(normal), std::move(shear), std::move(damage), std::move(mixity)};
  grid.cell_int_fields = {std::move(state)};
  return grid;
}

}  // namespace knap
