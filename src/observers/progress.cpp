#include "observers/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace knap {
namespace {

constexpr std::int64_t steps_between_looks_at_the_clock = 4;
constexpr double seconds_on_a_terminal = 0.25;
constexpr double seconds_between_lines = 10.0;
constexpr double seconds_to_first_line = 1.0;

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string progress_line(const ProgressNumbers& n) {
  const double share = n.end_time > 0.0 ? std::min(1.0, n.time / n.end_time) : 0.0;
  std::string line = fmt::format("{:6.2f} / {}{:.1f} us {:3.0f} %", 1e6 * n.time, n.end_is_expected ? "~" : "",
                                 1e6 * n.end_time, 100.0 * share);
  if (n.time_left >= 0.0) line += fmt::format(" | {} left", duration(n.time_left));
  if (n.rate > 0.0) line += fmt::format(" | {:.0f} steps/s", n.rate);
  line += fmt::format(" | cracks {:.2f} mm2 | {} fragment{} | ledger {:.3f} %", 1e6 * n.cracked_area, n.fragments,
                      n.fragments == 1 ? "" : "s", 100.0 * n.closure_error);
  return line;
}

Progress::Progress(ProgressOptions options)
    : Observer(steps_between_looks_at_the_clock), options_(std::move(options)) {}

void Progress::look(const Simulation& s) {
  if (last_step_ < 0) {
    last_step_ = s.clock.step;
    last_ = Clock::now();
    return;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - last_).count();
  const bool terminal = options_.style == ProgressOptions::Style::Terminal;
  const double wait = terminal ? seconds_on_a_terminal : rate_ > 0.0 ? seconds_between_lines : seconds_to_first_line;
  if (seconds < wait || s.clock.step <= last_step_) return;
  update_rate(s, seconds);
  show(s);
}

void Progress::update_rate(const Simulation& s, double seconds) {
  const double now = static_cast<double>(s.clock.step - last_step_) / seconds;
  const double memory = rate_ > 0.0 ? std::exp(-seconds / 5.0) : 0.0;
  rate_ = memory * rate_ + (1.0 - memory) * now;
  last_step_ = s.clock.step;
  last_ = Clock::now();
}

void Progress::show(const Simulation& s) {
  const double steps_left = (options_.end_time - s.clock.time()) / s.clock.dt;
  std::string line = progress_line({.time = s.clock.time(),
                                    .end_time = options_.end_time,
                                    .end_is_expected = options_.end_is_expected,
                                    .rate = rate_,
                                    .time_left = rate_ > 0.0 && steps_left > 0.0 ? steps_left / rate_ : -1.0,
                                    .cracked_area = s.cracks.cracked_area,
                                    .fragments = s.contact.fragments,
                                    .closure_error = s.ledger.closure_error()});
  if (options_.style == ProgressOptions::Style::Terminal) {
    if (options_.width > 1) line.resize(std::min(line.size(), static_cast<std::size_t>(options_.width - 1)));
    line = "\r\x1b[K" + line;
  }
  options_.show(line);
}

void Progress::clear() {
  if (options_.style == ProgressOptions::Style::Terminal && rate_ > 0.0) options_.show("\r\x1b[K");
}

void Progress::finish(const Simulation& s) {
  // A short run ends before its first line was due: the rate is then that of the whole run.
  const double seconds = std::chrono::duration<double>(Clock::now() - last_).count();
  if (rate_ == 0.0 && last_step_ >= 0 && s.clock.step > last_step_ && seconds > 0.0) update_rate(s, seconds);
  show(s);
  if (options_.style == ProgressOptions::Style::Terminal) options_.show("\n");
}

}  // namespace knap
