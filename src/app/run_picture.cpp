#include "app/run_picture.hpp"

#include <fmt/format.h>

#include "io/picture.hpp"
#include "observers/tool_surface.hpp"

namespace knap {
namespace {

// Both sides of every facet between two fragments.
std::vector<std::array<Index, 3>> broken_facets(const Simulation& s, const std::vector<Index>& fragment_of_tet) {
  std::vector<std::array<Index, 3>> facets;
  for (Index facet = 0; facet < s.topology.num_facets(); ++facet) {
    const auto& [minus, plus] = s.topology.facet_tets[at(facet)];
    if (fragment_of_tet[at(minus)] == fragment_of_tet[at(plus)]) continue;
    for (int side = 0; side < 2; ++side)
      facets.push_back({s.topology.facet_node(facet, 0, side), s.topology.facet_node(facet, 1, side),
                        s.topology.facet_node(facet, 2, side)});
  }
  return facets;
}

// A floor at rest is drawn as ground, other tools as bodies.
bool is_floor(const Simulation& s, std::size_t tool) {
  return std::holds_alternative<HalfSpace>(s.tools[tool].shape) &&
         std::holds_alternative<AtRest>(s.options.tools[tool].motion) &&
         s.tools[tool].state.orientation.coeffs() == Eigen::Quaterniond::Identity().coeffs();
}

void add_tools(PictureInput& input, const Simulation& s, const RunOutcome& outcome) {
  const Vec3 centre = outcome.damage.fragments.front().centre;
  for (std::size_t k = 0; k < s.tools.size(); ++k) {
    if (is_floor(s, k)) {
      input.wall_height = s.tools[k].state.position.z();
      continue;
    }
    DrawnSurface surface = tool_surface(s.tools[k], centre, 2.0 * outcome.card.input.diameter);
    input.tools.push_back({std::move(surface.points), std::move(surface.triangles)});
  }
}

// What happened to it, in a few words.
std::string load(const Simulation& s, const RunOutcome& outcome) {
  const SanityInput& in = outcome.card.input;
  if (s.tools.size() == 1 && is_floor(s, 0))
    return fmt::format("at {:.4g} m/s, {:.3g}° to the wall", in.speed, in.angle * 180.0 / EIGEN_PI);
  if (outcome.compression && outcome.compression->fracture.force > 0.0)
    return fmt::format("pressed at {:.4g} m/s, {:.3g} N", in.speed, outcome.compression->fracture.force);
  return fmt::format("at {:.4g} m/s", in.speed);
}

std::string subtitle(const Simulation& s, const RunOutcome& outcome) {
  const BreakageMeasures& m = outcome.damage.measures;
  const SanityInput& in = outcome.card.input;
  return fmt::format(
      "{:.3g} mm {}, after {:.3g} µs: {}, largest piece {:.1f} %, {} above 0.1 %, outside the largest {:.1f} %",
      1e3 * in.diameter, load(s, outcome), 1e6 * s.clock.time(), name(m.breakage_class),
      100.0 * m.largest_mass_fraction, m.count_above_0p1pct, 100.0 * m.chipping_ratio);
}

}  // namespace

void draw_run(const std::filesystem::path& png, const Simulation& s, const RunOutcome& outcome) {
  PictureInput input;
  input.tets = s.topology.tet_nodes;
  input.broken_facets = broken_facets(s, outcome.damage.fragment_of_tet);
  input.fragment_of_tet = outcome.damage.fragment_of_tet;
  input.damage_of_tet = tet_damage(s);
  input.title = outcome.case_name;
  input.subtitle = subtitle(s, outcome);
  for (const Vec4& x : s.nodes.x) input.points.emplace_back(xyz(x));
  for (const Fragment& fragment : outcome.damage.fragments) input.fragment_mass.push_back(fragment.mass);
  add_tools(input, s, outcome);
  render_picture(png, input);
}

}  // namespace knap
