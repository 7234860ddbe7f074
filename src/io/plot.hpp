#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace knap {

struct PlotSeries {
  enum class Style { Line, Dashes, Points };
  std::string name{};  ///< in the legend, UTF-8 as all texts; "" = not there
  std::vector<double> x{}, y{};
  Style style = Style::Line;
  std::optional<std::size_t> colour{};  ///< a number; without one the series' own, counted from 0
  std::vector<double> low{}, high{};    ///< ends of error bars in y; empty = none
};

/// A value of x worth knowing: a dashed line from top to bottom.
struct PlotMark {
  double x = 0.0;
  std::string name{};
};

struct PlotInput {
  std::string title{};
  std::string x_label{}, y_label{};  ///< with units
  std::vector<PlotSeries> series{};
  bool log_x = false, log_y = false;  ///< logarithmic axes, for values above 0
  std::vector<PlotMark> marks{};
};

/// Draws curves as a PNG of 1200 x 800 pixels. Throws RuntimeFailure where it cannot be drawn (a value that is not
/// finite, or not above 0 on a logarithmic axis), std::invalid_argument for series of unequal lengths.
void draw_plot(const std::filesystem::path& png, const PlotInput& input);
/// The same as stem.png and stem.svg.
void draw_plot_twice(const std::filesystem::path& stem, const PlotInput& input);

}  // namespace knap
