#include "app/run_picture.hpp"

#include <fmt/format.h>

#include "io/picture.hpp"

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

std::string subtitle(const Simulation& s, const RunOutcome& outcome) {
  const BreakageMeasures& m = outcome.damage.measures;
  const SanityInput& in = outcome.card.input;
  return fmt::format(
      "{:.3g} mm at {:.4g} m/s, {:.3g}° to the wall, after {:.3g} µs: {}, largest piece {:.1f} %, {} "
      "above 0.1 %, outside the largest {:.1f} %",
      1e3 * in.diameter, in.speed, in.angle * 180.0 / EIGEN_PI, 1e6 * s.clock.time(), name(m.breakage_class),
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
  if (!s.tools.empty()) input.wall_height = s.tools.front().state.position.z();
  render_picture(png, input);
}

}  // namespace knap
