// Twenty patches over an icosahedron, filled between splines; the surface vertices are moved onto the ellipsoid once
// the surface is meshed. OpenCASCADE has exact ellipsoids, but their seam and poles left slivers in half of the meshes
// (shape quality down to 0.01), and the built-in kernel's exact patches are for spheres only.
#include <gmsh.h>

#include "meshing/shapes/geometry.hpp"

namespace knap {
namespace {

constexpr double golden = 1.6180339887498949;
const std::array<Vec3, 12> icosahedron_corners{{{-1, golden, 0},
                                                {1, golden, 0},
                                                {-1, -golden, 0},
                                                {1, -golden, 0},
                                                {0, -1, golden},
                                                {0, 1, golden},
                                                {0, -1, -golden},
                                                {0, 1, -golden},
                                                {golden, 0, -1},
                                                {golden, 0, 1},
                                                {-golden, 0, -1},
                                                {-golden, 0, 1}}};
// Counter-clockwise from outside.
constexpr std::array<std::array<std::size_t, 3>, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// The image on the ellipsoid of a direction in the icosahedron's frame.
struct Projection {
  Vec3 diameters;
  Mat3 orientation;
  Vec3 operator()(const Vec3& direction) const {
    return 0.5 * diameters.cwiseProduct(orientation * direction.normalized());
  }
};

int add_point(const Vec3& x) { return gmsh::model::geo::addPoint(x.x(), x.y(), x.z()); }

// A spline through the images of points spread along the edge (a, b).
int add_edge(const Projection& project, std::size_t a, std::size_t b, const std::array<int, 12>& corners) {
  constexpr int segments = 8;
  std::vector<int> points{corners[a]};
  for (int i = 1; i < segments; ++i) {
    const double t = static_cast<double>(i) / segments;
    points.push_back(add_point(project((1.0 - t) * icosahedron_corners[a] + t * icosahedron_corners[b])));
  }
  points.push_back(corners[b]);
  return gmsh::model::geo::addSpline(points);
}

}  // namespace

void add_geometry(const Ellipsoid& ellipsoid, const Mat3& orientation) {
  namespace geo = gmsh::model::geo;
  const Projection project{ellipsoid.diameters, orientation};
  std::array<int, 12> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = add_point(project(icosahedron_corners[i]));
  std::array<std::array<int, 12>, 12> edges{};  // signed curve from row to column, 0 = not made yet
  std::vector<int> patches;
  for (const auto& face : icosahedron_faces) {
    std::vector<int> loop;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % 3];
      if (edges[a][b] == 0) {
        edges[a][b] = add_edge(project, a, b, corners);
        edges[b][a] = -edges[a][b];
      }
      loop.push_back(edges[a][b]);
    }
    patches.push_back(geo::addSurfaceFilling({geo::addCurveLoop(loop)}));
  }
  geo::addVolume({geo::addSurfaceLoop(patches)});
  geo::synchronize();
}

}  // namespace knap
