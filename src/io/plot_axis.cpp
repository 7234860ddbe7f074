#include "io/plot_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace knap {
namespace {

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void extend(const std::vector<double>& values) {
    for (const double value : values) low = std::min(low, value), high = std::max(high, value);
  }
};

void add_tick(PlotAxis& axis, double position, double value) {
  axis.ticks.push_back(position);
  axis.labels.push_back(fmt::format("{:.6g}", value));
}

// About seven round numbers around the values: steps of 1, 2 or 5 times a power of ten.
PlotAxis linear_axis(const Interval& range) {
  constexpr double most_ticks = 8.0;
  const double width = std::max(range.high - range.low, 1e-3 * std::abs(range.high) + 1e-300);
  const double power = std::pow(10.0, std::floor(std::log10(width / most_ticks)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (width / step > most_ticks) step = factor * power;
  double first = std::floor(range.low / step), last = std::ceil(range.high / step);
  if (first == last) first -= 1.0, last += 1.0;  // a single value that is a multiple of the step
  PlotAxis axis{.low = first * step, .high = last * step};
  for (double i = first; i <= last; ++i) add_tick(axis, i * step, i * step);
  return axis;
}

// Whole decades, also twice and five times them where there are few.
PlotAxis logarithmic_axis(const Interval& range) {
  const double margin = std::max(0.04 * (range.high - range.low), 0.02);
  PlotAxis axis{.low = range.low - margin, .high = range.high + margin};
  const double decades = std::ceil(axis.high) - std::floor(axis.low);
  const double step = std::ceil(decades / 10.0);
  for (double i = std::floor(axis.low); i <= axis.high; i += step)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, i), position = std::log10(value);
      if ((factor == 1.0 || decades <= 3.0) && position >= axis.low && position <= axis.high)
        add_tick(axis, position, value);
    }
  constexpr std::size_t fewest_ticks = 3;
  if (axis.ticks.size() >= fewest_ticks) return axis;
  axis.ticks.clear(), axis.labels.clear();  // less than a decade: round steps
  const double low = std::pow(10.0, axis.low), high = std::pow(10.0, axis.high);
  for (const double value : linear_axis({low, high}).ticks)
    if (value >= low && value <= high) add_tick(axis, std::log10(value), value);
  return axis;
}

PlotAxis axis_around(bool is_logarithmic, const Interval& all, const Interval& markers) {
  PlotAxis axis = is_logarithmic ? logarithmic_axis(all) : linear_axis(all);
  const double room = 0.03 * (axis.high - axis.low);
  axis.low = std::min(axis.low, markers.low - room);
  axis.high = std::max(axis.high, markers.high + room);
  return axis;
}

}  // namespace

PlotAxis x_axis_of(const PlotInput& input) {
  Interval all, markers;
  for (const PlotSeries& series : input.series) {
    all.extend(series.x);
    if (series.style == PlotSeries::Style::Points) markers.extend(series.x);
  }
  for (const PlotMark& mark : input.marks) all.extend({mark.x});
  return axis_around(input.log_x, all, markers);
}

PlotAxis y_axis_of(const PlotInput& input) {
  Interval all, markers;
  for (const PlotSeries& series : input.series) {
    for (const auto* values : {&series.y, &series.low, &series.high}) all.extend(*values);
    if (series.style == PlotSeries::Style::Points) markers.extend(series.y);
  }
  return axis_around(input.log_y, all, markers);
}

}  // namespace knap
