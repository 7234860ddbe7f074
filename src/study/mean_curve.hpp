#pragma once
#include "study/condition_plots.hpp"

namespace knap {

/// The mean of a share over the speeds that were run. Between them the logarithm of the mean goes linearly with that of
/// the speed, where either mean is a millionth or more: near a threshold a line through the values themselves would lie
/// far above the curve.
class MeanCurve {
 public:
  /// `runs`: of each condition of `list`, in the order of the speeds.
  MeanCurve(const Study& study, const std::vector<Condition>& list, const std::vector<std::vector<std::size_t>>& runs,
            const std::string& response);

  /// NaN outside the speeds that were run.
  double at(double speed) const;
  /// The speed at which the mean first reaches a level, the slowest one if it does there already; infinity if it never
  /// does.
  double speed_of(double level) const;
  double slowest() const { return speeds_.front(); }
  double fastest() const { return speeds_.back(); }

 private:
  std::vector<double> speeds_{}, means_{};
};

}  // namespace knap
