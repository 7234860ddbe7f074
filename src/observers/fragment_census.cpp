#include "observers/fragment_census.hpp"

#include <algorithm>
#include <limits>

#include "cohesive/crack_faces.hpp"

namespace knap {
namespace {

// Part of the work of separation that was spent in shear.
double shear_share(const CrackState& cracks) {
  CrackLosses losses;
  for (const Index vertex : cracks.vertices) losses += cracks.losses_of_vertex[at(vertex)];
  return losses.cohesive > 0.0 ? std::clamp(losses.cohesive_shear / losses.cohesive, 0.0, 1.0) : 0.0;
}

// Share of a facet's corners that have failed.
double failed_share(const Simulation& s, Index facet) {
  switch (s.topology.facet_state[at(facet)]) {
    case FacetState::Bonded:
      return 0.0;
    case FacetState::Cohesive: {
      const auto& failed = s.cracks.faces[at(s.cracks.face_of_facet[at(facet)])].failed;
      return (failed[0] + failed[1] + failed[2]) / 3.0;
    }
    case FacetState::Failed:
    case FacetState::HandedOver:
      break;
  }
  return 1.0;
}

double ratio(double a, double b) { return b > 0.0 ? a / b : std::numeric_limits<double>::quiet_NaN(); }

}  // namespace

CrackCensus crack_census(const Simulation& s) {
  CrackCensus census;
  if (s.totals.inserted_facets == 0) return census;
  census.area = s.cracks.cracked_area;
  const double share = shear_share(s.cracks);
  census.area_mode_i = (1.0 - share) * census.area;
  census.area_mode_ii = share * census.area;
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet)
    census.failed_area += failed_share(s, facet) * s.reference.facet_area[at(facet)];
  return census;
}

Index count_fragments(const Simulation& s, FragmentLabel label) {
  if (s.totals.inserted_facets == 0) return 1;
  return num_fragments(fragment_labels(s.topology, s.cracks, label));
}

std::vector<double> facet_damage(const Simulation& s) {
  std::vector<double> damage(at(s.topology.num_facets()), 0.0);
  for (const CrackRecord& record : s.cracks.records)
    damage[at(s.cracks.faces[at(record.face)].facet)] += record.damage() / 3.0;
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet) {
    const FacetState state = s.topology.facet_state[at(facet)];
    if (state == FacetState::Failed || state == FacetState::HandedOver) damage[at(facet)] = 1.0;
  }
  return damage;
}

std::vector<double> tet_damage(const Simulation& s) {
  const auto of_facet = facet_damage(s);
  std::vector<double> damage(at(s.topology.num_tets()), 0.0);
  for (Index tet = 0; tet < s.topology.num_tets(); ++tet)
    for (const Index facet : s.topology.tet_facets[at(tet)])
      if (facet != none) damage[at(tet)] = std::max(damage[at(tet)], of_facet[at(facet)]);
  return damage;
}

Rebound rebound(const Simulation& s) {
  const Vec3 normal = s.tools.empty() ? Vec3::UnitZ() : s.tools.front().state.orientation * Vec3::UnitZ();
  const Vec3 start = s.reference.start.velocity();
  const Vec3 now = momentum(s.nodes).velocity();
  const Vec3 along = start - start.dot(normal) * normal;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (starts_at_onset(s)) return {unknown, unknown};  // it does not fly
  Rebound result{ratio(now.dot(normal), -start.dot(normal)), unknown};
  if (along.norm() > 1e-9 * start.norm()) result.tangential = now.dot(along) / along.squaredNorm();
  return result;
}

MomentumErrors momentum_errors(const Simulation& s, double radius) {
  const Momentum& start = s.reference.start;
  const Momentum now = momentum(s.nodes);
  Vec3 linear = now.linear - start.linear - s.totals.added_linear - s.totals.gravity.linear;
  Vec3 angular = now.angular - start.angular - s.totals.added_angular - s.totals.gravity.angular -
                 pending_angular_momentum(s.cracks);
  for (const Tool& tool : s.tools) {
    linear -= tool.state.impulse;
    angular -= tool.state.angular_impulse;
  }
  double incident = start.linear.norm();
  for (const Tool& tool : s.tools)
    if (start.linear.norm() == 0.0 || starts_at_onset(s)) incident = std::max(incident, tool.state.impulse.norm());
  return {ratio(linear.norm(), incident), ratio(angular.norm(), std::max(incident * radius, start.angular.norm()))};
}

}  // namespace knap
