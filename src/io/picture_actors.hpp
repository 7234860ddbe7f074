#pragma once
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <functional>

#include "io/picture_colours.hpp"

namespace knap {

vtkNew<vtkPoints> vtk_points(const std::vector<Vec3>& points);
/// The colours of n cells or points.
vtkNew<vtkUnsignedCharArray> vtk_colours(Index n, const std::function<Rgb(Index)>& colour);

/// Adds data in its own colours; smooth where the surface is, with edges where it bends by more than 35 degrees.
void add_lit_surface(vtkRenderer* view, vtkPolyData* data);
/// Adds data in exactly its own colours.
void add_flat(vtkRenderer* view, vtkPolyData* data);
/// Adds data as dark lines, never hidden by the faces they lie on.
void add_lines(vtkRenderer* view, vtkPolyData* data);
/// Adds a grey horizontal disc around `centre` that fades into the background, wider than a particle of `radius` [m].
void add_wall(vtkRenderer* view, const Vec3& centre, double radius);

/// Adds data in grey through which one can see.
void add_ghost(vtkRenderer* view, vtkPolyData* data);

struct Framing {
  double azimuth = 0.0;    ///< 0 = seen from -y, counter-clockwise from above [degrees]
  double elevation = 0.0;  ///< [degrees]
  double floor = 0.0;      ///< room under the particle, as a share of its height in the view
};

/// Points the camera so that the box around `shown` in the view fills it.
void aim(vtkRenderer* view, const std::vector<Vec3>& shown, const Framing& framing);
/// Lights that move with the camera: after aim().
void add_lights(vtkRenderer* view);

}  // namespace knap
