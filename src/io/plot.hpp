#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace knap {

struct PlotSeries {
  enum class Style { Line, Points };
  std::string name;  ///< in the legend, UTF-8 as all texts
  std::vector<double> x{}, y{};
  Style style = Style::Line;
};

struct PlotInput {
  std::string title;
  std::string x_label, y_label;  ///< with units
  std::vector<PlotSeries> series;
  std::chrono::seconds timeout{60};  ///< for each attempt to draw
};

/// Draws curves over linear axes as a PNG of 1200 x 800 pixels, in a process of its own as render_picture does. Throws
/// RuntimeFailure where it cannot be drawn, std::invalid_argument for series of unequal lengths.
void draw_plot(const std::filesystem::path& png, const PlotInput& input);

}  // namespace knap
