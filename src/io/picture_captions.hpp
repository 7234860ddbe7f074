#pragma once
#include <vtkRenderer.h>

#include "io/picture_geometry.hpp"

namespace knap {

/// Title, subtitle, captions of the views, scale of damage and the fragments' shares of the mass, in a renderer that
/// covers the whole picture; `scale` = its pixels per pixel of the finished picture.
void add_captions(vtkRenderer* page, const PictureInput& input, const PictureGeometry& geometry, double scale);

}  // namespace knap
