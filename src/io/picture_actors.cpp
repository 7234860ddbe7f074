#include "io/picture_actors.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkLightKit.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace knap {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr Rgb ink{38, 38, 42};
constexpr float line_width = 4.0F;  // [pixels of the enlarged picture]

constexpr int num_rings = 48;
constexpr int num_spokes = 96;
constexpr double wall_extent = 1.45;  // in radii of the particle

/// Darkest under the particle, as if in its shadow, and white at the rim.
Rgb wall_colour(Index point) {
  const double r = wall_extent * (point / num_spokes) / num_rings;  // in radii of the particle
  const double fade = 1.0 - std::pow(r / wall_extent, 3.0);
  const double grey = 255.0 - fade * (26.0 + 62.0 * std::exp(-2.5 * r * r));
  const auto value = static_cast<std::uint8_t>(std::lround(grey));
  return {value, value, value};
}

vtkNew<vtkCellArray> wall_quads() {
  vtkNew<vtkCellArray> quads;
  for (vtkIdType ring = 0; ring < num_rings; ++ring) {
    for (vtkIdType spoke = 0; spoke < num_spokes; ++spoke) {
      const vtkIdType next = (spoke + 1) % num_spokes;
      const vtkIdType base = ring * num_spokes;
      quads->InsertNextCell({base + spoke, base + next, base + num_spokes + next, base + num_spokes + spoke});
    }
  }
  return quads;
}

// Maps a surface with normals that keep its edges sharp.
vtkNew<vtkPolyDataMapper> shaded_mapper(vtkPolyData* data) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SetFeatureAngle(35.0);
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  return mapper;
}

}  // namespace

vtkNew<vtkPoints> vtk_points(const std::vector<Vec3>& points) {
  vtkNew<vtkPoints> target;
  target->SetDataTypeToDouble();
  target->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) target->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  return target;
}

vtkNew<vtkUnsignedCharArray> vtk_colours(Index n, const std::function<Rgb(Index)>& colour) {
  vtkNew<vtkUnsignedCharArray> target;
  target->SetName("colour");
  target->SetNumberOfComponents(3);
  target->SetNumberOfTuples(n);
  for (Index i = 0; i < n; ++i) {
    const Rgb rgb = colour(i);
    target->SetTypedTuple(i, rgb.data());
  }
  return target;
}

void add_lit_surface(vtkRenderer* view, vtkPolyData* data) {
  const vtkNew<vtkPolyDataMapper> mapper = shaded_mapper(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.18);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecular(0.08);
  actor->GetProperty()->SetSpecularPower(25.0);
  view->AddActor(actor);
}

void add_flat(vtkRenderer* view, vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  view->AddActor(actor);
}

void add_lines(vtkRenderer* view, vtkPolyData* data) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-4.0, -4.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(ink[0] / 255.0, ink[1] / 255.0, ink[2] / 255.0);
  actor->GetProperty()->SetLineWidth(line_width);
  view->AddActor(actor);
}

void add_wall(vtkRenderer* view, const Vec3& centre, double radius) {
  std::vector<Vec3> points;
  for (int ring = 0; ring <= num_rings; ++ring) {
    const double r = wall_extent * radius * ring / num_rings;
    for (int spoke = 0; spoke < num_spokes; ++spoke) {
      const double angle = 2.0 * std::numbers::pi * spoke / num_spokes;
      points.emplace_back(centre + r * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
  }
  vtkNew<vtkPolyData> disc;
  disc->SetPoints(vtk_points(points));
  disc->SetPolys(wall_quads());
  disc->GetPointData()->SetScalars(vtk_colours(to_index(points.size()), wall_colour));
  add_flat(view, disc);
}

void add_ghost(vtkRenderer* view, vtkPolyData* data) {
  const vtkNew<vtkPolyDataMapper> mapper = shaded_mapper(data);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.62, 0.64, 0.68);
  actor->GetProperty()->SetOpacity(0.35);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.75);
  view->AddActor(actor);
}

void aim(vtkRenderer* view, const std::vector<Vec3>& shown, const Framing& framing) {
  constexpr double margin = 1.06;
  const double a = framing.azimuth * degree;
  const double e = framing.elevation * degree;
  const Vec3 away{std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e)};
  const Vec3 right{std::cos(a), std::sin(a), 0.0};
  Mat3 axes;
  axes << right, away.cross(right), away;
  Eigen::AlignedBox3d box;
  for (const Vec3& point : shown) box.extend(axes.transpose() * point);
  box.min().y() -= framing.floor * box.sizes().y();
  const Vec3 target = axes * box.center();
  const Vec3 position = target + 4.0 * box.diagonal().norm() * away;
  const double aspect = view->GetTiledAspectRatio();
  vtkCamera* camera = view->GetActiveCamera();
  camera->SetFocalPoint(target.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(margin * std::max(box.sizes().y(), box.sizes().x() / aspect) / 2.0);
  view->ResetCameraClippingRange();
}

void add_lights(vtkRenderer* view) {
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.92);
  lights->SetKeyLightAngle(48.0, -28.0);
  lights->SetKeyToFillRatio(2.0);
  lights->SetKeyToHeadRatio(2.8);
  lights->SetKeyToBackRatio(4.0);
  lights->SetKeyLightWarmth(0.54);
  lights->SetFillLightWarmth(0.46);
  lights->AddLightsToRenderer(view);
}

}  // namespace knap
