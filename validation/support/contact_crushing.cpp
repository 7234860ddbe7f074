// What is compared: the means over three orientations of the mesh on n elements with those on the finest mesh, for each
// speed. Ten per cent is what the issue of a converged mesh asks; of what is nearly nothing, one per cent of the whole
// energy or mass is as good.
//
// N facets in series in a zone that is short against the shear process zone slip together, stably, until their slips
// add up to delta_c; then one of them takes over. Linear softening gives the zone (3 - 3/N + 1/N^2) of one facet's mode
// II energy (shared_slip_factor in analysis/sanity_card.hpp). That is shown by giving coarser meshes more mode II
// energy by the ratio of this factor to the finest mesh's: they must then do what the finest does.
//
// Analysis of what is found out of tolerance: see validation/README.md, "Contact crushing".
#include "validation/support/contact_crushing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "analysis/sanity_card.hpp"

namespace knap {
namespace {

constexpr std::array<int, 4> resolutions{1, 2, 3, 5};
constexpr std::array<double, 5> speeds{8.0, 12.0, 15.0, 18.0, 23.0};  // [m/s]
constexpr int orientations = 3;
// Where all of it is compared with the finest mesh's mode II energy of the zone, too.
constexpr std::array<int, 2> equalised_resolutions{2, 3};
constexpr std::array<double, 3> equalised_speeds{15.0, 18.0, 23.0};  // [m/s]

struct Quantity {
  const char* name;
  double GranuleOutcome::*field;
};
constexpr std::array<Quantity, 3> quantities{{{"chipping ratio", &GranuleOutcome::chipping},
                                              {"restitution", &GranuleOutcome::restitution},
                                              {"friction loss", &GranuleOutcome::friction}}};

// A mesh, what it is thrown at, and the facets' mode II energy.
struct Kind {
  int resolution = 1;
  double speed = 0.0;          // [m/s]
  double mode_ii_ratio = 1.0;  // [-]
};

RunConfig case_of(const CrushingStudy& study, const Kind& kind, int seed) {
  GranuleCase granule = study.granule;
  granule.contact_element_size = study.resolved_length / kind.resolution;
  granule.element_size = std::max(study.far_size, granule.contact_element_size);
  granule.speed = kind.speed;
  granule.seed = seed;
  granule.overrides.push_back(fmt::format("fracture.mode_ii_ratio={}", kind.mode_ii_ratio));
  return granule_case(granule);
}

// All orientations at a speed on a mesh.
using Ensemble = std::vector<GranuleOutcome>;

Ensemble ensemble(GranuleStudy& runs, const CrushingStudy& study, const Kind& kind) {
  Ensemble all;
  for (int seed = 0; seed < orientations; ++seed)
    all.push_back(runs.at_parameters({1.0 * kind.resolution, kind.speed, 1.0 * seed, kind.mode_ii_ratio},
                                     [&] { return case_of(study, kind, seed); }));
  return all;
}

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

// To three digits, as a case would have it.
double equalising_ratio(int resolution) {
  return std::round(1e3 * shared_slip_factor(resolutions.back()) / shared_slip_factor(resolution)) / 1e3;
}

// The restitutions go to a series each.
void compare_equalised(Evidence& evidence, GranuleStudy& runs, const CrushingStudy& study, const Ensemble& fine,
                       double speed, std::span<PlotSeries> series) {
  for (std::size_t i = 0; i < equalised_resolutions.size(); ++i) {
    const int resolution = equalised_resolutions[i];
    const double ratio = equalising_ratio(resolution);
    const Ensemble coarse = ensemble(runs, study, {resolution, speed, ratio});
    for (const Quantity& quantity : quantities) {
      const double finest = mean(values(fine, quantity.field));
      evidence.absolute(
          fmt::format("{} at {} m/s, {} elements and mode II ratio {} [-]", quantity.name, speed, resolution, ratio),
          mean(values(coarse, quantity.field)), finest, tolerance(finest),
          "10 %, or 1 % of the whole; the crushed zone has the mode II energy of the finest mesh");
    }
    series[i].x.push_back(speed);
    series[i].y.push_back(mean(values(coarse, &GranuleOutcome::restitution)));
  }
}

}  // namespace

void show_contact_crushing(Evidence& evidence, const CrushingStudy& study) {
  GranuleStudy runs(evidence.folder() / "study.csv",
                    {"elements in the resolved length", "speed [m/s]", "mesh seed", "mode II ratio [-]"},
                    evidence.keeps_runs());
  std::vector<Column> table{{"speed [m/s]", {}}, {"elements", {}}, {"runs", {}}, {"tets", {}}};
  for (const Quantity& quantity : quantities)
    for (const char* what : {"", " spread"}) table.push_back({fmt::format("{}{} [-]", quantity.name, what), {}});
  PlotInput plot{.title = fmt::format("{}, {:.2f} mm: restitution on finer and finer contacts", study.granule.preset,
                                      1e3 * study.granule.diameter),
                 .x_label = "speed [m/s]",
                 .y_label = "restitution [-]"};
  for (const int resolution : resolutions)
    plot.series.push_back({fmt::format("{} element{}", resolution, resolution == 1 ? "" : "s")});
  for (const int resolution : equalised_resolutions)
    plot.series.push_back({.name = fmt::format("{}, mode II ratio {}", resolution, equalising_ratio(resolution)),
                           .style = PlotSeries::Style::Points});
  for (const double speed : speeds) {
    std::array<Ensemble, resolutions.size()> by_resolution;
    for (std::size_t r = 0; r < resolutions.size(); ++r) {
      Ensemble& all = by_resolution[r] = ensemble(runs, study, {resolutions[r], speed});
      std::vector<double> row{speed, 1.0 * resolutions[r], 1.0 * orientations,
                              mean(values(all, &GranuleOutcome::tets))};
      for (const Quantity& quantity : quantities) {
        row.push_back(mean(values(all, quantity.field)));
        row.push_back(spread(values(all, quantity.field)));
      }
      for (std::size_t i = 0; i < row.size(); ++i) table[i].values.push_back(row[i]);
      plot.series[r].x.push_back(speed);
      plot.series[r].y.push_back(mean(values(all, &GranuleOutcome::restitution)));
    }
    compare(evidence, speed, by_resolution);
    if (std::find(equalised_speeds.begin(), equalised_speeds.end(), speed) != equalised_speeds.end())
      compare_equalised(evidence, runs, study, by_resolution.back(), speed,
                        std::span(plot.series).subspan(resolutions.size()));
  }
  runs.tell_kept(evidence);
  evidence.curve(table);
  evidence.plot(plot);
}

}  // namespace knap
