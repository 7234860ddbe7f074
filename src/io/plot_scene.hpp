#pragma once
#include "io/plot.hpp"

namespace knap {

inline constexpr int plot_width = 1200;  ///< [pixels]
inline constexpr int plot_height = 800;

/// Draws on the display $DISPLAY and returns the bytes of the PNG. May abort the process or hang where OpenGL is
/// broken; throws RuntimeFailure where it is missing. To be called in a process of its own.
std::string png_of_plot(const PlotInput& input);

}  // namespace knap
