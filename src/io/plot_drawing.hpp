#pragma once
#include <string>

#include "io/plot.hpp"

namespace knap {

inline constexpr int plot_width = 1200;  ///< [pixels]
inline constexpr int plot_height = 800;

/// The bytes of the files. Text is drawn as outlines: the SVG looks the same wherever it is opened.
std::string png_of_plot(const PlotInput& input);
std::string svg_of_plot(const PlotInput& input);

}  // namespace knap
