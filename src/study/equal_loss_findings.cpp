#include "study/equal_loss_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "study/mean_curve.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;
using Runs = std::vector<std::vector<std::size_t>>;  // of each condition

constexpr auto response = "chipping_ratio";
constexpr double least_loss = 1e-3;  // an intact particle may lose as much

/// Losses that are told together.
struct Band {
  std::string name;
  double least = 0.0, most = 0.0;
};
const std::array<Band, 3> bands{{{"0.1 to 1 %", least_loss, 0.01}, {"1 to 10 %", 0.01, 0.1}, {"above 10 %", 0.1, 1.0}}};

/// A speed and angle, and the straight-on speed at which as much is lost, over v sin th.
struct EqualLoss {
  double speed = 0.0, angle = 0.0, normal = 0.0;
  double loss = 0.0;
  double ratio = 0.0;
  std::vector<double> drawn{};  // ratios by draws of the runs
  Interval interval{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
};

/// Where the straight-on impacts stand among all conditions.
std::vector<std::size_t> straight_on(const Series& series) {
  constexpr double same = 1e-6;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < series.conditions.size(); ++i)
    if (std::abs(series.conditions[i].angle - 0.5 * std::numbers::pi) <= same) places.push_back(i);
  return places;
}

MeanCurve straight_curve(const Study& study, const Series& series, const std::vector<std::size_t>& places,
                         const Runs& runs) {
  std::vector<Condition> list;
  Runs own;
  for (const std::size_t i : places) list.push_back(series.conditions[i]), own.push_back(runs[i]);
  return MeanCurve(study, list, own, response);
}

std::vector<EqualLoss> equal_losses(const Study& study, const Series& series, const std::vector<std::size_t>& places) {
  constexpr int samples = 300;
  const MeanCurve straight = straight_curve(study, series, places, runs_of(series.conditions));
  std::vector<EqualLoss> list;
  std::vector<std::size_t> place_of;
  for (std::size_t i = 0; i < series.conditions.size(); ++i) {
    const Condition& condition = series.conditions[i];
    if (std::find(places.begin(), places.end(), i) != places.end()) continue;
    EqualLoss one{.speed = condition.speed,
                  .angle = condition.angle,
                  .normal = normal_speed(condition.speed, condition.angle),
                  .loss = mean_of(study, condition.runs, response)};
    const double speed = straight.speed_of(one.loss);
    if (one.loss < least_loss || speed == straight.slowest() || !std::isfinite(speed)) continue;
    one.ratio = speed / one.normal;
    list.push_back(one), place_of.push_back(i);
  }
  if (!has_repeats(series.conditions)) return list;
  for (const Runs& draw : drawn_conditions(series.conditions, samples)) {
    const MeanCurve curve = straight_curve(study, series, places, draw);
    for (std::size_t k = 0; k < list.size(); ++k) {  // a loss that is not reached counts as that of the fastest
      const double speed = curve.speed_of(mean_of(study, draw[place_of[k]], response));
      list[k].drawn.push_back(std::min(speed, curve.fastest()) / list[k].normal);
    }
  }
  for (EqualLoss& one : list) one.interval = central_95(one.drawn);
  return list;
}

/// a mu by least squares of ratio^2 = 1 + (a mu)^2 cos^2 th, each point by what its ratio is known to. 0 where less is
/// lost than by v sin th.
double fitted_product(const std::vector<EqualLoss>& list, const std::vector<double>& ratios) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double cosine2 = std::pow(std::cos(list[k].angle), 2);
    const double width = list[k].drawn.empty() ? 1.0 : list[k].interval.high - list[k].interval.low;
    const double weight = 1.0 / std::pow(2.0 * list[k].ratio * std::max(width, 1e-3), 2);
    sum += weight * cosine2 * (ratios[k] * ratios[k] - 1.0);
    weights += weight * cosine2 * cosine2;
  }
  return std::sqrt(std::max(0.0, sum / weights));
}

void add_band(const Band& band, const std::vector<EqualLoss>& all, const Series& series, PageSection& section,
              Findings& findings, Json& json) {
  std::vector<EqualLoss> within;
  std::vector<double> ratios;
  for (const EqualLoss& one : all)
    if (one.loss >= band.least && one.loss < band.most) within.push_back(one), ratios.push_back(one.ratio);
  if (within.size() < 2) return;
  const double product = fitted_product(within, ratios);
  std::vector<double> drawn;
  for (std::size_t k = 0; k < within.front().drawn.size(); ++k) {
    for (std::size_t i = 0; i < within.size(); ++i) ratios[i] = within[i].drawn[k];
    drawn.push_back(fitted_product(within, ratios));
  }
  const Interval interval = central_95(drawn);
  json["bands"].push_back({{"loss", {band.least, band.most}},
                           {"conditions", within.size()},
                           {"a_mu", json_of(product)},
                           {"interval", json_of(interval)}});
  section.rows.push_back({fmt::format("a μ where {} is lost", band.name), fmt::format("{:.2f}", product),
                          shown(interval), fmt::format("{} speeds and angles", within.size())});
  if (std::isfinite(interval.low))
    findings.verdicts.push_back(
        fmt::format("{}: where {} is lost under an angle, as much is lost straight on at v_eq "
                    "with a μ = {} ({} speeds and angles).",
                    titled("Equal loss", series), band.name, shown(product, interval), within.size()));
}

PlotInput plot_of(const std::vector<EqualLoss>& all, const Series& series) {
  PlotInput plot{.title = titled("straight-on speed of equal loss", series),
                 .x_label = "v sin θ [m/s]",
                 .y_label = "straight-on speed of equal loss over v sin θ [-]"};
  double slowest = all.front().normal, fastest = slowest;
  for (const double angle : angles_of(series)) {
    PlotSeries points{.name = fmt::format("{:.4g}°", angle / degree), .style = PlotSeries::Style::Points};
    for (const EqualLoss& one : all) {
      if (one.angle != angle) continue;
      slowest = std::min(slowest, one.normal), fastest = std::max(fastest, one.normal);
      points.x.push_back(one.normal), points.y.push_back(one.ratio);
      if (!one.drawn.empty()) points.low.push_back(one.interval.low), points.high.push_back(one.interval.high);
    }
    if (!points.x.empty()) plot.series.push_back(points);
  }
  plot.series.push_back({.name = "normal component alone", .x = {slowest, fastest}, .y = {1.0, 1.0}});
  return plot;
}

}  // namespace

void add_equal_loss(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                    Json& json) {
  const std::vector<std::size_t> places = straight_on(series);
  if (places.size() < 2) return;
  const std::vector<EqualLoss> all = equal_losses(study, series, places);
  if (all.empty()) return;
  PageSection section{.title = titled("Equal loss straight on", series)};
  section.paragraphs.push_back(
      "The straight-on speed at which as much is lost as under an angle, over v sin θ, without any law of breakage "
      "between. By the equivalent velocity it is √(1 + (a μ cos θ)²), the same at all speeds; 1 is the normal "
      "component "
      "alone, less a tangential velocity that saves the particle. Of the mean chipping ratio, where 0.1 % or more is "
      "lost and as much is reached straight on. a μ by least squares, 0 also where less is lost than by v sin θ, and "
      "above 1 where the points ask for it.");
  Json result;
  for (const EqualLoss& one : all)
    result["conditions"].push_back({{"angle_deg", one.angle / degree},
                                    {"speed", one.speed},
                                    {"normal_speed", one.normal},
                                    {"loss", one.loss},
                                    {"ratio", one.ratio},
                                    {"interval", json_of(one.interval)}});
  for (const Band& band : bands) add_band(band, all, series, section, findings, result);
  json["equal_loss"] = result;
  add_figure(findings, section, "equal_loss" + suffix, plot_of(all, series), "");
  findings.sections.push_back(std::move(section));
}

}  // namespace knap
