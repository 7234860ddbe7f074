#pragma once
#include <vtkRenderer.h>

#include "io/picture_geometry.hpp"

namespace knap {

/// The three views, side by side in the picture.
void add_outside_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry);
void add_cut_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry);
void add_exploded_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry);

}  // namespace knap
