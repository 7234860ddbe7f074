#pragma once

#include "core/types.hpp"

namespace knap {

/// Fields on nodes, as structure of arrays. Velocities live at half steps (leapfrog).
struct NodalState {
  std::vector<Vec4> x;         ///< position [m]
  std::vector<Vec4> v;         ///< velocity [m/s]
  std::vector<Vec4> v_before;  ///< velocity before this step's kick and impulses [m/s]
  std::vector<Vec4> f;         ///< force of the bulk [N]
  std::vector<double> mass;    ///< lumped [kg]

  Index size() const { return to_index(x.size()); }
};

/// Calls visit(name, field) for every nodal field: splitting, checkpoints and the state hash all walk this one list.
template <class State, class Visit>
void visit_nodal_fields(State& nodes, Visit&& visit) {
  visit("nodes.x", nodes.x);
  visit("nodes.v", nodes.v);
  visit("nodes.v_before", nodes.v_before);
  visit("nodes.f", nodes.f);
  visit("nodes.mass", nodes.mass);
}

/// Appends a copy of node `source`; returns the new node.
inline Index append_copy(NodalState& nodes, Index source) {
  const Index copy = nodes.size();
  visit_nodal_fields(nodes, [source](const char*, auto& field) {
    const auto value = field[at(source)];
    make_room(field, field.size() + 1);
    field.push_back(value);
  });
  return copy;
}

}  // namespace knap
