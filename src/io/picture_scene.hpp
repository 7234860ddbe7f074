#pragma once
#include "io/picture_geometry.hpp"

namespace knap {

inline constexpr int picture_width = 2400;  ///< [pixels]
inline constexpr int picture_height = 900;

/// Draws on the display $DISPLAY and returns the bytes of the PNG. May abort the process or hang where OpenGL is
/// broken; throws RuntimeFailure where it is missing. To be called in a process of its own.
std::string png_of_picture(const PictureInput& input, const PictureGeometry& geometry);

}  // namespace knap
