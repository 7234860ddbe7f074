#include "analysis/equivalent_velocity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace knap {
namespace {

using Impacts = std::vector<ObliqueImpact>;

/// One way to fit: null, or with the term of friction.
struct Model {
  FrictionRule rule = FrictionRule::FreeProduct;
  bool has_friction_term = true;
  BreakageScale breakage_scale = BreakageScale::Plain;

  double velocity(const ObliqueImpact& impact, double value) const {
    const double factor = rule == FrictionRule::KnownFriction ? impact.friction : 1.0;
    return equivalent_velocity(impact.speed, impact.angle, has_friction_term ? value * factor : 0.0);
  }
};

double scaled(const Model& model, double breakage) {
  if (model.breakage_scale == BreakageScale::Plain) return breakage;
  return std::asin(std::sqrt(std::clamp(breakage, 0.0, 1.0)));
}

// The term of friction last, where there is one.
std::vector<FitParameter> parameters_of(const Model& model, std::span<const ObliqueImpact> impacts) {
  double fastest = 0.0, most_friction = 0.0;
  for (const ObliqueImpact& impact : impacts) {
    fastest = std::max(fastest, impact.speed);
    most_friction = std::max(most_friction, impact.friction);
  }
  std::vector<FitParameter> parameters{{"plateau", "-", 0.01, 1.0, true},
                                       {"scale", "m/s", 0.05 * fastest, 20.0 * fastest, true},
                                       {"exponent", "-", 0.3, 60.0, true}};
  if (!model.has_friction_term) return parameters;
  if (model.rule == FrictionRule::FreeProduct)
    parameters.push_back({"a_mu", "-", 0.0, 1.0});
  else
    parameters.push_back({"a", "-", 0.0, 1.0 / most_friction});
  return parameters;
}

BreakageCurve curve_of(std::span<const double> values) { return {values[0], values[1], values[2]}; }

// Impacts alike as their mean: the sum of squares is the same but for a constant, and is found sooner.
struct Means {
  Impacts impacts{};            // with the mean breakage, scaled
  std::vector<double> roots{};  // of their number
};

std::vector<std::vector<std::size_t>> groups_of(std::span<const ObliqueImpact> impacts) {
  std::map<std::array<double, 3>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < impacts.size(); ++i)
    groups[{impacts[i].speed, impacts[i].angle, impacts[i].friction}].push_back(i);
  std::vector<std::vector<std::size_t>> list;
  for (const auto& [key, members] : groups) list.push_back(members);
  return list;
}

Means means_of(const Model& model, std::span<const ObliqueImpact> impacts) {
  Means means;
  for (const auto& group : groups_of(impacts)) {
    ObliqueImpact middle = impacts[group.front()];
    middle.breakage = 0.0;
    for (const std::size_t i : group)
      middle.breakage += scaled(model, impacts[i].breakage) / static_cast<double>(group.size());
    means.impacts.push_back(middle);
    means.roots.push_back(std::sqrt(static_cast<double>(group.size())));
  }
  return means;
}

// Weighted law and data over `means`, which must outlive them.
Law law_of(const Model& model, const Means& means) {
  return [&means, model](std::span<const double> values, std::size_t i) {
    return means.roots[i] *
           scaled(model, curve_of(values)(model.velocity(means.impacts[i], values.size() > 3 ? values[3] : 0.0)));
  };
}

std::vector<double> breakage_of(const Means& means) {
  std::vector<double> breakage;
  for (std::size_t i = 0; i < means.impacts.size(); ++i) breakage.push_back(means.roots[i] * means.impacts[i].breakage);
  return breakage;
}

// Locally from a guess, and from another strength of the friction term: the loss may have two minima there.
std::vector<double> refitted(const Model& model, const Impacts& impacts, const std::vector<double>& guess) {
  const Means means = means_of(model, impacts);
  const std::vector<double> breakage = breakage_of(means);
  const Law law = law_of(model, means);
  const std::vector<FitParameter> parameters = parameters_of(model, impacts);
  std::vector<double> best = refit(parameters, law, breakage, guess);
  if (!model.has_friction_term) return best;
  std::vector<double> other = guess;
  other[3] = guess[3] < 0.25 * parameters[3].high ? 0.5 * parameters[3].high : 0.0;
  other = refit(parameters, law, breakage, other);
  return rms_residual(law, other, breakage) < rms_residual(law, best, breakage) ? other : best;
}

double rms_of(const Model& model, const Impacts& impacts, std::span<const double> values) {
  double squares = 0.0;
  for (const ObliqueImpact& impact : impacts) {
    const double at = curve_of(values)(model.velocity(impact, values.size() > 3 ? values[3] : 0.0));
    const double miss = scaled(model, at) - scaled(model, impact.breakage);
    squares += miss * miss;
  }
  return std::sqrt(squares / static_cast<double>(impacts.size()));
}

// For each angle: how far its runs are from the curve of the others.
std::vector<double> left_out(const Model& model, const Impacts& impacts, const std::vector<double>& guess) {
  std::vector<double> errors;
  for (const double angle : angles(impacts)) {
    Impacts others, own;
    for (const ObliqueImpact& impact : impacts) (impact.angle == angle ? own : others).push_back(impact);
    errors.push_back(rms_of(model, own, refitted(model, others, guess)));
  }
  return errors;
}

Collapse collapse_of(const Model& model, const Impacts& impacts, std::vector<double>& values) {
  const Means means = means_of(model, impacts);
  const Fit fit = least_squares_fit(parameters_of(model, impacts), law_of(model, means), breakage_of(means));
  values = fit.values;
  Collapse collapse{.curve = curve_of(values), .rms = rms_of(model, impacts, values)};
  if (model.has_friction_term) {
    collapse.value = values[3], collapse.is_at_end = fit.is_at_end[3];
    collapse.product = values[3] / fit.parameters[3].high;  // whose end is where that product is 1
  }
  collapse.left_out_by_angle = left_out(model, impacts, values);
  collapse.left_out_rms = mean(collapse.left_out_by_angle);
  return collapse;
}

// Mean over angles of the rms of runs about the mean of their group.
double scatter_of(const Model& model, std::span<const ObliqueImpact> impacts) {
  std::map<double, std::vector<double>> squares;
  for (const auto& group : groups_of(impacts)) {
    std::vector<double> values;
    for (const std::size_t i : group) values.push_back(scaled(model, impacts[i].breakage));
    for (const double value : values)
      squares[impacts[group.front()].angle].push_back((value - mean(values)) * (value - mean(values)));
  }
  std::vector<double> errors;
  for (const auto& [angle, of_angle] : squares) errors.push_back(std::sqrt(mean(of_angle)));
  return mean(errors);
}

// The fewest groups that are left when an angle is left out.
std::size_t fewest_left(std::span<const ObliqueImpact> impacts) {
  const auto groups = groups_of(impacts);
  std::map<double, std::size_t> by_angle;
  for (const auto& group : groups) ++by_angle[impacts[group.front()].angle];
  std::size_t most = 0;
  for (const auto& [angle, count] : by_angle) most = std::max(most, count);
  return groups.size() - most;
}

}  // namespace

double equivalent_velocity(double speed, double angle, double a_mu) {
  const double term = a_mu * std::cos(angle);
  return speed * std::sin(angle) * std::sqrt(1.0 + term * term);
}

double BreakageCurve::operator()(double velocity) const {
  return plateau * -std::expm1(-std::pow(std::max(0.0, velocity) / scale, exponent));
}

bool is_null_rule(const CollapseComparison& comparison) {
  constexpr double least_product = 0.05;
  return comparison.model.product < least_product;
}

CollapseVerdict verdict(const CollapseComparison& comparison) {
  if (is_null_rule(comparison)) return CollapseVerdict::Undecided;
  const double least = 1e-2 * comparison.null.left_out_rms;  // what matters, and beyond what fits find by chance
  if (comparison.gain.low > least) return CollapseVerdict::Beats;
  return comparison.gain.high < -least ? CollapseVerdict::Loses : CollapseVerdict::Undecided;
}

std::vector<double> angles(std::span<const ObliqueImpact> impacts) {
  std::vector<double> list;
  for (const ObliqueImpact& impact : impacts) list.push_back(impact.angle);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

CollapseComparison compare_collapse(std::span<const ObliqueImpact> impacts, FrictionRule rule, BreakageScale scale,
                                    int samples) {
  if (angles(impacts).size() < 3 || impacts.size() < 10)
    throw std::invalid_argument("equivalent velocity: needs at least three angles and ten impacts");
  const bool has_friction = std::any_of(impacts.begin(), impacts.end(), [](const auto& i) { return i.friction > 0.0; });
  if (!has_friction) throw std::invalid_argument("equivalent velocity: no wall has friction");
  const Model model{rule, true, scale}, null{rule, false, scale};
  constexpr std::size_t num_parameters = 4;
  if (fewest_left(impacts) <= num_parameters)
    throw std::invalid_argument("equivalent velocity: too few speeds and angles");
  const Impacts all(impacts.begin(), impacts.end());
  std::vector<double> model_values, null_values;
  CollapseComparison result{.model = collapse_of(model, all, model_values),
                            .null = collapse_of(null, all, null_values),
                            .scatter = scatter_of(model, impacts)};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  result.has_repeats = impacts.size() >= 2 * groups_of(impacts).size();
  result.model.interval = result.gain = {nan, nan};
  if (!result.has_repeats) return result;
  std::vector<double> values, gains;
  for (const auto& pick : bootstrap_picks(groups_of(impacts), samples)) {
    Impacts drawn;
    for (const std::size_t i : pick) drawn.push_back(all[i]);
    const std::vector<double> fitted = refitted(model, drawn, model_values);
    values.push_back(fitted[3]);
    gains.push_back(mean(left_out(null, drawn, refitted(null, drawn, null_values))) -
                    mean(left_out(model, drawn, fitted)));
  }
  result.model.interval = central_95(values);
  result.gain = central_95(gains);
  return result;
}

}  // namespace knap
