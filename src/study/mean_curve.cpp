#include "study/mean_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knap {
namespace {

constexpr double least = 1e-6;

bool is_line(double a, double b) { return std::max(a, b) <= least; }

}  // namespace

MeanCurve::MeanCurve(const Study& study, const std::vector<Condition>& list,
                     const std::vector<std::vector<std::size_t>>& runs, const std::string& response) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    speeds_.push_back(list[k].speed);
    means_.push_back(mean_of(study, runs[k], response));
  }
}

double MeanCurve::at(double speed) const {
  constexpr double same = 1e-6;
  for (std::size_t k = 0; k < speeds_.size(); ++k)
    if (std::abs(speeds_[k] - speed) <= same * speed) return means_[k];
  for (std::size_t k = 1; k < speeds_.size(); ++k) {
    const double low = speeds_[k - 1], high = speeds_[k], before = means_[k - 1], after = means_[k];
    if (speed < low || speed > high) continue;
    if (is_line(before, after)) return before + (after - before) * (speed - low) / (high - low);
    const double a = std::max(before, least), b = std::max(after, least);
    return a * std::pow(b / a, std::log(speed / low) / std::log(high / low));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double MeanCurve::speed_of(double level) const {
  for (std::size_t k = 0; k < speeds_.size(); ++k) {
    if (means_[k] < level) continue;
    if (k == 0) return speeds_[0];
    const double low = speeds_[k - 1], high = speeds_[k], before = means_[k - 1], after = means_[k];
    if (is_line(before, after)) return low + (level - before) / (after - before) * (high - low);
    const double a = std::max(before, least), b = std::max(after, least);
    return low * std::pow(high / low, std::log(std::max(level, a) / a) / std::log(b / a));
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace knap
