#pragma once
#include <filesystem>
#include <string>

#include "io/vtk_writer.hpp"

namespace knap {

/// Where a time series of frames lies: <run>/<folder>/<stem>_0000.vtu, ..., listed in <run>/<folder>.pvd.
struct FrameSeriesOptions {
  std::filesystem::path run;
  std::string folder;
  std::string stem;
  std::int64_t interval = 1;  ///< steps between two regular frames
};

/// The frames of a run, numbered in order: frame n is of step n x interval, but for the last one.
class FrameSeries {
 public:
  explicit FrameSeries(FrameSeriesOptions options) : options_(std::move(options)) {}
  /// Keeps the regular frames up to `step` (time step dt [s]) and removes the rest.
  void resume(std::int64_t step, double dt);

  bool has(std::int64_t step) const { return step == last_step_; }
  void add(const VtkGrid& grid, std::int64_t step, double time);

 private:
  std::string file_name(std::size_t number) const;

  FrameSeriesOptions options_;
  std::vector<PvdFrame> frames_;
  std::int64_t last_step_ = -1;
};

}  // namespace knap
