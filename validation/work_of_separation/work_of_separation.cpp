// A facet is pulled apart along straight paths, from pure opening to pure shear: the work that separates it is G_c
// (kappa = 1), in whatever mode; unloading and reloading below the largest opening so far costs nothing.
#include <numbers>

#include "validation/problems.hpp"
#include "validation/support/driven_crack.hpp"

namespace knap {
namespace {

constexpr double zeolite_strength = 8.34e6, zeolite_fracture_energy = 8.6;

DrivenCrackOptions crack(double beta, double kappa = 1.0) {
  return {
      .law = {.beta = beta, .kappa = kappa}, .strength = zeolite_strength, .fracture_energy = zeolite_fracture_energy};
}

// To 1.001 delta_c and one step more, in mode mixity `angle`: 0 = opening, 90 degrees = shear.
CrackPath separation(const DrivenCrackOptions& options, double angle, int steps) {
  const double reach = 1.001 * options.delta_c();
  const std::array<double, 2> end{reach * std::cos(angle),
                                  reach * std::sin(angle) * options.law.kappa / options.law.beta};
  return drive_crack(options, straight_path(std::span(&end, 1), steps));
}

double error_of_reloading(int steps) {
  const DrivenCrackOptions options = crack(1.5);
  const double d = 0.4 * options.delta_c();
  const std::array<std::array<double, 2>, 1> once{{{d, 0.5 * d}}};
  const std::array<std::array<double, 2>, 5> thrice{
      {{d, 0.5 * d}, {0.1 * d, 0.05 * d}, {d, 0.5 * d}, {0.0, 0.0}, {d, 0.5 * d}}};
  const double lost = drive_crack(options, straight_path(once, steps)).dissipated;
  return (drive_crack(options, straight_path(thrice, steps)).dissipated - lost) / options.fracture_energy;
}

}  // namespace

void show_work_of_separation(Evidence& evidence) {
  const int steps = evidence.is_short() ? 5000 : 20000;
  Column angles{"mode mixity [deg]", {}}, work{"work of the traction over G_c [-]", {}};
  Column booked{"booked dissipation over G_c [-]", {}};
  double largest_work = 0.0, largest_booked = 0.0;
  for (const double beta : {1.0, 1.5, 2.5}) {
    for (int k = 0; k <= 8; ++k) {
      const double angle = k * std::numbers::pi / 16.0;
      const CrackPath path = separation(crack(beta), angle, steps);
      const double by_work = path.work / zeolite_fracture_energy, by_books = path.dissipated / zeolite_fracture_energy;
      largest_work = std::max(largest_work, std::abs(by_work - 1.0));
      largest_booked = std::max(largest_booked, std::abs(by_books - 1.0));
      if (beta != 1.5) continue;
      angles.values.push_back(11.25 * k);
      work.values.push_back(by_work);
      booked.values.push_back(by_books);
    }
  }
  const double shear = separation(crack(1.5, 3.0), 0.5 * std::numbers::pi, steps).work / zeolite_fracture_energy;
  evidence.at_most("|work of the traction/G_c - 1|, modes I, II, mixed [-]", largest_work, 1e-6, "physics.md 3");
  evidence.at_most("|booked dissipation/G_c - 1|, modes I, II, mixed [-]", largest_booked, 1e-6, "physics.md 3");
  evidence.relative("work of mode II over G_c, kappa = 3 [-]", shear, 3.0, 1e-6, "physics.md 3");
  evidence.at_most("|dissipation of two reloadings|/G_c [-]", std::abs(error_of_reloading(steps)), 1e-12, "round-off");
  evidence.curve({angles, work, booked});
  evidence.plot({.title = "Work of separation, beta = 1.5",
                 .x_label = "mode mixity [deg]: 0 = opening, 90 = shear",
                 .y_label = "work over G_c [-]",
                 .series = {{"of the traction", angles.values, work.values, PlotSeries::Style::Points},
                            {"as booked", angles.values, booked.values, PlotSeries::Style::Points},
                            {"G_c", {0.0, 90.0}, {1.0, 1.0}, PlotSeries::Style::Dashes}}});
}

}  // namespace knap
