#pragma once
#include <optional>

#include "io/csv_table.hpp"
#include "simulation/observer.hpp"

namespace knap {

/// history.csv: a row every `interval` steps, just after an energy balance, so that its energies are of that moment.
class History : public Observer {
 public:
  /// Starts the file anew. `interval` is raised to a multiple of `ledger_interval`.
  History(std::filesystem::path path, std::int64_t interval, std::int64_t ledger_interval);
  /// Goes on after the regular rows up to `step`; those behind it, and the last row of a session that ended there, go.
  void resume(std::int64_t step, std::size_t num_tools);

  void look(const Simulation& s) override;
  /// A row off the regular ones: the last of a session.
  void add_last_row(const Simulation& s);

 private:
  bool is_regular(std::int64_t step) const { return step == 0 || (step > 1 && step % interval_ == 1); }
  void add_row(const Simulation& s);

  std::filesystem::path path_;
  std::int64_t interval_;
  std::optional<CsvTable> table_;
  std::int64_t last_step_ = -1;
  double last_time_ = 0.0;       ///< of the row before [s]
  std::vector<Vec3> last_sums_;  ///< impulse and moment of each tool, in the row before [N s, N m s]
};

}  // namespace knap
