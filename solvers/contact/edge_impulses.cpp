#include "contact/edge_impulses.hpp"

#include <algorithm>

namespace knap {
namespace {

constexpr int num_sweeps = 8;

// Largest change of the relative velocity at a touch by a unit impulse.
double mobility(const Tool& tool, const NodalState& nodes, const EdgeTouch& touch) {
  double sum = tool.is_guided() ? 1.0 / tool.mass : 0.0;
  for (std::size_t k = 0; k < 3; ++k) sum += touch.weights[k] * touch.weights[k] / nodes.mass[at(touch.nodes[k])];
  return sum;
}

void add_impulse(Tool& tool, NodalState& nodes, const EdgeTouch& touch, const Vec3& impulse, double dt) {
  for (std::size_t k = 0; k < 3; ++k)
    xyz(nodes.v[at(touch.nodes[k])]) += touch.weights[k] / nodes.mass[at(touch.nodes[k])] * impulse;
  if (tool.is_guided())
    set_guided_speed(tool, tool.guide.dot(tool.state.velocity) - tool.guide.dot(impulse) / tool.mass, dt);
}

void take_turn(Tool& tool, NodalState& nodes, EdgeTouch& touch, double dt) {
  Vec3 over = -tool.velocity_at(touch.place);
  for (std::size_t k = 0; k < 3; ++k) over += touch.weights[k] * xyz(nodes.v[at(touch.nodes[k])]);
  const Vec3 old = touch.push + touch.drag;
  const Vec3 trial = old - over / mobility(tool, nodes, touch);
  const double push = std::max(0.0, -trial.dot(touch.normal));  // into the particle
  Vec3 drag = trial - trial.dot(touch.normal) * touch.normal;
  const double size = drag.norm();
  if (size > tool.friction * push) drag *= tool.friction * push / size;
  touch.push = -push * touch.normal;
  touch.drag = drag;
  add_impulse(tool, nodes, touch, touch.push + touch.drag - old, dt);
}

}  // namespace

void push_edges(std::span<Tool> tools, NodalState& nodes, std::span<EdgeTouch> touches, double dt) {
  for (int sweep = 0; sweep < num_sweeps; ++sweep)
    for (EdgeTouch& touch : touches) take_turn(tools[at(touch.tool)], nodes, touch, dt);
}

}  // namespace knap
