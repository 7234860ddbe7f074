#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "study/findings.hpp"

namespace knap {

inline constexpr Interval any_value{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

/// A number of a run that is told by condition.
struct Measure {
  std::string name;
  std::string unit;
  std::function<double(const StudyRun&)> value;  ///< NaN = not resolved
  Interval range = any_value;                    ///< of what it can be
};
/// Chipping and breakage ratio, t_n, pieces, shapes, energy split.
const std::vector<Measure>& measures();
/// Throws std::out_of_range if there is none of this name.
const Measure& measure(const std::string& name);

/// A measure over the runs of a condition.
struct Spread {
  std::size_t count = 0;        ///< of runs where it is resolved
  double mean = 0.0;            ///< NaN where it is not
  double deviation = 0.0;       ///< of runs
  double between_meshes = 0.0;  ///< deviation of the means of meshes; NaN for one mesh
  double between_seeds = 0.0;   ///< root mean square deviation of seeds about their mesh's mean
  Interval interval{};          ///< of the mean, 95 %, within what the measure can be
};
Spread spread_of(const Study& study, const Condition& condition, const Measure& measure);

/// summary.csv: a row a condition and measure.
void add_summary(Findings& findings, const Study& study);

}  // namespace knap
