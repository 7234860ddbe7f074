// How much of a result is the mesh: a zeolite granule of 1.5 mm on three sizes of elements (h, h/1.4, h/2), five meshes
// each, over the speeds at which it breaks; the middle size also with displaced nodes and with scattered strengths.
// physics.md section 3: critical speed and dissipated energy within 10 %; the spread is printed beside each number.
#include <fmt/format.h>

#include <cmath>

#include "validation/problems.hpp"
#include "validation/support/granule_study.hpp"

namespace knap {
namespace {

const std::vector<double> speeds{15.0, 17.0, 19.0, 21.0, 23.0};  // [m/s]
constexpr int seeds = 5;
constexpr double coarse = 150e-6;  // [m]

struct Variant {
  const char* name;
  double refinement;
  std::vector<std::string> overrides{};
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> list{
      {"h", 1.0},
      {"h/1.4", 1.4},
      {"h/2", 2.0},
      {"h/1.4, nodes displaced by 0.15", 1.4, {"mesh.perturbation=0.15"}},
      {"h/1.4, Weibull modulus 10", 1.4, {"fracture.weibull_modulus=10", "fracture.weibull_reference_volume=1e-12"}}};
  return list;
}

// Where a falling quantity first passes a level, between two speeds linearly; the last speed if it does not.
double crossing(const std::vector<double>& values, double level) {
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (values[i] > level) continue;
    if (i == 0) return speeds.front();
    return speeds[i - 1] + (speeds[i] - speeds[i - 1]) * (values[i - 1] - level) / (values[i - 1] - values[i]);
  }
  return speeds.back();
}

// The granules of a variant: an entry for each seed.
struct Ensemble {
  std::vector<double> critical_speed, dissipated, debris, largest;
};

Ensemble ensemble(GranuleStudy& study, std::size_t v) {
  const Variant& variant = variants()[v];
  Ensemble all;
  for (int seed = 0; seed < seeds; ++seed) {
    std::vector<double> restitution;
    GranuleOutcome last;
    for (const double speed : speeds) {
      const GranuleOutcome outcome = study.at_parameters({1.0 * static_cast<double>(v), speed, 1.0 * seed}, [&] {
        const double size = coarse / variant.refinement;
        return granule_case({.element_size = size,
                             .contact_element_size = size,
                             .contact_extent = 0.3e-3,
                             .speed = speed,
                             .seed = seed,
                             .end_time = 25e-6,
                             .overrides = variant.overrides});
      });
      restitution.push_back(outcome.restitution);
      last = outcome;
    }
    all.critical_speed.push_back(crossing(restitution, 0.5));
    all.dissipated.push_back(1.0 - last.kinetic);
    all.debris.push_back(last.chipping);
    all.largest.push_back(last.largest);
  }
  return all;
}

}  // namespace

void show_mesh_study(Evidence& evidence) {
  GranuleStudy study(evidence.folder() / "study.csv", {"variant", "speed [m/s]", "seed"}, evidence.keeps_runs());
  std::vector<Ensemble> all;
  std::vector<Column> table{{"variant", {}},
                            {"critical speed [m/s]", {}},
                            {"spread [m/s]", {}},
                            {"dissipated [-]", {}},
                            {"spread of it [-]", {}},
                            {"debris [-]", {}},
                            {"spread of debris [-]", {}},
                            {"largest [-]", {}},
                            {"spread of largest [-]", {}}};
  PlotInput plot{.title = "Zeolite of 1.5 mm: five meshes of each kind",
                 .x_label = "kind of mesh",
                 .y_label = "critical speed, restitution 1/2 [m/s]"};
  for (std::size_t v = 0; v < variants().size(); ++v) {
    all.push_back(ensemble(study, v));
    const Ensemble& e = all.back();
    std::vector<double> row{static_cast<double>(v)};
    for (const auto* values : {&e.critical_speed, &e.dissipated, &e.debris, &e.largest}) {
      row.push_back(mean(*values));
      row.push_back(spread(*values));
    }
    for (std::size_t i = 0; i < row.size(); ++i) table[i].values.push_back(row[i]);
    plot.series.push_back({variants()[v].name, std::vector<double>(seeds, static_cast<double>(v)), e.critical_speed,
                           PlotSeries::Style::Points});
    const std::string name = variants()[v].name;
    evidence.tell(fmt::format("critical speed, {} [m/s]", name), mean(e.critical_speed),
                  fmt::format("spread {:.2g} m/s over {} meshes", spread(e.critical_speed), seeds));
    evidence.tell(fmt::format("debris at 23 m/s, {} [-]", name), mean(e.debris),
                  fmt::format("spread {:.2g}", spread(e.debris)));
    evidence.tell(fmt::format("largest fragment at 23 m/s, {} [-]", name), mean(e.largest),
                  fmt::format("spread {:.2g}", spread(e.largest)));
  }
  const Ensemble& finest = all[2];
  for (std::size_t v = 0; v < 2; ++v) {
    evidence.relative(fmt::format("critical speed, {} against h/2 [m/s]", variants()[v].name),
                      mean(all[v].critical_speed), mean(finest.critical_speed), 0.1, "physics.md section 3");
    evidence.relative(fmt::format("dissipated energy at 23 m/s, {} against h/2 [-]", variants()[v].name),
                      mean(all[v].dissipated), mean(finest.dissipated), 0.1, "physics.md section 3");
  }
  study.tell_kept(evidence);
  evidence.curve(table);
  evidence.plot(plot);
}

}  // namespace knap
