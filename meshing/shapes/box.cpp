#include <gmsh.h>

#include "meshing/shapes/geometry.hpp"

namespace knap {

void add_geometry(const Box& box, const Mat3& /*orientation*/) {
  namespace geo = gmsh::model::geo;
  const Vec3 h = 0.5 * box.lengths;
  std::array<int, 8> corner;  // 0-3 around the bottom, 4-7 above them
  for (std::size_t i = 0; i < 8; ++i) {
    const double x = (i % 4 == 1 || i % 4 == 2) ? h.x() : -h.x();
    const double y = i % 4 >= 2 ? h.y() : -h.y();
    corner[i] = geo::addPoint(x, y, i < 4 ? -h.z() : h.z());
  }
  std::array<int, 4> bottom, top, side;
  for (std::size_t i = 0; i < 4; ++i) {
    bottom[i] = geo::addLine(corner[i], corner[(i + 1) % 4]);
    top[i] = geo::addLine(corner[4 + i], corner[4 + (i + 1) % 4]);
    side[i] = geo::addLine(corner[i], corner[4 + i]);
  }
  std::vector<int> faces;
  const auto add_face = [&](const std::vector<int>& curves) {
    faces.push_back(geo::addPlaneSurface({geo::addCurveLoop(curves)}));
  };
  add_face({bottom[0], bottom[1], bottom[2], bottom[3]});
  add_face({top[0], top[1], top[2], top[3]});
  for (std::size_t i = 0; i < 4; ++i) add_face({bottom[i], side[(i + 1) % 4], -top[i], -side[i]});
  geo::addVolume({geo::addSurfaceLoop(faces)});
  geo::synchronize();
}

}  // namespace knap
