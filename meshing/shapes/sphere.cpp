// Eight octant patches of the built-in kernel rather than OpenCASCADE's one face with a seam and two poles: the worst
// surface triangle has a shape quality of 0.8 instead of 0.3-0.6 (10k tets), and vertices lie on the sphere to
// round-off.
#include <gmsh.h>

#include "meshing/shapes/geometry.hpp"

namespace knap {

void add_geometry(const Sphere& sphere, const Mat3& orientation) {
  namespace geo = gmsh::model::geo;
  const auto add_point = [&](const Vec3& direction) {
    const Vec3 x = 0.5 * sphere.diameter * (orientation * direction);
    return geo::addPoint(x.x(), x.y(), x.z());
  };
  const int centre = geo::addPoint(0.0, 0.0, 0.0);
  const std::array<int, 4> equator{add_point({1, 0, 0}), add_point({0, 1, 0}), add_point({-1, 0, 0}),
                                   add_point({0, -1, 0})};
  const int north = add_point({0, 0, 1});
  const int south = add_point({0, 0, -1});

  std::array<int, 4> around, up, down;
  for (std::size_t i = 0; i < 4; ++i) {
    around[i] = geo::addCircleArc(equator[i], centre, equator[(i + 1) % 4]);
    up[i] = geo::addCircleArc(equator[i], centre, north);
    down[i] = geo::addCircleArc(equator[i], centre, south);
  }
  std::vector<int> patches;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const int upper = geo::addCurveLoop({around[i], up[next], -up[i]});
    const int lower = geo::addCurveLoop({-around[i], down[i], -down[next]});
    patches.push_back(geo::addSurfaceFilling({upper}, -1, centre));
    patches.push_back(geo::addSurfaceFilling({lower}, -1, centre));
  }
  geo::addVolume({geo::addSurfaceLoop(patches)});
  geo::synchronize();
}

}  // namespace knap
