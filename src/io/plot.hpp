#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace knap {

struct PlotSeries {
  enum class Style { Line, Dashes, Points };
  std::string name{};  ///< in the legend, UTF-8 as all texts
  std::vector<double> x{}, y{};
  Style style = Style::Line;
};

struct PlotInput {
  std::string title{};
  std::string x_label{}, y_label{};  ///< with units
  std::vector<PlotSeries> series{};
  bool log_x = false, log_y = false;  ///< logarithmic axes, for values above 0
  std::chrono::seconds timeout{60};   ///< for each attempt to draw
};

/// Draws curves as a PNG of 1200 x 800 pixels, in a process of its own as render_picture does. Throws
/// RuntimeFailure where it cannot be drawn (a value that is not finite, or not above 0 on a logarithmic axis),
/// std::invalid_argument for series of unequal lengths.
void draw_plot(const std::filesystem::path& png, const PlotInput& input);

}  // namespace knap
