#pragma once
#include <functional>
#include <string>

#include "simulation/observer.hpp"

namespace knap {

/// Warns once when the energy balance is off by more than `energy_warning`, and once when a tet is inverted.
class EnergyWatch : public Observer {
 public:
  explicit EnergyWatch(std::function<void(const std::string&)> warn);
  void look(const Simulation& s) override;

 private:
  std::function<void(const std::string&)> warn_;
  bool warned_ = false;
  bool warned_of_inversion_ = false;
};

}  // namespace knap
