#pragma once
#include "observers/frame_series.hpp"
#include "observers/particle_grid.hpp"
#include "simulation/observer.hpp"

namespace knap {

/// frames/*.vtu, cracks/*.vtu and tools/*.vtu with their .pvd, every `interval` steps and at the end.
class VtkFrames : public Observer {
 public:
  VtkFrames(const std::filesystem::path& run, std::int64_t interval, Relabel relabel);
  /// Keeps the regular frames up to `step` and removes the rest.
  void resume(std::int64_t step, double dt);
  void look(const Simulation& s) override;

 private:
  FrameSeries particle_;
  FrameSeries cracks_;
  FrameSeries tools_;
  Relabel relabel_;
};

}  // namespace knap
