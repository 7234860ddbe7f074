#pragma once
#include <vector>

#include "simulation/observer.hpp"

namespace knap {

/// Where and when facets fail, and which way they face; places in the unbroken particle.
struct CrackEvent {
  double time = 0.0;   ///< of full failure [s]
  Vec3 place, normal;  ///< centroid [m], unit
  double area = 0.0;   ///< [m2]

  /// Share of the normal along the azimuth about the z axis: 1 = on a meridional plane.
  double azimuthal() const {
    const Vec3 around = Vec3(-place.y(), place.x(), 0.0).normalized();
    return std::abs(normal.dot(around));
  }
};

/// Collects the failures of a run.
class CrackEvents : public Observer {
 public:
  explicit CrackEvents(std::int64_t interval) : Observer(interval) {}
  void look(const Simulation& s) override;
  const std::vector<CrackEvent>& events() const { return events_; }

 private:
  std::vector<bool> seen_{};
  std::vector<CrackEvent> events_{};
};

}  // namespace knap
