#pragma once
#include "simulation/simulation.hpp"

namespace knap {

/// Looks at a run every `interval` steps, and only looks.
class Observer {
 public:
  explicit Observer(std::int64_t interval) : interval_(interval) {}
  virtual ~Observer() = default;
  virtual void look(const Simulation& s) = 0;
  std::int64_t interval() const { return interval_; }

 private:
  std::int64_t interval_;
};

}  // namespace knap
