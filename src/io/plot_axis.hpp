#pragma once
#include <string>
#include <vector>

#include "io/plot.hpp"

namespace knap {

/// An axis of a plot, in the values as drawn: decimal logarithms where it is logarithmic.
struct PlotAxis {
  double low = 0.0, high = 1.0;  ///< its ends
  std::vector<double> ticks{};
  std::vector<std::string> labels{};  ///< of the ticks

  /// Where a value lies: 0 at the low end, 1 at the high one.
  double part(double value) const { return (value - low) / (high - low); }
};

/// The axes of a plot whose values are as drawn. Markers keep clear of the ends.
PlotAxis x_axis_of(const PlotInput& input);
PlotAxis y_axis_of(const PlotInput& input);

}  // namespace knap
