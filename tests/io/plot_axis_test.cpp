#include "io/plot_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knap {
namespace {

// As drawn: logarithms where the axis is logarithmic.
PlotInput points(std::vector<double> x, bool is_logarithmic) {
  if (is_logarithmic)
    for (double& value : x) value = std::log10(value);
  return {.series = {{.x = x, .y = x}}, .log_x = is_logarithmic, .log_y = is_logarithmic};
}

TEST(PlotAxis, RoundStepsAroundTheValues) {
  const PlotAxis axis = x_axis_of(points({0.3, 9.2}, false));
  EXPECT_EQ(axis.labels.front(), "0");
  EXPECT_EQ(axis.labels.back(), "10");
  EXPECT_LE(axis.ticks.size(), 9U);
  EXPECT_DOUBLE_EQ(axis.part(axis.low), 0.0);
  EXPECT_DOUBLE_EQ(axis.part(axis.high), 1.0);
}

TEST(PlotAxis, DecadesAndTheirParts) {
  EXPECT_EQ(x_axis_of(points({1.0, 1e6}, true)).labels,
            (std::vector<std::string>{"1", "10", "100", "1000", "10000", "100000", "1e+06"}));
  EXPECT_EQ(x_axis_of(points({1.0, 50.0}, true)).labels, (std::vector<std::string>{"1", "2", "5", "10", "20", "50"}));
}

TEST(PlotAxis, LessThanADecadeHasRoundSteps) {
  const PlotAxis axis = x_axis_of(points({14.0, 18.0}, true));
  ASSERT_GE(axis.ticks.size(), 3U);
  for (std::size_t i = 0; i < axis.ticks.size(); ++i)
    EXPECT_NEAR(std::pow(10.0, axis.ticks[i]), std::stod(axis.labels[i]), 1e-9);
}

TEST(PlotAxis, MarksAndErrorBarsAreWithin) {
  PlotInput input = points({1.0, 2.0}, false);
  input.marks.push_back({5.0, "far"});
  input.series[0].low = {-3.0, 1.0}, input.series[0].high = {1.5, 7.0};
  EXPECT_GE(x_axis_of(input).high, 5.0);
  EXPECT_LE(y_axis_of(input).low, -3.0);
  EXPECT_GE(y_axis_of(input).high, 7.0);
}

}  // namespace
}  // namespace knap
