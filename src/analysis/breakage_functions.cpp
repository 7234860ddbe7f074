#include "analysis/breakage_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace knap {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double largest_energy(std::span<const EnergyImpact> impacts) {
  double largest = 0.0;
  for (const EnergyImpact& impact : impacts) largest = std::max(largest, impact.energy);
  if (!(largest > 0.0)) throw std::invalid_argument("breakage functions: no impact has energy");
  return largest;
}

std::vector<bool> outcomes_of(std::span<const EnergyImpact> impacts) {
  std::vector<bool> outcomes;
  for (const EnergyImpact& impact : impacts) outcomes.push_back(impact.is_broken);
  return outcomes;
}

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Rising f: where it reaches `value`, between low and high, which it halves by their geometric mean.
template <class Function>
double where_reached(const Function& f, double value, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (f(middle) < value ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

FitParameter f_x_parameter(double largest) { return {"f_x", "kg/J", 1e-2 / largest, 1e4 / largest, true}; }
FitParameter least_energy_parameter(double largest) { return {"W_min", "J/kg", 0.0, largest}; }

}  // namespace

double vogel_peukert(double energy, double f_x, double least_energy, double impacts) {
  return energy > least_energy ? -std::expm1(-f_x * impacts * (energy - least_energy)) : 0.0;
}

Fit fit_vogel_peukert(std::span<const EnergyImpact> impacts) {
  const double largest = largest_energy(impacts);
  return probability_fit(
      {f_x_parameter(largest), least_energy_parameter(largest)},
      [&](std::span<const double> p, std::size_t i) { return vogel_peukert(impacts[i].energy, p[0], p[1]); },
      outcomes_of(impacts));
}

Fit fit_shi_kojovic(std::span<const EnergyImpact> impacts) {
  const double largest = largest_energy(impacts);
  std::vector<double> energy, t10;
  for (const EnergyImpact& impact : impacts)
    if (std::isfinite(impact.t10)) energy.push_back(impact.energy), t10.push_back(impact.t10);
  return least_squares_fit(
      {{"M", "-", 1e-4, 1.0, true}, f_x_parameter(largest), least_energy_parameter(largest)},
      [&](std::span<const double> p, std::size_t i) { return p[0] * vogel_peukert(energy[i], p[1], p[2]); }, t10);
}

double tavares_probability(double energy, double e50, double sigma, double e_max_ratio) {
  const double e_max = e_max_ratio * e50;
  if (energy <= 0.0) return 0.0;
  if (energy >= e_max) return 1.0;
  const double relative = std::isinf(e_max) ? energy : e_max * energy / (e_max - energy);
  return normal_probability(std::log(relative / e50) / sigma);
}

Fit fit_tavares(std::span<const EnergyImpact> impacts) {
  const double largest = largest_energy(impacts);
  return probability_fit(
      {{"E50", "J/kg", 1e-3 * largest, 1e2 * largest, true}, {"sigma", "-", 0.01, 5.0, true}},
      [&](std::span<const double> p, std::size_t i) {
        return tavares_probability(impacts[i].energy, p[0], p[1], infinity);
      },
      outcomes_of(impacts));
}

double median_broken_energy(double energy, double e50, double sigma) {
  const auto probability = [&](double e) { return tavares_probability(e, e50, sigma, infinity); };
  return where_reached(probability, 0.5 * probability(energy), 1e-12 * energy, energy);
}

Fit fit_tavares_t10(std::span<const EnergyImpact> impacts, double e50, double sigma) {
  std::vector<double> ratio, t10;
  for (const EnergyImpact& impact : impacts)
    if (impact.is_broken && std::isfinite(impact.t10)) {
      ratio.push_back(impact.energy / median_broken_energy(impact.energy, e50, sigma));
      t10.push_back(impact.t10);
    }
  return least_squares_fit(
      {{"A", "-", 1e-4, 1.0, true}, {"b'", "-", 1e-4, 1e2, true}},
      [&](std::span<const double> p, std::size_t i) { return p[0] * -std::expm1(-p[1] * ratio[i]); }, t10);
}

double tavares_damage(double energy, double breakage_energy, double gamma) {
  if (energy >= breakage_energy) return 1.0;
  double damage = 0.0, last = -1.0;
  for (int i = 0; i < 1000 && damage - last > 1e-14; ++i) {  // from below: rises to the least root
    last = damage;
    damage = std::pow(2.0 * gamma / (2.0 * gamma - 5.0 * damage + 5.0) * energy / breakage_energy, 0.4 * gamma);
  }
  return std::min(damage, 1.0);
}

int impacts_to_break(double energy, double breakage_energy, double gamma, int most) {
  for (int n = 1; n <= most; ++n) {
    if (energy >= breakage_energy) return n;
    breakage_energy *= 1.0 - tavares_damage(energy, breakage_energy, gamma);
  }
  return most + 1;
}

Fit fit_damage(std::span<const RepeatedImpacts> particles, double e50, double sigma) {
  int most = 0;
  for (const RepeatedImpacts& particle : particles) most = std::max(most, particle.impacts);
  const Loss loss = [&](std::span<const double> p) {
    // Over the energy of an impact: the breakage energy up to which n impacts break. It depends on nothing else.
    std::vector<double> reach{0.0};
    for (int n = 1; n <= most; ++n) {
      const auto takes_longer = [&](double e) { return impacts_to_break(1.0, e, p[0], n) > n ? 1.0 : 0.0; };
      reach.push_back(where_reached(takes_longer, 0.5, 1.0, 1e3));
    }
    const auto within = [&](const RepeatedImpacts& particle, int n) {
      return tavares_probability(reach[static_cast<std::size_t>(n)] * particle.energy, e50, sigma, infinity);
    };
    constexpr double least = 1e-9;
    double sum = 0.0;
    for (const RepeatedImpacts& particle : particles) {
      const double before = within(particle, particle.impacts - (particle.is_broken ? 1 : 0));
      const double by_last = particle.is_broken ? within(particle, particle.impacts) - before : 1.0 - before;
      sum -= std::log(std::max(by_last, least));
    }
    return sum;
  };
  return likelihood_fit({{"gamma", "-", 0.5, 50.0, true}}, loss, particles.size());
}

Fit fit_speed_weibull(std::span<const double> speeds, const std::vector<bool>& is_broken) {
  if (speeds.empty()) throw std::invalid_argument("Weibull in speed: no impacts");
  const double fastest = *std::max_element(speeds.begin(), speeds.end());
  return probability_fit(
      {{"v_s", "m/s", 0.05 * fastest, 20.0 * fastest, true}, {"m", "-", 0.3, 100.0, true}},
      [&](std::span<const double> p, std::size_t i) { return -std::expm1(-std::pow(speeds[i] / p[0], p[1])); },
      is_broken);
}

}  // namespace knap
