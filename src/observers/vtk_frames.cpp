#include "observers/vtk_frames.hpp"

#include "observers/crack_grid.hpp"
#include "observers/tool_grid.hpp"

namespace knap {

VtkFrames::VtkFrames(const std::filesystem::path& run, std::int64_t interval, Relabel relabel)
    : Observer(interval),
      particle_({run, "frames", "frame", interval}),
      cracks_({run, "cracks", "cracks", interval}),
      tools_({run, "tools", "tools", interval}),
      relabel_(std::move(relabel)) {}

void VtkFrames::resume(std::int64_t step, double dt) {
  particle_.resume(step, dt);
  cracks_.resume(step, dt);
  tools_.resume(step, dt);
}

void VtkFrames::look(const Simulation& s) {
  if (!particle_.has(s.clock.step)) particle_.add(particle_grid(s, relabel_), s.clock.step, s.clock.time());
  if (!cracks_.has(s.clock.step)) cracks_.add(crack_grid(s), s.clock.step, s.clock.time());
  if (!s.tools.empty() && !tools_.has(s.clock.step)) tools_.add(tool_grid(s), s.clock.step, s.clock.time());
}

}  // namespace knap
