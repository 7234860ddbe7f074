#include "io/picture_views.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkClipPolyData.h>
#include <vtkCutter.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkPlane.h>
#include <vtkSphere.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/picture_actors.hpp"

namespace knap {
namespace {

constexpr Rgb bare{128, 126, 122};  // what the cut view shows beside the cut itself

/// The surface facets that `is_shown` selects, coloured facet by facet.
vtkNew<vtkPolyData> surface_data(const std::vector<Vec3>& points, const PictureGeometry& geometry,
                                 const std::function<bool(Index)>& is_shown, const std::function<Rgb(Index)>& colour) {
  std::vector<Index> shown;
  for (Index i = 0; i < to_index(geometry.surface.size()); ++i) {
    if (is_shown(i)) shown.push_back(i);
  }
  vtkNew<vtkCellArray> triangles;
  for (const Index i : shown) {
    const auto& nodes = geometry.surface[at(i)];
    triangles->InsertNextCell({nodes[0], nodes[1], nodes[2]});
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(points));
  data->SetPolys(triangles);
  data->GetCellData()->SetScalars(vtk_colours(to_index(shown.size()), [&](Index k) { return colour(shown[at(k)]); }));
  return data;
}

Rgb colour_of_surface(const PictureInput& input, const PictureGeometry& geometry, Index i) {
  const Index fragment = input.fragment_of_tet[at(geometry.tet_of_surface[at(i)])];
  const Rgb colour = fragment_colour(geometry.fragment_rank[at(fragment)]);
  return geometry.is_crack_face[at(i)] ? fracture_colour(colour) : colour;
}

vtkNew<vtkPolyData> crack_line_data(const std::vector<Vec3>& points, const PictureGeometry& geometry) {
  vtkNew<vtkCellArray> lines;
  for (const auto& [a, b] : geometry.crack_lines) lines->InsertNextCell({a, b});
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(points));
  data->SetLines(lines);
  return data;
}

vtkNew<vtkPolyData> broken_facet_data(const PictureInput& input) {
  vtkNew<vtkCellArray> triangles;
  for (const auto& facet : input.broken_facets) triangles->InsertNextCell({facet[0], facet[1], facet[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(vtk_points(input.points));
  data->SetPolys(triangles);
  return data;
}

vtkNew<vtkUnstructuredGrid> damage_data(const PictureInput& input) {
  vtkNew<vtkCellArray> tets;
  for (const TetCorners& tet : input.tets) tets->InsertNextCell({tet[0], tet[1], tet[2], tet[3]});
  vtkNew<vtkUnstructuredGrid> data;
  data->SetPoints(vtk_points(input.points));
  data->SetCells(VTK_TETRA, tets);
  data->GetCellData()->SetScalars(
      vtk_colours(to_index(input.tets.size()), [&](Index t) { return damage_colour(input.damage_of_tet[at(t)]); }));
  return data;
}

/// The section of any data set with the plane.
vtkNew<vtkPolyData> section(vtkDataSet* data, vtkPlane* plane) {
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(data);
  cutter->SetCutFunction(plane);
  cutter->GenerateTrianglesOff();
  cutter->Update();
  vtkNew<vtkPolyData> cut;
  cut->ShallowCopy(cutter->GetOutput());
  return cut;
}

void add_wall_below(vtkRenderer* view, const std::vector<Vec3>& shown, const PictureInput& input,
                    const PictureGeometry& geometry) {
  if (std::isnan(input.wall_height)) return;
  const Vec3 centre{geometry.centre.x(), geometry.centre.y(), input.wall_height};
  double radius = 0.0;
  for (const Vec3& point : shown) radius = std::max(radius, (point - centre).head<2>().norm());
  add_wall(view, centre, radius);
}

/// The tools as far as they are near what is shown, and behind `cut` if there is one.
void add_tools(vtkRenderer* view, const std::vector<Vec3>& shown, const PictureInput& input, vtkPlane* cut) {
  constexpr double reach = 1.5;  // in radii of the sphere around what is shown
  Eigen::AlignedBox3d box;
  for (const Vec3& point : shown) box.extend(point);
  const Vec3 centre = box.center();
  vtkNew<vtkSphere> near;
  near->SetCenter(centre.data());
  near->SetRadius(reach * 0.5 * box.sizes().maxCoeff());
  for (const PictureTool& tool : input.tools) {
    vtkNew<vtkCellArray> triangles;
    for (const auto& [a, b, c] : tool.triangles) triangles->InsertNextCell({a, b, c});
    vtkNew<vtkPolyData> data;
    data->SetPoints(vtk_points(tool.points));
    data->SetPolys(triangles);
    // Large triangles, as of a disc, are cut to small ones first: a clip interpolates distance along their edges.
    vtkNew<vtkLinearSubdivisionFilter> fine;
    fine->SetInputData(data);
    fine->SetNumberOfSubdivisions(tool.triangles.size() < 2000 ? 3 : 0);
    vtkNew<vtkClipPolyData> clip;
    clip->SetInputConnection(fine->GetOutputPort());
    clip->SetClipFunction(near);
    clip->InsideOutOn();
    clip->Update();
    if (cut == nullptr) {
      add_ghost(view, clip->GetOutput());
      continue;
    }
    vtkNew<vtkClipPolyData> rear;
    rear->SetInputData(clip->GetOutput());
    rear->SetClipFunction(cut);
    rear->Update();
    add_ghost(view, rear->GetOutput());
    add_lines(view, section(clip->GetOutput(), cut));
  }
}

}  // namespace

void add_outside_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry) {
  const auto all = [](Index) { return true; };
  const auto colour = [&](Index i) { return colour_of_surface(input, geometry, i); };
  add_lit_surface(view, surface_data(input.points, geometry, all, colour));
  add_lines(view, crack_line_data(input.points, geometry));
  const std::vector<Vec3> shown = main_points(input.points, input, geometry);
  add_wall_below(view, shown, input, geometry);
  add_tools(view, shown, input, nullptr);
  aim(view, shown, {.azimuth = 20.0, .elevation = 14.0, .floor = 0.14});
  add_lights(view);
}

void add_cut_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(geometry.centre.data());
  plane->SetNormal(0.0, 1.0, 0.0);
  vtkNew<vtkClipPolyData> rear;
  const auto all = [](Index) { return true; };
  const auto colour = [&](Index) { return bare; };
  rear->SetInputData(surface_data(input.points, geometry, all, colour));
  rear->SetClipFunction(plane);
  rear->Update();
  add_lit_surface(view, rear->GetOutput());
  add_flat(view, section(damage_data(input), plane));
  add_lines(view, section(broken_facet_data(input), plane));
  const std::vector<Vec3> shown = main_points(input.points, input, geometry);
  add_wall_below(view, shown, input, geometry);
  add_tools(view, shown, input, plane);
  aim(view, shown, {.elevation = 8.0, .floor = 0.14});
  add_lights(view);
}

void add_exploded_view(vtkRenderer* view, const PictureInput& input, const PictureGeometry& geometry) {
  constexpr double spread = 0.7;  // of a fragment's distance from the centre
  const std::vector<Vec3> points = exploded_points(input, geometry, spread);
  const auto no_dust = [&](Index i) {
    return geometry.fragment_rank[at(input.fragment_of_tet[at(geometry.tet_of_surface[at(i)])])] != none;
  };
  const auto colour = [&](Index i) { return colour_of_surface(input, geometry, i); };
  add_lit_surface(view, surface_data(points, geometry, no_dust, colour));
  aim(view, main_points(points, input, geometry), {.azimuth = 20.0, .elevation = 14.0});
  add_lights(view);
}

}  // namespace knap
