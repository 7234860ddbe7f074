#include "analysis/chipping_law.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

namespace knap {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Line {
  double slope = 0.0, offset = 0.0;
};

// Over the logarithms of the means; nothing where fewer than two speeds have lost mass.
std::optional<Line> line_through(const std::map<double, std::vector<double>>& by_speed) {
  std::vector<double> x, y;
  for (const auto& [speed, ratios] : by_speed)
    if (const double middle = mean(ratios); middle > 0.0) x.push_back(std::log(speed)), y.push_back(std::log(middle));
  if (x.size() < 2) return std::nullopt;
  const double mean_x = mean(x), mean_y = mean(y);
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return Line{xy / xx, mean_y - xy / xx * mean_x};
}

}  // namespace

ChippingLaw fit_chipping_law(std::span<const Chipping> runs) {
  std::map<double, std::vector<double>> by_speed;
  for (const Chipping& run : runs) by_speed[run.speed].push_back(run.ratio);
  std::erase_if(by_speed, [](const auto& speed) { return !(mean(speed.second) > 0.0); });
  if (by_speed.size() < 3) throw std::invalid_argument("chipping law: needs three speeds at which something chips");
  std::vector<Chipping> kept;
  std::vector<std::vector<std::size_t>> groups;
  for (const auto& [speed, ratios] : by_speed) {
    groups.emplace_back();
    for (const double ratio : ratios) {
      groups.back().push_back(kept.size());
      kept.push_back({speed, ratio});
    }
  }
  const Line line = *line_through(by_speed);
  std::vector<double> slopes;
  for (const auto& pick : bootstrap_picks(groups, bootstrap_samples)) {
    std::map<double, std::vector<double>> drawn;
    for (const std::size_t i : pick) drawn[kept[i].speed].push_back(kept[i].ratio);
    if (const auto again = line_through(drawn)) slopes.push_back(again->slope);
  }
  return {.exponent = line.slope,
          .factor = std::exp(line.offset),
          .interval = kept.size() >= 2 * groups.size() ? central_95(slopes) : Interval{nan, nan},
          .num_speeds = by_speed.size(),
          .slowest = by_speed.begin()->first,
          .fastest = by_speed.rbegin()->first};
}

}  // namespace knap
