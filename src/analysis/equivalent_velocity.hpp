#pragma once
// The equivalent velocity of an oblique impact (Wang et al. 2019), v_eq = v sin th sqrt(1 + (a mu cos th)^2): does the
// breakage of all angles fall on one curve over it, and better than over the normal velocity alone?
#include <span>
#include <vector>

#include "analysis/fit.hpp"
#include "analysis/statistics.hpp"

namespace knap {

/// One run, or the mean of some.
struct ObliqueImpact {
  double speed = 0.0;     ///< [m/s]
  double angle = 0.0;     ///< from the plane of the wall [rad]
  double friction = 0.0;  ///< mu of particle and wall
  double breakage = 0.0;  ///< 0 to 1
};

/// `a_mu` is a times mu; at most 1, beyond it v_eq does not rise with the angle any more.
double equivalent_velocity(double speed, double angle, double a_mu);

/// A curve over a velocity: b_max (1 - exp(-(v/v_scale)^exponent)).
struct BreakageCurve {
  double plateau = 1.0;  ///< b_max
  double scale = 1.0;    ///< [m/s]
  double exponent = 1.0;

  double operator()(double velocity) const;
};

/// How the friction enters: a product a mu for all (free), or one a times each run's own mu.
enum class FrictionRule { FreeProduct, KnownFriction };

/// On which scale runs and curve are compared: as they are, or as asin(sqrt(b)), on which shares scatter alike whether
/// few or many break (Bartlett 1947): the runs near the threshold then count as much as those far above it.
enum class BreakageScale { Plain, Stabilised };

struct Collapse {
  double value = 0.0;      ///< a mu, or a
  double product = 0.0;    ///< the largest a mu of any wall
  Interval interval{};     ///< 95 %, bootstrap over the runs of each speed and angle
  bool is_at_end = false;  ///< 0, or a mu = 1
  BreakageCurve curve{};
  double rms = 0.0;                         ///< of runs about the curve, on the scale of the comparison
  double left_out_rms = 0.0;                ///< mean of each angle's runs about the curve of the other angles
  std::vector<double> left_out_by_angle{};  ///< rms, in the order of angles()
};

struct CollapseComparison {
  Collapse model{};          ///< with the friction term
  Collapse null{};           ///< normal component only: v sin th
  Interval gain{};           ///< 95 % of left_out_rms of null minus model
  double scatter = 0.0;      ///< as left_out_rms, of runs about the mean of their own speed and angle
  bool has_repeats = false;  ///< else there are no intervals and no verdict
};

/// Whether the best a mu is so small that v_eq is v sin th, within 0.2 %.
bool is_null_rule(const CollapseComparison& comparison);

enum class CollapseVerdict { Beats, Loses, Undecided };
/// By whether the interval of the gain lies above, below or around zero, by more than a hundredth of the null's
/// error; undecided without repeats, and where a mu is so small that both rules are one.
CollapseVerdict verdict(const CollapseComparison& comparison);

/// The different angles, ascending [rad].
std::vector<double> angles(std::span<const ObliqueImpact> impacts);

/// Fits both. Throws std::invalid_argument for fewer than three angles or ten impacts, where
/// no wall has friction, or where the speeds and angles left are too few for the curve.
CollapseComparison compare_collapse(std::span<const ObliqueImpact> impacts, FrictionRule rule,
                                    BreakageScale scale = BreakageScale::Plain, int samples = 300);

}  // namespace knap
