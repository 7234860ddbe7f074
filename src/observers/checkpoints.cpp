#include "observers/checkpoints.hpp"

#include "simulation/persistent_arrays.hpp"

namespace knap {
namespace {

constexpr std::int64_t steps_between_looks_at_the_clock = 8;

}  // namespace

Checkpoints::Checkpoints(std::filesystem::path path, double seconds)
    : Observer(steps_between_looks_at_the_clock), path_(std::move(path)), interval_(seconds) {}

void Checkpoints::look(const Simulation& s) {
  if (interval_.count() > 0.0 && Clock::now() - last_ >= interval_) write(s);
}

void Checkpoints::write(const Simulation& s) {
  write_checkpoint(path_, make_checkpoint(s));
  last_ = Clock::now();
}

}  // namespace knap
