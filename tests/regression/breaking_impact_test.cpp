// A zeolite granule of 1.5 mm at 22 m/s on about 19k tets, 8 us: numbers that change only on purpose. The baseline
// stands in cases/baselines/breaking_impact.csv, a row a number: value, tolerance (relative), kind. `reference`: has a
// source; `change_detector`: what the program gave before. Write the latter anew with KNAP_UPDATE_BASELINES=1, in a
// commit that says why.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "analysis/breakage.hpp"
#include "analysis/fragments.hpp"
#include "cohesive/crack_faces.hpp"
#include "cohesive/fragments.hpp"
#include "simulation/step.hpp"
#include "tests/support/granule.hpp"

namespace knap {
namespace {

struct Row {
  double value;
  double tolerance;
  std::string kind;
};

const std::string path = std::string(KNAP_SOURCE_DIR) + "/cases/baselines/breaking_impact.csv";

std::map<std::string, Row> read_baseline() {
  std::map<std::string, Row> rows;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line.starts_with("name,")) continue;
    std::istringstream fields(line);
    std::string name, value, tolerance, kind;
    std::getline(fields, name, ',');
    std::getline(fields, value, ',');
    std::getline(fields, tolerance, ',');
    std::getline(fields, kind, ',');
    rows[name] = {std::stod(value), std::stod(tolerance), kind};
  }
  return rows;
}

void write_baseline(const std::map<std::string, Row>& rows, const std::map<std::string, double>& found) {
  std::ofstream file(path);
  file << "# Zeolite 1.5 mm, 22 m/s, 8 us (tests/regression/breaking_impact_test.cpp). Cracking is chaotic: tolerances "
          "of\n"
          "# the change detectors are a guess, no spread has been measured yet.\n"
          "name,value,tolerance,kind\n";
  for (const auto& [name, row] : rows)
    file << name << ',' << (row.kind == "reference" ? row.value : found.at(name)) << ',' << row.tolerance << ','
         << row.kind << '\n';
}

Simulation impact() {
  Granule granule{.element_size = 0.105e-3, .contact_element_size = 0.105e-3};
  granule.particle.fracture = zeolite_fracture();
  granule.options.tools = {wall(0.3)};
  granule.particle.velocity = {0.0, 0.0, -22.0};
  Simulation s = make_granule(granule);
  while (s.clock.time() < 8e-6) EXPECT_EQ(step(s), StepStatus::Ok);
  return s;
}

BreakageMeasures measures(const Simulation& s, FragmentLabel label) {
  const auto labels = fragment_labels(s.topology, s.cracks, label);
  const std::vector<double> densities{s.options.particles[0].density};
  const auto fragments = find_fragments({.tet_nodes = s.topology.tet_nodes,
                                         .tet_facets = s.topology.tet_facets,
                                         .facet_tets = s.topology.facet_tets,
                                         .x = s.nodes.x,
                                         .v = s.nodes.v,
                                         .tet_volume = s.reference.tet_volume,
                                         .densities = densities,
                                         .label = labels});
  return breakage_measures(fragments, {.mass = s.reference.start.mass, .diameter = 1.5e-3, .element_size = 0.105e-3});
}

std::map<std::string, double> numbers_of(const Simulation& s) {
  const Momentum now = momentum(s.nodes);
  const Momentum& start = s.reference.start;
  const double incident = s.ledger.reference;
  const BreakageMeasures broken = measures(s, FragmentLabel::Damage);
  const double scale = start.linear.norm();
  return {
      {"incident_energy_J", incident},
      {"one_plus_closure_error", 1.0 + s.ledger.max_closure_error},
      {"one_plus_linear_error",
       1.0 + (now.linear - start.linear - s.tools[0].state.impulse - s.totals.added_linear).norm() / scale},
      {"one_plus_angular_error", 1.0 + (now.angular - start.angular - s.tools[0].state.angular_impulse -
                                        s.totals.added_angular - pending_angular_momentum(s.cracks))
                                               .norm() /
                                           (scale * 0.75e-3)},
      {"mass_sum_fraction", broken.mass_sum_fraction},
      {"kinetic", s.ledger[EnergyTerm::Kinetic] / incident},
      {"cohesive_dissipated", s.ledger[EnergyTerm::CohesiveDissipated] / incident},
      {"friction_and_closure", (s.ledger[EnergyTerm::CrackFriction] + s.ledger[EnergyTerm::ClosureImpact]) / incident},
      {"cracked_area_mm2", s.cracks.cracked_area * 1e6},
      {"largest_wall_force_N", s.tools[0].state.max_force},
      {"chipping_ratio", broken.chipping_ratio},
      {"mass_outside_the_two_largest", 1.0 - broken.largest_mass_fraction - broken.second_mass_fraction},
  };
}

TEST(BreakingImpact, StaysWhatItWas) {
  const auto found = numbers_of(impact());
  const auto baseline = read_baseline();
  ASSERT_FALSE(baseline.empty()) << path;
  if (std::getenv("KNAP_UPDATE_BASELINES")) write_baseline(baseline, found);
  for (const auto& [name, row] : baseline) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found.at(name) / row.value, 1.0, row.tolerance)
        << name << " = " << found.at(name) << ", was " << row.value;
  }
}

}  // namespace
}  // namespace knap
