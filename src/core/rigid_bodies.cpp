#include "core/rigid_bodies.hpp"

namespace knap {

Mat3 inverse_mass_at(const RigidBody& body, const Vec3& point) {
  const Vec3 r = point - body.centre;
  Mat3 cross;
  cross << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
  return Mat3::Identity() / body.mass - cross * body.inverse_inertia_world * cross;
}

}  // namespace knap
