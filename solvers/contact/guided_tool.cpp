#include "contact/guided_tool.hpp"

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

constexpr int largest_iterations = 100;
constexpr double converged = 1e-15;  // change of speed over the free speed and what the impulses would change it by

std::vector<Index> nodes_on(const ToolLandings& landings, Index tool) {
  std::vector<Index> nodes;
  for (const auto& block : landings)
    for (const NodeLanding& landing : block)
      if (landing.tool == tool) nodes.push_back(landing.node);
  return nodes;
}

/// The tool at any speed among the nodes that it stops at its free speed.
struct Meeting {
  Tool& tool;
  const NodalState& nodes;
  const ToolStep& step;
  std::vector<Index> candidates;
  double free_speed;

  // By how much the speed is above what the impulses at that speed leave of the free one; grows with the speed.
  double excess(double speed) {
    set_guided_speed(tool, speed, step.dt);
    double impulse = 0.0;
    for (const Index node : candidates)
      if (const auto landing = find_landing(tool, nodes, node, step))
        impulse += tool.guide.dot(landing->push + landing->drag);
    return speed - (free_speed - impulse / tool.mass);
  }

  // Regula falsi (Illinois) between the free speed and one where nothing pushes any more.
  double solve() {
    double a = free_speed, at_a = excess(a);
    if (at_a == 0.0) return a;
    double b = a - at_a, at_b = excess(b);
    for (double way = at_a; at_a * at_b > 0.0 && std::isfinite(way); way *= 2.0) {
      b -= way;
      at_b = excess(b);
    }
    const double scale = std::abs(free_speed) + std::abs(at_a);
    for (int i = 0; i < largest_iterations && at_b != 0.0 && std::abs(b - a) > converged * scale; ++i) {
      const double c = b - at_b * (b - a) / (at_b - at_a);
      const double at_c = excess(c);
      if (at_c * at_b < 0.0)
        a = b, at_a = at_b;
      else
        at_a *= 0.5;
      b = c, at_b = at_c;
    }
    return b;
  }
};

}  // namespace

void meet_guided_tool(Tool& tool, Index number, const NodalState& nodes, const ToolStep& step, ToolLandings& landings) {
  auto candidates = nodes_on(landings, number);
  if (candidates.empty()) return;
  Meeting meeting{tool, nodes, step, std::move(candidates), tool.guide.dot(tool.state.velocity)};
  set_guided_speed(tool, meeting.solve(), step.dt);
  for (auto& block : landings) {
    for (NodeLanding& landing : block)
      if (landing.tool == number) {
        const auto met = find_landing(tool, nodes, landing.node, step);
        landing = met ? *met : NodeLanding{};
        landing.tool = met ? number : none;
      }
    std::erase_if(block, [](const NodeLanding& landing) { return landing.tool == none; });
  }
}

}  // namespace knap
