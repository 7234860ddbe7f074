#pragma once
// Laws of breakage that process models use, and their fits to single impacts. W is the energy of an impact over the
// particle's mass [J/kg], v_eq^2/2 for an impact on a wall.
#include <span>
#include <vector>

#include "analysis/fit.hpp"

namespace knap {

/// One particle and one impact.
struct EnergyImpact {
  double energy = 0.0;  ///< W [J/kg]
  bool is_broken = false;
  double t10 = 0.0;  ///< NaN = not resolved
};

/// Vogel & Peukert 2003: S = 1 - exp(-f_mat x k (W - W_min)) for k impacts, 0 below W_min; here by f_x = f_mat x
/// [kg/J].
double vogel_peukert(double energy, double f_x, double least_energy, double impacts = 1.0);
/// Most likely "f_x" [kg/J] and "W_min" [J/kg].
Fit fit_vogel_peukert(std::span<const EnergyImpact> impacts);
/// Shi & Kojovic 2007: t10 = M (1 - exp(-f_mat x (W - W_min))): "M" [-], "f_x" [kg/J], "W_min" [J/kg] by least squares.
Fit fit_shi_kojovic(std::span<const EnergyImpact> impacts);

/// Tavares & King 1998, Tavares 2009: P = 1/2 (1 + erf((ln E* - ln E50)/(sqrt 2 sigma))), E* = E_max E/(E_max - E);
/// with `e_max_ratio` = E_max/E50, infinite for a distribution without an upper end.
double tavares_probability(double energy, double e50, double sigma, double e_max_ratio);
/// Most likely "E50" [J/kg] and "sigma" [-], without an upper end.
Fit fit_tavares(std::span<const EnergyImpact> impacts);
/// The median breakage energy of the particles that an impact breaks [J/kg]; without an upper end.
double median_broken_energy(double energy, double e50, double sigma);
/// t10 = A (1 - exp(-b' E/E50b)): "A" and "b'" by least squares over broken particles, E50b of those that break.
Fit fit_tavares_t10(std::span<const EnergyImpact> impacts, double e50, double sigma);

/// Damage of an impact that does not break: the least root of D = [2 g/(2 g - 5 D + 5) E/E_b]^(2 g/5) (Tavares & King
/// 2002), E_b the particle's breakage energy before it; 1 where it breaks.
double tavares_damage(double energy, double breakage_energy, double gamma);
/// How many equal impacts a particle takes until it breaks, its breakage energy falling by (1 - D) each time; `most` +
/// 1 if it stands `most`.
int impacts_to_break(double energy, double breakage_energy, double gamma, int most);

/// One particle under equal impacts.
struct RepeatedImpacts {
  double energy = 0.0;     ///< W of each [J/kg]
  int impacts = 0;         ///< that it got
  bool is_broken = false;  ///< by the last of them
};
/// Most likely "gamma" for breakage energies of this E50 and sigma.
Fit fit_damage(std::span<const RepeatedImpacts> particles, double e50, double sigma);

/// Weibull in speed: P = 1 - exp(-(v/v_s)^m): "v_s" [m/s], "m".
Fit fit_speed_weibull(std::span<const double> speeds, const std::vector<bool>& is_broken);

}  // namespace knap
