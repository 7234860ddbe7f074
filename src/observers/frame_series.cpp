#include "observers/frame_series.hpp"

#include <fmt/format.h>

namespace knap {

namespace fs = std::filesystem;

std::string FrameSeries::file_name(std::size_t number) const {
  return fmt::format("{}/{}_{:04}.vtu", options_.folder, options_.stem, number);
}

void FrameSeries::resume(std::int64_t step, double dt) {
  for (std::int64_t regular = 0; regular <= step; regular += options_.interval) {
    const std::string file = file_name(frames_.size());
    if (!fs::exists(options_.run / file)) break;
    frames_.push_back({dt * static_cast<double>(regular), file});
    last_step_ = regular;
  }
  for (std::size_t later = frames_.size(); fs::remove(options_.run / file_name(later));) ++later;
}

void FrameSeries::add(const VtkGrid& grid, std::int64_t step, double time) {
  fs::create_directories(options_.run / options_.folder);
  const std::string file = file_name(frames_.size());
  write_vtu(options_.run / file, grid);
  frames_.push_back({time, file});
  last_step_ = step;
  write_pvd(options_.run / (options_.folder + ".pvd"), frames_);
}

}  // namespace knap
