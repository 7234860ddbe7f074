#include "study/equal_loss_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "study/condition_plots.hpp"

namespace knap {
namespace {

using Json = nlohmann::ordered_json;
using Runs = std::vector<std::vector<std::size_t>>;  // of each condition

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto response = "chipping_ratio";
constexpr double least_loss = 1e-3;  // an intact particle may lose as much

/// Losses that are told together.
struct Band {
  std::string name;
  double least = 0.0, most = 0.0;
};
const std::array<Band, 2> bands{{{"0.1 to 5 %", least_loss, 0.05}, {"more than 5 %", 0.05, 1.0}}};

// Where the mean over the runs first reaches a loss: between speeds by straight lines of the logarithms. NaN where it
// does not, or does at the lowest speed already.
double speed_of_loss(const Study& study, const std::vector<Condition>& list, const Runs& runs, double loss) {
  double before = 0.0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const double now = mean_of(study, runs[k], response);
    if (now >= loss) {
      if (k == 0) return nan;
      const double low = list[k - 1].speed, high = list[k].speed;
      if (before <= 0.0) return low + loss / now * (high - low);
      return low * std::pow(high / low, std::log(loss / before) / std::log(now / before));
    }
    before = now;
  }
  return nan;
}

/// A condition's, and the same by draws of the runs.
struct EqualLoss {
  Condition condition;
  double loss = 0.0;
  double ratio = 0.0;  // straight-on speed over v sin th
  std::vector<double> drawn{};
};

double product_of(double ratio, double angle) {
  return std::sqrt(std::max(0.0, ratio * ratio - 1.0)) / std::cos(angle);
}

std::vector<EqualLoss> equal_losses(const Study& study, const Series& series, const std::vector<Condition>& straight) {
  constexpr int samples = 300;
  std::vector<EqualLoss> list;
  for (const Condition& condition : series.conditions) {
    if (condition.angle == straight.front().angle) continue;
    std::vector<Condition> all = straight;
    all.push_back(condition);
    const double normal = normal_speed(condition.speed, condition.angle);
    const auto ratio_of = [&](const Runs& runs) {
      return speed_of_loss(study, straight, runs, mean_of(study, runs.back(), response)) / normal;
    };
    Runs runs;
    for (const Condition& one : all) runs.push_back(one.runs);
    EqualLoss one{.condition = condition, .loss = mean_of(study, condition.runs, response), .ratio = ratio_of(runs)};
    if (one.loss < least_loss || !std::isfinite(one.ratio)) continue;
    if (has_repeats(all))
      for (const auto& draw : drawn_conditions(all, samples)) one.drawn.push_back(ratio_of(draw));
    list.push_back(std::move(one));
  }
  return list;
}

// The median over conditions, and its interval over the draws.
void add_band(const Band& band, const std::vector<EqualLoss>& all, const Series& series, PageSection& section,
              Findings& findings, Json& json) {
  std::vector<const EqualLoss*> within;
  for (const EqualLoss& one : all)
    if (one.loss >= band.least && one.loss < band.most) within.push_back(&one);
  if (within.size() < 2) return;
  const auto median_of = [&](const auto& ratio) {
    std::vector<double> products;
    for (const EqualLoss* one : within)
      if (const double value = ratio(*one); std::isfinite(value))
        products.push_back(product_of(value, one->condition.angle));
    return products.empty() ? nan : quantile(products, 0.5);
  };
  const double product = median_of([](const EqualLoss& one) { return one.ratio; });
  std::vector<double> drawn;
  for (std::size_t k = 0; k < within.front()->drawn.size(); ++k)
    drawn.push_back(median_of([&](const EqualLoss& one) { return one.drawn.empty() ? nan : one.drawn[k]; }));
  const Interval interval = central_95(drawn);
  json["bands"].push_back({{"loss", {band.least, band.most}},
                           {"conditions", within.size()},
                           {"a_mu_median", json_of(product)},
                           {"interval", json_of(interval)}});
  section.rows.push_back({fmt::format("median a μ where {} is lost", band.name), fmt::format("{:.2f}", product),
                          shown(interval), fmt::format("{} speeds and angles", within.size())});
  findings.verdicts.push_back(
      fmt::format("{}: where {} is lost, as much is lost straight on as if a μ were {} (median of {}).",
                  titled("Equal loss", series), band.name, shown(product, interval), within.size()));
}

}  // namespace

void add_equal_loss(Findings& findings, const Study& study, const Series& series, const std::string& suffix,
                    Json& json) {
  const std::vector<Condition> straight = at_steepest_angle(series);
  constexpr double same = 1e-6;
  if (std::abs(straight.front().angle - 0.5 * std::numbers::pi) > same) return;
  const std::vector<EqualLoss> all = equal_losses(study, series, straight);
  if (all.empty()) return;
  PageSection section{.title = titled("Equal loss straight on", series)};
  section.paragraphs.push_back(
      "The straight-on speed at which as much is lost as under an angle, over v sin θ, without any law of breakage "
      "between. "
      "By the equivalent velocity it is √(1 + (a μ cos θ)²), the same at all speeds; 1 is the normal component alone, "
      "less "
      "is a tangential velocity that saves the particle, for which a μ counts as 0. Of the mean chipping ratio, where "
      "0.1 % "
      "or more is lost and as much is reached straight on; between speeds by straight lines of the logarithms.");
  Json result;
  PlotInput plot{.title = titled("straight-on speed of equal loss", series),
                 .x_label = "v sin θ [m/s]",
                 .y_label = "straight-on speed of equal loss over v sin θ [-]"};
  for (const double angle : angles_of(series)) {
    PlotSeries points{.name = fmt::format("{:.4g}°", angle / degree), .style = PlotSeries::Style::Points};
    for (const EqualLoss& one : all) {
      if (one.condition.angle != angle) continue;
      const double normal = normal_speed(one.condition.speed, angle);
      const Interval interval = central_95(one.drawn);
      points.x.push_back(normal), points.y.push_back(one.ratio);
      points.low.push_back(std::isfinite(interval.low) ? interval.low : one.ratio);
      points.high.push_back(std::isfinite(interval.high) ? interval.high : one.ratio);
      result["conditions"].push_back({{"angle_deg", angle / degree},
                                      {"speed", one.condition.speed},
                                      {"normal_speed", normal},
                                      {"loss", one.loss},
                                      {"ratio", one.ratio},
                                      {"interval", json_of(interval)},
                                      {"a_mu", product_of(one.ratio, angle)}});
    }
    if (!points.x.empty()) plot.series.push_back(points);
  }
  double slowest = plot.series.front().x.front(), fastest = slowest;
  for (const PlotSeries& points : plot.series)
    for (const double x : points.x) slowest = std::min(slowest, x), fastest = std::max(fastest, x);
  plot.series.push_back({.name = "normal component alone", .x = {slowest, fastest}, .y = {1.0, 1.0}});
  for (const Band& band : bands) add_band(band, all, series, section, findings, result);
  json["equal_loss"] = result;
  add_figure(findings, section, "equal_loss" + suffix, plot, "");
  findings.sections.push_back(std::move(section));
}

}  // namespace knap
