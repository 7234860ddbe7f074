// Paths of opening and shear, proportional and not, against the effective-opening law with linear softening as
// published (Camacho & Ortiz 1996; Ortiz & Pandolfi 1999), written out here a second time.
#include <numbers>

#include "validation/problems.hpp"
#include "validation/support/driven_crack.hpp"

namespace knap {
namespace {

constexpr double beta = 1.5, strength = 8.34e6, fracture_energy = 8.6;

DrivenCrackOptions options() {
  return {.law = {.beta = beta}, .strength = strength, .fracture_energy = fracture_energy};
}

// delta = sqrt(beta^2 slip^2 + opening^2); on a new largest delta t = sigma_c (1 - delta/delta_c), below it
// t = t_max delta/delta_max; traction = t/delta (beta^2 slip, opening).
struct PublishedLaw {
  double delta_max = 0.0;  // [m]

  CrackPoint at(double opening, double slip) {
    const double delta_c = 2.0 * fracture_energy / strength;
    const double delta = std::hypot(beta * slip, opening);
    delta_max = std::max(delta_max, delta);
    if (delta == 0.0) return {};
    const double t = strength * std::max(0.0, 1.0 - delta_max / delta_c) * delta / delta_max;
    return {opening, slip, t / delta * opening, t / delta * beta * beta * slip};
  }
};

struct Compared {
  double traction_error = 0.0;  // largest, over the strength [-]
  double energy_error = 0.0;    // dissipated, over G_c [-]
  std::vector<CrackPoint> knap, published;
};

Compared compare(std::span<const std::array<double, 2>> corners, int steps) {
  const CrackPath path = drive_crack(options(), straight_path(corners, steps));
  Compared result{.knap = path.points, .published = {}};
  PublishedLaw law;
  double work = 0.0;
  CrackPoint last;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const CrackPoint& p = path.points[i];
    const CrackPoint q = law.at(p.opening, p.slip);
    result.published.push_back(q);
    // At no opening the published traction has no direction; at the next point it starts from the full strength.
    if (i == 0) continue;
    if (i == 1) last = {0.0, 0.0, q.normal, q.tangent};
    work += 0.5 *
            ((last.normal + q.normal) * (q.opening - last.opening) + (last.tangent + q.tangent) * (q.slip - last.slip));
    last = q;
    // Knap's crack is rigid up to an opening that goes with the square of the step: no direction there either.
    if (std::hypot(beta * p.slip, p.opening) < 1e-6 * options().delta_c()) continue;
    result.traction_error =
        std::max(result.traction_error, std::hypot(p.normal - q.normal, p.tangent - q.tangent) / strength);
  }
  const double stored = 0.5 * (last.normal * last.opening + last.tangent * last.slip);
  result.energy_error = std::abs(path.dissipated - (work - stored)) / fracture_energy;
  return result;
}

std::vector<std::array<double, 2>> proportional(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, reach = 1.01 * options().delta_c();
  return {{reach * std::cos(angle), reach * std::sin(angle) / beta}};
}

struct NamedPath {
  std::string name;
  std::vector<std::array<double, 2>> corners;  // opening, slip [m]
};

std::vector<NamedPath> paths() {
  std::vector<NamedPath> all;
  for (const double angle : {0.0, 30.0, 45.0, 60.0, 90.0})
    all.push_back({"proportional, " + std::to_string(static_cast<int>(angle)) + " deg", proportional(angle)});
  const double d = options().delta_c();
  all.push_back({"opening, then shear", {{0.4 * d, 0.0}, {0.4 * d, d / beta}}});
  all.push_back({"shear, then opening", {{0.0, 0.4 * d / beta}, {1.01 * d, 0.4 * d / beta}}});
  all.push_back({"half closed, then shear", {{0.6 * d, 0.0}, {0.2 * d, 0.0}, {0.2 * d, 0.8 * d / beta}}});
  return all;
}

// Both components over the length of the path's effective opening.
void draw(Evidence& evidence, const Compared& path) {
  PlotSeries normal{.name = "normal traction"}, tangent{.name = "shear traction"};
  PlotSeries published_normal{.name = "published law"}, published_tangent;
  normal.style = tangent.style = PlotSeries::Style::Points;
  published_normal.style = published_tangent.style = PlotSeries::Style::Dashes;
  Column opening{"opening [m]", {}}, slip{"slip [m]", {}};
  const double d = options().delta_c();
  const std::size_t stride = path.knap.size() / 200;
  for (std::size_t i = 1; i < path.knap.size(); i += stride) {
    const CrackPoint& p = path.knap[i];
    const CrackPoint& q = path.published[i];
    const double way = (p.opening + beta * p.slip) / d;
    normal.x.push_back(way), normal.y.push_back(p.normal / strength);
    tangent.x.push_back(way), tangent.y.push_back(p.tangent / strength);
    published_normal.x.push_back(way), published_normal.y.push_back(q.normal / strength);
    published_tangent.x.push_back(way), published_tangent.y.push_back(q.tangent / strength);
    opening.values.push_back(p.opening), slip.values.push_back(p.slip);
  }
  published_tangent.name = "published law, shear";
  evidence.curve({opening,
                  slip,
                  {"normal traction over strength [-]", normal.y},
                  {"shear traction over strength [-]", tangent.y},
                  {"published normal traction over strength [-]", published_normal.y},
                  {"published shear traction over strength [-]", published_tangent.y}});
  evidence.plot({.title = "Mixed mode: opening to 0.4 delta_c, then shear",
                 .x_label = "way of the faces, (opening + beta slip)/delta_c [-]",
                 .y_label = "traction over strength [-]",
                 .series = {normal, tangent, published_normal, published_tangent}});
}

}  // namespace

void show_mixed_mode(Evidence& evidence) {
  double proportional_error = 0.0, other_error = 0.0, energy_error = 0.0;
  for (const NamedPath& path : paths()) {
    const Compared result = compare(path.corners, evidence.is_short() ? 5000 : 20000);
    double& error = path.corners.size() == 1 ? proportional_error : other_error;
    error = std::max(error, result.traction_error);
    energy_error = std::max(energy_error, result.energy_error);
    if (path.name == "opening, then shear") draw(evidence, result);
  }
  const std::string why = "the same law; tractions are read from small changes of large momenta";
  evidence.at_most("traction error over strength, proportional paths [-]", proportional_error, 1e-6, why);
  evidence.at_most("traction error over strength, other paths [-]", other_error, 1e-6, why);
  evidence.at_most("error of the dissipated energy over G_c [-]", energy_error, 1e-5,
                   "the reference integrates along the path by the trapezoidal rule");
}

}  // namespace knap
