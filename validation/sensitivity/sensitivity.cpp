// What the parameters do around the shipped alumina case (1.09 mm, 23 m/s), and to the restitution well below damage
// (12 m/s): elasticities d ln q/d ln p from runs with p down and up by a quarter (numerical options: by a factor of
// two), as means over three meshes, which the pairs share. Numerical options must do nothing beyond the scatter of the
// cracks; more strength in shear must suppress breakage (method.md section 6).
#include <fmt/format.h>

#include <cmath>

#include "io/file_output.hpp"
#include "validation/problems.hpp"
#include "validation/support/granule_study.hpp"

namespace knap {
namespace {

constexpr double breaking = 23.0, below = 12.0;  // [m/s]
constexpr int seeds = 3;

struct Parameter {
  std::string name, key;  // without a key it is an option of the solver
  double base = 0.0;
  double factor = 1.25;
  int SimulationOptions::*option = nullptr;
  bool is_numerical = false;
};

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> list{
      {"shear strength ratio beta", "fracture.shear_strength_ratio", 1.5},
      {"internal friction", "fracture.internal_friction", 0.8},
      {"sliding friction", "fracture.sliding_friction", 0.1},
      {"wall friction", "impact.wall_friction", 0.37},
      {"fracture energy G_c", "fracture.fracture_energy", 9.1},
      {"strength sigma_c", "fracture.strength", 17.84e6},
      {"step safety", "run.step_safety", 0.5, 1.25, nullptr, true},
      {"insertion interval", "run.insertion_interval", 4, 2.0, nullptr, true},
      {"contact interval", "", 8, 2.0, &SimulationOptions::contact_interval, true},
      {"contact sweeps", "", 2, 2.0, &SimulationOptions::contact_sweeps, true},
      {"vertex impulse sweeps", "", 2, 2.0, &SimulationOptions::impulse_sweeps, true}};
  return list;
}

struct Quantity {
  const char* name;
  double GranuleOutcome::*field;
};
constexpr std::array<Quantity, 8> quantities{{{"chipping", &GranuleOutcome::chipping},
                                              {"t10", &GranuleOutcome::t10},
                                              {"largest", &GranuleOutcome::largest},
                                              {"restitution", &GranuleOutcome::restitution},
                                              {"kinetic", &GranuleOutcome::kinetic},
                                              {"cohesion", &GranuleOutcome::cohesion},
                                              {"friction", &GranuleOutcome::friction},
                                              {"closure", &GranuleOutcome::closure}}};

/// What the plot shows, by its change: of what is nearly nothing an elasticity says little.
struct Drawn {
  const char* name;
  std::size_t column;  // among the quantities, behind which the restitution at 12 m/s comes
};
constexpr std::array<Drawn, 6> drawn_quantities{{{"chipping", 0},
                                                 {"largest", 2},
                                                 {"restitution", 3},
                                                 {"cohesion", 5},
                                                 {"friction", 6},
                                                 {"restitution at 12 m/s", quantities.size()}}};

GranuleCase alumina(double speed, int seed) {
  return {.preset = "gamma_alumina",
          .diameter = 1.09e-3,
          .element_size = 84e-6,
          .contact_element_size = 42e-6,
          .contact_extent = 0.25e-3,
          .speed = speed,
          .seed = seed,
          .end_time = 10e-6,
          .overrides = {"impact.wall_friction=0.37"}};
}

GranuleOutcome outcome(GranuleStudy& study, std::size_t p, int direction, double speed, int seed) {
  const Parameter& parameter = parameters()[p];
  const double value = parameter.base * std::pow(parameter.factor, direction);
  const auto make_case = [&] {
    GranuleCase granule = alumina(speed, seed);
    if (!parameter.key.empty() && direction != 0)
      granule.overrides.push_back(fmt::format("{}={}", parameter.key, value));
    return granule_case(granule);
  };
  const auto set_option = [&](Simulation& s) {
    if (parameter.option != nullptr) s.options.*(parameter.option) = static_cast<int>(value);
  };
  // All parameters share the base.
  const double number = direction == 0 ? -1.0 : static_cast<double>(p);
  return study.at_parameters({number, 1.0 * direction, speed, 1.0 * seed}, make_case, set_option);
}

// Change with ln p, over the base, of each quantity; and its standard error over the meshes.
struct Elasticity {
  double value = 0.0, error = 0.0, base = 0.0;
  double change() const { return value * base; }  // dq/d ln p
};
Elasticity elasticity(GranuleStudy& study, std::size_t p, double speed, double GranuleOutcome::*field) {
  std::vector<double> slopes, base;
  for (int seed = 0; seed < seeds; ++seed) {
    const double up = outcome(study, p, 1, speed, seed).*field, down = outcome(study, p, -1, speed, seed).*field;
    slopes.push_back((up - down) / (2.0 * std::log(parameters()[p].factor)));
    base.push_back(outcome(study, p, 0, speed, seed).*field);
  }
  const double at_base = mean(base);
  const double scale = std::max(std::abs(at_base), 1e-6);
  return {mean(slopes) / scale, spread(slopes) / std::sqrt(1.0 * seeds) / scale, at_base};
}

std::string markdown_row(const std::string& name, const std::vector<Elasticity>& row) {
  std::string text = "| " + name;
  for (const Elasticity& e : row) text += fmt::format(" | {:+.2f} +- {:.2f}", e.value, e.error);
  return text + " |\n";
}

void judge(Evidence& evidence, const Parameter& parameter, const std::vector<Elasticity>& row) {
  const double kinetic = row[4].change();
  if (parameter.is_numerical)
    evidence.absolute(fmt::format("change of the dissipated energy, {} x {} [-]", parameter.name, parameter.factor),
                      -kinetic * std::log(parameter.factor), 0.0, 0.03, "a numerical option");
  if (parameter.key == "fracture.shear_strength_ratio" || parameter.key == "fracture.internal_friction" ||
      parameter.key == "fracture.strength")
    evidence.at_least(fmt::format("elasticity of the restitution at 12 m/s, {} [-]", parameter.name), row.back().value,
                      0.0, "a stronger granule loses less");
}

}  // namespace

void show_sensitivity(Evidence& evidence) {
  GranuleStudy study(evidence.folder() / "study.csv", {"parameter", "direction", "speed [m/s]", "mesh seed"},
                     evidence.keeps_runs());
  std::vector<Column> table{{"parameter", {}}};
  std::string text = "| parameter", rule = "\n|---", base = "| at the base";
  PlotInput plot{.title = "Alumina at 23 m/s: what the parameters change",
                 .x_label = "parameter, in the order of elasticities.md",
                 .y_label = "dq/d ln p [-]"};
  for (const Quantity& quantity : quantities) {
    text += fmt::format(" | {}", quantity.name);
    rule += "|---";
    table.push_back({fmt::format("{} [-]", quantity.name), {}});
  }
  table.push_back({"restitution at 12 m/s [-]", {}});
  for (const Drawn& drawn : drawn_quantities)
    plot.series.push_back({.name = drawn.name, .style = PlotSeries::Style::Points});
  text += " | restitution at 12 m/s |" + rule + "|---|\n";
  for (std::size_t p = 0; p < parameters().size(); ++p) {
    std::vector<Elasticity> row;
    for (const Quantity& quantity : quantities) row.push_back(elasticity(study, p, breaking, quantity.field));
    row.push_back(elasticity(study, p, below, &GranuleOutcome::restitution));
    if (p == 0) {
      for (const Elasticity& e : row) base += fmt::format(" | {:.3f}", e.base);
      text += base + " |\n";
    }
    text += markdown_row(parameters()[p].name, row);
    table[0].values.push_back(static_cast<double>(p));
    for (std::size_t i = 0; i < row.size(); ++i) table[i + 1].values.push_back(row[i].value);
    for (std::size_t i = 0; i < drawn_quantities.size(); ++i) {
      plot.series[i].x.push_back(static_cast<double>(p));
      plot.series[i].y.push_back(row[drawn_quantities[i].column].change());
    }
    judge(evidence, parameters()[p], row);
  }
  write_text_atomically(evidence.folder() / "elasticities.md", text);
  study.tell_kept(evidence);
  evidence.curve(table);
  evidence.plot(plot);
}

}  // namespace knap
