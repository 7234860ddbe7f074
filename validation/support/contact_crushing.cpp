// What is compared: the means over three orientations of the mesh on n elements with those on the finest mesh, for each
// speed. Ten per cent is what the issue of a converged mesh asks; of what is nearly nothing, one per cent of the whole
// energy or mass is as good.
//
// Analysis of what is found out of tolerance: see validation/README.md, "Contact crushing".
#include "validation/support/contact_crushing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace knap {
namespace {

constexpr std::array<int, 4> resolutions{1, 2, 3, 5};
constexpr std::array<double, 5> speeds{8.0, 12.0, 15.0, 18.0, 23.0};  // [m/s]
constexpr int orientations = 3;

struct Quantity {
  const char* name;
  double GranuleOutcome::*field;
};
constexpr std::array<Quantity, 3> quantities{{{"chipping ratio", &GranuleOutcome::chipping},
                                              {"restitution", &GranuleOutcome::restitution},
                                              {"friction loss", &GranuleOutcome::friction}}};

RunConfig case_of(const CrushingStudy& study, int resolution, double speed, int seed) {
  GranuleCase granule = study.granule;
  granule.contact_element_size = study.resolved_length / resolution;
  granule.element_size = std::max(study.far_size, granule.contact_element_size);
  granule.speed = speed;
  granule.seed = seed;
  return granule_case(granule);
}

// All orientations at a speed on a mesh.
using Ensemble = std::vector<GranuleOutcome>;

std::vector<double> values(const Ensemble& ensemble, double GranuleOutcome::*field) {
  std::vector<double> all;
  for (const GranuleOutcome& outcome : ensemble) all.push_back(outcome.*field);
  return all;
}

double tolerance(double finest) { return std::max(0.1 * std::abs(finest), 0.01); }

// The fewest elements from which on all quantities stay within the tolerance of the finest; the finest itself if none.
int cheapest(const std::array<Ensemble, resolutions.size()>& by_resolution) {
  int best = resolutions.back();
  for (std::size_t r = resolutions.size() - 1; r-- > 0;) {
    for (const Quantity& quantity : quantities) {
      const double finest = mean(values(by_resolution.back(), quantity.field));
      if (std::abs(mean(values(by_resolution[r], quantity.field)) - finest) > tolerance(finest)) return best;
    }
    best = resolutions[r];
  }
  return best;
}

void compare(Evidence& evidence, double speed, const std::array<Ensemble, resolutions.size()>& by_resolution) {
  const Ensemble& medium = by_resolution[2];
  const Ensemble& fine = by_resolution[3];
  for (const Quantity& quantity : quantities) {
    const double finest = mean(values(fine, quantity.field));
    evidence.absolute(
        fmt::format("{} at {} m/s, {} against {} elements [-]", quantity.name, speed, resolutions[2], resolutions[3]),
        mean(values(medium, quantity.field)), finest, tolerance(finest),
        "10 %, or 1 % of the whole; means over orientations");
  }
  evidence.tell(fmt::format("fewest elements within 10 % at {} m/s", speed), cheapest(by_resolution),
                "chipping, restitution and friction loss together");
}

}  // namespace

void show_contact_crushing(Evidence& evidence, const CrushingStudy& study) {
  Study runs(evidence.folder() / "study.csv", {"elements in the resolved length", "speed [m/s]", "mesh seed"},
             evidence.keeps_runs());
  std::vector<Column> table{{"speed [m/s]", {}}, {"elements", {}}, {"runs", {}}, {"tets", {}}};
  for (const Quantity& quantity : quantities)
    for (const char* what : {"", " spread"}) table.push_back({fmt::format("{}{} [-]", quantity.name, what), {}});
  PlotInput plot{.title = fmt::format("{}, {:.2f} mm: restitution on finer and finer contacts", study.granule.preset,
                                      1e3 * study.granule.diameter),
                 .x_label = "speed [m/s]",
                 .y_label = "restitution [-]"};
  for (const int resolution : resolutions) plot.series.push_back({fmt::format("{} elements", resolution)});
  for (const double speed : speeds) {
    std::array<Ensemble, resolutions.size()> by_resolution;
    for (std::size_t r = 0; r < resolutions.size(); ++r) {
      Ensemble& ensemble = by_resolution[r];
      for (int seed = 0; seed < orientations; ++seed)
        ensemble.push_back(runs.at_parameters({1.0 * resolutions[r], speed, 1.0 * seed},
                                              [&] { return case_of(study, resolutions[r], speed, seed); }));
      std::vector<double> row{speed, 1.0 * resolutions[r], 1.0 * orientations,
                              mean(values(ensemble, &GranuleOutcome::tets))};
      for (const Quantity& quantity : quantities) {
        row.push_back(mean(values(ensemble, quantity.field)));
        row.push_back(spread(values(ensemble, quantity.field)));
      }
      for (std::size_t i = 0; i < row.size(); ++i) table[i].values.push_back(row[i]);
      plot.series[r].x.push_back(speed);
      plot.series[r].y.push_back(mean(values(ensemble, &GranuleOutcome::restitution)));
    }
    compare(evidence, speed, by_resolution);
  }
  runs.tell_kept(evidence);
  evidence.curve(table);
  evidence.plot(plot);
}

}  // namespace knap
