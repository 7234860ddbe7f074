#include "contact/tool_contact.hpp"

#include <algorithm>

#include "contact/edge_impulses.hpp"
#include "contact/guided_tool.hpp"
#include "contact/tool_landing.hpp"
#include "core/parallel.hpp"

namespace knap {
namespace {

// Of a node on several tools: Gauss-Seidel sweeps at most (a valley 10 deg deep takes 500), and the change of velocity
// to stop at, over the speed.
constexpr int largest_sweeps = 1000;
constexpr double converged = 1e-13;

using Group = std::span<NodeLanding>;  // the landings of one node

// Calls action(group) for every node of a block.
template <class Action>
void for_each_node(std::vector<NodeLanding>& block, Action&& action) {
  for (std::size_t begin = 0, end = 0; begin < block.size(); begin = end) {
    for (end = begin + 1; end < block.size() && block[end].node == block[begin].node;) ++end;
    action(Group(block).subspan(begin, end - begin));
  }
}

// One tool's turn at a node: the impulse nearest to the one that would land it and stop its sliding. Returns the change
// of velocity [m/s].
double take_turn(const Tool& tool, NodalState& nodes, const ToolStep& step, NodeLanding& landing) {
  const NodeApproach approach = approach_of(tool, nodes, landing.node, step);
  const double mass = nodes.mass[at(landing.node)];
  const Vec3 old = landing.push + landing.drag;
  const Vec3 trial = old + mass * (approach.stop * approach.normal - approach.sliding);
  const double push = std::max(0.0, trial.dot(approach.normal));
  Vec3 drag = trial - trial.dot(approach.normal) * approach.normal;
  const double size = drag.norm();
  if (size > tool.friction * push) drag *= tool.friction * push / size;
  landing.push = push * approach.normal;
  landing.drag = drag;
  landing.end = approach.end;
  const Vec3 change = (landing.push + landing.drag - old) / mass;
  xyz(nodes.v[at(landing.node)]) += change;
  return change.norm();
}

// The landings of a node that several tools stop, in turns of all tools.
std::vector<NodeLanding> solve_corner(std::span<const Tool> tools, NodalState& nodes, const NodeLanding& first,
                                      const ToolStep& step) {
  std::vector<NodeLanding> landings(tools.size());
  for (std::size_t k = 0; k < tools.size(); ++k)
    landings[k] = {.node = first.node, .tool = to_index(k), .v_free = first.v_free};
  xyz(nodes.v[at(first.node)]) = first.v_free;
  for (int sweep = 0; sweep < largest_sweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t k = 0; k < tools.size(); ++k)
      change = std::max(change, take_turn(tools[k], nodes, step, landings[k]));
    if (change <= converged * first.v_free.norm()) break;
  }
  std::erase_if(landings, [](const NodeLanding& landing) { return landing.push.squaredNorm() == 0.0; });
  return landings;
}

// Whether a node landed on one tool would now end the step inside another.
bool meets_another(std::span<const Tool> tools, const NodalState& nodes, const NodeLanding& landing,
                   const ToolStep& step) {
  for (std::size_t k = 0; k < tools.size(); ++k)
    if (to_index(k) != landing.tool && find_landing(tools[k], nodes, landing.node, step)) return true;
  return false;
}

// Gives the nodes of a block their velocities; nodes on several tools get new landings.
void land(std::span<const Tool> tools, NodalState& nodes, std::vector<NodeLanding>& block, const ToolStep& step) {
  std::vector<NodeLanding> settled;
  for_each_node(block, [&](const Group& group) {
    const NodeLanding& first = group.front();
    xyz(nodes.v[at(first.node)]) = first.v_after;
    if (group.size() == 1 && !meets_another(tools, nodes, first, step)) {
      settled.push_back(first);
      return;
    }
    const auto solved = solve_corner(tools, nodes, first, step);
    settled.insert(settled.end(), solved.begin(), solved.end());
  });
  block = std::move(settled);
}

// The tool's velocity is the mean of before and after the impulses, as the particle's is: what rides on a tool that
// gathers speed loses nothing.
void add(ToolAction& sum, const ToolState& state, const ToolDeed& deed) {
  const Vec3 arm = deed.place - deed.origin;
  const Vec3 carried = 0.5 * (state.velocity + state.velocity_before + (state.spin + state.spin_before).cross(arm));
  const Vec3 impulse = deed.push + deed.drag;
  sum.push += deed.push;
  sum.impulse += impulse;
  sum.angular_impulse += deed.lever.cross(impulse);
  sum.work += impulse.dot(carried);
  sum.impact_loss -= deed.push.dot(deed.mean_velocity - carried);
  sum.friction_loss -= deed.drag.dot(deed.mean_velocity - carried);
}

Vec3 mean_velocity(const NodalState& nodes, Index node) {
  const Vec3 v = xyz(nodes.v[at(node)]);
  return 0.5 * (v + xyz(nodes.v_before[at(node)]));
}

ToolDeed deed_of(const NodeLanding& landing, const Tool& tool, const NodalState& nodes) {
  return {landing.tool,
          landing.end,
          tool.next.position,
          landing.push,
          landing.drag,
          mean_velocity(nodes, landing.node),
          xyz(nodes.x[at(landing.node)])};
}

ToolDeed deed_of(const EdgeTouch& touch, const Tool& tool, const NodalState& nodes) {
  ToolDeed deed{touch.tool, touch.place, tool.state.position, touch.push, touch.drag, Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    deed.mean_velocity += touch.weights[k] * mean_velocity(nodes, touch.nodes[k]);
    deed.lever += touch.weights[k] * xyz(nodes.x[at(touch.nodes[k])]);
  }
  return deed;
}

// At the final velocities; summed by blocks of nodes, edges last.
void book(std::span<Tool> tools, const NodalState& nodes, const ToolLandings& landings,
          std::span<const EdgeTouch> touches, std::span<const ToolDeed> deeds, const ToolStep& step) {
  std::vector<ToolAction> total(tools.size());
  for (const ToolDeed& deed : deeds) add(total[at(deed.tool)], tools[at(deed.tool)].state, deed);
  for (const auto& block : landings) {
    std::vector<ToolAction> sum(tools.size());
    for (const NodeLanding& landing : block) {
      const Tool& tool = tools[at(landing.tool)];
      add(sum[at(landing.tool)], tool.state, deed_of(landing, tool, nodes));
    }
    for (std::size_t k = 0; k < tools.size(); ++k) total[k] += sum[k];
  }
  for (const EdgeTouch& touch : touches) {
    const Tool& tool = tools[at(touch.tool)];
    add(total[at(touch.tool)], tool.state, deed_of(touch, tool, nodes));
  }
  for (std::size_t k = 0; k < tools.size(); ++k)
    if (total[k].push.squaredNorm() > 0.0) book_action(tools[k], total[k], step.dt, step.step);
}

// The final speeds of guided tools: exactly what the particle's impulses make of the free ones.
void push_guided_tools_back(std::span<Tool> tools, std::span<const double> free_speed, const ToolLandings& landings,
                            double dt) {
  for (std::size_t k = 0; k < tools.size(); ++k) {
    if (!tools[k].is_guided()) continue;
    double along = 0.0;
    for (const auto& block : landings)
      for (const NodeLanding& landing : block)
        if (landing.tool == to_index(k)) along += tools[k].guide.dot(landing.push + landing.drag);
    set_guided_speed(tools[k], free_speed[k] - along / tools[k].mass, dt);
  }
}

}  // namespace

std::vector<Index> apply_tools(std::span<Tool> tools, NodalState& nodes, const ToolStep& step,
                               std::span<EdgeTouch> touches, std::span<const ToolDeed> deeds) {
  push_edges(tools, nodes, touches, step.dt);
  std::vector<double> free_speed;
  for (const Tool& tool : tools) free_speed.push_back(tool.guide.dot(tool.state.velocity));
  ToolLandings landings = find_landings(tools, nodes, step);
  for (std::size_t k = 0; k < tools.size(); ++k)
    if (tools[k].is_guided()) meet_guided_tool(tools[k], to_index(k), nodes, step, landings);
  std::vector<Index> touched;
  for (auto& block : landings) {
    land(tools, nodes, block, step);
    for_each_node(block, [&](const Group& group) { touched.push_back(group.front().node); });
  }
  push_guided_tools_back(tools, free_speed, landings, step.dt);
  book(tools, nodes, landings, touches, deeds, step);
  if (touches.empty()) return touched;
  for (const EdgeTouch& touch : touches) touched.insert(touched.end(), touch.nodes.begin(), touch.nodes.end());
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

}  // namespace knap
