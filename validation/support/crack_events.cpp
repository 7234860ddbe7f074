#include "validation/support/crack_events.hpp"

namespace knap {

void CrackEvents::look(const Simulation& s) {
  seen_.resize(s.topology.facet_state.size(), false);
  for (Index f = 0; f < s.topology.num_facets(); ++f) {
    const FacetState state = s.topology.facet_state[at(f)];
    if (seen_[at(f)] || (state != FacetState::Failed && state != FacetState::HandedOver)) continue;
    seen_[at(f)] = true;
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) x[at(k)] = s.reference.vertices[at(s.topology.facet_vertex(f, k))];
    events_.push_back({.time = s.clock.time(),
                       .place = (x[0] + x[1] + x[2]) / 3.0,
                       .normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized(),
                       .area = s.reference.facet_area[at(f)]});
  }
}

}  // namespace knap
