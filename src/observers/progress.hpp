#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "simulation/observer.hpp"

namespace knap {

struct ProgressOptions {
  enum class Style {
    Terminal,  ///< one line, rewritten in place
    Lines      ///< a line now and then
  };
  Style style = Style::Lines;
  double end_time = 0.0;                           ///< expected [s]
  bool end_is_expected = false;                    ///< the run may end earlier or later
  std::function<void(const std::string&)> show{};  ///< takes a plain line; for a terminal, raw text to print
  int width = 0;                                   ///< columns of the terminal, 0 = not known
};

/// Tells how far a run is.
class Progress : public Observer {
 public:
  explicit Progress(ProgressOptions options);
  void look(const Simulation& s) override;
  /// The last word, as a plain line, when the run has ended.
  void finish(const Simulation& s);
  /// Wipes the line on the terminal so that something else can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void update_rate(const Simulation& s, double seconds);
  void show(const Simulation& s);

  ProgressOptions options_;
  Clock::time_point last_ = Clock::now();
  std::int64_t last_step_ = -1;
  double rate_ = 0.0;  ///< steps per second, smoothed
};

/// What one line of progress says.
struct ProgressNumbers {
  double time = 0.0;      ///< [s]
  double end_time = 0.0;  ///< [s]
  bool end_is_expected = false;
  double rate = 0.0;          ///< [steps/s]; 0 = not known
  double time_left = 0.0;     ///< [s]; negative = not known
  double cracked_area = 0.0;  ///< [m2]
  Index fragments = 1;
  double closure_error = 0.0;  ///< [-]
};
std::string progress_line(const ProgressNumbers& numbers);

}  // namespace knap
