// OpenCASCADE, because the built-in kernel has no exact ellipsoid.
#include <gmsh.h>

#include "meshing/shapes/geometry.hpp"

namespace knap {

void add_geometry(const Ellipsoid& ellipsoid, const Mat3& orientation) {
  namespace occ = gmsh::model::occ;
  const gmsh::vectorpair sphere{{3, occ::addSphere(0.0, 0.0, 0.0, 0.5)}};
  const Eigen::AngleAxisd turn(orientation);
  if (turn.angle() != 0.0)
    occ::rotate(sphere, 0.0, 0.0, 0.0, turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle());
  const Vec3& d = ellipsoid.diameters;
  occ::dilate(sphere, 0.0, 0.0, 0.0, d.x(), d.y(), d.z());
  occ::synchronize();
}

}  // namespace knap
